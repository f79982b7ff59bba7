#!/bin/sh
# Fuzzes each target for $SECONDS.  Stops at the first finding, which it writes
# to $BUILD.  New inputs of the corpus stay in $BUILD too; to keep the useful
# ones: TARGET -merge=1 tests/fuzz/corpus/TARGET $BUILD/corpus/TARGET
# The target scene_file has no corpus: it makes its first inputs itself, of up to 10 kB.
for target in record command shapes scene_file; do
    mkdir -p "$BUILD/corpus/$target"
    kept=tests/fuzz/corpus/$target longest=4096
    [ -d "$kept" ] || kept= longest=16384
    echo "fuzz: $target, $SECONDS s"
    "$BUILD/tests/fuzz/$target" -max_total_time="$SECONDS" -max_len=$longest \
        -timeout=20 -close_fd_mask=2 -print_final_stats=1 \
        -artifact_prefix="$BUILD/" "$BUILD/corpus/$target" $kept >"$BUILD/$target.log" 2>&1 || {
        tail -n 40 "$BUILD/$target.log"
        exit 1
    }
    grep '^Done\|^stat::' "$BUILD/$target.log"
done
