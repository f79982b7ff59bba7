#!/bin/sh
# Floors intersect and command: the command answers the records of hard.txt.
# In each line the input is left of `=>`, the expected answer right of it.
# Numbers are compared as numbers.
. "$(dirname "$0")/../support/verdict.sh"

grep '=>' tests/library/hard.txt | grep -v '^#' >"$scratch/cases"
sed 's/ *=>.*//' "$scratch/cases" >"$scratch/input"
sed 's/.*=> *//' "$scratch/cases" >"$scratch/expected"
"$build/cylint" "$scratch/input" >"$scratch/answers" 2>"$scratch/messages"
status=$?
[ -s "$scratch/messages" ] && cat "$scratch/messages"

# paste separates by TAB, so the answer's own TABs become blanks
tr '\t' ' ' <"$scratch/answers" | paste - "$scratch/expected" "$scratch/input" |
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
