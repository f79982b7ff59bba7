#!/bin/sh
# A picture by 8 workers under the thread sanitizer, which must stay silent,
# is the picture by one.  On one processor, since Embree's own threads, which
# then do not run, mean nothing to the sanitizer.  For make check-threads.
build=${BUILD:-build}
command -v taskset > /dev/null || {
    echo 'no taskset, which comes with util-linux'
    exit 77
}
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
TSAN_OPTIONS=exitcode=66
export TSAN_OPTIONS
awk -v trees=2 -f tools/render/autumn.awk > "$scratch/scene"
for workers in 1 8; do
    taskset -c "$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')" \
        "$build/cylint-render" "$scratch/scene" -o "$scratch/$workers.png" \
        --size 64x36 --samples 2 --ground '#808080' -j $workers || exit
done
cmp "$scratch/1.png" "$scratch/8.png" && echo '1 passed, 0 failed'
