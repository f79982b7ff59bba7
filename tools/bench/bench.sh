#!/bin/sh
# make bench: runs the benchmarks of $BUILD, and of $BUILD/fma if $FMA is set,
# and writes tables and charts to $BUILD/bench.  QUICK=1: under two minutes.
here=$(dirname "$0")
out=$BUILD/bench
mkdir -p "$out" || exit 3
if [ -n "$QUICK" ]; then
    turns=20 rounds=40 cases=400 seconds=0.02 batch_seconds=2 most=4000000
else
    turns=120 rounds=400 cases=100000 seconds=1 batch_seconds=20 most=10000000
fi

# Runs a program of each build; the second build's output loses its header.
# Both builds give the same answers, so only the first is compared with the
# reference.
measure() {
    program=$1 csv=$2 first=$3 second=$4
    "$BUILD/tools/bench/$program" "$flags" $first >"$csv" || exit 1
    [ -n "$FMA" ] || return
    "$BUILD/fma/tools/bench/$program" "$flags -mfma" $second >"$csv.fma" ||
        exit 1
    sed 1d "$csv.fma" >>"$csv"
    rm "$csv.fma"
}

# The number of shapes that fit into half of the free memory, at most $1.
fitting() {
    awk -v most="$1" '/^MemAvailable:/ { n = $2 * 1024 / 2 / 700 }
        END { if (n == 0) n = 1e6; printf "%d", n < most ? n : most }' \
        /proc/meminfo 2>/dev/null || echo 1000000
}

draw() { # SCRIPT CSV [AWK ARGUMENT]...
    script=$1 csv=$2
    shift 2
    awk "$@" -f "$here/$script" "$csv" | gnuplot
}

describe_machine() {
    sed -n 's/^model name[^:]*: /processor: /p' /proc/cpuinfo 2>/dev/null |
        head -n 1
    echo "system:    $(uname -sm)"
    echo "compiler:  $($CC --version | head -n 1)"
    echo "flags:     $CFLAGS"
    echo "commit:    $(git -C "$here" describe --always --dirty 2>/dev/null)"
}

flags=$(echo " $CFLAGS" | sed 's/ -g[0-9a-z]*//g; s/,/ /g; s/^ *//')
describe_machine >"$out/machine.txt"
cat "$out/machine.txt"

echo 'time of a question beside the quadratics ...' >&2
measure cost "$out/cost.csv" $rounds $rounds
awk -f "$here/cost.awk" "$out/cost.csv" >"$out/cost.txt"

# Runs a program with all kernels that this processor runs.
with_all_kernels() { # PROGRAM ARGUMENT CSV
    for kernels in $("$BUILD/tools/bench/kernels"); do
        KERNELS=$kernels "$BUILD/tools/bench/$1" "$2" "$kernels" || exit 1
    done | awk 'NR == 1 { header = $0 } NR == 1 || $0 != header' >"$3"
}

echo 'single questions beside the leanest formula ...' >&2
with_all_kernels single $turns "$out/single.csv"
awk -f "$here/single.awk" "$out/single.csv" >"$out/single.txt"

echo 'distances beside the leanest formulas ...' >&2
with_all_kernels distance $turns "$out/distance.csv"
awk -f "$here/distance.awk" "$out/distance.csv" >"$out/distance.txt"

echo "time against error, $cases cases a family ..." >&2
measure methods "$out/methods.csv" "$cases $seconds" "0 $seconds"
awk -f "$here/table.awk" "$out/methods.csv" >"$out/methods.txt"

most=$(fitting $most)
echo "batches, up to $most shapes ..." >&2
"$BUILD/tools/bench/batch" $batch_seconds "$most" >"$out/batch.csv" || exit 1
awk -f "$here/batch.awk" "$out/batch.csv" >"$out/batch.txt"
awk -f "$here/builds.awk" "$out/single.csv" "$out/distance.csv" \
    "$out/batch.csv" >"$out/builds.txt"
awk -v readme=1 -f "$here/batch.awk" "$out/batch.csv" >"$out/readme.md"

if command -v gnuplot >/dev/null 2>&1; then
    for chart in growth kernels; do
        draw batch_charts.awk "$out/batch.csv" -v chart=$chart \
            -v out="$out/batch-$chart.svg"
    done
    draw charts.awk "$out/methods.csv" -v class='cylinder infinite' \
        -v only='ordinary;far origin;grazing;nearly parallel' \
        -v unit=radii -v out="$out/time-error.svg" # README's
    sed 1d "$out/methods.csv" | cut -d , -f 2 | uniq | sort -u |
    while read -r class; do
        for unit in radii ulp; do
            svg=$out/$(echo "$class" | tr ' ' -)-$unit.svg
            draw charts.awk "$out/methods.csv" -v class="$class" \
                -v unit=$unit -v out="$svg"
        done
    done
else
    echo 'note: no gnuplot, no charts (Debian: gnuplot-nox)'
fi
cat "$out/methods.txt"
echo
cat "$out/cost.txt"
echo
cat "$out/single.txt"
echo
cat "$out/distance.txt"
echo
cat "$out/batch.txt"
echo
cat "$out/builds.txt"
echo
echo "tables and charts: $out/"
