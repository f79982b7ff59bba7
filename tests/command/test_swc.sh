#!/bin/sh
# Floors command and tools: `cylint -s neuron.swc` and cylint-convert swc read the
# same shapes in the same order and refuse the same files with the same message,
# at the column of the bad field.
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

# both NAME: the file read and the file converted give the same answers, as cones
# and as round shapes.
both()
{
    for form in cones round; do
        in_form $form
        verdict "${1}_as_$form" $?
    done
}

in_form()
{
    tools/convert/swc2scene --swc=$1 "$native" > "$converted" 2> "$scratch/skipped" &&
        answers "$converted" && mv "$scratch/answers" "$scratch/expected" &&
        [ -s "$scratch/expected" ] && [ ! -s "$scratch/messages" ] &&
        answers "$native" --swc=$1 &&
        cmp "$scratch/expected" "$scratch/answers" &&
        sed "s|^cylint-convert: |cylint: $native: |" "$scratch/skipped" |
        diff - "$scratch/messages"
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
    random_neuron 1 3000 > "$native"
    lines_through_nodes "$native" 3
    both swc_is_read_as_it_is_converted
    awk 'BEGIN { srand(3) } { print rand(), $0 }' "$native" | sort |
        cut -d ' ' -f 2- > "$scratch/mixed" && mv "$scratch/mixed" "$native"
    both swc_parents_may_stand_anywhere
    { printf '\357\273\277# a neuron\r\n\r\n'
      sed 's/ /\t  /g; s/^/ /; s/$/ behind, the parent\r/' "$native" |
          awk '{ sub(/ -1 /, " -1\t"); print }
               NR % 9 == 0 { print "  # comment\n" }'
      printf '0030 1 1e0 .5 -.25e+1 1. 000'; } > "$scratch/mixed"
    printf '0 9 0 0 0 4 -1\n' | cat "$scratch/mixed" - |
        sed 's/0000 9/000\n0 9/' > "$native"
    both swc_blanks_comments_and_ends_of_lines_do_not_matter
    random_neuron 1 3000 > "$native"
    awk '{ $1 = $1 ".0"; $7 = NR % 3 ? $7 ".00" : $7 / 10 "e1"
           gsub(/ /, NR % 2 ? " , " : "\t"); printf "%s\r", $0 }
         NR % 50 == 0 { print "# a comment" }' "$native" > "$scratch/mixed" &&
        mv "$scratch/mixed" "$native"
    both swc_numbers_may_be_decimal_fields_have_commas_and_lines_end_in_cr
    random_neuron 1 3000 | grep -v '0 ' | head -2000 > "$native"
    both swc_parents_may_be_missing
    grep -q 'with a parent that is not in the file taken as roots' \
        "$scratch/messages"
    verdict swc_missing_parents_are_counted $?
    awk 'BEGIN { for (n = 0; n < 4000; n++)
        print n * 4096, 0, n % 20, n / 7, n, 2, n ? (n - 1) * 4096 : -1 }' \
        > "$native"
    lines_through_nodes "$native" 9
    both swc_numbers_may_be_multiples_of_a_power_of_two
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
    both swc_what_has_no_radius_gives_nothing
    grep -q '1 root of no radius skipped' "$scratch/messages"
    verdict swc_roots_without_radius_are_counted $?
    # The line enters at the point of the rounded cone and leaves through the ball
    # about node 3, its first.
    [ "$("$build/cylint" -s "$native" --swc=round -q all -f t0,t1 "$scratch/lines")" = "$(printf '5\t16')" ] &&
        [ "$("$build/cylint" -s "$native" --swc=round --ends cap1 -q all -f t0,t1 "$scratch/lines")" = "$(printf '5\tnan')" ]
    verdict swc_rounded_cones_have_the_ends_of_the_option $?
}

# refuses MESSAGE LINE...: both readers refuse a file of these lines with MESSAGE.
refuses()
{
    message=$1
    shift
    printf '%b\n' "$@" > "$native"
    said_by_both && [ "$(cat "$scratch/messages")" = "cylint: $native:$message" ]
    verdict "swc_refused: $message" $? || cat "$scratch/messages"
}

# Both exit with 1 and the same message except program and column, or both read
# the file.
said_by_both()
{
    tools/convert/swc2scene "$native" > "$converted" 2> "$scratch/expected"
    converts=$?
    answers "$native"
    [ $? -eq $converts ] || return 1
    if [ $converts -eq 0 ]; then
        sed "s|^cylint-convert: |cylint: $native: |" "$scratch/expected" |
            diff - "$scratch/messages"
    else
        sed 's/^cylint:/cylint-convert:/; s/:\([0-9]*\):[0-9]*: /:\1: /' \
            "$scratch/messages" | diff "$scratch/expected" -
    fi
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
    refuses "1:12: expected a node's number or -1, found the end of the line" \
        '1 1 0 0 0 2'
    refuses "3:11: negative radius: '-2'" '# a\n' '1 1 0 0 0 -2 -1'
    refuses "1:1: expected a node's number, found '1.5'" '1.5 1 0 0 0 2 -1'
    refuses "1:1: expected a node's number, found '9007199254740992.0'" \
        '9007199254740992.0 1 0 0 0 2 -1'
    refuses "1:11: expected a number, found 'nan'" '1 1 0 0 0 nan -1'
    refuses "1:2: expected a node's number, found '-1'" ' -1 1 0 0 0 2 -1'
    refuses "1:1: expected a node's number, found '1234567890123456789'" \
        '1234567890123456789 1 0 0 0 2 -1'
    refuses "1:13: expected a node's number or -1, found '-2'" \
        '1 1 0 0 0 2 -2'
    refuses "2:2: this node was given before: '01'" "$root" '\t01 1 0 0 9 2 -1'
    refuses "2:13: node 2 is its own parent" "$root" '2 1 0 0 9 2 2.0'
    refuses "2:13: the parents of node 7 lead back to it" "$root" \
        '7 1 0 0 9 2 5' '4 1 0 0 9 2 1' '5 1 0 0 9 2 6' '6 1 0 0 9 2 7'
    refuses "3:13: the parents of node 7 lead back to it" \
        '3 1 0 0 1 2 5' "$root" '7 1 0 0 9 2 5' '5 1 0 0 9 2 7'
    refuses "3:3: expected a number, found the end of the line" \
        '5 0 0 0 0 1 7' "$root" '2 '
    refuses ' no node was found' '# a comment' ''
    : > "$native"
    said_by_both && [ "$(cat "$scratch/messages")" = \
        "cylint: $native: no node was found" ]
    verdict swc_refuses_an_empty_file $?
    awk 'BEGIN { while (n++ <= 1024 * 1024) printf "1" }' > "$native"
    answers "$native"
    [ $? -eq 1 ] && [ "$(cat "$scratch/messages")" = \
        "cylint: $native:1:1: line longer than 1 MiB" ]
    verdict swc_refuses_lines_longer_than_1_mib $?
}

# 300 neurons with one byte changed: both readers give the same scene or the same
# message.
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
        if said_by_both > "$scratch/log"; then
            [ $converts -eq 0 ] || { refused=$((refused + 1)); continue; }
            mv "$scratch/answers" "$scratch/expected"
            answers "$converted" &&
                cmp -s "$scratch/expected" "$scratch/answers" && continue
        fi
        wrong=$((wrong + 1))
        cat "$scratch/log"
    done
    [ $wrong -eq 0 ] && [ $refused -gt 30 ] && [ $refused -lt 270 ] ||
        { echo "$wrong of 300 differ, $refused were refused"; false; }
    verdict swc_with_a_byte_changed_is_read_as_converted $?
}

test_real_neuron()
{
    cp $data/medulla_7114.swc "$native"
    lines_through_nodes "$native" 50
    both swc_a_real_neuron_is_read_as_it_is_converted
    tr '\n' '\r' < $data/medulla_top24.swc > "$native" # 3.8 MB without a LF
    both swc_a_file_without_line_feeds_may_be_long
}

test_same_shapes
test_refused
test_one_byte_changed
if [ -d $data ]; then
    test_real_neuron
else
    echo "note: no $data, the test on a real neuron is left out"
fi
check_end
