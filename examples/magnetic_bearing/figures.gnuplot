# SPDX-License-Identifier: 0BSD
# What magnetic_bearing wrote -> figures 8 to 13 of Delpoux, Floquet 2015, as SVG. Variables: run, folder.
#   gnuplot -e "run='RUN.csv'; folder='DIR'" figures.gnuplot
# Columns: t, status, retuned, wanted y, y, wanted z, z, perturbation y, perturbation z, i1, i2, i3, lambda1 to lambda3, their true values.
set encoding utf8
set datafile separator ","
stats run using (strcol(2) eq "filling" ? $1 : NaN) every ::1 name "filling" nooutput
stats run using ($3 == 1 ? $1 : NaN) every ::1 name "retuned" nooutput
fed = filling_min
retuned = retuned_min

set grid lt 1 lc "gray90"
set border 3
set tics nomirror
set style line 1 lw 1.5 lc "#d55e00"
set style line 2 lw 1.5 lc "#0072b2"
set style line 3 lw 1.5 lc "#009e73"
set style line 4 lw 1.5 lc "gray60"
set style line 5 lw 1.5 lc "black"
set style line 6 lw 1.5 lc "black" dt 2
set key outside top center horizontal
upper = 'unset xlabel; set format x ""'
lower = 'set xlabel "time [s]"; set format x'
mark = 'set arrow 1 from fed, graph 0 to fed, graph 1 nohead ls 4; set arrow 2 from retuned, graph 0 to retuned, graph 1 nohead ls 5'

set terminal svg size 900,360 font "sans,13" background "white"
set output folder."/figure_8_estimates.svg"
set lmargin at screen 0.10
eval lower
eval mark
set xrange [0.34:0.46]
set yrange [1.8:4.2]
set ylabel "force constant [10⁻⁶ N.m²/A²]"
plot for [k=1:3] run using 1:(column(12 + k)*1e6) every ::1 with lines ls k title sprintf("λ%d", k), \
     for [k=1:3] run using 1:(column(15 + k)*1e6) every ::1 with lines ls k dt 2 notitle, \
     NaN ls 6 title "truth", NaN ls 4 title "estimator is fed", NaN ls 5 title "controller is retuned"

set xrange [0.3:0.5]
set yrange [*:*]
do for [axis in "y z"] {
    wanted = axis eq "y" ? 4 : 6
    set terminal svg size 900,680
    set output folder.(axis eq "y" ? "/figure_9_tracking_y.svg" : "/figure_10_tracking_z.svg")
    set multiplot layout 3,1 margins 0.10,0.97,0.08,0.92 spacing 0,0.06
    set key
    eval upper
    set ylabel axis." [µm]"
    plot run using 1:(column(wanted + 1)*1e6) every 2::1 with lines ls 2 title "shaft", \
         run using 1:(column(wanted)*1e6) every 2::1 with lines ls 6 title "reference", \
         NaN ls 4 title "estimator is fed", NaN ls 5 title "controller is retuned"
    unset key
    set ylabel "error of ".axis." [µm]"
    plot run using 1:((column(wanted) - column(wanted + 1))*1e6) every 2::1 with lines ls 1
    eval lower
    set ylabel "perturbation ".axis." [N]"
    plot run using 1:(column(axis eq "y" ? 8 : 9)) every 2::1 with lines ls 1
    unset multiplot
}

unset arrow
set terminal svg size 900,360
set output folder."/figure_11_currents.svg"
set yrange [0:5]
set multiplot layout 1,2 margins 0.08,0.97,0.16,0.88 spacing 0.09,0
do for [part in "before after"] {
    if (part eq "before") { set xrange [0.2:0.3] } else { set xrange [0.6:0.7] }
    set xtics 0.02
    set key
    set ylabel "current, ".part." [A]"
    plot for [k=1:3] run using 1:(column(9 + k)) every ::1 with lines ls k title sprintf("i%d", k)
}
unset multiplot

set terminal svg size 560,620
unset lmargin
set xlabel "y [µm]"
set ylabel "z [µm]"
set xtics autofreq
set xrange [-60:60]
set yrange [-100:100]
set size ratio -1
do for [part in "before after"] {
    from = part eq "before" ? 0.2 : 0.6
    set output folder.(part eq "before" ? "/figure_12_path_before.svg" : "/figure_13_path_after.svg")
    plot run using ($1 >= from && $1 < from + 0.1 ? $5*1e6 : NaN):($7*1e6) every ::1 with lines ls 2 title "shaft", \
         run using ($1 >= from && $1 < from + 0.02 ? $4*1e6 : NaN):($6*1e6) every ::1 with lines ls 6 title "reference"
}
