# chart.gp - time against error of the methods in a file of `bench methods`
#
#     gnuplot -c tools/bench/chart.gp METHODS.csv SUBJECT >CHART.svg
#
# A panel for each family of lines: nanoseconds of both t, and the error that 99 % of all
# t do not exceed, in radii; less is better.  libcylint's error is at most half a unit in
# the last place, drawn at 1e-17; "wrong" are verdicts.  Larger errors than 1e4 are drawn
# there.
set terminal svg size 940,600 font "sans-serif,11" background "white"
set logscale xy
set xrange [10:100000]
set yrange [3e-18:3e4]
set format x "%g ns"
set format y "1e%T"
set xtics 10, 10, 10000
set ytics 1e-16, 1e4
set grid
unset mxtics
unset mytics
set key at graph 0.98, 0.92 spacing 0.95 autotitle columnheader

# A block for each method: its name, then time and error.
awk = 'awk -F '', *'' -v subject="'.ARG2.'" -v family="%s" ''{ split($3, of, "; ") } \
    $2 != subject || of[1] != family { next } \
    of[2] == "" { name[++n] = $5; ns[n] = $7; if (n == 1 || $(NF - 1) < ours) ours = $(NF - 1) } \
    of[2] == "wrong" && $7 > 0 { wrong[n] = " (" 0 + sprintf("%%.2g", $7) " %% wrong)" } \
    of[2] ~ /^error/ { error[n] = $7 < 1e-17 ? 1e-17 : $7 > 1e4 ? 1e4 : $7 } \
    END { print "libcylint\n" ours, 1e-17 "\n\n"; \
        for (i = 1; i <= n; i++) print "\"" name[i] wrong[i] "\"\n" ns[i], error[i] "\n\n" }'' '.ARG1

set multiplot layout 2,2
do for [family in "ordinary 'far origin' grazing 'nearly parallel'"] {
    set title family
    plot for [i=0:*] '< '.sprintf(awk, family) index i using 1:2 with points pt 7 lc i + 1
}
