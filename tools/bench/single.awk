# The measurements of single.c as text: awk -f single.awk single.csv
BEGIN {
    FS = ","
    print "One question: ns of the rival / of cylint, and cylint : rival; lower is better."
    print "Rivals: lean, a prepared quadratic in doubles; shader; own, our ordinary ray with 93 % of hits."
}
NR == 1 { next }
$1 != build { build = $1; shape = ""; printf "\n\nkernels: %s", build }
$2 != shape { shape = $2; row = ""; printf "\n%s\n", shape }
{
    name = sprintf("%-20s %-8s %3d %% %-9s %-7s", $3, $4, $5, $6, $8)
    if (name != row) {
        if (row != "")
            print ""
        printf "%s", name
        row = name
    }
    printf "  %s %5.1f/%6.1f %5.2fx", $7, $9, $10, $11
}
END { print "" }
