#!/bin/sh
# usage: far.sh [PIXELS] > far.ppm
# Draws four cylinders of radius 0.35 to 0.5 through a telescope, three times: by the
# quadratic formula in doubles from 1e7 and from 1e8 units away, and by cylint from 1e8.
# Nothing else differs.  Needs `cylint` in the PATH, and awk.
set -e
export LC_ALL=C
pixels=${1:-300}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

cat > "$scratch/scene" <<END
cylinder -3 0 -1.2       3 0 -1.2       0.5
cylinder 0 -3 0          0 3 0          0.5
cylinder 0.8 0.6 -3      0.8 0.6 3      0.35
cylinder -1.2 -0.5 -2.6  -1.9 0.8 2.6   0.5
END

# rays DISTANCE: from one point to a grid in the plane through the origin
rays()
{
    awk -v far="$1" -v n="$pixels" 'BEGIN {
        for (j = n - 1; j >= 0; j--)
            for (i = 0; i < n; i++) {
                right = (2 * i + 1 - n) * 3.4 / n
                up = (2 * j + 1 - n) * 3.4 / n
                printf "ray %.17g %.17g %.17g  %.17g %.17g %.17g\n",
                       0.48 * far, -0.64 * far, 0.6 * far,
                       0.8 * right - 0.36 * up - 0.48 * far,
                       0.6 * right + 0.48 * up + 0.64 * far, 0.8 * up - 0.6 * far
            }
    }'
}

view() # DISTANCE OPTION...
{
    distance=$1
    shift
    rays "$distance" | cylint -s "$scratch/scene" -f shape,nx,ny,nz "$@"
}

view 1e7 --method=quadratic > "$scratch/near"
view 1e8 --method=quadratic > "$scratch/far"
view 1e8 > "$scratch/exact"
paste "$scratch/near" "$scratch/far" "$scratch/exact" | awk -v n="$pixels" '
    BEGIN {
        print "P3", 3 * n, n, 255
        split("222 120 60 90 140 200 235 200 90 130 180 110", colour)
    }
    # the colour of shape s, 0 for none, with the normal x, y, z
    function pixel(s, x, y, z,   light, c) {
        if (s == 0)
            return "250 250 248"
        light = 0.2 * x - 0.55 * y + 0.81 * z
        light = 0.25 + 0.75 * (light > 0 ? light : 0)
        c = 3 * s - 2
        return int(colour[c] * light) " " int(colour[c + 1] * light) " " int(colour[c + 2] * light)
    }
    {
        for (v = 0; v < 3; v++)
            row[v] = row[v] pixel($(4 * v + 1), $(4 * v + 2), $(4 * v + 3), $(4 * v + 4)) "\n"
    }
    NR % n == 0 {
        printf "%s%s%s", row[0], row[1], row[2]
        row[0] = row[1] = row[2] = ""
    }'
