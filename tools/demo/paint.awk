# paint.awk - adds colours to the shapes of forest.awk, for cylint-render
#
# The last word of a label is the kind, for instance stem of spruce7-stem.

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
