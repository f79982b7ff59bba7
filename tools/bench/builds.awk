# Whether wider kernels are faster: awk -f builds.awk FILE.csv...
# Reads the CSV of single, distance (their first column names the kernels) and
# batch (part "cache").  Prints, for each pair of kernels, the geometric mean of the
# ratios of time, and every row where the wider kernels take more than 1.05 of the
# time of the narrower: a difference below that is noise.
BEGIN { FS = ","; n = split("plain avx2 avx512", names, " ") }
function row(kernels, key, ns) {
    if (ns == "nan" || ns + 0 == 0)
        return
    if (!(key in known)) { known[key] = 1; keys[++rows] = key }
    if (!((key, kernels) in time) || ns + 0 < time[key, kernels]) time[key, kernels] = ns + 0
    there[kernels] = 1
}
FNR == 1 { file = FILENAME; sub(/.*\//, "", file); sub(/\.csv$/, "", file); next }
file == "batch" && $1 != "cache" { next }
file == "batch" {
    hits = $7 < 0.2 ? 0 : $7 < 3 ? 1 : $7 < 20 ? 10 : 50
    row($2, "batch: " $3 ", " $4 ", " $5 ", " hits " % hits", $10)
}
file == "single" { row($1, "single: " $2 ", " $3 ", " $4 ", " $5 " % hits, " $6 ", " $7, $10) }
file == "distance" { row($1, "distance: " $2 ", " $3 ", " $4 ", " $5, $7) }
END {
    for (a = 1; a < n; a++)
        for (b = a + 1; b <= n; b++) {
            if (!(names[a] in there) || !(names[b] in there))
                continue
            log_sum = count = slow = 0
            list = ""
            for (i = 1; i <= rows; i++) {
                narrow = time[keys[i], names[a]]
                wide = time[keys[i], names[b]]
                if (narrow == 0 || wide == 0)
                    continue
                log_sum += log(wide / narrow)
                count++
                if (wide > 1.05 * narrow) {
                    slow++
                    list = list sprintf("  %-70s %7.2f ns, %s %7.2f ns (%.2f)\n", keys[i], wide, names[a], narrow, wide / narrow)
                }
            }
            if (count)
                printf "%s beside %s: %.2f of the time (geometric mean of %d rows), slower in %d rows\n%s",
                    names[b], names[a], exp(log_sum / count), count, slow, list
        }
}
