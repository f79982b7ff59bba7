# Charts of batch.csv, as gnuplot scripts:
#
#     awk -v chart=growth|kernels -v out=file.svg -f batch_charts.awk batch.csv
#
# growth: million tests a second against the number of shapes, beside reading
# the same bytes.  kernels: million tests a second by instruction set and share
# of hits, one panel a kind of shape.
BEGIN {
    FS = ","
    colour["plain quadratic"] = "#777777"; colour["plain"] = "#e69f00"
    colour["avx2"] = "#0072b2"; colour["avx512"] = "#d55e00"
    title["plain quadratic"] = "plain quadratic, one by one"; title["plain"] = "cylint, without vector flags"
    title["avx2"] = "cylint, AVX2"; title["avx512"] = "cylint, AVX-512"
    n = split("plain quadratic,plain,avx2,avx512", order, ",")
    if (terminal == "") terminal = "svg size %d,%d dynamic font 'sans-serif,12' background 'white'"
}

NR == 1 { next }
$1 == "growth" { line[$2, $5] = line[$2, $5] sprintf("%s %g\n", $6, 1000 / $10) }
$1 == "cache" && $4 == "one line" && $5 == "nearest" && $7 > 0 {
    if (!($3 in seen)) { seen[$3] = ++kinds; kind[kinds] = $3 }
    h = $7 < 3 ? 1 : $7 < 20 ? 2 : 3
    if (h > most) most = h
    rate[$3, $2, h] = 1000 / $10
    if ($11 != "nan") rate[$3, "plain quadratic", h] = 1000 / $11
}

function begin(w, h) {
    printf "set terminal " terminal "\nset output '%s'\nset encoding utf8\n", w, h, out
    print "set border 3 lw 0.6 lc rgb '#666666'; set tics nomirror scale 0.4"
    print "set grid ytics lw 0.4 lc rgb '#dddddd'"
    print "set ylabel 'million tests a second (higher is better)'"
}

# A name without blanks, for gnuplot's data blocks.
function block(name) { gsub(/ /, "_", name); return name }

# The colour is the contestant, the dash the query.
function growth(   i, a, to, comma) {
    begin(860, 440)
    for (a in line) { split(a, part, SUBSEP); printf "$%s_%s << EOD\n%sEOD\n", block(part[1]), part[2], line[a] }
    print "set title 'One line against n capped cylinders' font ',15'"
    print "set logscale xy; set xlabel 'n'; set format x '10^{%T}'; set format y '%g'; set xrange [1:*]; set yrange [8:4000]"
    print "set key outside right center Left reverse samplen 2.5 spacing 1.4 width -2"
    printf "plot "
    for (i = n; i >= 1; i--) {
        to = order[i]
        if (!((to, "nearest") in line)) continue
        printf "%s$%s_nearest using 1:2 with linespoints lw 2 pt 7 ps 0.5 lc rgb '%s' title '%s'", comma, block(to), colour[to], title[to]
        printf ", $%s_any using 1:2 with linespoints lw 1.5 pt 6 ps 0.4 dt 2 lc rgb '%s' notitle", block(to), colour[to]
        comma = ", "
    }
    printf ", $reading_read using 1:2 with lines lw 1.2 dt 3 lc rgb 'black' title 'reading the same bytes'"
    printf ", -1 with linespoints lw 2 pt 7 ps 0.5 lc rgb 'black' title 'solid: nearest, 1 %% hits'"
    print ", -1 with linespoints lw 1.5 pt 6 ps 0.4 dt 2 lc rgb 'black' title 'dashed: any, 0 %% hits'"
}

# A group of bars is a share of hits, a bar in it an instruction set.
function kernels(   k, i, h, to, comma, wide) {
    begin(860, 380)
    for (k = 1; k <= kinds; k++)
        for (i = 1; i <= n; i++) {
            printf "$D%d_%d << EOD\n", k, i
            for (h = 1; h <= most; h++)
                if ((kind[k], order[i], h) in rate) printf "%g %g\n", h + (i - 2.5) * 0.2, rate[kind[k], order[i], h]
            print "EOD"
        }
    print "set multiplot"
    print "set label 1 'The nearest of 512 shapes in cache, by instruction set' at screen 0.5,0.96 center font ',15'"
    print "set boxwidth 0.18; set style fill solid 0.9 noborder; set xrange [0.4:3.6]; set yrange [0:*]"
    print "set xtics ('1 %%' 1, '10 %%' 2, '50 %%' 3) scale 0; set xlabel 'hits'"
    for (k = 1; k <= kinds; k++)
        for (i = 1; i <= n; i++)
            for (h = 1; h <= most; h++)
                if (rate[kind[k], order[i], h] > top) top = rate[kind[k], order[i], h]
    printf "set yrange [0:%g]\n", top * 1.08
    for (k = 1; k <= kinds; k++) {
        wide = 0.91 / kinds
        printf "set lmargin at screen %g; set rmargin at screen %g\n", 0.075 + (k - 1) * wide, 0.055 + k * wide
        print "set bmargin at screen 0.24; set tmargin at screen 0.85"
        printf "set title '%s, capped' offset 0,-0.6\n", kind[k]
        if (k > 1) print "unset ylabel; set format y ''; unset label"
        comma = ""
        printf "unset key\nplot "
        for (i = 1; i <= n; i++) {
            if (!((kind[k], order[i], 1) in rate)) continue
            printf "%s$D%d_%d using 1:2 with boxes lc rgb '%s' notitle", comma, k, i, colour[order[i]]
            comma = ", "
        }
        print ""
    }
    print "unset border; unset tics; unset xlabel; unset title; unset grid"
    print "set lmargin at screen 0.02; set rmargin at screen 0.98; set bmargin at screen 0; set tmargin at screen 0.1"
    print "set xrange [0:1]; set yrange [0:1]"
    print "set key at graph 0.5,0.5 center center horizontal Left reverse samplen 1 width 1 maxrows 1"
    printf "plot -1 notitle"
    for (i = 1; i <= n; i++) printf ", -1 with boxes lc rgb '%s' title '%s'", colour[order[i]], title[order[i]]
    print "\nunset multiplot"
}

END { if (chart == "growth") growth(); else kernels() }
