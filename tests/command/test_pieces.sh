#!/bin/sh
# Floor command: first pieces, first boundaries and depths agree with the pieces of
# lines, and all answers are the same bytes for any number of workers and a saved
# scene.  tests/scene/test_pieces.c has pieces and sums beside a loop,
# tests/python/test_pieces.py those of the command; cli.txt options and messages.
. "$(dirname "$0")/../support/verdict.sh"
PATH=$build:$PATH
cd "$scratch" || exit 1

# Solids of all kinds, some unbounded; names of solids do not follow each other.
awk 'function at(most) { return sprintf("%.17g", (2 * rand() - 1) * most) }
BEGIN {
    srand(4)
    for (i = 0; i < 400; i++) {
        x = at(10); y = at(10); z = at(10); r = 1 + 2 * rand()
        axis = x " " y " " z "  " x + at(3) " " y + at(3) " " z + at(3)
        shape = i % 3 == 0 ? "sphere " x " " y " " z " " r : i % 3 == 1 ? "cylinder " axis " " r : "capsule " axis " " r
        if (i % 87 == 1) shape = shape " ends=infinite"
        word = ""
        if (i % 4 == 1) word = " in=s" int(i / 8)
        if (i % 4 == 2) word = " out=s" int(i / 8) (i % 8 == 2 ? "" : "/3")
        if (i % 16 == 3) word = " in=s" int(i / 8) "/3"
        if (i % 64 == 7) word = word " out=s" int(i / 8) "/1"
        print shape word (i % 5 ? " m" i % 7 : "")
    }
    print "sphere 0 0 0 9 out=world space"
}' >solids
awk 'function at(most) { return sprintf("%.17g", (2 * rand() - 1) * most) }
BEGIN {
    srand(6)
    for (i = 0; i < 300; i++)
        print substr("ray    line   segment", 1 + 7 * (i % 3), 7), at(20), at(20),
            at(20), at(9), at(9), at(9)
    print "line 0 0 0  1 0 0"
    print "span 1 2 3  0 1 0  -4 4"
}' >through
printf 'm3 -7\nm1 2\nspace 9\n' >more

# More pieces on a line than are found at once, in every mode.
awk 'BEGIN { for (i = 0; i < 3000; i++)
    print "sphere", i * 0.75, 0, 0, i % 9 ? 0.25 : 0.875, i % 4 ? "a" : "b" }' >beads
echo 'line -1 0.125 0  1 0 0' >row
for mode in owner union cells chords; do
    cylint -s beads -q pieces --pieces $mode row >out
    [ "$(wc -l <out)" -gt 1500 ]
    verdict "$mode: a line has many pieces" $?
    for k in 1 3 5 256 257 1000; do
        head -n $k out >want
        cylint -s beads -q pieces --first $k --pieces $mode row | cmp want - || break
    done
    verdict "$mode: --first writes the first pieces" $?
done

# The first boundary is the first end of a piece of the union within the line.
cylint -s solids -q pieces --union -f record,t0,t1 through >pieces
cylint -s solids -q first -f id,t,side through >out
awk 'NR == FNR { if (!($1 in begin)) { begin[$1] = $2; end[$1] = $3 }; next }
    { min = FNR > 300 ? (FNR == 301 ? "-inf" : -4) : FNR % 3 == 2 ? "-inf" : 0
      max = FNR == 302 ? 4 : FNR < 301 && FNR % 3 == 0 ? 1 : "inf"
      enters = begin[FNR] != "" && begin[FNR] != min
      t = enters ? begin[FNR] : end[FNR] != max ? end[FNR] : ""
      print FNR "\t" (t == "" ? "nan\t-" : t "\t" (enters ? "entering" : "leaving")) }' pieces out >want
cmp want out
verdict 'the first boundary is the first end of a piece' $?
# Points within pieces lie in as many solids.
cylint -s solids -q pieces --pieces cells -k line -f t0,t1,depth,shape - <<END >cells
-20 1 2  1 0 0
END
awk '$1 != "-inf" && $2 != "inf" { print "point", -20 + ($1 + $2) / 2, 1, 2 }' cells |
    cylint -s solids -q inside -f depth,shape >out
awk '$1 != "-inf" && $2 != "inf" { print $3 "\t" $4 }' cells | cmp - out
verdict 'depth and owner of points are those of the pieces' $?

# same ARGUMENT...: the bytes of one worker and the text
cylint --save saved -s solids
for i in 1 2 3 4 5 6 7 8 9; do cat through; done >more.through
for i in 1 2 3 4 5 6 7 8; do cat more.through; echo nonsense; done >many
for what in '-q first -f id,shape,label,t,part,side,x,nx,h,phi' '-q pieces' \
    '-q pieces --union --header -f record,label,length' '-q pieces --pieces cells' \
    '-q pieces --pieces chords --first 3' '-q pieces --sum label:t' \
    '-q pieces --sum label --header --rank more' '-q pieces --binary-out --rank more'; do
    cylint -s solids -j 1 $what many >want 2>want.err
    for other in '-s saved -j 1' '-s saved -j 4' '-s solids -j 2' '-s solids -j 8'; do
        cylint $other $what many >out 2>err
        [ $? -eq 1 ] && cmp want out && cmp want.err err
        verdict "$other: the same bytes: $what" $?
    done
done
cylint --save again -s saved && cmp saved again
verdict 'solids are saved again' $?
check_end
