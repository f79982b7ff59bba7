#!/bin/sh
# The transcripts of saved.txt: a saved scene gives the bytes that its text gives, for
# every query and any number of workers.  Processes that open it share its memory.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
run_transcripts saved.txt <tests/command/saved.txt
cd "$scratch/work" || exit 1

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
