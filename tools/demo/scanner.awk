# scanner.awk - a terrestrial laser scanner: one ray per line for `cylint -s`
#
# The scanner is `height` metres above the origin and faces along x.  It sweeps
# `azimuth` degrees from left to right in `columns` steps, and the elevations
# from `highest` to `lowest` in `rows` steps.  Directions are decimals of almost
# unit length, so t is the range to a part in 10^9.  The label of a ray is its
# column and row.

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
