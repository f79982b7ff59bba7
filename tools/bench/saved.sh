#!/bin/sh
# make bench-saved: the command with a scene of text, and with the same scene saved:
# elapsed and processor time and memory, for one ray and for 200,000, on one
# processor, the least of five runs.  SHAPES is the number of cylinders.  They are
# 3 long and 0.15 thick (thin) or 1.2 long and 0.4 thick (fat), one in each unit of
# volume.
: "${BUILD:=build}" "${SHAPES:=1000000}"
scratch=$(mktemp -d "${TMPDIR:-/tmp}/cylint.XXXXXX") || exit 3
trap 'rm -rf "$scratch"' EXIT
trap 'exit 130' INT TERM

# generate COUNT LENGTH RADIUS: cylinders, or rays if LENGTH is 0.  Every awk prints
# the same bytes.
generate() {
    awk -v n="$1" -v length_="$2" -v r="$3" -v shapes="$SHAPES" '
    function within(most) {
        state = state * 16807 % 2147483647 # [Park, Miller 1988]
        return most * (2 * state / 2147483647 - 1)
    }
    BEGIN {
        state = 12345 + n
        half = exp(log(shapes) / 3) / 2
        for (i = 0; i < n; i++) {
            x = within(half); y = within(half); z = within(half)
            do {
                u = within(1); v = within(1); w = within(1)
                size = sqrt(u * u + v * v + w * w)
            } while (size > 1 || size < 0.1)
            if (length_ == 0) {
                printf "ray %.9f %.9f %.9f %.9f %.9f %.9f\n", x, y, z, u, v, w
                continue
            }
            size = length_ / size
            printf "cylinder %.9f %.9f %.9f %.9f %.9f %.9f %g\n", x, y, z,
                x + size * u, y + size * v, z + size * w, r
        }
    }'
}

# least NAME ARGUMENT...: the least figures of five runs of the command
least() {
    name=$1
    shift
    for run in 1 2 3 4 5; do
        "$BUILD/tools/bench/measure" "$BUILD/cylint" -j 1 "$@" 3>&1 >/dev/null
    done | awk -v name="$name" '
        NR == 1 || $1 < wall { wall = $1 }
        NR == 1 || $2 < cpu { cpu = $2 }
        NR == 1 || $3 > memory { memory = $3 }
        END { printf "%-28s %8.3f %8.3f %8.0f\n", name, wall, cpu, memory * 1.024e-3 }'
}

generate 200000 0 0 >"$scratch/rays"
head -n 1 "$scratch/rays" >"$scratch/ray"
echo "$SHAPES cylinders"
printf '%-28s %8s %8s %8s\n' 'lower is better' elapsed cpu 'RSS MB'
for kind in 'thin 3 0.15' 'fat 1.2 0.4'; do
    set -- $kind
    generate "$SHAPES" "$2" "$3" >"$scratch/text"
    least "$1, save" --save "$scratch/saved" -s "$scratch/text"
    for from in text saved; do
        least "$1, $from, 1 ray" -s "$scratch/$from" "$scratch/ray"
        least "$1, $from, 200,000 rays" -s "$scratch/$from" "$scratch/rays"
    done
    echo "$(wc -c <"$scratch/text") bytes of text, $(wc -c <"$scratch/saved") saved"
done
