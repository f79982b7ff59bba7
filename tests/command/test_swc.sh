#!/bin/sh
# `cylint -s neuron.swc` makes the shapes of the definition, whatever the form of
# the file.  swc.txt has small files and those that are refused.
. "$(dirname "$0")/../support/verdict.sh"
PATH=$build:$PATH
data=../shared/data
native=$scratch/neuron.swc

# is_plain NAME: the scene of the file is that of the nodes of `plain`, by a reader of
# plain lines: number type x y z radius parent.
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
        cylint --save "$scratch/want" -s "$scratch/shapes" &&
            cylint --save "$scratch/saved" -s "$native" --swc=$form 2> "$scratch/messages" &&
            cmp "$scratch/want" "$scratch/saved"
        verdict "${1}_as_$form" $?
    done
}

# Nodes of a random tree; ids have gaps, some edges have length 0 or radius 0.
random_neuron()
{
    awk -v seed="$1" -v nodes="$2" -v OFMT=%.17g 'BEGIN {
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
    is_plain swc_has_the_shapes_of_the_definition
    awk 'BEGIN { srand(3) } { print rand(), $0 }' "$native" | sort |
        cut -d ' ' -f 2- > "$scratch/plain"
    cp "$scratch/plain" "$native"
    is_plain swc_parents_may_stand_anywhere
    { printf '\357\273\277# a neuron\r\n\r\n'
      sed 's/ /\t  /g; s/^/ /; s/$/ behind, the parent\r/' "$native" |
          awk '{ sub(/ -1 /, " -1\t"); print }
               NR % 9 == 0 { print "  # comment\n" }'
      printf '0030 1 1e0 .5 -.25e+1 1. 000\n0 9 0 0 0 4 -1\n'; } > "$scratch/mixed"
    mv "$scratch/mixed" "$native"
    printf '30 1 1 0.5 -2.5 1 0\n0 9 0 0 0 4 -1\n' >> "$scratch/plain"
    is_plain swc_blanks_comments_and_ends_of_lines_do_not_matter
    random_neuron 1 3000 | tee "$scratch/plain" |
        awk '{ $1 = $1 ".0"; $7 = NR % 3 ? $7 ".00" : $7 / 10 "e1"
               gsub(/ /, NR % 2 ? " , " : "\t"); printf "%s\r", $0 }
             NR % 50 == 0 { print "# a comment" }' > "$native"
    is_plain swc_numbers_may_be_decimal_fields_have_commas_and_lines_end_in_cr
    random_neuron 1 3000 | grep -v '0 ' | head -2000 | tee "$scratch/plain" > "$native"
    is_plain swc_parents_may_be_missing
    grep -q 'whose parent is not in the file are roots' "$scratch/messages"
    verdict swc_missing_parents_are_counted $?
    awk 'BEGIN { for (n = 0; n < 4000; n++)
        print n * 4096, 0, n % 20, n / 7, n, 2, n ? (n - 1) * 4096 : -1 }' |
        tee "$scratch/plain" > "$native"
    is_plain swc_numbers_may_be_multiples_of_a_power_of_two
}

test_real_neuron()
{
    cp $data/medulla_7114.swc "$native"
    grep -v '^#' "$native" > "$scratch/plain"
    is_plain swc_a_real_neuron_has_the_shapes_of_the_definition
    grep -v '^#' $data/medulla_top24.swc > "$scratch/plain"
    tr '\n' '\r' < $data/medulla_top24.swc > "$native" # 3.8 MB without a LF
    is_plain swc_a_file_without_line_feeds_may_be_long
}

test_same_shapes
if [ -d $data ]; then
    test_real_neuron
else
    echo "note: no $data, the test on a real neuron is left out"
fi
check_end
