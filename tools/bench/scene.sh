#!/bin/sh
# make bench-scene: scenes beside batches of all shapes.  SCENES lists the
# kinds of tests/support/scenes.h to generate, SIZES the numbers of shapes,
# KERNELS the kernels (default: all that the processor runs).
: "${BUILD:=build}" "${SCENES:=0 1 2 5}" "${SIZES:=1000 10000 100000}"
: "${KERNELS:=$("$BUILD/tools/bench/bench" -o NONE single | sed "s/.*theirs,//; s/,ratio//; y/,/ /")}"
all_kernels=$KERNELS
bench=$BUILD/tools/bench/scene
neurons=../shared/data/medulla_top24.swc
for KERNELS in $all_kernels; do
    export KERNELS
    echo "kernels: $KERNELS"
    if [ -r $neurons ]; then
        $bench neurons "$BUILD/cylint -s $neurons --text 2>/dev/null"
        $bench -j 2 neurons "$BUILD/cylint -s $neurons --text 2>/dev/null"
    fi
    for kind in $SCENES; do
        for n in $SIZES; do
            $bench "$kind" "$n"
        done
    done
    # Distances of points: growth with the number of shapes, beside a loop.
    $BUILD/tools/bench/distance_scene 0 $SIZES
done
