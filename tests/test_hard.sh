#!/bin/sh
# The records of hard.txt through the command: the left of each `=>` is the
# input, the right what must be answered.  Numbers are compared as numbers.
here=$(dirname "$0")
cylint=${BUILD:-build}/cylint
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

grep '=>' "$here/hard.txt" | grep -v '^#' >"$work/cases"
sed 's/ *=>.*//' "$work/cases" >"$work/input"
sed 's/.*=> *//' "$work/cases" >"$work/expected"
"$cylint" "$work/input" >"$work/answers" 2>"$work/messages"
status=$?
[ -s "$work/messages" ] && cat "$work/messages"

# paste's TAB parts answer from expectation; the answer's own are blanks
tr '\t' ' ' <"$work/answers" | paste - "$work/expected" "$work/input" |
awk -F '\t' -v status=$status '
function number(x) { return x ~ /^-?[0-9]/ }
function same(x, y) {
    return x == y "" || (number(x) && number(y) && x + 0 == y + 0)
}
{
    n = split($1, got, " ")
    m = split($2, want, " ")
    good = n == m && m == 4
    for (i = 1; i <= m && good; i++) good = same(got[i] "", want[i] "")
    if (good) passed++
    else { failed++; printf "%s\n  got  %s\n  want %s\n", $3, $1, $2 }
}
END {
    if (status != 0) { print "exit status " status; failed++ }
    if (NR == 0) { print "no cases"; failed++ }
    printf "%d passed, %d failed\n", passed, failed
    exit failed > 0
}'
