#!/bin/sh
# usage: sh tests/support/recipe.sh [NAME [MANUAL]]
# Prints, unescaped, a literal display of MANUAL (default: cylint.7): NAME is that of a
# comment line `.\" recipe NAME` above it, or SECTION:NUMBER.  NAME `all`: all displays,
# with a blank line after each.  Without NAME, prints the names in comments.
awk -v name="${1-}" '
    /^\.Sh/ { section = $2; number = 0 }
    /^\.\\" recipe / { found = $3; if (name == "") print found }
    /^\.Ed/ { if (inside && name == "all") print ""; inside = 0; found = "" }
    inside { gsub(/\\e/, "\\"); gsub(/\\&/, ""); gsub(/\\-/, "-"); print }
    /^\.Bd -literal/ {
        place = section ":" ++number
        inside = name != "" && (name == found || name == place || name == "all")
    }
' "$(dirname "$0")/../../man/${2-cylint.7}"
