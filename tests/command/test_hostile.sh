#!/bin/sh
# Floor command: with hostile input the command never crashes, never writes part
# of a line, never loses input without a message, and exits with the right
# status.  hostile.txt has what a transcript can show.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH
good='line 0 0 -1  0 0 1  cylinder 0 0 0  0 0 1  1'

# expect NAME STATUS: out equals want and err equals want.err, if those exist,
# and code is STATUS.  Removes want and want.err.
expect() {
    wrong=0
    [ "$(cat code)" = "$2" ] || { echo "status $(cat code), not $2"; wrong=1; }
    if [ -e want ]; then diff want out || wrong=1; fi
    if [ -e want.err ]; then diff want.err err || wrong=1; fi
    grep -Eiq 'sanitizer|runtime error' err && { cat err; wrong=1; }
    verdict "$1" $wrong
    rm -f want want.err
}

# answer ARGUMENT...: writes messages to err and the exit status to code.
answer() {
    cylint "$@" 2>err
    echo $? >code
}
run() { answer "$@" >out; }

# A sanitizer reserves more address space than any limit below allows.
is_sanitized() {
    grep -q __asan_init "$build/cylint"
}

# --- bytes that are not text
LC_ALL=C awk 'BEGIN { srand(7); for (i = 0; i < 200000; i++)
    printf "%c", int(256 * rand()) }' >in
run -f id in
[ "$(grep -c '; this looks like a binary file$' err)" -eq 1 ] &&
    [ "$(grep -c '^cylint: ' err)" -eq 2 ] &&
    [ "$(wc -l <out)" -eq "$(grep -c '^error$' out)" ] &&
    [ "$(wc -l <out)" -gt 100 ] || echo output >>code
expect 'binary garbage gives one error a line, one message and the count' 1

{ cat in; printf '\nx\n'; } >in2
printf 'y\nz\n' >text
run -f id text in2 text
[ "$(grep -c '^cylint: text:' err)" -eq 4 ] &&
    [ "$(grep -c '^cylint: in2:' err)" -eq 1 ] || echo messages >>code
expect 'the messages about files around a binary one are shown' 1

{ echo "$good"; head -c 4000 in; } | tr -d '\n' >in2
run -s in2 text
[ "$(grep -c '^cylint: ' err)" -eq 1 ] || echo messages >>code
expect 'a binary scene gives one message' 1

# --- long lines
{ printf '%s ' "$good"; head -c $((1048576 - ${#good} - 1)) /dev/zero |
    tr '\0' x; printf '\n%s after\n' "$good"; } >in
run in
[ "$(wc -c <out)" -eq "$((1048576 - ${#good} - 1 + 13 + 18))" ] ||
    echo "$(wc -c <out) bytes" >>code
expect 'a line of 1 MiB is answered, its tail whole' 0

{ printf '%s ' "$good"; head -c $((1048577 - ${#good} - 1)) /dev/zero |
    tr '\0' x; printf '\n%s after\n' "$good"; } >in
printf 'error\tnan\tnan\tnan\ncross\t2\t1\t2\tafter\n' >want
echo 'cylint: in:1:1: line longer than 1 MiB' >want.err
run in
expect 'a line of 1 MiB and a byte is bad, the next one is not' 1

for size in 3000000 50000000; do
    { echo "$good a"; head -c $size /dev/zero | tr '\0' x; printf '\n%s b\n' "$good"
      head -c $size /dev/zero | tr '\0' '#'; } >in
    printf 'cross\t2\t1\t2\ta\nerror\tnan\tnan\tnan\n' >want
    printf 'cross\t2\t1\t2\tb\nerror\tnan\tnan\tnan\n' >>want
    printf 'cylint: in:%d:1: line longer than 1 MiB\n' 2 4 >want.err
    run in
    expect "lines of $size bytes are bad, those between are answered" 1
done

if is_sanitized; then
    echo "note: no memory limits under a sanitizer"
else
    cat in | (ulimit -v 20000; run)
    expect 'memory does not grow with a line' 1
    yes "$good" | head -n 300000 | (ulimit -v 20000; run -f n)
    [ "$(grep -c '^2$' out)" -eq 300000 ] || echo lost >>code
    expect 'memory does not grow with the input' 0
    yes 'cylinder 0 0 0  0 0 1  1' | head -n 100000 >scene
    (ulimit -v 20000; run -s scene <in)
    echo 'cylint: out of memory' >want.err
    expect 'a scene too large for memory says so' 4
fi

# --- output that fails
yes "$good" | head -n 100000 >in
if [ -w /dev/full ]; then
    echo 'cylint: standard output: No space left on device' >want.err
    answer in >/dev/full
    expect 'a full disk gives a message' 3
    answer --help >/dev/full
    expect 'a full disk gives a message with --help too' 3
    echo 'cylint: /dev/full: No space left on device' >want.err
    run -o /dev/full in
    expect 'a full disk gives a message with -o too' 3
fi
answer in | head -n 1 >out
printf 'cross\t2\t1\t2\n' >want
: >want.err
expect 'death by SIGPIPE is silent' 141

(ulimit -f 8; trap '' XFSZ; answer -o limited in)
echo 'cylint: limited: File too large' >want.err
expect 'a file size limit gives a message' 3

# --- bad binary records
head -c 1000000 /dev/zero | tr '\0' '\377' >nans
run -b -k ray,cylinder -f n nans
[ "$(wc -c <out)" -eq $(((1000000 + 103) / 104 * 8)) ] || echo lost >>code
expect 'binary NaN makes bad records, none is lost' 1

# --- many answers
yes 'cylinder 0 0 0  0 0 1  1' | head -n 3000 >scene
yes 'ray 0 0 -1  0 0 1' | head -n 100 >rays
run -s scene -q all -f id,shape rays
awk 'BEGIN { for (i = 1; i <= 100; i++) for (j = 1; j <= 3000; j++)
    print i "\t" j }' >want
expect 'a scene that answers much answers all' 0

# --- slow and talkative partners
printf '%s a\n# b\n%s c' "$good" "$good" >in
printf 'cross\t2\t1\t2\ta\ncross\t2\t1\t2\tc\n' >want
i=1
while [ $i -le "$(wc -c <in)" ]; do
    tail -c +$i in | head -c 1
    i=$((i + 1))
done | run
expect 'input in single bytes is put together' 0

{ printf '\357'; sleep 0.05; printf '\273'; sleep 0.05; printf '\277%s\n' \
    "$good"; } | run
printf 'cross\t2\t1\t2\n' >want
expect 'a byte order mark in single bytes is skipped' 0

# `script` runs the command on a terminal of its own, where its input is empty.
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    say='cylint: waiting for records from the terminal'
    for options in '' '-s scene'; do
        script -qec "cylint $options" /dev/null </dev/null >out
        echo $? >code
        [ "$(grep -c "^$say, LINE.*Ctrl-D" out)" -eq 1 ] || echo "$(cat out)" >>code
        expect "on a terminal cylint $options says what it waits for" 0
        script -qec "cylint $options in" /dev/null </dev/null >out
        echo $? >code
        ! grep "$say" out || echo said >>code
        expect "on a terminal cylint $options FILE does not wait" 0
    done
else
    echo 'note: no terminal can be made here'
fi
: >want.err
run </dev/null
expect 'elsewhere it does not say so' 0

# The partner writes a record and reads its answer before it writes the next.
# If the command held answers back both would wait forever, so a timer ends
# them.
mkfifo there back
cylint -f n,id <there >back 2>err &
pid=$!
(sleep 20 & echo $! >timer; wait $! && kill $pid) >/dev/null 2>&1 &
exec 3>there 4<back
: >out
for i in 1 2 3 4 5; do
    echo "$good" >&3
    IFS= read -r answer <&4 || break
    echo "$answer" >>out
done
exec 3>&-
wait $pid
echo $? >code
exec 4<&-
kill "$(cat timer)" 2>/dev/null
printf '2\t%d\n' 1 2 3 4 5 >want
expect 'a partner on a pipe is answered record by record' 0

check_end
