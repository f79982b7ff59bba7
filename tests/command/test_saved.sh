#!/bin/sh
# A saved scene gives the bytes that its text gives, for every query and any number
# of workers, and processes that open it share its memory.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH

# Shapes of every kind; some are unbounded, some have labels, some labels are the
# same.  Among them a row of discs that one line hits.
awk 'function at(most) { return sprintf("%.17g", (2 * rand() - 1) * most) }
function three(most) { return at(most) " " at(most) " " at(most) }
BEGIN {
    srand(7)
    split("cylinder cone ecylinder econe acone sphere capsule rcone", word)
    for (i = 0; i < 2000; i++) {
        kind = 1 + i % 8
        x = at(20); y = at(20); z = at(20); r = rand() + 0.01
        top = x + at(1) " " y + at(1) " " z + at(1)
        text = word[kind] " " x " " y " " z " "
        if (kind == 1 || kind == 7) text = text top " " r
        if (kind == 2 || kind == 8) text = text r " " top " " rand()
        if (kind == 3 || kind == 4) text = text three(1) " " three(1) " " three(1)
        if (kind == 4) text = text " " rand()
        if (kind == 5) text = text three(1) " " 5 + 60 * rand()
        if (kind == 6) text = text r
        if (kind < 6)
            text = text " ends=" (i % 101 ? i % 3 ? "capped" : "open" : "infinite")
        print text (i % 5 ? " L" i % 300 " of " i : "")
    }
    for (i = 0; i < 700; i++)
        print "cylinder", 30, 0, i / 8, 30, 0, i / 8 + 0.0625, 0.5
}' >scene
awk 'function at() { return 60 * rand() - 30 }
BEGIN {
    srand(8)
    for (i = 0; i < 900; i++) {
        print substr("ray    line   segment", 1 + 7 * (i % 3), 7), at(),
              at(), at(), at(), at(), at(), (!i || i % 4 ? "" : "not=" i), "id" i
        if (i % 90 == 0)
            print "point", at(), at(), at(), "id" i
    }
    print "line 30 0 -5  0 0 1\nray 3e7 -4e7 5e7  -3 4 -5\nrye 1 2 3"
}' >records
head -n 150 records >fewer # for a loop over all shapes
sed 's/not=/&L/' records >labelled
awk '{ print "point", $2, $3, $4 }' records | head -n 300 >points
grep '^ray' records | sed 's/ not=[0-9]*//; s/ *id.*//; s/^ray *//' >numbers
# Solids whose names do not follow each other, and more lines than a worker takes.
head -n 400 scene | awk '{
    n = NR - 1; s = int(n / 8); word = ""
    if (n % 4 == 1) word = " in=s" s
    if (n % 4 == 2) word = " out=s" s (n % 8 == 2 ? "" : "/3")
    if (n % 16 == 3) word = " in=s" s "/3"
    if (n % 64 == 7) word = word " out=s" s "/1"
    if (!sub(/ L/, word " L")) $0 = $0 word
    print
} END { print "sphere 0 0 0 9 out=world space" }' >solids
sed '/^point/d; s/ not=[0-9]*//' records >through
for i in 1 2 3 4 5 6 7 8; do cat through through through; done >many
printf 'L3 -7\nL11 2\nspace 9\n' >ranks
printf '1 1 0 0 0 2 -1\n2 3 0 0 10 1 1\n3 3 0 5 20 1 2\n' >neuron.swc
cylint --save saved -s scene
verdict 'a scene is saved without a question' $?
cylint --save neuron -s neuron.swc --swc round
grep '^c[yo]' scene | sed 's/ends=[a-z]*//' >rods
cylint --save tubes -s rods --ends open
cylint --save saved.solids -s solids && cylint --save again -s saved.solids && cmp saved.solids again
verdict 'solids are saved again' $?

# same SAVED TEXT ARGUMENT...: the same bytes and messages as from the text by one worker
same() {
    from=$1 text=$2
    shift 2
    cylint -s $text -j 1 "$@" >want 2>want.err
    echo $? >>want.err
    for other in "-s $from -j 1" "-s $from -j 4" "-s $text -j 8"; do
        cylint $other "$@" >out 2>err
        echo $? >>err
        [ -s want ] && cmp want out && cmp want.err err
        verdict "$other: the same bytes: $*" $?
    done
}
long=shape,label,relation,t,part,side,x,ny,h,phi
for query in nearest any count all; do
    same saved scene -q $query records
    same saved scene -q $query --accel none fewer
    same saved scene -q $query --not label labelled
    same saved scene -q $query --within 3 points
    same saved scene -q $query -k ray -b numbers
    same neuron 'neuron.swc --swc round' -q $query records
    same tubes 'rods --ends open' -q $query records
done
same saved scene -f $long --header records
same saved scene -q all -f id,shape,label,t0,nx1,chord records
for what in '-q first -f id,shape,label,t,part,side,x,nx,h,phi' '-q pieces' \
    '-q pieces --union --header -f record,label,length' '-q pieces --pieces cells' \
    '-q pieces --pieces chords --first 3' '-q pieces --sum label:t' \
    '-q pieces --sum label --header --rank ranks' '-q pieces --binary-out --rank ranks'; do
    same saved.solids solids $what many
done
same saved scene -f shape,label,distance,feature,x,nx points
same tubes 'rods --ends open' --method quadratic records
[ "$(cylint -s saved -q all -f label numbers -k ray | grep -c ' of ')" -gt 100 ]
verdict 'labels are saved' $?

# The text and the saved scene give one file, whatever the threads and the query.
cylint --save again -s saved && cmp saved again &&
    cylint -j 3 --save again -s scene -q any records >out 2>err
cmp saved again
verdict 'a scene that is saved again is the same file' $?
for from in scene saved; do
    cylint -s $from --text -j 3 >text 2>err && cylint --save again -s text && cmp saved again && [ ! -s err ]
    verdict "the text of $from is read as the same scene" $?
done
sed 's/ L[0-9]* of .*//' scene >unnamed
cylint --save small -s unnamed
[ "$(wc -c <small)" -lt $(($(wc -c <saved) - 8 * 2700)) ]
verdict 'a scene without labels has no space for them' $?

if command -v cylint-render >/dev/null; then
    cylint-render scene --size 60x40 --colour label -o text.png 2>err &&
        cylint-render saved --size 60x40 --colour label -o saved.png 2>err && cmp text.png saved.png
    verdict 'cylint-render draws a saved scene as its text' $?
fi

# Processes map the file: its pages are in memory once, and stay when another file
# takes its name.  of_map NAME: the sum of these lines of the first process, in KiB.
of_map() {
    awk -v name="$1:" '/^[0-9a-f]+-/ { inside = /many.saved$/ }
        inside && $1 == name { sum += $2 } END { print sum + 0 }' maps
}
awk 'BEGIN { srand(5); for (i = 0; i < 100000; i++) print "sphere", 99 * rand(),
    99 * rand(), 99 * rand(), 0.2 }' >many
cylint --save many.saved -s many
mkfifo first second
cylint -s many.saved <first >out1 &
one=$!
exec 3>first
cylint -s many.saved <second >out2 &
two=$!
exec 4>second
echo 'ray 0 0 0 1 1 1' | tee /dev/fd/3 >&4
for i in $(seq 200); do
    [ -s out1 ] && [ -s out2 ] && break
    sleep 0.05
done
cat /proc/$one/smaps >maps 2>/dev/null
size=$(($(wc -c <many.saved) / 1024))
cylint --save many.saved -s scene
echo 'ray 0 0 0 1 1 1' | tee /dev/fd/3 | tee /dev/fd/4 | cylint -s many.saved >out3
exec 3>&- 4>&-
wait $one && wait $two && cmp out1 out2
verdict 'two processes answer from one saved scene' $?
[ "$(wc -l <out1)" -eq 2 ] && [ "$(uniq out1 | wc -l)" -eq 1 ] && ! head -n 1 out1 | cmp -s - out3
verdict 'a file is replaced under processes that have opened it' $?
if [ -s maps ]; then
    shared=$(($(of_map Shared_Clean) + $(of_map Shared_Dirty)))
    echo "note: of $size KiB mapped, $shared KiB are shared," \
        "$(of_map Private_Dirty) KiB are the process's own"
    [ "$(of_map Rss)" -ge $((size * 9 / 10)) ] && [ $shared -ge $((size * 9 / 10)) ] &&
        [ "$(of_map Private_Dirty)" -eq 0 ] && [ "$(of_map Pss)" -le $((size * 6 / 10)) ]
    verdict 'and the pages are in memory once' $?
else
    echo 'note: no /proc/PID/smaps, so shared pages are not counted'
fi
check_end
