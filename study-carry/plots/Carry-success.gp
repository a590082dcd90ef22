# Made by lockstep. Box: quartiles; line: median; whiskers: minimum and maximum; circle: mean; bar: median, 95 % interval.
# To draw it again: gnuplot Carry-success.gp
data = './Carry-success.dat'
set terminal svg noenhanced size 720,432 font 'sans-serif,15' background 'white'
set output './Carry-success.svg'
title = 'Carry  (limit 100 %)'
x_label = ''
y_label = 'success'
groups = 1
crowded = 0
array group[groups] = ['']
array n[groups] = ['2']
array success[groups] = ['0 %']
row_font = ',15'
set yrange [0:1]

# A box for each group of the runs of a study. What this plot is of stands above.

blue = '#0072b2'
red = '#d55e00'
set encoding utf8
set title title noenhanced
# Between the axis and the labels of the groups are two rows: how many values each box is of, and
# how many of the runs succeeded.
set xlabel x_label noenhanced offset 0,-2
set ylabel y_label noenhanced
set xtics nomirror scale 0 offset 0,-2 ()
if (crowded) { set xtics rotate by -35 }
set for [i=1:groups] xtics add (group[i] i-1)
set label 'n' at screen 0.008, graph 0 offset 0,-0.9 left
set label 'success' at screen 0.008, graph 0 offset 0,-1.9 left
do for [i=1:groups] {
  set label n[i] at first i-1, graph 0 offset 0,-0.9 center font row_font
  set label success[i] at first i-1, graph 0 offset 0,-1.9 center font row_font
}
set xrange [-0.6:groups-0.4]
set ytics nomirror scale 0.5
set grid ytics lt 1 lw 0.6 lc rgb '#dcdcdc'
set border 3 lw 0.8 lc rgb '#404040'
set xzeroaxis lt 1 lw 0.8 lc rgb '#404040'
set key tmargin center horizontal reverse Left samplen 1.5 noenhanced
set style fill solid 0.25 border
width = 0.525
set boxwidth width

# The box, its median with the interval of it, its mean; then the legend.
plot \
  data using 1:3:2:6:5 with candlesticks whiskerbars 0.5 lc rgb blue lw 1.4 notitle, \
  data using ($1-width/2):4:(width):(0) with vectors nohead lc rgb blue lw 3 notitle, \
  data using ($1+width/3):9:(0):($10-$9) with vectors heads size screen 0.006,90 lc rgb red lw 2 notitle, \
  data using 1:7 with points pt 7 ps 0.75 lc rgb 'white' notitle, \
  data using 1:7 with points pt 6 ps 0.75 lw 1.4 lc rgb blue notitle, \
  keyentry with boxes lc rgb blue lw 1.4 title 'quartiles', \
  keyentry with lines lc rgb blue lw 3 title 'median', \
  keyentry with lines lc rgb red lw 2 title '95 % of median', \
  keyentry with lines lc rgb blue lw 1.4 title 'min, max', \
  keyentry with points pt 6 ps 0.75 lw 1.4 lc rgb blue title 'mean'
set terminal pngcairo noenhanced size 1440,864 font 'sans-serif,15' fontscale 1.467 linewidth 2 pointscale 2
set output './Carry-success.png'
replot
