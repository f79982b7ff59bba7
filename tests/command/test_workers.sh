#!/bin/sh
# Any number of workers gives the same answers, messages and exit status as one
# worker, and no worker waits for input after the work has ended.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH

is() { # NAME, then the arguments of test(1)
    about=$1
    shift
    [ "$@" ]
    verdict "$about" $?
}

# More than eight blocks: numbered rays and cylinders, comments and bad records.
# Some blocks have no bad record and some have many.
awk 'BEGIN {
    for (i = 1; i <= 20000; i++) {
        if (i % 1999 == 0) print "# comment " i
        if (i % 1777 == 0 || (i > 15000 && i < 15020)) print "nonsense " i
        else printf "%.6f %.6f %.6f, 0 %.6f 1, %.6f 0 1, 0 %.6f 4, %.3f id%d\n",
            i % 23 - 11, i % 89 / 7 - 6, i % 13 - 30, i % 11 / 11 - 0.5,
            i % 17 - 9, i % 19 / 5, 1 + i % 7, i
    }
}' >records
for i in 1 2 3 4 5 6; do cat records; done >many
grep -v '[a-z#]s' many | grep -v '#' >good
printf '%s\n' 'cylinder 0 0 0  0 0 9  9' 'cone 5 5 0 8  5 5 4 0' \
    'ecylinder 3 0 0  9 0 0  0 14 0  1 0 7' >scene
cut -d, -f1,2 many >rays
is 'the input has many blocks' "$(wc -c <many)" -gt 6000000

same() { # NAME, then the command's arguments
    name=$1
    shift
    cylint -j 1 "$@" >want 2>want.err
    echo $? >>want.err
    for workers in 2 3 8; do
        cylint -j $workers "$@" >out 2>err
        echo $? >>err
        [ -s want ] && cmp want out && cmp want.err err
        verdict "$name, -j $workers" $?
    done
}

same 'pairs'                -k ray,cylinder -f id,relation,t0,t1 many
is 'no answer is lost' "$(wc -l <want)" -eq 120000
is 'eleven messages and the status' "$(wc -l <want.err)" -eq 12
same 'many columns'         -k ray,cylinder -p 9 -C \
    -f n,t0,part0,side0,x0,ny0,h0,phi0,part1 records
same 'bad records left out' -k ray,cylinder -e skip many
same 'the work stops at a bad record' -k ray,cylinder -e stop good many good
same 'several files'        -k ray,cylinder -f id,n many records good many
same 'a missing file'       -k ray,cylinder -f id,n good missing many
same 'nearest'              -k ray -s scene rays
same 'all, more answers than records' -k ray -s scene -q all rays
is 'there are more answers' "$(wc -l <want)" -gt 125000
awk '!/[a-z#]/ { print $1, $2, $3, "p" NR }' rays | head -n 60000 >near
same 'points, nearest'      -k point -s scene -f shape,distance,part,feature,x near
is 'every point has an answer' "$(grep -c 'p[0-9]' want)" -eq 60000
same 'points, all within a radius' -k point -s scene -q all --within 20 near
sed 's/ id/ /' good >numbered
{ cat good; cat numbered numbered; } >late
same 'one warning about the tail' -k ray,cylinder late
is 'the warning names the first numeric tail' "$(cut -d: -f3 want.err | head -n 1)" \
    -eq "$(($(wc -l <good) + 1))"
is 'there is no second warning' "$(wc -l <want.err)" -eq 2
same 'a method'             -k ray,cylinder --method=quadratic many
same 'binary answers'       -k ray,cylinder --binary-out many

cut -d' ' -f1-13 good | sed 's/ id.*//' >bare
cylint -k ray,cylinder --binary-out -f t0,t1,n,t0,t1,n,t0,t1,n,t1,t0,n,n bare >doubles 2>/dev/null
same 'binary input with many bad records' -b -k ray,cylinder doubles
is 'others are good' "$(od -An -v -tf8 -w32 want | grep -cv '^ *nan')" -gt 10000

cat many | cylint -k ray,cylinder -j 3 >out 2>err
cylint -k ray,cylinder -j 1 many >want 2>/dev/null
is 'a pipe and a file give the same bytes' "$(cksum <out)" = "$(cksum <want)"

mkfifo there
ended() { # NAME STATUS, then the command's arguments
    name=$1 wanted=$2
    shift 2
    (cat good && echo nonsense && exec sleep 30) >there &
    writer=$!
    timeout 20 cylint -k ray,cylinder "$@" <there >out 2>err
    status=$?
    kill $writer 2>/dev/null
    wait $writer 2>/dev/null
    is "$name" "$status" -eq "$wanted"
}
for workers in 1 2 8; do
    ended "-e stop ends the work while input is open, -j $workers" 1 -j $workers -e stop
    [ -w /dev/full ] && ended "a full disk ends the work while input is open, -j $workers" 3 \
            -j $workers -o /dev/full
done

check_end
