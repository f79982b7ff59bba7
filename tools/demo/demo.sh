#!/bin/sh
# demo.sh - a laser scan of a generated forest, from text to text
#
# The demo writes to BUILD/demo.  CYLINT is the command, or BUILD/cylint; AWK is the
# awk to use.
set -eu
LC_ALL=C
export LC_ALL
here=$(dirname "$0")
build=${BUILD:-build}
awk=${AWK:-awk}
cylint=${CYLINT:-$build/cylint}
out=$build/demo
columns=400 rows=64

mkdir -p "$out"
$awk -v trees=18 -f "$here/forest.awk" > "$out/forest.scene"
$awk -v height=1.6 -v azimuth=120 -v lowest=-13 -v highest=47 \
    -v columns=$columns -v rows=$rows -f "$here/scanner.awk" > "$out/rays.txt"

echo "A forest, one shape a line, in $out/forest.scene:"
echo
sed -n 2,6p "$out/forest.scene"
echo
echo "A laser scanner among the trees, one ray a line, in $out/rays.txt:"
echo
sed -n 1,3p "$out/rays.txt"
echo
echo "What does each ray hit, at which distance, on which part, and at which height"
echo "above the ground?"
echo
echo "\$ cylint -s forest.scene -f t,part,z,label rays.txt > answers.txt"
started=$(date +%s.%N)
"$cylint" -s "$out/forest.scene" -f t,part,z,label "$out/rays.txt" \
    > "$out/answers.txt"
ended=$(date +%s.%N)
$awk -v columns=$columns -v rows=$rows -v wide=4 -v high=2 \
    -v started="$started" -v ended="$ended" -f "$here/report.awk" "$out/answers.txt"

# A picture in colours, if cylint-render was built.
[ -x "$build/cylint-render" ] || exit 0
"$build/cylint-render" "$out/forest.scene" -o "$out/forest.png" \
    --eye -18,-6,9 --look-at 12,0,4.6 --fov 44 --light -0.6,1,1.1 \
    --size 800x400
echo
echo "The forest from behind the scanner, by cylint-render: $out/forest.png"
