#!/bin/sh
# 8 workers draw the picture that one worker draws, and the thread sanitizer reports
# nothing (make check-threads).  It runs on one processor: Embree then starts no
# threads of its own, which the sanitizer cannot check.
. "$(dirname "$0")/../support/verdict.sh"
command -v taskset > /dev/null ||
    skip_all 'no taskset, which is in the package util-linux'
TSAN_OPTIONS=exitcode=66
export TSAN_OPTIONS
awk -v trees=2 -f tools/render/autumn.awk > "$scratch/scene"
for workers in 1 8; do
    taskset -c "$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')" \
        "$build/cylint-render" "$scratch/scene" -o "$scratch/$workers.png" \
        --size 64x36 --samples 2 --ground '#808080' -j $workers || exit
done
cmp "$scratch/1.png" "$scratch/8.png"
verdict 'eight workers draw the picture of one' $?
check_end
