# table.awk - prints some answers of the scan with the label of the shape hit
#
# Reads a scene, then the answers of `cylint -f shape,t,part,z`.  Prints the
# first hit on each part of each kind of shape, in aligned columns.

FNR == 1 { files++ }

files == 1 && !/^#/ { label[++shapes] = $NF }

files == 2 && $1 > 0 {
    kind = label[$1]
    sub(/.*-/, "", kind)
    if (!((kind, $3) in shown)) {
        if (!lines++)
            line("shape", "t", "part", "z", "column row", "label")
        shown[kind, $3] = 1
        line($1, $2, $3, $4, $5 " " $6, label[$1])
    }
}

function line(shape, t, part, z, ray, name)
{
    printf "%-5s  %-18s  %-7s  %-22s  %-10s  %s\n", shape, t, part, z, ray,
           name
}
