#!/bin/sh
# make bench-text: the command beside other programs that read numbers, on
# records of 13 numbers: MB and records a second of elapsed time, and memory.
# All programs take turns in several rounds, and the best round counts.  A run
# on one processor is pinned to it.  QUICK=1: a tenth of the records.
#
# PYTHON is an interpreter that has pandas, polars or duckdb.  UNDER is a
# command that starts each run, for instance UNDER='nice -n -10'.
here=$(dirname "$0")
: "${BUILD:=build}" "${PYTHON:=python3}"
if [ -n "$QUICK" ]; then tenth=50000; else tenth=500000; fi
rounds=5 slow_rounds=2
mkdir -p "$BUILD/bench" || exit 3
place=/dev/shm
[ -w $place ] || place=${TMPDIR:-/tmp}
scratch=$(mktemp -d "$place/cylint.XXXXXX") || exit 3
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM
measure=$BUILD/tools/bench/measure
text=$scratch/text doubles=$scratch/doubles four=$scratch/four

ten_times() { # FROM TO
    for i in 1 2 3 4 5 6 7 8 9 10; do cat "$1"; done >"$2"
}

echo "writing ${tenth}0 records ..." >&2
awk -v n=$tenth -f "$here/text_records.awk" >"$scratch/some" || exit 3
cut -d ' ' -f 1-4 "$scratch/some" >"$four"
ten_times "$scratch/some" "$text"
"$PYTHON" -c 'import array, sys
for line in sys.stdin:
    array.array("d", map(float, line.split())).tofile(sys.stdout.buffer)' \
    <"$scratch/some" >"$scratch/some.doubles" &&
    ten_times "$scratch/some.doubles" "$doubles"

# on PROCESSORS COMMAND...
on() {
    if [ "$1" -eq 1 ] && command -v taskset >/dev/null; then
        pin='taskset -c 0'
    else
        pin=
    fi
    shift
    $UNDER $pin "$@"
}

# keep PROCESSORS FILE RECORDS NAME FIGURES; FIGURES is empty if the run failed
keep() {
    if [ -n "$5" ]; then
        printf '%s\t%s\t%s\t%s\t%s\n' "$4" "$1" "$(wc -c <"$2")" "$3" \
            "$(echo "$5" | tr ' ' '\t')" >>"$scratch/runs"
    else
        echo "note: $4 did not run" >&2
    fi
}

run() { # PROCESSORS FILE RECORDS NAME COMMAND...
    processors=$1 file=$2 count=$3 name=$4
    shift 4
    figures=$(on "$processors" "$measure" "$@" 3>&1 <"$file" >/dev/null \
        2>/dev/null) || figures=
    keep "$processors" "$file" "$count" "$name" "$figures"
}

read_by() { # PROCESSORS LIBRARY
    figures=$(on "$1" "$PYTHON" "$here/text_readers.py" "$2" "$text" "$1" \
        2>/dev/null) || figures=
    keep "$1" "$text" ${tenth}0 "$2" "$figures"
}

sums='{ for (i = 1; i <= 13; i++) s[i] += $i } END { for (i in s) print s[i] }'
round=1
while [ $round -le $rounds ]; do
    echo "round $round of $rounds ..." >&2
    run 1 "$text" ${tenth}0 cat cat
    for j in 1 2; do
        run $j "$text" ${tenth}0 "cylint -j $j" \
            "$BUILD/cylint" -j $j -k ray,cylinder
        run $j "$doubles" ${tenth}0 "cylint -b -j $j" \
            "$BUILD/cylint" -j $j -b -k ray,cylinder
        read_by $j duckdb
        read_by $j polars
    done
    if [ $round -le $slow_rounds ]; then
        read_by 1 pandas
        run 1 "$text" ${tenth}0 'wc -w' wc -w
        run 1 "$text" ${tenth}0 'mawk, 13 sums' mawk "$sums"
        run 1 "$text" ${tenth}0 'datamash, 13 sums' datamash -W sum 1-13
        run 1 "$four" $tenth 'cct, 4 numbers' cct +proj=utm +zone=32
    fi
    round=$((round + 1))
done

awk -F '\t' '
    { key = $1 FS $2 }
    !(key in wall) { order[++n] = key }
    !(key in wall) || $5 < wall[key] {
        wall[key] = $5; processor[key] = $6; bytes[key] = $3; rows[key] = $4
    }
    $7 > memory[key] { memory[key] = $7 }
    END {
        print "higher is better: MB/s, Mrecord/s; lower is better: seconds, cpu, RSS MB"
        printf "%-18s %10s %8s %9s %8s %8s %7s\n", "program", "processors",
            "MB/s", "Mrecord/s", "seconds", "cpu", "RSS MB"
        for (i = 1; i <= n; i++) {
            split(order[i], k, FS)
            key = order[i]
            printf "%-18s %10d %8.0f %9.2f %8.2f %8.2f %7.0f\n", k[1], k[2],
                bytes[key] / wall[key] / 1e6, rows[key] / wall[key] / 1e6,
                wall[key], processor[key], memory[key] / 1024
        }
    }' "$scratch/runs" | tee "$BUILD/bench/text.txt"
