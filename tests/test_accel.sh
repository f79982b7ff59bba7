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
check_end
