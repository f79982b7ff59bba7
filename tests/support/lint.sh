#!/bin/sh
# Checks the sources with other tools than the compiler: cppcheck, clang-tidy,
# gcc's analyzer, sh -n, mandoc, groff; whether includes and calls point down the
# ladder; and how the sources look: clang-format, tabs, blanks at line ends,
# width, file length.  A tool that is not installed is named and its check
# skipped (make deps-cross).  `make lint` runs this; every finding fails.
cd "$(dirname "$0")/../.." || exit 1
. tests/support/verdict.sh
work=$scratch

result() { # NAME: passes if $work/found is empty
    [ ! -s "$work/found" ]
    if verdict "$1" $?; then
        printf 'ok   %s\n' "$1"
    else
        head -n 40 "$work/found"
    fi
}

installed() { # TOOL CHECK
    command -v "$1" >/dev/null && return
    skip "$2" "no $1"
    return 1
}

git ls-files >"$work/all" 2>/dev/null || find . -type f -not -path './build*' |
    sed 's|^\./||' >"$work/all"
while read -r file; do
    [ -f "$file" ] && printf '%s\n' "$file"
done <"$work/all" >"$work/files"
of_kind() { grep -E "$1" "$work/files"; }
library=$(of_kind '^src/.*\.c$')
command=$(of_kind '^tools/(cylint|render)/.*\.c$')
sources=$(of_kind '\.(c|cc|h)$')
scripts=$(of_kind '\.sh$')
pages=$(of_kind '^man/.*\.[0-9]$')
options='-std=c99 -Iinclude -Isrc -Itools/cylint -D_POSIX_C_SOURCE=200809L'
options="$options -DCYLINT_THREADS -DCYLINT_EMBREE=3"

# Removes findings that were checked and are no faults: those below a comment
# "lint: REASON", as far as the end of the function or type.
remove_checked() {
    awk -F: '
        function is_checked(file, line,    text, n, reason) {
            while (n < line && (getline text < file) > 0) {
                n++
                if (text ~ /lint: /)
                    reason = 1
                else if (text ~ /^}/ && n < line)
                    reason = 0
            }
            close(file)
            return reason
        }
        !is_checked($1, $2 + 0)'
}

# ------------------------------------------------------------- analysis --

if installed cppcheck cppcheck; then
    # Not enabled: style, whose rules differ from ours.
    cppcheck --quiet -j 2 --std=c99 --language=c --inline-suppr -Iinclude \
        -Isrc --enable=warning,portability,performance --max-configs=4 \
        --suppress=missingIncludeSystem --suppress=toomanyconfigs \
        --template='{file}:{line}: {severity}: {message} [{id}]' \
        $library $command 2>&1 | remove_checked >"$work/found"
    result cppcheck
fi

if installed clang-tidy clang-tidy; then
    # Of the analyzer's checks not those that want C11's Annex K.
    checks='-*,clang-analyzer-*,-clang-analyzer-security.insecureAPI.*'
    checks=$checks,bugprone-infinite-loop,bugprone-integer-division
    checks=$checks,bugprone-sizeof-*,bugprone-suspicious-mem*
    checks=$checks,bugprone-macro-repeated-side-effects
    for file in $library $command; do
        printf '%s\n' "$file"
    done | xargs -n 4 -P 2 sh -c 'checks=$1 options=$2; shift 2
        clang-tidy --quiet --checks="$checks" "$@" -- $options 2>/dev/null' \
        sh "$checks" "$options" | grep -E '(warning|error):' |
        sort -u | remove_checked >"$work/found"
    result clang-tidy
fi

if installed gcc 'gcc -fanalyzer'; then
    # many.c would take it half of an hour; most of it is in one.c, too.  It takes
    # three rounds of a loop for one: clang's analyzer finds numbers without a value.
    for file in $library $command; do
        [ "$file" = src/filter/many.c ] || printf '%s\n' "$file"
    done | xargs -n 1 -P 2 gcc $options -O1 -fanalyzer \
        -Wno-analyzer-use-of-uninitialized-value -c -o /dev/null 2>&1 |
        grep -E '(warning|error):' | sort -u | remove_checked >"$work/found"
    result 'gcc -fanalyzer'
fi

# ------------------------------------------------------------ the ladder --

if installed python3 'the ladder'; then
    python3 tests/support/ladder.py "${BUILD:-build}" >"$work/found" 2>&1
    result 'includes and calls point down the ladder of src/README.md'
fi

# -------------------------------------------------- scripts and manuals --

: >"$work/found"
for file in $scripts; do
    sh -n "$file" 2>>"$work/found"
done
result 'sh -n'

if installed actionlint 'the workflows'; then # go install github.com/rhysd/actionlint/cmd/actionlint@latest
    actionlint .github/workflows/*.yml >"$work/found" 2>&1
    result 'the workflows by actionlint'
fi

if installed mandoc mandoc; then
    # Manuals that are not installed are referenced.
    mandoc -T lint -W style $pages 2>&1 | grep -v \
        -e 'referenced manual not found: Xr \(cylint\|sbatch\|parallel\)' \
        -e 'outdated mandoc\.db' >"$work/found"
    result mandoc
fi
if installed groff groff; then
    groff -mdoc -Tutf8 -z $pages 2>&1 | grep -v "can't break line" >"$work/found"
    result groff
fi

# ------------------------------------------------------------ appearance --

if installed clang-format-14 'layout by clang-format'; then
    clang-format-14 --dry-run $(of_kind '\.(c|h)$' |
        grep -v '^tests/embree/embree4/') 2>&1 | grep 'warning:' >"$work/found"
    result 'layout as .clang-format has it'
fi

tab=$(printf '\t')
grep -nE "$tab" $sources $scripts >"$work/found"
result 'no tabs'

grep -nE "[ $tab]+\$" $sources $scripts Makefile README.md >"$work/found"
result 'no blanks at line ends'

# Aligned formulas may stay aligned; beyond these few columns nothing may.
awk 'length($0) > 80 {
    printf "%s%s:%d: %d columns\n", (length($0) > 84 ? "" : "note: "),
           FILENAME, FNR, length($0)
}' $sources >"$work/wide"
grep -v '^note' "$work/wide" >"$work/found"
result '80 columns'
grep '^note' "$work/wide"

for file in $sources; do
    lines=$(wc -l <"$file")
    [ "$lines" -lt 700 ] || printf '%s: %d lines\n' "$file" "$lines"
done >"$work/found"
result 'files below 700 lines'

for file in $(grep -Ev '^tests/fuzz/corpus/|\.png$' "$work/files"); do
    [ ! -s "$file" ] || [ -z "$(tail -c 1 "$file" | tr -d '\n')" ] ||
        printf '%s\n' "$file"
done >"$work/found"
result 'every file ends with a newline'

grep -nE '(^|[^[:alnum:]_])(TODO|FIXME|XXX)([^[:alnum:]_]|$)' $sources \
    $scripts | grep -v '^tests/support/lint.sh' >"$work/found"
result 'nothing left for later'

check_end
