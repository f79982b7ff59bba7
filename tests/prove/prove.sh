#!/bin/sh
# Proves bounds stated in headers with Gappa, each claim twice: as stated,
# which must succeed in every rounding mode it is about, and 1 % smaller,
# which must fail in one of them.  The numbers come from the headers
# themselves, through the C compiler.
#
# A claim is a *.g file.  Its comments name the bound it claims, the rounding
# modes it is about and the size of one factor's d; in its text MODE and BOUND
# stand for these, RANGES(K) for |d1| <= each /\ ... /\ |dK| <= each, FACTORS(K)
# for (1 + d1) * ... * (1 + dK), SHRINK(n) for n factors (1 - 2^-52).
here=$(dirname "$0")
build=${BUILD:-build}/prove
headers='error_bounds.h embree/angle.h'
if ! command -v gappa >/dev/null; then
    echo 'no gappa: the bounds are not proved (Debian: apt-get install gappa)'
    exit 77
fi
mkdir -p "$build"
passed=0 failed=0

tell() { # name, whether it is as it should be
    if [ "$2" = yes ]; then
        passed=$((passed + 1))
        echo "note: $1"
    else
        failed=$((failed + 1))
        echo "FAILED $1"
    fi
}

constants() { # every constant: name, hexadecimal, the same 1 % smaller
    names=$(cd "$here/../../src" &&
            sed -n 's/^#define \(CYLINT_[A-Z_]*\) .*/\1/p' $headers)
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
    ${CC:-cc} -I"$here/../../src" -o "$build/constants" \
        "$build/constants.c" && "$build/constants"
}

ratios() { # the lines of ratios.txt: text, yes or no
    {
        printf '#include <stdio.h>\n#include "numbers/error_bounds.h"\nint main(void)\n{\n'
        sed -n 's/^\(CYLINT.*\) | \(.*\)$/printf("%s;\1 >= \2\\n", (\1) >= (\2) ? "yes" : "no");/p' \
            "$here/ratios.txt"
        printf 'return 0;\n}\n'
    } > "$build/ratios.c"
    ${CC:-cc} -I"$here/../../src" -o "$build/ratios" \
        "$build/ratios.c" && "$build/ratios"
}

expand() { # claim, mode, column of constants: 2 as stated, 3 smaller
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
        }' "$build/constants.txt" "$here/../../src/numbers/error_bounds.h" "$1"
}

is_proved() { # claim, mode, column
    expand "$1" "$2" "$3" > "$build/claim.g"
    timeout 60 gappa -Eprecision=300 "$build/claim.g" \
        > "$build/claim.log" 2>&1
    status=$?
    # 1 is "not proved"; anything else is no answer at all
    if grep -q 'syntax error' "$build/claim.log"; then
        status=2
    fi
    return $status
}

constants > "$build/constants.txt" || exit 1
for claim in "$here"/*.g; do
    name=$(basename "$claim" .g)
    bound=$(sed -n 's/^# bound: //p' "$claim")
    sharp=no
    for mode in $(sed -n 's/^# modes: //p' "$claim"); do
        is_proved "$claim" "$mode" 2
        [ $? -eq 0 ] && ok=yes || ok=no
        tell "$name ($mode): at most $bound" $ok
        is_proved "$claim" "$mode" 3
        [ $? -eq 1 ] && sharp=yes
    done
    tell "$name: 1 % less is not proved" $sharp
done
ratios > "$build/ratios.txt" || exit 1
while IFS=';' read -r ok text; do
    tell "$text" "$ok"
done < "$build/ratios.txt"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
