#!/bin/sh
# Floor command: `cylint -s neuron.swc` makes the shapes of the definition, whatever
# the form of the file; their text gives the same answers; bad files are refused with
# a message at the bad field.
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

# text NAME SCENE FILE [OPTION]: the file (printf) has the scene SCENE.
text()
{
    printf "$3" > "$native"
    printf "$2" > "$scratch/expected"
    "$build/cylint" -s "$native" --text $4 2> "$scratch/messages" | diff "$scratch/expected" -
    verdict "$1" $?
}

# says NAME MESSAGE: what the last command wrote to standard error.
says()
{
    [ "$(cat "$scratch/messages")" = "$2" ] || { cat "$scratch/messages"; false; }
    verdict "$1" $?
}

test_small_files()
{
    text swc_gives_a_frustum_from_node_to_parent \
        'cone 0 0 10 1 0 0 0 0.5 2\ncone 0 1 10 0 0 0 10 1 3\n' \
        '# neuron\n1 1 0 0 0 0.50 -1\n 2 3 0 0 1e1 1.0 1\n\n3 3 0 1 10 0 2\n'
    text swc_gives_rounded_cones_and_a_sphere_at_the_root \
        'sphere 0 0 0.5 2 1\nrcone 0 0 10 1 0 0 0.5 2 2\nrcone 0 1 10 0 0 0 10 1 3\n' \
        '1 1 0 0 0.50 2 -1\n2 3 0 0 1e1 1.0 1\n3 3 0 1 10 0 2\n' --swc=round
    text swc_a_soma_of_one_point_gives_a_sphere 'sphere 1 2 3 4 7\n' \
        '7 1 1 2 3 4 -1\n' --swc=round
    text swc_a_root_alone_gives_nothing '' '1 1 0 0 0 2 -1\n'
    text swc_parents_may_follow_and_lines_may_end_in_cr_lf 'cone 0 0 4 1 0 0 0 2 2\n' \
        '2 3 0 0 4 1 1\r\n1 1 0 0 0 2 -1\r\n'
    text swc_may_begin_with_a_mark_and_end_without_a_newline \
        'cone 0 0 4 1 0 0 0 2 2\n' '\357\273\2771 1 0 0 0 2 -1\n2 3 0 0 4 1 1'
    text swc_edges_that_bound_nothing_are_left_out 'cone 0 0 1 0 -0 0 0 2 4\n' \
        '1 1 0 0 0 1 -1\n2 0 0.0 0 0 2 1\n3 0 -0 0e5 0 2 2\n4 0 0 0 1 0 3\n5 0 0 0 2 0 4\n'
    says swc_edges_left_out_are_counted "cylint: $native: 2 edges of no length skipped
cylint: $native: 1 edge of no radius skipped"
    text swc_edges_without_length_are_balls \
        'rcone 0 0 0 2 0 0 0 0 2\nrcone 0 0 0 1 0 0 0 2 3\nsphere 9 9 9 1 5\n' \
        '1 1 0 0 0 0 -1\n2 3 0 0 0 2 1\n3 3 0 0 0 1 2\n4 3 0 0 5 0 1\n5 3 9 9 9 1 77\n' --swc=round
    says swc_what_has_no_radius_is_counted "cylint: $native: 1 node with a parent that is not in the file taken as a root
cylint: $native: 1 edge of no radius skipped
cylint: $native: 1 root of no radius skipped"
    for file in '1.0 1 0 0 0 2 -1.0\n2.0 3. 0 0 4 1 1.0\n10. 3 0 0 9 1 2e0\n' \
        '1,1,0,0,0,2,-1\n2 , 3 , 0 , 0 , 4 , 1 , 1,\n10\t3,0 0,9 1,2\n' \
        '# mac\r1 1 0 0 0 2 -1\r\r2 3 0 0 4 1 1\r10 3 0 0 9 1 2' \
        '1 1 0 0 0 2 0\n2 3 0 0 4 1 1\n10 3 0 0 9 1 2\n11 3 9 9 9 1 12\n'; do
        text "swc_is_read_as_found: $file" \
            'cone 0 0 4 1 0 0 0 2 2\ncylinder 0 0 9 0 0 4 1 10\n' "$file"
    done
    says swc_parents_that_are_not_in_the_file_are_counted \
        "cylint: $native: 2 nodes with a parent that is not in the file taken as roots"
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
    grep -q 'with a parent that is not in the file taken as roots' "$scratch/messages"
    verdict swc_missing_parents_are_counted $?
    awk 'BEGIN { for (n = 0; n < 4000; n++)
        print n * 4096, 0, n % 20, n / 7, n, 2, n ? (n - 1) * 4096 : -1 }' > "$native"
    lines_through_nodes "$native" 9
    same swc_numbers_may_be_multiples_of_a_power_of_two
    cp "$native" "$scratch/NEURON.SWC"
    answers "$native" && mv "$scratch/answers" "$scratch/expected" &&
        answers "$scratch/NEURON.SWC" &&
        cmp "$scratch/expected" "$scratch/answers"
    verdict swc_may_be_written_in_capitals $?
    printf '1 1 0 0 0 2 -1\n2 3 0 0 10 1 1\n' > "$native"
    echo 'ray 0 0 -5  0 0 1' > "$scratch/lines"
    [ "$("$build/cylint" -s "$native" "$scratch/lines")" = "$(printf '1\t5\tcap1')" ] &&
        [ "$("$build/cylint" -s "$native" --ends open "$scratch/lines")" = "$(printf '0\tnan\t-')" ]
    verdict swc_frusta_have_the_ends_of_the_option $?
    printf '1 1 0 0 0 0 -1\n2 3 0 0 0 0 1\n3 3 0 0 10 1 2\n' > "$native"
    same swc_what_has_no_radius_gives_nothing
    grep -q '1 root of no radius skipped' "$scratch/messages"
    verdict swc_roots_without_radius_are_counted $?
    # The line enters at the point of the rounded cone and leaves through the ball
    # about node 3, its first.
    [ "$("$build/cylint" -s "$native" --swc=round -q all -f t0,t1 "$scratch/lines")" = "$(printf '5\t16')" ] &&
        [ "$("$build/cylint" -s "$native" --swc=round --ends cap1 -q all -f t0,t1 "$scratch/lines")" = "$(printf '5\tnan')" ]
    verdict swc_rounded_cones_have_the_ends_of_the_option $?
}

# refuses MESSAGE LINE...: a file of these lines is refused with MESSAGE.
refuses()
{
    message=$1
    shift
    printf '%b\n' "$@" > "$native"
    answers "$native"
    [ $? -eq 1 ] && [ "$(cat "$scratch/messages")" = "cylint: $native:$message" ]
    verdict "swc_refused: $message" $? || cat "$scratch/messages"
}

test_refused()
{
    root='1 1 0 0 0 2 -1'
    echo 'ray 0 0 -5  0 0 1' > "$scratch/lines"
    refuses "2:7: expected a number, found 'abc'" "$root" '2 1 0 abc 0 2 1'
    refuses "1:9: number too large: '1e999'" '1 1 0 0 1e999 2 -1'
    refuses "1:9: expected a number, found 'nan'" '1 1 0 0 nan 2 -1'
    refuses "1:9: expected a number, found '0x10'" '1 1 0 0 0x10 2 -1'
    refuses "1:9: expected a number, found '1e'" '1 1 0 0 1e 2 -1'
    refuses "1:5: expected a number, found ','" '1 1,,0,0,0 2 -1'
    refuses "1:9: expected a number, found the end of the line" '1 1 0 0 '
    refuses "1:12: expected a node's number or -1, found the end of the line" '1 1 0 0 0 2'
    refuses "3:11: negative radius: '-2'" '# a\n' '1 1 0 0 0 -2 -1'
    refuses "1:1: expected a node's number, found '1.5'" '1.5 1 0 0 0 2 -1'
    refuses "1:1: expected a node's number, found '9007199254740992.0'" \
        '9007199254740992.0 1 0 0 0 2 -1'
    refuses "1:11: expected a number, found 'nan'" '1 1 0 0 0 nan -1'
    refuses "1:2: expected a node's number, found '-1'" ' -1 1 0 0 0 2 -1'
    refuses "1:1: expected a node's number, found '1234567890123456789'" \
        '1234567890123456789 1 0 0 0 2 -1'
    refuses "1:13: expected a node's number or -1, found '-2'" '1 1 0 0 0 2 -2'
    refuses "2:2: this node was given before: '01'" "$root" '\t01 1 0 0 9 2 -1'
    refuses "2:13: node 2 is its own parent" "$root" '2 1 0 0 9 2 2.0'
    refuses "2:13: the parents of node 7 lead back to it" "$root" \
        '7 1 0 0 9 2 5' '4 1 0 0 9 2 1' '5 1 0 0 9 2 6' '6 1 0 0 9 2 7'
    refuses "3:13: the parents of node 7 lead back to it" \
        '3 1 0 0 1 2 5' "$root" '7 1 0 0 9 2 5' '5 1 0 0 9 2 7'
    refuses "3:3: expected a number, found the end of the line" '5 0 0 0 0 1 7' "$root" '2 '
    refuses ' no node was found' '# a comment' ''
    : > "$native"
    answers "$native"
    [ $? -eq 1 ] && [ "$(cat "$scratch/messages")" = "cylint: $native: no node was found" ]
    verdict swc_refuses_an_empty_file $?
    awk 'BEGIN { while (n++ <= 1024 * 1024) printf "1" }' > "$native"
    answers "$native"
    [ $? -eq 1 ] && [ "$(cat "$scratch/messages")" = \
        "cylint: $native:1:1: line longer than 1 MiB" ]
    verdict swc_refuses_lines_longer_than_1_mib $?
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

test_small_files
test_same_shapes
test_refused
test_one_byte_changed
if [ -d $data ]; then
    test_real_neuron
else
    echo "note: no $data, the test on a real neuron is left out"
fi
check_end
