#!/bin/sh
# Floors numbers, distance and embree: Gappa proves the error bounds of the headers.  Each
# claim is proved as stated in every rounding mode that it names; 1 % smaller,
# it must be unprovable in one of them.  The C compiler reads the numbers from
# the headers.
#
# A claim is a *.g file.  Its comments name the bound, the rounding modes and
# the size of one factor's d.  In its text MODE and BOUND stand for these,
# RANGES(K) for |d1| <= each /\ ... /\ |dK| <= each, FACTORS(K) for
# (1 + d1) * ... * (1 + dK), SHRINK(n) for n factors (1 - 2^-52).
. "$(dirname "$0")/../../support/verdict.sh"
here=$top/tests/bounds/prove
build=$build/prove
headers='numbers/error_bounds.h distance/error_bounds.h embree/float_filter_lanes.h'
command -v gappa >/dev/null ||
    skip_all 'no gappa, so no proof of the bounds (Debian: apt-get install gappa)'
mkdir -p "$build"

result() { # NAME STATUS
    verdict "$1" "$2" && echo "note: $1"
}

constants() { # prints all constants: name, hexadecimal, 1 % smaller
    names=$(cd "$top/src" &&
            sed -n 's/^#define \(CYLINT_[A-Z0-9_]*\) .*/\1/p' $headers)
    {
        printf '#include <stdio.h>\n'
        printf '#include "%s"\n' $headers
        printf 'int main(void)\n{\n'
        for n in $names; do
            printf 'printf("%s %%a %%a\\n", (double)(%s), 0.99 * (%s));\n' \
                "$n" "$n" "$n"
        done
        printf 'return 0;\n}\n'
    } > "$build/constants.c"
    ${CC:-cc} -I"$top/src" -I"$top/include" -o "$build/constants" \
        "$build/constants.c" && "$build/constants"
}

ratios() { # prints the lines of ratios.txt with yes or no
    {
        printf '#include <math.h>\n#include <stdio.h>\n#include "distance/error_bounds.h"\nint main(void)\n{\n'
        sed -n 's/^\([C(0].*\) | \(.*\)$/printf("%s;\1 >= \2\\n", (\1) >= (\2) ? "yes" : "no");/p' \
            "$here/ratios.txt"
        printf 'return 0;\n}\n'
    } > "$build/ratios.c"
    ${CC:-cc} -I"$top/src" -o "$build/ratios" \
        "$build/ratios.c" -lm && "$build/ratios"
}

expand() { # CLAIM MODE COLUMN; column of constants: 2 as stated, 3 smaller
    awk -v mode="$2" -v column="$3" '
        function repeat(text, n, between,    i, all, one) {
            for (i = 1; i <= n; i++) {
                one = text
                gsub(/#/, i, one)
                all = all (i > 1 ? between : "") one
            }
            return all
        }
        function number(text) {
            return text in integer ? integer[text] : text + 0
        }
        function grow(line, word, text, between,    at, rest, n) {
            while ((at = index(line, word "(")) > 0) {
                rest = substr(line, at + length(word) + 1)
                n = number(substr(rest, 1, index(rest, ")") - 1))
                line = substr(line, 1, at - 1) repeat(text, n, between) \
                       substr(rest, index(rest, ")") + 1)
            }
            return line
        }
        FNR == NR {
            value[$1] = $2
            smaller[$1] = $3
            next
        }
        FILENAME ~ /bounds\.h$/ {
            if ($1 == "#define" && $3 ~ /^[0-9]+$/)
                integer[$2] = $3
            next
        }
        /^# bound:/ { bound = column == 2 ? value[$3] : smaller[$3] }
        /^# each:/ { each = value[$3] }
        /^#/ { next }
        {
            $0 = grow($0, "RANGES", "|d#| <= " each, " /\\ ")
            $0 = grow($0, "FACTORS", "(1 + d#)", " * ")
            $0 = grow($0, "SHRINK", "(1 - 1b-52)", " * ")
            gsub(/MODE/, mode)
            gsub(/BOUND/, bound)
            print
        }' "$build/constants.txt" "$top/src/numbers/error_bounds.h" "$1"
}

is_proved() { # CLAIM MODE COLUMN
    expand "$1" "$2" "$3" > "$build/claim.g"
    timeout 300 gappa -Eprecision=300 "$build/claim.g" \
        > "$build/claim.log" 2>&1
    status=$?
    # 1 means "not proved"; any other status is a failure of gappa
    if grep -q 'syntax error' "$build/claim.log"; then
        status=2
    fi
    return $status
}

constants > "$build/constants.txt" || exit 1
for claim in "$here"/*.g; do
    name=$(basename "$claim" .g)
    bound=$(sed -n 's/^# bound: //p' "$claim")
    sharp=1
    for mode in $(sed -n 's/^# modes: //p' "$claim"); do
        is_proved "$claim" "$mode" 2
        result "$name ($mode): at most $bound" $?
        is_proved "$claim" "$mode" 3
        [ $? -eq 1 ] && sharp=0
    done
    result "$name: 1 % less is not proved" $sharp
done
ratios > "$build/ratios.txt" || exit 1
while IFS=';' read -r ok text; do
    [ "$ok" = yes ]
    result "$text" $?
done < "$build/ratios.txt"
check_end
