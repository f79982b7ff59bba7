# report.awk - shows a scan: some answers, the range image as text, and the totals
#
# Reads the answers of `cylint -f t,part,z,label` with the tail `column row`; a shape's
# label is `spruce7-stem #rrggbb`.  Prints the first hit on each part of each kind of
# shape; then an image, whose characters show the nearest hit of wide x high rays: a
# tree by its range, near to far in `shades`, the ground as a dot, the sky as a blank.
# The command ran from `started` to `ended`, seconds with a fraction where `date` can;
# of a text such as 1764460800.N awk reads the number.

BEGIN {
    shades = "@#%*+=-:"
    nearest_shown = 7
    farthest_shown = 31
    print_row("t", "part", "z", "column row", "label")
}

$1 != "nan" {
    hits++
    kind = $4
    sub(/.*-/, "", kind)
    if (!((kind, $2) in shown))
        print_row($1, $2, $3, $(NF - 1) " " $NF, $4)
    shown[kind, $2] = 1
    cell = int($(NF - 1) / wide) "," int($NF / high)
    if (kind == "ground")
        ground[cell] = 1
    else if (!(cell in nearest_in) || $1 < nearest_in[cell])
        nearest_in[cell] = $1
    parts[$2]++
    if (hits == 1 || $1 < nearest)
        nearest = $1
    if ($1 > farthest)
        farthest = $1
    if (hits == 1 || $3 > height) {
        height = $3
        tallest = $4
    }
}

END {
    if (hits == 0) {
        print "report.awk: no ray hit anything" | "cat 1>&2"
        exit 1
    }
    printf "\nThe same %d answers as a picture:\n\n", NR
    for (row = 0; row < rows / high; row++)
        print row_of_picture()
    print legend()
    printf "\nrays %d, hits %d (%.1f %%), sky %d\n",
           NR, hits, 100 * hits / NR, NR - hits
    printf "range: nearest %.3f m, farthest %.3f m\n", nearest, farthest
    printf "tallest hit: %.3f m, on %s\n", height, tallest
    printf "part hit: lateral %d, cap0 %d, cap1 %d\n\n",
           parts["lateral"], parts["cap0"], parts["cap1"]
    print "time: " time()
}

function print_row(t, part, z, ray, label)
{
    printf "%-18s  %-7s  %-22s  %-10s  %s\n", t, part, z, ray, label
}

function row_of_picture(   column, text)
{
    for (column = 0; column < columns / wide; column++)
        text = text mark(column "," row)
    sub(/ +$/, "", text)
    return text
}

function mark(cell)
{
    if (cell in nearest_in)
        return substr(shades, shade(nearest_in[cell]), 1)
    return cell in ground ? "." : " "
}

function shade(distance,   n)
{
    n = 1 + int(length(shades) * (distance - nearest_shown) / \
                (farthest_shown - nearest_shown))
    return n < 1 ? 1 : n > length(shades) ? length(shades) : n
}

function legend(   i, step, text)
{
    step = (farthest_shown - nearest_shown) / length(shades)
    for (i = 1; i <= length(shades); i++)
        text = text "  " substr(shades, i, 1) " " \
               sprintf("%g", nearest_shown + (i - 1) * step)
    return "range in m from:" text "    . ground"
}

function time(   seconds)
{
    seconds = ended - started
    if (seconds <= 0)
        return "too short for this clock"
    return sprintf("%.2f s, %.0f rays/s, reading and writing text", seconds,
                   NR / seconds)
}
