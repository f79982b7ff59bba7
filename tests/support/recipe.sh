#!/bin/sh
# usage: sh tests/support/recipe.sh [NAME [MANUAL]]
# Prints, unescaped, the display of MANUAL (default: cylint.7) that follows the
# comment line `.\" recipe NAME`.  Without NAME, prints the names of all.
awk -v name="${1-}" '
    /^\.\\" recipe / { found = $3; if (name == "") print found }
    /^\.Ed/ { inside = 0; found = "" }
    inside { gsub(/\\e/, "\\"); gsub(/\\&/, ""); gsub(/\\-/, "-"); print }
    /^\.Bd -literal/ { inside = name != "" && found == name }
' "$(dirname "$0")/../../man/${2-cylint.7}"
