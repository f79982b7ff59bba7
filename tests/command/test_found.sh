#!/bin/sh
# Floor command: the shapes that a scene's hierarchy finds are those of a loop over
# all shapes: --accel=none for lines, a record for each pair for points.
. "$(dirname "$0")/../support/verdict.sh"
cylint=$build/cylint

# 3,000 random cylinders and cones, 700 discs in a row, 5 infinite cylinders.
awk 'function at() { return 40 * rand() - 20 }
BEGIN {
    srand(7)
    for (i = 0; i < 3000; i++) {
        x = at(); y = at(); z = at()
        printf i % 3 ? "cylinder" : "cone"
        printf " %.17g %.17g %.17g", x, y, z
        if (i % 3 == 0) printf " %.17g", rand()
        printf " %.17g %.17g %.17g %.17g\n", x + rand(), y + rand(),
               z + rand(), rand() / 4
    }
    for (i = 0; i < 700; i++)
        print "cylinder", 30, 0, i / 8, 30, 0, i / 8 + 0.0625, 0.5
    for (i = 0; i < 5; i++)
        print "cylinder", at(), at(), at(), at(), at(), at(), 0.1, "ends=infinite"
}' >"$scratch/scene"
awk 'function at() { return 60 * rand() - 30 }
BEGIN {
    srand(8)
    for (i = 0; i < 4000; i++)
        print substr("ray    line   segment", 1 + 7 * (i % 3), 7), at(),
              at(), at(), at(), at(), at(), "id" i
    print "line 30 0 -5  0 0 1"
    print "line 30 0.5 -5  0 0 1"
    print "ray 30 0 3.9  0 0 -1"
    print "ray 3e7 -4e7 5e7  -3 4 -5"
    print "span 1e300 0 0  -1e297 0 0  -inf inf"
}' >"$scratch/lines"

# A loop over all shapes finds all hits; awk has the other answers from these.
found() { # WANT QUERY [OPTION]...: the answers without tails are those wanted
    want=$1 query=$2
    shift 2
    "$cylint" -s "$scratch/scene" -q $query -e skip "$@" "$scratch/lines" \
        2>"$scratch/log" >"$scratch/out"
    status=$?
    sed 's/\tid[0-9]*$//' "$scratch/out" | cmp -s - "$want" && [ $status -eq 1 ] &&
        [ "$(wc -l <"$scratch/log")" -eq 1 ]
    verdict "-q $query: a loop finds the same; one line is bad" $?
}
"$cylint" -s "$scratch/scene" -q all -f record,shape,t0,part0 -e skip --accel none \
    "$scratch/lines" 2>"$scratch/log" | sed 's/\tid[0-9]*$//' >"$scratch/none"
awk -v OFS='\t' -v of="$scratch/want." '
    function answer() {
        print near + 0, near ? t : "nan", near ? part : "-" >(of "nearest")
        some = n > 0
        print some >(of "any")
        print n + 0 >(of "count")
        near = n = 0
    }
    { while (last < $1) if (last++) answer(); n++ }
    !near || $3 + 0 < t + 0 { near = $2; t = $3; part = $4 }
    END { while (last++ < 4005) answer() }' "$scratch/none"
found "$scratch/none" all -f record,shape,t0,part0
for query in nearest any count; do
    found "$scratch/want.$query" $query
done
[ "$(cut -f 1 "$scratch/none" | grep -c '^4001$')" -eq 700 ]
verdict 'a line down 700 discs hits them all' $?

# --- points, some inside shapes.  A record for each point and shape gives all
# distances.
head -n 400 "$scratch/scene" >"$scratch/few"
awk 'NR % 50 == 0 && $5 + 0 { print "point", $2, $3, $4 / 2 }' "$scratch/lines" >"$scratch/points"
awk '/^cyl/ && NR % 20 == 1 { print "point", ($2 + $5) / 2, ($3 + $6) / 2, ($4 + $7) / 2 + 0.01 }' \
    "$scratch/few" >>"$scratch/points"
awk -v shapes="$scratch/few" '{ while ((getline shape < shapes) > 0) print $0, shape, NR
    close(shapes) }' "$scratch/points" >"$scratch/pairs"
for signed in '' --signed; do
    "$cylint" $signed -f distance,part -p 17 "$scratch/pairs" | awk -v signed=$signed '
        function answer() { if (NR > 1) print near "\t" least "\t" part "\t" n + 0 }
        $3 != last { answer(); n = number = 0; last = $3 }
        { size = signed || $1 > 0 ? $1 + 0 : -$1; number++; n += size <= 4 }
        number == 1 || size < least { near = number; least = size; part = $2 }
        END { answer() }' >"$scratch/want"
    "$cylint" -s "$scratch/few" $signed -p 17 -f shape,distance,part "$scratch/points" |
        awk -v signed=$signed '{ print $1 "\t" (signed || $2 > 0 ? $2 + 0 : -$2) "\t" $3 }' >"$scratch/near"
    "$cylint" -s "$scratch/few" $signed -q count --within 4 "$scratch/points" |
        paste "$scratch/near" - | cmp -s - "$scratch/want"
    verdict "the nearest shape of each point, and the number within 4 $signed" $?
    "$cylint" -s "$scratch/few" $signed -q all --within 4 -f id "$scratch/points" | uniq -c |
        awk '{ print $1 }' >"$scratch/counts"
    awk '$4 > 0 { print $4 }' "$scratch/want" | cmp -s - "$scratch/counts"
    verdict "all shapes within 4 of each point $signed" $?
done
[ "$(wc -l <"$scratch/want")" -gt 50 ]
verdict 'there are more than 50 points' $?

grep -v 1e300 "$scratch/lines" >"$scratch/good"

# --- shapes left out.  awk computes the expected answers from all hits without
# not=.  Every shape is in the scene twice with the label of its pair, so many
# hits have the same t.
awk 'NF < 10 && NR % 4 == 0 { n++; $NF += 1; print $0 "  L" n " stick"
                              print $0 "  L" n }' "$scratch/scene" >"$scratch/twins"
grep ' id[0-9]*$' "$scratch/good" >"$scratch/few"
"$cylint" -s "$scratch/twins" -q all -f record,shape,t0 -p 17 "$scratch/few" |
    sort -s -k1,1n -k3,3g >"$scratch/hits"
# leave_out HOW: writes lines with not= and their expected answers.  A third of
# the lines leave out no shape, a third the shape of the first hit, a third
# those of the first two hits.  HOW: by number or by label.
leave_out() { # HOW
    awk -v how="$1" -v few="$scratch/few" -v lines="$scratch/excluding" \
        -v expected="$scratch/expected" '
        function name(shape) {
            return how == "number" ? shape : "L" int((shape + 1) / 2)
        }
        function finish(    i, near, t, n, words, out) {
            while ((getline text < few) > 0 && ++record < last)
                answer(text, 0, "", 0)
            for (i = 1; i <= hits && i <= last % 3; i++) {
                words = words " not=" name(shape[i])
                out[name(shape[i])]
            }
            for (i = 1; i <= hits; i++)
                if (!(name(shape[i]) in out)) {
                    n++
                    if (!near || (t0[i] == t && shape[i] < near)) {
                        near = shape[i]
                        t = t0[i]
                    }
                }
            answer(text, near + 0, words, n + 0)
        }
        function answer(text, near, words, n) {
            match(text, / id[0-9]+$/)
            print substr(text, 1, RSTART - 1) words substr(text, RSTART) > lines
            print near "\t" n "\t" substr(text, RSTART + 1) > expected
        }
        $1 != last { if (last) finish(); last = $1; hits = 0 }
        { hits++; shape[hits] = $2; t0[hits] = $3 }
        END { finish(); while ((getline text < few) > 0) answer(text, 0, "", 0) }
    ' "$scratch/hits"
}
for how in number label; do
    leave_out $how
    [ "$(grep -c not= "$scratch/excluding")" -gt 500 ]
    verdict "--not $how: more than 500 lines leave out shapes" $?
    # By number a method, below, visits the shapes one by one, as none does.
    for accel in $([ $how = number ] || echo none) auto; do
        for query in nearest count any all; do
            "$cylint" -s "$scratch/twins" --not $how --accel $accel -q $query \
                "$scratch/excluding" >"$scratch/$query" || echo "status $?"
        done >"$scratch/log"
        cut -f 1,4 "$scratch/nearest" >"$scratch/answers"
        cut -f 1,3 "$scratch/expected" | cmp -s - "$scratch/answers"
        verdict "--not $how, --accel $accel: the nearest of the others" $?
        cut -f 2,3 "$scratch/expected" | cmp -s - "$scratch/count"
        verdict "--not $how, --accel $accel: the count of the others" $?
        awk '{ print ($2 > 0) "\t" $3 }' "$scratch/expected" |
            cmp -s - "$scratch/any"
        verdict "--not $how, --accel $accel: any of the others" $?
        cut -f 5 "$scratch/all" | uniq -c |
            awk '{ print $1 "\t" $2 }' >"$scratch/answers"
        awk '$2 > 0 { print $2 "\t" $3 }' "$scratch/expected" |
            cmp -s - "$scratch/answers" && [ ! -s "$scratch/log" ]
        verdict "--not $how, --accel $accel: all the others" $?
    done
    "$cylint" -s "$scratch/twins" --not $how --method=quadratic -f shape,t \
        "$scratch/excluding" 2>/dev/null | cut -f 1,3 >"$scratch/answers"
    agree=$(cut -f 1,3 "$scratch/expected" | paste - "$scratch/answers" |
        awk '$1 == $3 { n++ } END { print int(1000 * n / NR) }')
    [ "$agree" -ge 999 ]
    verdict "--not $how: --method=quadratic leaves them out too" $?
done
check_end
