# SPDX-License-Identifier: 0BSD
# What drive_train wrote -> figures 2, 3, 6 and 7 of Fliess, Fuchshumer, Schlacher, Sira-Ramirez 2006, as SVG. Variables: run, folder.
#   gnuplot -e "run='RUN.txt'; folder='DIR'" figures.gnuplot
# Blocks: 0 identification, 1 roots, 2 frequency responses, 3 closed loop; main.cpp says which columns.
set encoding utf8
set grid lt 1 lc "gray90"
set border 3
set tics nomirror
set style line 1 lw 1.5 lc "#d55e00"
set style line 2 lw 1.5 lc "#0072b2"
set style line 3 lw 1.5 lc "black" dt 2
set style line 4 lw 1.5 lc "#009e73"
set style line 5 lw 1.5 lc "#cc79a7"
set terminal svg size 900,900 font "sans,13" background "white"

# Both parametrisations of the numerator: roots, magnitude, and the speed that the model gives.
do for [which in "all preset"] {
    set output folder.(which eq "all" ? "/figure_2_all_zeros.svg" : "/figure_3_preset_zeros.svg")
    magnitude = which eq "all" ? 4 : 6
    speed = which eq "all" ? 4 : 5
    set multiplot layout 3,1 margins 0.10,0.97,0.07,0.94 spacing 0,0.09
    set xlabel "real part [rad/s]"
    set ylabel "imaginary part [rad/s]"
    set key inside top left Left reverse
    set xrange [*:*]
    set yrange [*:*]
    roots(kind) = sprintf("< awk '$1 == \"%s\" { print $2, $3 }' '%s'", kind, run)
    if (which eq "all") {
        plot roots("true_pole") with points pt 2 ps 1.4 lw 1.5 lc "black" title "poles of the machine", roots("all_pole") with points pt 2 ps 1.0 lw 1.5 lc "#0072b2" title "poles found", \
             roots("all_zero") with points pt 6 ps 1.0 lw 1.5 lc "#d55e00" title "zeros found"
    } else {
        plot roots("true_pole") with points pt 2 ps 1.4 lw 1.5 lc "black" title "poles of the machine", roots("preset_pole") with points pt 2 ps 1.0 lw 1.5 lc "#0072b2" title "poles found"
    }
    set logscale x
    set format x "%g"
    set xrange [1:100]
    set yrange [*:*]
    set key inside bottom left
    set xlabel "frequency [rad/s]"
    set ylabel "magnitude [dB]"
    plot run index 2 using 1:2 with lines ls 3 title "machine", run index 2 using 1:magnitude with lines ls 2 title "model"
    unset logscale x
    set xrange [0:1.35]
    set xlabel "time [s]"
    set ylabel "speed [rad/s]"
    plot run index 0 using 1:3 with lines ls 1 title "measured", run index 0 using 1:speed with lines ls 2 title "model"
    unset multiplot
}

set key noreverse Right outside top center horizontal
set terminal svg size 900,640
set output folder."/figure_6_loop_shaping.svg"
set multiplot layout 2,1 margins 0.10,0.97,0.09,0.93 spacing 0,0.05
set logscale x
set xrange [1:100]
unset xlabel
set format x ""
set ylabel "magnitude [dB]"
plot run index 2 using 1:6 with lines ls 2 title "model", run index 2 using 1:8 with lines ls 4 title "N1", run index 2 using 1:10 with lines ls 5 title "N2", \
     run index 2 using 1:12 with lines ls 1 title "open loop"
unset key
set format x "%g"
set xlabel "frequency [rad/s]"
set ylabel "phase [deg]"
set yrange [-190:190]
set ytics 90
plot run index 2 using 1:7 with lines ls 2, run index 2 using 1:9 with lines ls 4, run index 2 using 1:11 with lines ls 5, run index 2 using 1:13 with lines ls 1
unset multiplot

set key
set output folder."/figure_7_closed_loop.svg"
set multiplot layout 2,1 margins 0.10,0.97,0.09,0.93 spacing 0,0.05
unset logscale x
set ytics autofreq
set xrange [0:*]
set yrange [*:*]
unset xlabel
set format x ""
set ylabel "speed [rad/s]"
plot run index 3 using 1:4 with lines ls 1 title "PI alone", run index 3 using 1:3 with lines ls 2 title "with notches", run index 3 using 1:2 with lines ls 3 title "wanted"
unset key
set format x "%g"
set xlabel "time [s]"
set ylabel "voltage [V]"
plot run index 3 using 1:6 with lines ls 1, run index 3 using 1:5 with lines ls 2
unset multiplot
