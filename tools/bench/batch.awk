# The tables of batch.csv as text: awk -f batch.awk batch.csv
# With -v readme=1: the table of README.md.
BEGIN { FS = ","; width["plain"] = 128; width["avx2"] = 256; width["avx512"] = 512 }

function once(list, name) { # appends a name to a list unless it is there
    if (!((list, name) in listed)) { listed[list, name] = 1; names[list, ++many[list]] = name }
}

# The share of hits that the race was set up for: 0, 1, 10 or 50 %.
function nominal(percent) { return percent < 0.2 ? 0 : percent < 3 ? 1 : percent < 20 ? 10 : 50 }

NR == 1 { next }
$1 == "bytes" { bytes[$3] = $10 }
$1 == "core" { core[$2, $5] = $10; once("widths", $2) }
$1 == "cache" {
    h = nominal($7); k = $3 SUBSEP $4 SUBSEP $5 SUBSEP h
    ns[k, $2] = $10; plain[k] = $11; reached[k] = $8; exactly[k] = $7
    once("kernels", $2); once("shapes", $3); once("query " $4, $5); once("hits", h); once("arrangements", $4)
}
$1 == "growth" { grown[$2, $5, $6] = $10; once("sizes", $6); once("runners", $2) }
$1 == "families" || $1 == "drawing" {
    once($1, $3); undecided[$3] = $9; hit[$3] = $7; case_ns[$3, $2] = $10; single[$3] = $12; by_plain[$3] = $11
}

function ratio(x, y) { return y + 0 > 0 ? sprintf("%6.2fx", x / y) : sprintf("%7s", "") }

function kernels_line(text,   k) {
    printf "%s", text
    for (k = 1; k <= many["kernels"]; k++) printf " %16s", called(names["kernels", k])
    print ""
}

function in_cache(   s, a, h, k, key, query) {
    print "One line against 512 capped shapes in cache: ns a test, and the ratio to the plain quadratic one by one (lower is better)"
    kernels_line(sprintf("%-18s %-13s %5s %8s", "", "query", "hits", "plain q."))
    for (s = 1; s <= many["shapes"]; s++)
        for (a = 1; a <= many["query one line"]; a++)
            for (h = 1; h <= many["hits"]; h++) {
                query = names["query one line", a]
                key = names["shapes", s] SUBSEP "one line" SUBSEP query SUBSEP names["hits", h]
                printf "%-18s %-13s %4.1f%% %8s", (a + h == 2 ? names["shapes", s] : ""), (h == 1 ? query : ""),
                    exactly[key], (plain[key] == "nan" ? "" : sprintf("%.2f", plain[key]))
                for (k = 1; k <= many["kernels"]; k++)
                    printf " %8.2f %s", ns[key, names["kernels", k]], ratio(ns[key, names["kernels", k]], plain[key])
                print ""
            }
}

function beside_cylinders(   s, h, k, key, to) {
    print "\nThe nearest of 512: time over that for cylinders (lower is better)"
    kernels_line(sprintf("%-18s %5s", "", "hits"))
    for (s = 2; s <= many["shapes"]; s++)
        for (h = 1; h <= many["hits"]; h++) {
            key = SUBSEP "one line" SUBSEP "nearest" SUBSEP names["hits", h]
            printf "%-18s %4d%%", (h == 1 ? names["shapes", s] : ""), names["hits", h]
            for (k = 1; k <= many["kernels"]; k++) {
                to = names["kernels", k]
                printf " %16s", ratio(ns[names["shapes", s] key, to], ns[names["shapes", 1] key, to])
            }
            print ""
        }
}

function arranged(   s, a, h, k, r, key, to) {
    print "\nColumns of answers, 512 of each: ns a test with one line, and the ratios of one shape and of pairs to it (lower is better)"
    printf "%-18s %-10s %5s", "", "columns", "hits"
    for (k = 1; k <= many["kernels"]; k++) printf "   %22s", called(names["kernels", k]) ": line, shape, pairs"
    print ""
    for (s = 1; s <= many["shapes"]; s++)
        for (a = 1; a <= many["query pairs"]; a++)
            for (h = 2; h <= many["hits"]; h++) {
                printf "%-18s %-10s %4d%%", (a == 1 && h == 2 ? names["shapes", s] : ""), (h == 2 ? names["query pairs", a] : ""), names["hits", h]
                key = SUBSEP names["query pairs", a] SUBSEP names["hits", h]
                for (k = 1; k <= many["kernels"]; k++) {
                    to = names["kernels", k]
                    r = ns[names["shapes", s] SUBSEP "one line" key, to]
                    printf "   %8.2f %s %s", r, ratio(ns[names["shapes", s] SUBSEP "one shape" key, to], r),
                        ratio(ns[names["shapes", s] SUBSEP "pairs" key, to], r)
                }
                print ""
            }
}

# The filter divides three times and takes one square root where a line meets
# the bounding ball of a shape, and divides twice more for each rounded root.
function limits(   h, k, a, to, key, query, least, d, r, n) {
    print "\nThe divider: ns a result, and the least ns a test of cylinders that it allows (in brackets: share of the measured time; higher is better)"
    for (k = 1; k <= many["widths"]; k++)
        printf "%s: divide %.2f, root %.2f%s", names["widths", k], core[names["widths", k], "divide"],
            core[names["widths", k], "root"], (k < many["widths"] ? "; " : "\n")
    kernels_line(sprintf("%-10s %5s %9s", "query", "hits", "reached"))
    n = split("count,both t", query, ",")
    for (a = 1; a <= n; a++)
        for (h = 2; h <= many["hits"]; h++) {
            key = "cylinder" SUBSEP "one line" SUBSEP query[a] SUBSEP names["hits", h]
            printf "%-10s %4.1f%% %8.1f%%", query[a], exactly[key], reached[key]
            for (k = 1; k <= many["kernels"]; k++) {
                to = names["kernels", k]
                d = core[width[to] " bits", "divide"]; r = core[width[to] " bits", "root"]
                least = reached[key] / 100 * (3 * d + r) + (query[a] == "count" ? 0 : 4 * d * exactly[key] / 100)
                printf " %8.2f (%3.0f%%) ", least, 100 * least / ns[key, to]
            }
            print ""
        }
}

function growth(   i, k, n, read, to) {
    printf "\nOne line against n capped cylinders: ns a test (lower is better); nearest at 1 %% hits, any at 0 %% hits\n%9s", "n"
    for (k = 1; k < many["runners"]; k++) printf " %18s", (k == 1 ? "plain q.: near., any" : called(names["runners", k]))
    print "   reading  over any, nearest (higher is better)"
    for (i = 1; i <= many["sizes"]; i++) {
        n = names["sizes", i]; read = grown["reading", "read", n]
        printf "%9d", n
        for (k = 1; k < many["runners"]; k++) {
            to = names["runners", k]
            printf " %9.2f %8.2f", grown[to, "nearest", n], grown[to, "any", n]
        }
        to = names["runners", 2]
        printf "  %6.2f      %3.0f%% %3.0f%%\n", read, 100 * read / grown[to, "any", n], 100 * read / grown[to, "nearest", n]
    }
    print "reading: " bytes["read by the first pass"] " bytes a shape as fast as this core reads;"
    printf "in the last row %.1f GB/s, any %.1f GB/s; a shape takes %d bytes as made, %d packed\n", bytes["read by the first pass"] / read,
        bytes["read by the first pass"] / grown[names["runners", 2], "any", n], bytes["as made"], bytes["packed"]
}

function cases(part, title,   i, k, name) {
    print "\n" title
    printf "%-26s %6s %10s", "", "hits", "undecided"
    for (k = 1; k <= many["kernels"]; k++) printf " %8s", short(names["kernels", k])
    print " one by one" (part == "drawing" ? " plain q." : "")
    for (i = 1; i <= many[part]; i++) {
        name = names[part, i]
        printf "%-26s %5.1f%% %9.1f%%", name, hit[name], undecided[name]
        for (k = 1; k <= many["kernels"]; k++) printf " %8.0f", case_ns[name, names["kernels", k]]
        printf " %10.0f%s\n", single[name], (part == "drawing" ? sprintf(" %8.0f", by_plain[name]) : "")
    }
}

# One row; the unit is the plain quadratic against cylinders.
function readme_row(title, shape, to,   h, key, unit, cells) {
    for (h = 1; h <= many["hits"]; h++) {
        key = SUBSEP "one line" SUBSEP "nearest" SUBSEP names["hits", h]
        unit = plain["cylinder" key]
        if (to == "") cells = cells sprintf(" | %.1f", unit)
        else cells = cells sprintf(" | %.1f (%.2fx)", ns[shape key, to], ns[shape key, to] / unit)
    }
    print "| " title cells " |"
}

function readme_table(   h, k) {
    printf "| ns a test, lower is better"
    for (h = 1; h <= many["hits"]; h++) printf " | %d %% hits", names["hits", h]
    print " |"
    for (h = 0; h <= many["hits"]; h++) printf "|---"
    print "|"
    readme_row("cylinders, plain quadratic one by one", "cylinder", "")
    for (k = 1; k <= many["kernels"]; k++)
        readme_row("cylinders, " called(names["kernels", k]), "cylinder", names["kernels", k])
    readme_row("cones, " called(names["kernels", 1]), "cone", names["kernels", 1])
    readme_row("elliptic cylinders, " called(names["kernels", 1]), "elliptic cylinder", names["kernels", 1])
}

function short(kernels) { return kernels == "plain" ? "no flags" : kernels == "avx2" ? "AVX2" : "AVX-512" }

function called(kernels) { return kernels == "plain" ? "no vector flags" : kernels == "avx2" ? "AVX2" : "AVX-512" }

END {
    if (readme) { readme_table(); exit }
    in_cache()
    beside_cylinders()
    arranged()
    limits()
    growth()
    cases("drawing", "Pairs on an integer grid (20 % parallel, 2 % tangent), and exact tangents only: ns a test, both t (lower is better)")
    cases("families", "Pairs of the families, all kinds and ends: share that the kernels leave undecided, ns a test, both t (lower is better)")
}
