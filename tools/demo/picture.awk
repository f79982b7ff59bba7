# picture.awk - the scanner's range image, as text
#
# Reads a scene, then the answers of `cylint -f shape,t,part,z` with labels
# `column row`.  Each character shows the nearest hit of wide x high rays: a
# tree by its range, near to far in `shades`, the ground as a dot, the sky as a
# blank.

BEGIN {
    shades = "@#%*+=-:"
    nearest_shown = 7
    farthest_shown = 31
}

FNR == 1 { files++ }

files == 1 && !/^#/ { is_ground[++shapes] = $NF == "ground" }

files == 2 && $1 > 0 {
    cell = int($5 / wide) "," int($6 / high)
    if (is_ground[$1])
        ground[cell]++
    else if (!(cell in range) || $2 < range[cell])
        range[cell] = $2
}

END {
    for (row = 0; row < rows / high; row++) {
        line = ""
        for (column = 0; column < columns / wide; column++)
            line = line mark(column "," row)
        sub(/ +$/, "", line)
        print line
    }
    print legend()
}

function mark(cell)
{
    if (cell in range)
        return substr(shades, shade(range[cell]), 1)
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
