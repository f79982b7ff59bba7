#!/bin/sh
# With hostile input the command's memory does not grow, a message says that it
# waits for a terminal, and a partner on a pipe has each answer before it writes on.
# hostile.txt has what a transcript can show: that it never crashes, never writes part
# of a line, never loses input without a message, and exits with the right status.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH
good='line 0 0 -1  0 0 1  cylinder 0 0 0  0 0 1  1'
yes 'cylinder 0 0 0  0 0 1  1' | head -n 100000 >scene
: >none

# A sanitizer reserves more address space than any limit allows.
if grep -q __asan_init "$build/cylint"; then
    echo "note: no memory limits under a sanitizer"
else
    { echo "$good a"; head -c 50000000 /dev/zero | tr '\0' x; } | (ulimit -v 20000; cylint >out 2>err)
    [ $? -eq 1 ] && [ "$(cat err)" = 'cylint: stdin:2:1: line longer than 1 MiB' ]
    verdict 'memory does not grow with a line' $?
    yes "$good" | head -n 300000 | (ulimit -v 20000; cylint -f n) >out
    [ "$(uniq -c out | tr -s ' ')" = ' 300000 2' ]
    verdict 'memory does not grow with the input' $?
    echo "$good" | (ulimit -v 20000; cylint -s scene 2>err)
    [ $? -eq 4 ] && [ "$(cat err)" = 'cylint: out of memory' ]
    verdict 'a scene too large for memory says so' $?
fi

# `script` runs the command on a terminal of its own, where its input is empty.
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    say='cylint: waiting for records from the terminal'
    for options in '' '-s scene'; do
        script -qec "cylint $options" /dev/null </dev/null >out &&
            [ "$(grep -c "^$say, LINE.*Ctrl-D" out)" -eq 1 ]
        verdict "on a terminal cylint $options says what it waits for" $?
        script -qec "cylint $options none" /dev/null </dev/null >out && ! grep "$say" out
        verdict "on a terminal cylint $options FILE does not wait" $?
    done
    # Its input lasts longer than a second and ends with a bad record.
    slow="{ echo '$good'; sleep 1.1; echo '$good'; sleep 0.1; echo x; } | cylint"
    TERM=ansi script -qec "$slow -o none" /dev/null </dev/null >out
    [ "$(tr '\r' '\n' <out | grep -c records)" -eq 1 ] &&
        grep -q "$(printf '\r\033\\[Kcylint: stdin:3:1: expected')" out
    verdict 'a message replaces the progress on a terminal' $?
    script -qec "$slow" /dev/null </dev/null >out
    TERM=dumb script -qec "$slow -o none" /dev/null </dev/null >>out
    [ "$(grep -c '^cylint: stdin:3:1: expected' out)" -eq 2 ] && ! grep records out
    verdict 'no progress among answers, or on a dumb terminal' $?
else
    echo 'note: no terminal can be made here'
fi
[ -z "$(cylint </dev/null 2>&1)" ]
verdict 'elsewhere it does not say so' $?

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
code=$?
exec 4<&-
kill "$(cat timer)" 2>/dev/null
[ $code -eq 0 ] && printf '2\t%d\n' 1 2 3 4 5 | cmp - out
verdict 'a partner on a pipe is answered record by record' $?
check_end
