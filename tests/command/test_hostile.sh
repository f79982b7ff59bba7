#!/bin/sh
# On a terminal a message says that the command waits, and a partner on a pipe has each
# answer before it writes on.  hostile.txt has what a transcript can show: that it never
# crashes, never writes part of a line, never loses input without a message, needs no
# memory for it, and exits with the right status.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH
good='line 0 0 -1  0 0 1  cylinder 0 0 0  0 0 1  1'
: >none

# `script` runs the command on a terminal of its own, where its input is empty.
if script -qec true /dev/null >/dev/null 2>&1 </dev/null; then
    say='cylint: waiting for records from the terminal'
    for options in '' '-s none'; do
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
