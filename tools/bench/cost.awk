# The table of cost.csv as text: awk -f cost.awk cost.csv
BEGIN {
    FS = ","
    print "Time of one question in ns (lower is better): plain quadratic / full quadratic / cylint,"
    print "then cylint over the plain quadratic (below 1: cylint is faster)"
}
$1 == "build" { next }
$1 != build || $2 != shape {
    build = $1; shape = $2
    printf "\n%-19s %-13s", build, shape
    printf "\n%-13s %5s  %-27s %-27s %s\n", "", "hits", "verdict", "nearest t", "both t"
}
$5 == "verdict" { printf "%-13s %4.0f%%", $3, $4 }
{ printf "  %5.1f/%5.1f/%6.1f %5.2fx", $6, $7, $8, $9 }
$5 == "both" { print "" }
