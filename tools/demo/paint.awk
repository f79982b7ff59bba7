# paint.awk - gives the shapes of forest.awk colours for cylint-render
#
# A shape's label ends in what it is, for instance spruce7-stem.

BEGIN {
    colour["ground"] = "#a39b6f"
    colour["stem"] = colour["branch"] = "#8a7763"
    colour["twig"] = "#9c8a74"
    colour["foliage"] = "#5d8a5c"
}

/^#/ { print; next }

{
    kind = $NF
    sub(/.*-/, "", kind)
    print $0, colour[kind]
}
