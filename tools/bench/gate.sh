#!/bin/sh
# make gate COMMIT=...: the answers and times of this tree beside a commit's, which is
# built with this tree's benchmarks.  All answers to COUNT (20000) records must have the
# same bits.  Then CASES (single batch methods) of both run in turns, RUNS times (5), and
# the least times are compared: below 1 this tree is faster.  CASES= leaves out the times.
: "${BUILD:=build}" "${RUNS:=5}" "${COUNT:=20000}" "${CASES=single batch methods}"
work=$BUILD/gate
commit=$(git rev-parse --verify "$COMMIT^{commit}") && mkdir -p "$work" || exit 2
[ -d "$work/tree" ] || git worktree add -q --detach "$work/tree" || exit 2
git -C "$work/tree" checkout -q --force --detach "$commit" || exit 2
for folder in tools/bench tests/support tests/distance tests/package; do
    rm -rf "${work:?}/tree/$folder"
    cp -r $folder "$work/tree/$folder" || exit 2
done
make -C "$work/tree" BUILD=build build/tools/bench/bench build/tests/package/answers \
    >"$work/make.log" 2>&1 || { tail "$work/make.log"; exit 2; }

"$BUILD/tests/package/records" 1 "$COUNT" >"$work/records" || exit 2
"$BUILD/tests/package/answers" <"$work/records" >"$work/new" || exit 2
"$work/tree/build/tests/package/answers" <"$work/records" >"$work/old" || exit 2
status=0
if cmp "$work/old" "$work/new"; then
    echo "$(wc -l <"$work/new") answers are the same"
else
    status=1
fi
[ "$CASES" ] || exit $status

rm -f "$work"/*.csv
for run in $(seq "$RUNS"); do
    "$work/tree/build/tools/bench/bench" $CASES >>"$work/old.csv" &&
        "$BUILD/tools/bench/bench" $CASES >>"$work/new.csv" || exit 2
done
awk -F ', *' 'FNR == 1 { file++ }
    { for (i = 8; i < NF; i++) {
          key = $1 ", " $2 ", " $3 ", " $4 ", " kernels[i]
          if (FNR == 1) kernels[i] = $i
          else if ($i + 0 == 0) continue
          else if (!((file, key) in least) && file == 2) order[++n] = key
          if (!((file, key) in least) || $i + 0 < least[file, key]) least[file, key] = $i + 0 } }
    END { for (i = 1; i <= n; i++) if ((1, order[i]) in least)
              printf "%-80s %8s %8s %5.2f\n", order[i], least[1, order[i]],
                  least[2, order[i]], least[2, order[i]] / least[1, order[i]] }' \
    "$work/old.csv" "$work/new.csv"
exit $status
