# Prints n records of 13 numbers with six decimals: a ray in a box and a
# cylinder in its middle; about one ray in five hits.  Every awk prints the
# same bytes.
function within(most) {
    state = state * 16807 % 2147483647 # [Park, Miller 1988]
    return most * (2 * state / 2147483647 - 1)
}
BEGIN {
    state = 12345
    for (i = 0; i < n; i++)
        printf "%.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f %.6f\n",
            within(50), within(50), within(50), within(1), within(1), within(1),
            within(30), within(30), within(30), within(30), within(30),
            within(30), 17.5 + within(12.5)
}
