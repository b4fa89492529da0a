# SPDX-License-Identifier: 0BSD
# The pictures of docs/tutorial.md from what its commands left in FOLDER (a variable): estimates.csv of replay, run.csv of the controller.
set terminal svg size 900,620 font "sans,13" background "white"
set datafile separator ","
set grid
set style line 1 lw 2 lc "#0072b2"
set style line 2 lw 1.5 dt 2 lc "black"

set output folder . "/tutorial_estimates.svg"
set multiplot layout 4,1 margins 0.12,0.97,0.1,0.97 spacing 0,0.04
set key top right
set format x ""
set xrange [0:5]
set ylabel "R [ohm]"
set yrange [0.99:1.01]
set ytics 0.01
plot folder . "/estimates.csv" using 1:(strcol(2) eq "ok" ? $4 : NaN) every 5::1 with lines ls 1 title "estimate", 1.0 with lines ls 2 title "truth"
unset key
set ylabel "J [10^{-4} kg m^2]"
set yrange [2.4:2.6]
set ytics 0.1
plot folder . "/estimates.csv" using 1:(strcol(2) eq "ok" ? 1e4*$5 : NaN) every 5::1 with lines ls 1, 2.5 with lines ls 2
set ylabel "b [10^{-4} N m s/rad]"
set yrange [1.5:2.5]
set ytics 0.5
plot folder . "/estimates.csv" using 1:(strcol(2) eq "ok" ? 1e4*$6 : NaN) every 5::1 with lines ls 1, 2.0 with lines ls 2
set ylabel "Tc [10^{-2} N m]"
set yrange [1.8:2.2]
set ytics 0.2
set format x
set xlabel "time [s]"
plot folder . "/estimates.csv" using 1:(strcol(2) eq "ok" ? 100*$7 : NaN) every 5::1 with lines ls 1, 2.0 with lines ls 2
unset multiplot

set terminal svg size 900,480 font "sans,13" background "white"
set output folder . "/tutorial_speed.svg"
set multiplot layout 2,1 margins 0.1,0.97,0.12,0.97 spacing 0,0.04
set key top right horizontal
set xrange [0:4]
set format x ""
unset xlabel
set arrow 1 from 2, graph 0 to 2, graph 1 nohead lc "gray50" dt 3 lw 2
set ylabel "speed [rad/s]"
set yrange [-110:150]
set ytics 50
plot folder . "/run.csv" using 1:2 every 8::1 with lines ls 2 title "wanted", "" using 1:3 every 8::1 with lines ls 1 title "motor"
set ylabel "error [rad/s]"
set yrange [-25:25]
set ytics 10
set format x
set xlabel "time [s]"
set label 1 "retuned" at 2.03, graph 0.9
plot folder . "/run.csv" using 1:($2-$3) every 4::1 with lines ls 1 notitle
unset multiplot
