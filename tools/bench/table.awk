# The tables of methods.csv as text: awk -f table.awk methods.csv
#
# One table for each class of shapes, one line for each family.  For each
# method: ns of a question (both t; shader: the nearest), the error in radii
# that 99 % of the hits do not exceed, and the share of wrong verdicts if there
# are any.
BEGIN { FS = ","; first_build = "" }

function column(method, mode) {
    if (method == "plain") method = "plain quadratic"
    if (method == "quadratic") method = "full quadratic"
    return mode == "both" ? method : method " " mode
}

# The modes in the tables; the others are in the CSV only.
function shown(method, mode) {
    if (method == "cylint") return mode == "verdict" || mode == "both"
    return mode == "both" || (method == "shader" && mode == "nearest")
}

function number(x) { return x == "nan" || x == "" ? "-" : sprintf("%.0e", x) }

function error_text(x,   s) {
    s = number(x)
    sub(/e-0/, "e-", s); sub(/e\+0/, "e", s); sub(/e\+/, "e", s)
    return s
}

function percent(x) {
    return x == "nan" || x + 0 == 0 ? "" : x < 0.095 ? sprintf("%.2f%%", x) \
         : x < 9.5 ? sprintf("%.1f%%", x) : sprintf("%.0f%%", x)
}

function time_text(x) { return x < 9999.5 ? sprintf("%.0f", x) : sprintf("%.0fk", x / 1000) }

NR == 1 { cycles = $8; next }
$1 == "build" { next }
first_build == "" { first_build = $1 }
!($2 in class_seen) { class_seen[$2] = 1; classes[++n_classes] = $2 }
!shown($4, $5) { next }
{
    c = column($4, $5)
    if (!(($2, c) in column_seen)) { column_seen[$2, c] = 1; columns[$2, ++n_columns[$2]] = c }
}
$1 != first_build {
    other_build = $1
    other[$2, c] += log($7); n_other[$2, c]++
    next
}
{
    if (!(($2, $3) in family_seen)) { family_seen[$2, $3] = 1; families[$2, ++n_families[$2]] = $3 }
    ns[$2, $3, c] = $7; err[$2, $3, c] = $10; wrong[$2, $3, c] = $15; cases = $22
    sum[$2, c] += log($7); n[$2, c]++
    all_cycles[$2, c] += log($8 > 0 ? $8 : 1)
    if ($15 != "nan" && $15 + 0 > worst[$2, c] + 0) { worst[$2, c] = $15; worst_in[$2, c] = $3 }
    if ($13 != "nan" && $13 + 0 >= far[$2, c] + 0) far[$2, c] = $13
    if ($3 == "ordinary") { plain_err[$2, c] = $10; plain_ns[$2, c] = $7 }
}

function cell(k, c) {
    if (!((k, c) in ns)) return sprintf(" %19s", "")
    if (c == "cylint verdict") return sprintf(" %6s %6s", time_text(ns[k, c]), percent(wrong[k, c]))
    return sprintf(" %6s %6s %5s", time_text(ns[k, c]), error_text(err[k, c]), percent(wrong[k, c]))
}

function one_class(class,   i, j, c) {
    printf "%s: ns, error of 99 %% of hits in radii, wrong verdicts (%s); lower is better\n%-22s", class, first_build, "family"
    for (j = 1; j <= n_columns[class]; j++) {
        c = columns[class, j]
        printf (c == "cylint verdict" ? " %13s" : " %19s"), c
    }
    print ""
    for (i = 1; i <= n_families[class]; i++) {
        printf "%-22s", families[class, i]
        for (j = 1; j <= n_columns[class]; j++)
            printf "%s", cell(class SUBSEP families[class, i], columns[class, j])
        print ""
    }
    print ""
}

# For each method: the ordinary family, the geometric mean of all families,
# and that of a second build.
function summary(   i, j, k, class, c, row) {
    row = "%-25s %-22s %8s %9s %8s %8s %8s %9s  %s\n"
    printf "lower is better; ns: built with %s%s\n", first_build, (other_build == "" ? "" : "; ns*: with " other_build)
    printf row, "", "", "ordinary", "ordinary", "all", "all", "all", "worst", ""
    printf row, "shapes", "method", "ns", "99 % err", "ns", (other_build == "" ? "" : "ns*"), cycles, "99 % ulp", "most wrong verdicts"
    for (i = 1; i <= n_classes; i++)
        for (j = 1; j <= n_columns[classes[i]]; j++) {
            class = classes[i]; c = columns[class, j]; k = class SUBSEP c
            printf row, (j == 1 ? class : ""), c, time_text(plain_ns[k]), error_text(plain_err[k]),
                time_text(exp(sum[k] / n[k])), (n_other[k] ? time_text(exp(other[k] / n_other[k])) : ""),
                time_text(exp(all_cycles[k] / n[k])), (far[k] == "" ? "-" : far[k] < 10 ? far[k] : error_text(far[k])),
                (worst[k] == "" ? "none" : percent(worst[k]) "  " worst_in[k])
        }
}

END {
    for (i = 1; i <= n_classes; i++) one_class(classes[i])
    printf "All families, %s cases of each; the 99 %% error of the worst family is in ulp of t\n", cases
    summary()
}
