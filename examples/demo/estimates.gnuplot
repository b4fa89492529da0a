# SPDX-License-Identifier: 0BSD
# The four estimates over time beside the published values: estimates.csv -> SVG. Variables: estimates, picture, title.
set terminal svg size 900,760 font "sans,13" background "white"
set output picture
set datafile separator ","
set multiplot layout 4,1 title title margins 0.11,0.97,0.08,0.92 spacing 0,0.05
set grid
set key bottom right
set format x ""
set xrange [0:*]
set ylabel "M [kg]"
set yrange [80:110]
plot estimates using 1:3 every 20::1 with lines lw 2 title "estimate", 95.11 with lines dt 2 lc "black" title "published"
unset key
set ylabel "Fv [N s/m]"
set yrange [150:260]
plot estimates using 1:4 every 20::1 with lines lw 2, 203.5 with lines dt 2 lc "black"
set ylabel "Fc [N]"
set yrange [10:30]
plot estimates using 1:5 every 20::1 with lines lw 2, 20.39 with lines dt 2 lc "black"
set ylabel "offset [N]"
set yrange [-8:2]
set format x
set xlabel "time [s]"
plot estimates using 1:6 every 20::1 with lines lw 2, -3.16 with lines dt 2 lc "black"
unset multiplot
