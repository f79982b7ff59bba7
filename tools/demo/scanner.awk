# scanner.awk - a terrestrial laser scanner: one ray per line for `cylint -s`
#
# Stands `height` metres above the origin, looks along x, sweeps the given
# degrees of azimuth (left to right) and elevation (top to bottom) in
# `columns` by `rows` steps.  Directions need not be of unit length for
# cylint, and are not quite, being decimals; t is the range to a part in 10^9.
# The label of a ray is its column and row.

BEGIN {
    degree = atan2(0, -1) / 180
    for (row = 0; row < rows; row++) {
        up = (highest - (row + 0.5) * (highest - lowest) / rows) * degree
        for (column = 0; column < columns; column++) {
            turn = (0.5 - (column + 0.5) / columns) * azimuth * degree
            printf "ray 0 0 %s  %.9f %.9f %.9f  %d %d\n", height,
                   cos(up) * cos(turn), cos(up) * sin(turn), sin(up),
                   column, row
        }
    }
}
