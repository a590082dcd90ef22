# The progress of the children of a synchronized node over time; below the axis, when each of them
# was held, and a thin line of its factor if the node paces. What this plot is of stands above. A child
# is a number from 1.

# Colors that the color-blind and gray paper keep apart (Okabe and Ito).
color(child) = word('#0072b2 #e69f00 #009e73 #cc79a7 #56b4e9 #d55e00', 1 + (child - 1) % 6)
pattern(child) = int(word('4 5 1 2 6', (child - 1) / 6))
set for [i=1:6] style line i lc rgb color(i) lw 2.2 dt solid
set for [i=7:12] style line i lc rgb color(i) lw 2.2 dt (8,3)
set for [i=13:18] style line i lc rgb color(i) lw 2.2 dt (2,3)
set for [i=19:24] style line i lc rgb color(i) lw 2.2 dt (8,3,2,3)
set for [i=25:30] style line i lc rgb color(i) lw 2.2 dt (16,4)
set for [i=31:36] style line i lc rgb color(i) lw 2.2 dt (8,3,2,3,2,3)

# Each child has a strip below the axis.
strip = children * 0.055 > 0.6 ? 0.6 / children : 0.055
middle(child) = -0.05 - strip * (child - 0.5)

set encoding utf8
set label title at screen 0.5, screen 0.955 center noenhanced
set tmargin title_lines > 1 ? 3.6 : 2.4
set samples 2  # a barrier is a straight line: two points, not a hundred
set xlabel 'time (s)'
set ylabel 'progress'
set xrange [begin:end]
set yrange [middle(children + 1) + strip / 4:1.02]
set ytics nomirror scale 0.5 0,0.25,1
set label paces ? "held,\nfactor" : 'held' at graph -0.02, first (middle(1) + middle(children)) / 2 right
set xtics nomirror out scale 0.5
set grid ytics lt 1 lw 0.6 lc rgb '#e6e6e6'
set border 3 lw 0.8 lc rgb '#404040'
set xzeroaxis lt 1 lw 0.8 lc rgb '#404040'
set key outside right top reverse Left samplen 2 noenhanced font legend_font

# What a plot may lack is a text: gnuplot takes a loop over nothing for one round.
limits = ''
if (kind eq 'band') {
  limits = 'data index 0 using 1:2:3 with filledcurves fc rgb "#e4e4e4" fs solid noborder ' \
    .'title "delta band",'
}
if (kind eq 'steps') {
  limits = 'data index 0 using 1:3 with steps lc rgb "#808080" lw 1 dt 1 title "barrier",'
}
if (words(barriers) > 12) {
  set style line 40 lc rgb '#cccccc' lw 0.8 dt 1
} else {
  set style line 40 lc rgb '#808080' lw 0.8 dt (6,4)
}
if (kind eq 'barriers' && words(barriers) > 0) {
  limits = 'for [k=1:words(barriers)] real(word(barriers, k)) with lines ls 40 ' \
    .'title k == 1 ? "barrier" : "",'
}
held_child(k) = int(word(held, k))
low(k) = middle(held_child(k)) - 0.31 * strip
high(k) = middle(held_child(k)) + 0.31 * strip
solid = 0
do for [k=1:words(held)] { if (held_child(k) <= 6) { solid = k } }
box = 'data index k using 1:(middle(held_child(k))):1:2:(low(k)):(high(k)) with boxxyerror ' \
  .'fc rgb color(held_child(k)) fs '
boxes = solid > 0 ? ', for [k=1:solid] '.box.'solid noborder notitle' : ''
if (words(held) > solid) {
  boxes = boxes.', for [k=solid+1:words(held)] '.box.'pattern pattern(held_child(k)) ' \
    .'noborder notitle'
}

factors = ''
if (paces) {
  factors = ', for [i=1:children] data index 0 using ' \
    .'1:(middle(i) + (column(3 + children + i) - 0.5) * 0.7 * strip) ' \
    .'with steps lc rgb color(i) lw 1 dt 1 notitle'
}

plot @limits for [i=1:children] data index 0 using 1:i+3 with lines ls i title name[i] @boxes @factors
