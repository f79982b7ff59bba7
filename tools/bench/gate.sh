#!/bin/sh
# make gate COMMIT=...: the answers and the time of this tree beside a commit's.
# The hashes of gate.c must be the same.  Then `single` and `batch` of both trees run
# in turns, RUNS times (5) with all kernels, and gate.awk compares the least times.
# CASES: of each family (512).  ONLY=hash: no times.
: "${BUILD:=build}" "${RUNS:=5}" "${TURNS:=12}" "${SECONDS_A_RUN:=4}"
work=$BUILD/gate
old=$work/tree
base=$(git rev-parse --verify "$COMMIT^{commit}") || exit 2
mkdir -p "$work"
[ -d "$old" ] || git worktree add -q --detach "$old" "$base" || exit 2
git -C "$old" checkout -q --detach "$base" || exit 2
make -s -C "$old" BUILD=build bench_programs >"$work/make.log" 2>&1 ||
    { tail "$work/make.log"; exit 2; }
old=$old/build

# The same program and families, linked with the other library.
common="-std=c99 -O2 -ffp-contract=off -DCYLINT_STATIC -DHAVE_GSL -Itests/support"
$CC $common -I"$work/tree/include" -o "$work/gate-old" tools/bench/gate.c \
    tests/support/families.c tests/support/family_records.c "$old/libcylint.a" -lgsl \
    -lgslcblas -lm || exit 2
status=0
"$work/gate-old" $CASES >"$work/old.hashes"
"$BUILD/tools/bench/gate" $CASES >"$work/new.hashes" || status=1
if diff "$work/old.hashes" "$work/new.hashes" >"$work/hashes.diff"; then
    echo "hashes: $(wc -l <"$work/new.hashes") the same"
else
    status=1
    echo 'hashes differ:'
    head -n 40 "$work/hashes.diff"
fi
[ "$ONLY" = hash ] && exit $status

rm -f "$work"/*.csv
for run in $(seq "$RUNS"); do
    for tree in old new; do
        bench=$BUILD/tools/bench
        [ $tree = new ] || bench=$old/tools/bench
        for kernels in $("$BUILD/tools/bench/kernels"); do
            KERNELS=$kernels "$bench/single" "$TURNS" "$kernels" $SHAPE \
                >>"$work/$tree-single.csv"
        done
        "$bench/batch" "$SECONDS_A_RUN" 100000 cache >>"$work/$tree-batch.csv"
    done
    echo "run $run of $RUNS" >&2
done
awk -f tools/bench/gate.awk "$work"/old-*.csv "$work"/new-*.csv
exit $status
