#!/bin/sh
# Floor command: `cylint -s neuron.swc` makes the shapes of the definition, whatever
# the form of the file; their text gives the same answers.  swc.txt has small files
# and those that are refused.
. "$(dirname "$0")/../support/verdict.sh"
data=../shared/data
native=$scratch/neuron.swc converted=$scratch/neuron.scene

# answers SCENE OPTION...: writes all hits of the lines, with all bits, and all
# messages.
answers()
{
    "$build/cylint" -s "$@" -q all -x "$scratch/lines" \
        > "$scratch/answers" 2> "$scratch/messages"
}

# Lines through `each` and every following nth node, in changing directions.
lines_through_nodes()
{
    awk -v each="$2" '/^[^#]/ && ++n % each == 0 {
        print "line", $3 + 0.1 * $6, $4, $5, cos(n), sin(n), cos(7 * n)
    }' "$1" > "$scratch/lines"
}

# same NAME: the file read and the text of its scene give the same answers, as cones
# and as round shapes.
same()
{
    for form in cones round; do
        in_form $form
        verdict "${1}_as_$form" $?
    done
}

in_form()
{
    "$build/cylint" -s "$native" --swc=$1 --text > "$converted" 2> "$scratch/skipped" &&
        answers "$converted" && mv "$scratch/answers" "$scratch/expected" &&
        [ -s "$scratch/expected" ] && [ ! -s "$scratch/messages" ] &&
        answers "$native" --swc=$1 &&
        cmp "$scratch/expected" "$scratch/answers" &&
        diff "$scratch/skipped" "$scratch/messages"
}

# is_plain NAME FILE: the scene of the file is that of the neuron's nodes, by a
# reader of plain lines: number type x y z radius parent.
is_plain()
{
    for form in cones round; do
        awk -v form=$form '
            { at[$1] = $3 " " $4 " " $5; r[$1] = $6; up[$1] = $7; node[NR] = $1 }
            END {
                for (i = 1; i <= NR; i++) {
                    n = node[i]; p = up[n]
                    if (p in at && (r[n] > 0 || r[p] > 0) && (form == "round" || at[n] != at[p]))
                        print (form == "round" ? "rcone" : "cone"), at[n], r[n], at[p], r[p], n
                    if (!(p in at) && form == "round" && r[n] > 0)
                        print "sphere", at[n], r[n], n
                }
            }' "$scratch/plain" > "$scratch/shapes"
        "$build/cylint" --save "$scratch/want" -s "$scratch/shapes" &&
            "$build/cylint" --save "$scratch/saved" -s "$native" --swc=$form 2> /dev/null &&
            cmp "$scratch/want" "$scratch/saved"
        verdict "${1}_as_$form" $?
    done
}

# Nodes of a random tree; ids have gaps, some edges have length 0 or radius 0.
random_neuron()
{
    awk -v seed="$1" -v nodes="$2" 'BEGIN {
        srand(seed)
        for (n = 1; n <= nodes; n++) {
            step = rand() < 0.1 ? 0 : 1
            p = n == 1 || rand() < 0.02 ? 0 : n - 1 - int(rand() * (n - 1) / 4)
            x[n] = x[p] + step * (rand() - 0.5); y[n] = y[p] + step * rand()
            z[n] = z[p] + step * rand()
            print 7 * n, int(rand() * 5), x[n], y[n], z[n],
                  rand() < 0.2 ? 0 : rand(), p ? 7 * p : -1
        }
    }'
}

test_same_shapes()
{
    random_neuron 1 3000 | tee "$scratch/plain" > "$native"
    lines_through_nodes "$native" 3
    is_plain swc_has_the_shapes_of_the_definition
    same swc_is_read_as_its_text
    awk 'BEGIN { srand(3) } { print rand(), $0 }' "$native" | sort |
        cut -d ' ' -f 2- > "$scratch/mixed" && mv "$scratch/mixed" "$native"
    cp "$native" "$scratch/plain"
    is_plain swc_parents_may_stand_anywhere
    { printf '\357\273\277# a neuron\r\n\r\n'
      sed 's/ /\t  /g; s/^/ /; s/$/ behind, the parent\r/' "$native" |
          awk '{ sub(/ -1 /, " -1\t"); print }
               NR % 9 == 0 { print "  # comment\n" }'
      printf '0030 1 1e0 .5 -.25e+1 1. 000'; } > "$scratch/mixed"
    printf '0 9 0 0 0 4 -1\n' | cat "$scratch/mixed" - |
        sed 's/0000 9/000\n0 9/' > "$native"
    same swc_blanks_comments_and_ends_of_lines_do_not_matter
    random_neuron 1 3000 > "$native"
    awk '{ $1 = $1 ".0"; $7 = NR % 3 ? $7 ".00" : $7 / 10 "e1"
           gsub(/ /, NR % 2 ? " , " : "\t"); printf "%s\r", $0 }
         NR % 50 == 0 { print "# a comment" }' "$native" > "$scratch/mixed" &&
        mv "$scratch/mixed" "$native"
    same swc_numbers_may_be_decimal_fields_have_commas_and_lines_end_in_cr
    random_neuron 1 3000 | grep -v '0 ' | head -2000 > "$native"
    same swc_parents_may_be_missing
    grep -q 'whose parent is not in the file are roots' "$scratch/messages"
    verdict swc_missing_parents_are_counted $?
    awk 'BEGIN { for (n = 0; n < 4000; n++)
        print n * 4096, 0, n % 20, n / 7, n, 2, n ? (n - 1) * 4096 : -1 }' > "$native"
    lines_through_nodes "$native" 9
    same swc_numbers_may_be_multiples_of_a_power_of_two
}

# 300 neurons with one byte changed: refused with one message, or read, and then the
# text of the scene has the same answers.
test_one_byte_changed()
{
    random_neuron 2 20 > "$scratch/good"
    lines_through_nodes "$scratch/good" 1
    wrong=0 refused=0
    i=0
    while [ $i -lt 300 ]; do
        i=$((i + 1))
        awk -v seed=$i 'BEGIN { srand(seed); RS = "\001" } {
            at = 1 + int(rand() * length($0))
            bytes = "0123456789-+.eExX# \t,,a\n\r"
            new = substr(bytes, 1 + int(rand() * length(bytes)), 1)
            printf "%s", substr($0, 1, at - 1) new substr($0, at + 1)
        }' "$scratch/good" > "$native"
        answers "$native"
        status=$?
        mv "$scratch/answers" "$scratch/expected"
        if [ $status -eq 1 ] && [ "$(grep -c "^cylint: $native:" "$scratch/messages")" -eq 1 ]; then
            refused=$((refused + 1))
        else
            [ $status -eq 0 ] &&
                "$build/cylint" -s "$native" --text > "$converted" 2> "$scratch/skipped" &&
                answers "$converted" && cmp -s "$scratch/expected" "$scratch/answers" ||
                { wrong=$((wrong + 1)); cat "$scratch/messages"; }
        fi
    done
    [ $wrong -eq 0 ] && [ $refused -gt 30 ] && [ $refused -lt 270 ] ||
        { echo "$wrong of 300 differ, $refused were refused"; false; }
    verdict swc_with_a_byte_changed_is_refused_or_read $?
}

test_real_neuron()
{
    cp $data/medulla_7114.swc "$native"
    lines_through_nodes "$native" 50
    grep -v '^#' "$native" > "$scratch/plain"
    is_plain swc_a_real_neuron_has_the_shapes_of_the_definition
    same swc_a_real_neuron_is_read_as_its_text
    tr '\n' '\r' < $data/medulla_top24.swc > "$native" # 3.8 MB without a LF
    same swc_a_file_without_line_feeds_may_be_long
}

test_same_shapes
test_one_byte_changed
if [ -d $data ]; then
    test_real_neuron
else
    echo "note: no $data, the test on a real neuron is left out"
fi
check_end
