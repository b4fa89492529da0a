# SPDX-License-Identifier: 0BSD
# What pmsm_drive wrote -> figures 3 to 5 of Delpoux, Floquet 2015, as SVG. Variables: run, folder.
#   gnuplot -e "run='RUN.csv'; folder='DIR'" figures.gnuplot
# Columns: t, status, retuned, wanted omega, omega, v_d, v_q, i_d, i_q, R, L, K, true R, true L, true K.
set encoding utf8
set datafile separator ","
stats run using (strcol(2) eq "filling" ? $1 : NaN) every ::1 name "filling" nooutput
stats run using ($3 == 1 ? $1 : NaN) every ::1 name "retuned" nooutput
stats run using 1 every ::1 name "time" nooutput
fed = filling_min
retuned = retuned_min

set grid lt 1 lc "gray90"
set border 3
set tics nomirror
set xrange [0:time_max]
set style line 1 lw 1.5 lc "#d55e00"
set style line 2 lw 1.5 lc "#0072b2"
set style line 3 lw 1.5 lc "black" dt 2
set style line 4 lw 1.5 lc "gray60"
set style line 5 lw 1.5 lc "black"
set arrow 1 from fed, graph 0 to fed, graph 1 nohead ls 4
set arrow 2 from retuned, graph 0 to retuned, graph 1 nohead ls 5
set key outside top center horizontal
upper = 'unset xlabel; set format x ""'
lower = 'set xlabel "time [s]"; set format x'

set terminal svg size 900,640 font "sans,13" background "white"
set output folder."/figure_3_estimates.svg"
set multiplot layout 3,1 margins 0.10,0.97,0.09,0.92 spacing 0,0.06
eval upper
set ylabel "R [ohm]"
set yrange [0:6]
plot run using 1:10 every 10::1 with lines ls 2 title "estimate", run using 1:13 every 10::1 with lines ls 3 title "truth", NaN ls 4 title "estimator is fed", \
     NaN ls 5 title "controller is retuned"
unset key
set ylabel "L [mH]"
set yrange [0:35]
plot run using 1:($11*1e3) every 10::1 with lines ls 2, run using 1:($14*1e3) every 10::1 with lines ls 3
eval lower
set ylabel "K [N.m/A]"
set yrange [0.2:0.45]
plot run using 1:12 every 10::1 with lines ls 2, run using 1:15 every 10::1 with lines ls 3
unset multiplot

set key
set yrange [*:*]
set terminal svg size 900,520
set output folder."/figure_4_velocity.svg"
set multiplot layout 2,1 margins 0.10,0.97,0.11,0.90 spacing 0,0.08
eval upper
set ylabel "velocity [rad/s]"
plot run using 1:5 every 10::1 with lines ls 2 title "measured", run using 1:4 every 10::1 with lines ls 3 title "reference", \
     NaN ls 4 title "estimator is fed", NaN ls 5 title "controller is retuned"
eval lower
unset key
set ylabel "velocity error [rad/s]"
plot run using 1:($4-$5) every 10::1 with lines ls 1
unset multiplot

set key
set output folder."/figure_5_voltages.svg"
set multiplot layout 2,1 margins 0.10,0.97,0.11,0.90 spacing 0,0.08
eval upper
set ylabel "v_d [V]" noenhanced
plot run using 1:6 every 10::1 with lines ls 2 notitle, NaN ls 4 title "estimator is fed", NaN ls 5 title "controller is retuned"
eval lower
unset key
set ylabel "v_q [V]" noenhanced
plot run using 1:7 every 10::1 with lines ls 2
unset multiplot
