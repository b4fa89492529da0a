# SPDX-License-Identifier: 0BSD
# Speed of the motor less its free run on the test stretch, before and after: RECORDING and what discover left in FOUND -> SVG.
# Variables: recording, found, picture. Columns: t,u,i,w of the recording, then t,i,w of the run.
set terminal svg size 900,320 font "sans,13" background "white"
set output picture
set datafile separator ","
set lmargin at screen 0.09
set grid
set key outside top center horizontal
set xrange [3.5:5]
set xlabel "time [s]"
set ylabel "measured - simulated w [rad/s]"
run(name) = "< paste -d, " . recording . " " . found . "/" . name . ".csv"
set object rectangle from graph 0, first -0.2 to graph 1, first 0.2 fillcolor "gray85" fillstyle solid noborder behind
plot run("before") using 1:($4-$7) every 4::1 with lines lw 1.5 lc "#d55e00" title "first model, refitted", \
     run("after") using 1:($4-$7) every 4::1 with lines lw 1.5 lc "#0072b2" title "with what was named", \
     NaN with boxes lc "gray85" fillstyle solid title "two standard deviations of the noise"
