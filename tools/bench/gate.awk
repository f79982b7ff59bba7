# Times of two trees: awk -f gate.awk old-single.csv old-batch.csv new-single.csv ...
# For each row the least time of all runs; ratios new : old, geometric means by
# group, and the rows above 1.05.
BEGIN { FS = "," }
function add(group, key, ns) {
    if (ns == "nan" || ns + 0 == 0)
        return
    key = group SUBSEP key
    if (!(key in group_of)) { group_of[key] = group; keys[++rows] = key }
    if (!((key, tree) in time) || ns + 0 < time[key, tree]) time[key, tree] = ns + 0
}
FNR == 1 { file = FILENAME; sub(/.*\//, "", file); tree = substr(file, 1, 3) }
$1 == "build" || $1 == "part" { next }
file ~ /single/ { add("single " $1 ": " $3 ", " $7, $2 ", " $4 ", " $5 " %, " $6, $10) }
file ~ /batch/ && $1 == "cache" {
    hits = $7 < 0.2 ? 0 : $7 < 3 ? 1 : $7 < 20 ? 10 : 50
    add("batch " $2 ": " $4 ", " $5, $3 ", " hits " %", $10)
}
END {
    for (i = 1; i <= rows; i++) {
        key = keys[i]
        if (!((key, "old") in time) || !((key, "new") in time))
            continue
        ratio = time[key, "new"] / time[key, "old"]
        group = group_of[key]
        if (!(group in count)) groups[++many] = group
        count[group]++; logs[group] += log(ratio); all += log(ratio); total++
        if (ratio > worst[group]) worst[group] = ratio
        if (ratio > 1.05) {
            split(key, part, SUBSEP)
            slow[++slower] = sprintf("%.2f  %s; %s: %.2f -> %.2f ns", ratio, part[1], part[2], time[key, "old"], time[key, "new"])
        }
    }
    print "ratio of time, new : old (geometric mean, worst, rows)"
    for (g = 1; g <= many; g++)
        printf "%-58s %.3f  %.2f  %d\n", groups[g], exp(logs[groups[g]] / count[groups[g]]), worst[groups[g]], count[groups[g]]
    printf "%-58s %.3f        %d\n", "all", exp(all / total), total
    printf "rows above 1.05: %d\n", slower
    for (i = 1; i <= slower; i++)
        print slow[i]
}
