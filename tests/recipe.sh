#!/bin/sh
# usage: sh tests/recipe.sh NAME
# Prints the display of cylint(7) whose first line is `# NAME`, unescaped.
awk -v name="$1" '
    /^\.Bd -literal/ { first = NR + 1; next }
    /^\.Ed/ { inside = 0 }
    NR == first { inside = $1 == "#" && $2 ~ "^" name ":?$" }
    inside { gsub(/\\e/, "\\"); gsub(/\\&/, ""); gsub(/\\-/, "-"); print }
' "$(dirname "$0")/../man/cylint.7"
