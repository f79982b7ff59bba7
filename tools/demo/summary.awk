# summary.awk - prints the totals of a scan
#
# Reads a scene, then the answers of `cylint -f shape,t,part,z` sorted by t.
# `seconds` is the time of the command, 0 if the clock is too coarse.

FNR == 1 { files++ }

files == 1 && !/^#/ {
    label[++shapes] = $NF
    kind = kind_of($NF)
    shapes_of[kind]++
}

files == 2 { rays++ }

files == 2 && $1 > 0 {
    hits++
    range[hits] = $2
    kind = kind_of(label[$1])
    if (!(kind in hits_of)) # sorted by range, so the first is the nearest
        nearest_of[kind] = $2
    hits_of[kind]++
    if (kind != "ground" && !(label[$1] in seen)) {
        seen[label[$1]] = 1
        tree = label[$1]
        sub(/-.*/, "", tree)
        if (!(tree in tree_hit)) {
            tree_hit[tree] = 1
            trees++
        }
    }
    parts[$3]++
    if (hits == 1 || $4 > height) {
        height = $4
        tallest = label[$1]
    }
}

END {
    if (hits == 0) {
        print "summary.awk: no ray hit anything" | "cat 1>&2"
        exit 1
    }
    printf "rays %d, hits %d (%.1f %%), sky %d\n",
           rays, hits, 100 * hits / rays, rays - hits
    printf "range: nearest %.3f m, median %.3f m, farthest %.3f m\n",
           range[1], median(), range[hits]
    printf "tallest hit: %.3f m, on %s\n", height, tallest
    printf "trees hit: %d\n", trees
    printf "part hit: lateral %d, cap0 %d, cap1 %d\n\n",
           parts["lateral"], parts["cap0"], parts["cap1"]
    printf "%-8s %7s %7s %12s\n", "", "shapes", "hits", "nearest (m)"
    row("ground")
    row("stem")
    row("branch")
    row("twig")
    row("foliage")
    print ""
    print "time: " time()
}

# The label spruce7-stem is of the kind `stem`.
function kind_of(text)
{
    sub(/.*-/, "", text)
    return text
}

function median()
{
    if (hits % 2)
        return range[(hits + 1) / 2]
    return (range[hits / 2] + range[hits / 2 + 1]) / 2
}

function row(kind)
{
    printf "%-8s %7d %7d %12s\n", kind, shapes_of[kind], hits_of[kind],
           kind in hits_of ? sprintf("%.3f", nearest_of[kind]) : "-"
}

function time()
{
    if (seconds <= 0)
        return "too short for this clock"
    return sprintf("%.2f s, %.0f rays/s against %d shapes, reading and " \
                   "writing text", seconds, rays / seconds, shapes)
}
