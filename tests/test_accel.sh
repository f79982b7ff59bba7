#!/bin/sh
# However a scene is searched, `cylint` answers the same bytes.  The lines
# are more than auto asks by batches before it builds a hierarchy.
. "$(dirname "$0")/verdict.sh"
cylint=$build/cylint

# 3,000 sticks and cones at random, 700 discs in a row, and some without end.
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
        print "cylinder", at(), at(), at(), at(), at(), at(), 0.1, \
              "ends=infinite"
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

for query in nearest any count all; do
    "$cylint" -s "$scratch/scene" -q $query --accel none -j 1 \
        "$scratch/lines" >"$scratch/none" 2>"$scratch/complaints"
    status=$?
    "$cylint" -s "$scratch/scene" -q $query -j 2 "$scratch/lines" \
        2>>"$scratch/complaints" | cmp -s - "$scratch/none"
    verdict "-q $query: --accel auto answers as none does" $?
    [ $status -eq 1 ] && [ -s "$scratch/none" ]
    verdict "-q $query answers, and says that one line is bad" $?
done
[ "$(cut -f 1 "$scratch/none" | grep -c '^4001$')" -eq 700 ]
verdict 'a line down 700 discs hits them all' $?

grep -v 1e300 "$scratch/lines" >"$scratch/good"
"$cylint" -s "$scratch/scene" --accel none -q all "$scratch/good" \
    >"$scratch/none"
for how in tree embree; do
    "$cylint" -s "$scratch/scene" --accel $how -q all "$scratch/good" |
        cmp -s - "$scratch/none"
    verdict "--accel $how answers as none does" $?
done

# --- shapes left out.  All hits without not=, and awk, say what is right.
# Every shape is there twice, under a label of its pair, so that many hits
# have the same t.
awk 'NF < 10 && NR % 4 == 0 { n++; $NF += 1; print $0 "  L" n " stick"
                              print $0 "  L" n }' "$scratch/scene" >"$scratch/twins"
grep ' id[0-9]*$' "$scratch/good" >"$scratch/few"
"$cylint" -s "$scratch/twins" -q all -f record,shape,t0 -p 17 "$scratch/few" |
    sort -s -k1,1n -k3,3g >"$scratch/hits"
# Leaves out the shapes of the first hits: a third of the lines none, one, two
# shapes; HOW: number or label.  Writes lines with not=, and the answers.
leave_out() { # HOW
    awk -v how="$1" -v few="$scratch/few" -v asked="$scratch/asked" \
        -v right="$scratch/right" '
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
            print substr(text, 1, RSTART - 1) words substr(text, RSTART) > asked
            print near "\t" n "\t" substr(text, RSTART + 1) > right
        }
        $1 != last { if (last) finish(); last = $1; hits = 0 }
        { hits++; shape[hits] = $2; t0[hits] = $3 }
        END { finish(); while ((getline text < few) > 0) answer(text, 0, "", 0) }
    ' "$scratch/hits"
}
for how in number label; do
    leave_out $how
    [ "$(grep -c not= "$scratch/asked")" -gt 500 ]
    verdict "--not $how: there are lines that leave out shapes" $?
    for accel in none tree auto; do
        for query in nearest count any all; do
            "$cylint" -s "$scratch/twins" --not $how --accel $accel -q $query \
                "$scratch/asked" >"$scratch/$query" || echo "status $?"
        done >"$scratch/log"
        cut -f 1,4 "$scratch/nearest" >"$scratch/said"
        cut -f 1,3 "$scratch/right" | cmp -s - "$scratch/said"
        verdict "--not $how, --accel $accel: the nearest of the others" $?
        cut -f 2,3 "$scratch/right" | cmp -s - "$scratch/count"
        verdict "--not $how, --accel $accel: the count of the others" $?
        awk '{ print ($2 > 0) "\t" $3 }' "$scratch/right" |
            cmp -s - "$scratch/any"
        verdict "--not $how, --accel $accel: whether there is another" $?
        cut -f 5 "$scratch/all" | uniq -c |
            awk '{ print $1 "\t" $2 }' >"$scratch/said"
        awk '$2 > 0 { print $2 "\t" $3 }' "$scratch/right" |
            cmp -s - "$scratch/said" && [ ! -s "$scratch/log" ]
        verdict "--not $how, --accel $accel: all the others" $?
    done
    "$cylint" -s "$scratch/twins" --not $how --method=quadratic -f shape,t \
        "$scratch/asked" 2>/dev/null | cut -f 1,3 >"$scratch/said"
    agree=$(cut -f 1,3 "$scratch/right" | paste - "$scratch/said" |
        awk '$1 == $3 { n++ } END { print int(1000 * n / NR) }')
    [ "$agree" -ge 999 ]
    verdict "--not $how: a published method leaves them out as well" $?
done
check_end
