# Run time against error of one class of shapes, as a gnuplot script:
#
#     awk -v class='cylinder capped' -v unit=radii -v out=file.svg \
#         [-v only='ordinary;far origin'] -f charts.awk methods.csv
#
# One panel a family, one mark a method.  x: ns of a question.  y: the error
# that 99 % of the hits do not exceed, with a line from the median to the
# largest error; unit=radii (of the shape, along the line) or unit=ulp (of t).
# An error outside the frame is drawn on the frame: 0 has no logarithm, and a
# method without any correct verdict has no error of hits.
BEGIN {
    FS = ","; across = 5
    least = unit == "ulp" ? 1e-2 : 1e-18; most = unit == "ulp" ? 1e18 : 1e7
    median = unit == "ulp" ? 12 : 9
    if (terminal == "") terminal = "svg size %d,%d dynamic font 'sans-serif,11' background 'white'"
    # name, mode, title, point type open and filled, colour, size
    contestant("cylint", "both", "cylint, correctly rounded", 12, 13, "#d55e00", 1.2)
    contestant("shene-cylinder", "both", "Shene 1994", 6, 7, "#0072b2", 0.95)
    contestant("shene-cone", "both", "Shene 1995", 6, 7, "#0072b2", 0.95)
    contestant("gullotti", "both", "Gullotti", 4, 5, "#56b4e9", 0.95)
    contestant("closest-points", "both", "closest points", 8, 9, "#009e73", 1.1)
    contestant("cychosz-waggenspack", "both", "Cychosz, Waggenspack 1994", 10, 11, "#cc79a7", 1.1)
    contestant("quadratic", "both", "full quadratic", 14, 15, "#555555", 1.1)
    contestant("plain", "both", "plain quadratic", 4, 5, "#999999", 0.8)
    contestant("gsl", "both", "GSL's solver", 6, 7, "#000000", 0.8)
    contestant("shader", "nearest", "shader, nearest hit", 8, 9, "#8b5a2b", 0.95)
}

function contestant(name, mode, title, open, filled, colour, size) {
    methods[++n_methods] = name SUBSEP mode
    number[name, mode] = n_methods
    titles[n_methods] = title; opens[n_methods] = open; fills[n_methods] = filled
    colours[n_methods] = colour; sizes[n_methods] = size
}

function framed(x) { return x == "nan" || x > most ? most : x < least ? least : x }

NR == 1 { next }
build == "" { build = $1 }
$1 != build || $2 != class || !(($4, $5) in number) { next }
only != "" && !index(";" only ";", ";" $3 ";") { next }
$median == "nan" && ($15 == "nan" || $15 == 0) { next }
!($3 in seen) { seen[$3] = ++n_families; families[n_families] = $3 }
{
    m = number[$4, $5]; used[m] = 1
    rows[seen[$3], m] = sprintf("%s %g %g %g", $7, framed($median),
        framed($(median + 1)), framed($(median + 2)))
    wrong[seen[$3], m] = $15 + 0
    if ($7 > slowest) slowest = $7
    if (fastest == "" || $7 < fastest) fastest = $7
}

function data(   f, m) {
    for (f = 1; f <= n_families; f++)
        for (m = 1; m <= n_methods; m++)
            if ((f, m) in rows) printf "$D%d_%d << EOD\n%s\nEOD\n", f, m, rows[f, m]
}

# Sets the margins to a box in pixels from the top left.
function place(x, y, w, h) {
    printf "set lmargin at screen %.4f\nset rmargin at screen %.4f\n", x / width, (x + w) / width
    printf "set tmargin at screen %.4f\nset bmargin at screen %.4f\n", 1 - y / height, 1 - (y + h) / height
}

# Filled: no verdict is wrong.  Open: some are.  Crossed: 1 % or more are.
function marks(f, m,   d, share) {
    d = sprintf("$D%d_%d", f, m); share = wrong[f, m]
    printf "%s using 1:2:(0):($4-$2) with vectors nohead lw 1.2 lc rgb '%s' notitle", d, colours[m]
    printf ", %s using 1:3 with points lw 1.3 pt %d ps %s lc rgb '%s' notitle", d,
        (share > 0 ? opens[m] : fills[m]), sizes[m], colours[m]
    if (share >= 1)
        printf ", %s using 1:3 with points lw 1.3 pt 2 ps 0.8 lc rgb '%s' notitle", d, cross
}

function panel(f,   m, comma, row, column) {
    row = int((f - 1) / across); column = (f - 1) % across
    place(left + column * (wide + 8), top + row * (tall + 32), wide, tall)
    printf "set title \"%s\" font ',12' offset 0,-0.7\n", families[f]
    printf "set format y \"%s\"\n", (column ? "" : "10^{%T}")
    printf "set format x \"%s\"\n", (f + across > n_families ? "10^{%T}" : "")
    printf "plot "
    for (m = n_methods; m >= 1; m--) {
        if (!((f, m) in rows)) continue
        printf "%s", comma
        marks(f, m)
        comma = ", "
    }
    print ""
}

function key_entry(style, title) {
    printf ", NaN with %s title \"%s\"", style, title
}

function legend(   m, entries) {
    place(left, height - legend_height, width - left - 10, legend_height - 5)
    print "unset title; unset border; unset tics; unset grid; unset logscale"
    print "set xrange [0:1]; set yrange [0:1]"
    printf "set key at graph 0,1 left top Left reverse vertical maxrows %d samplen 1.5 width 2 spacing 1.2 font ',12'\n", key_rows
    printf "plot NaN notitle"
    for (m = 1; m <= n_methods; m++)
        if (used[m] && ++entries) key_entry(sprintf("points pt %d ps %s lc rgb '%s'", fills[m], sizes[m] + 0.1, colours[m]), titles[m])
    for (; entries % key_rows; entries++) key_entry("lines lc bgnd", " ") # fills the column
    key_entry("points pt 7 ps 1 lc rgb 'black'", "filled: every verdict right")
    key_entry("points pt 6 ps 1 lw 1.3 lc rgb 'black'", "open: some verdicts wrong")
    key_entry("points pt 2 ps 0.8 lw 1.3 lc rgb '" cross "'", "crossed: 1 % or more wrong")
    key_entry("lines lw 1.2 lc rgb 'black'", "line: median to largest error")
    print ""
}

END {
    if (n_families == 0) exit
    for (m in used) n_used++
    if (n_families < across) across = n_families
    key_rows = n_used > 8 ? int((n_used + 1) / 2) : 4 # two columns of methods, one of signs
    legend_height = 32 + 20 * key_rows
    down = int((n_families + across - 1) / across)
    wide = 205; tall = down > 1 ? 158 : 215; left = 66; top = 62; cross = "#c00000"
    width = left + across * (wide + 8) + 6
    height = top + down * (tall + 32) + 22 + legend_height
    printf "set terminal " terminal "\nset output '%s'\n", width, height, out
    print "set encoding utf8"
    data()
    print "set multiplot"
    printf "set label 1 \"%s: time of a question against error of its hits\" at screen 0.5,%.4f center font ',15'\n", class, 1 - 20 / height
    printf "set label 2 \"ns a question, both t (lower is better)\" at screen 0.5,%.4f center font ',12'\n", (legend_height + 16) / height
    printf "set label 3 \"error of 99 %% of hits, in %s (lower is better)\" at screen 0.013,%.4f center rotate font ',12'\n", \
        (unit == "ulp" ? "ulp of t" : "radii along the line"), 0.5 + legend_height / 2 / height
    print "set logscale xy; set mxtics 1; set mytics 1; set tics scale 0.4 font ',10'; set border lw 0.6 lc rgb '#666666'"
    print "set grid xtics ytics lw 0.4 lc rgb '#dddddd'; unset key"
    printf "set yrange [%g:%g]; set ytics 1e4\n", least, most
    printf "set xrange [%g:%g]; set xtics 10\n", fastest / 1.5, slowest * 1.5
    for (f = 1; f <= n_families; f++) {
        panel(f)
        if (f == 1) print "unset label"
    }
    legend()
    print "unset multiplot"
}
