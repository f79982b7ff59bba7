# The measurements of distance.c as text: awk -f distance.awk distance.csv
BEGIN {
    FS = ","
    print "One point, one shape: ns of the lean formula / of cylint, and cylint : lean; lower is better."
}
NR == 1 { next }
$1 != build { build = $1; shape = ""; printf "\n\nkernels: %s", build }
$2 != shape { shape = $2; row = ""; printf "\n%s\n", shape }
{
    name = sprintf("%-30s %-9s  lean signs wrong %4.1f %%", $3, $4, $9)
    if (name != row) {
        if (row != "")
            print ""
        printf "%s", name
        row = name
    }
    printf "  %s %5.1f/%5.1f %5.2fx", $5, $6, $7, $8
}
END { print "" }
