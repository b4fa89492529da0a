# SPDX-License-Identifier: 0BSD
# Speed of the motor less its free run, over time, or over the speed: RECORDING and what discover left in FOUND -> SVG.
# Variables: recording, found, picture; runs: "before" or "before after"; over: "time" or "speed". Columns: t,u,i,w of the recording, then t,i,w of the run.
set terminal svg size 900,320 font "sans,13" background "white"
set output picture
set datafile separator ","
set lmargin at screen 0.09
set grid
set key outside top center horizontal
set xlabel over eq "time" ? "time [s]" : "measured w [rad/s]"
set ylabel "measured - simulated w [rad/s]"
run(name) = "< paste -d, " . recording . " " . found . "/" . name . ".csv"
set object rectangle from graph 0, first -0.2 to graph 1, first 0.2 fillcolor "gray85" fillstyle solid noborder behind
what(name) = name eq "before" ? "first model, refitted" : "with what was named"
across = over eq "time" ? 1 : 4
set style line 1 lc "#d55e00" lw 1.5 pt 7 ps 0.25
set style line 2 lc "#0072b2" lw 1.5 pt 7 ps 0.25
if (over eq "time") {
    plot for [k=1:words(runs)] run(word(runs, k)) using (column(across)):($4-$7) every 4::1 with lines ls k title what(word(runs, k)), \
         NaN with boxes lc "gray85" fillstyle solid title "two standard deviations of the noise"
} else {
    plot for [k=1:words(runs)] run(word(runs, k)) using (column(across)):($4-$7) every 8::1 with points ls k title what(word(runs, k)), \
         NaN with boxes lc "gray85" fillstyle solid title "two standard deviations of the noise"
}
