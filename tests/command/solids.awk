# solids.awk - compares pieces of lines with the solids of other programs
#
#     awk -f solids.awk SCENE LINES PIECES
#
# SCENE: the display of cylint(7).  The tail of a solid's first shape is the solid in
# the notation of the other program.  LINES: `line ox oy oz dx dy dz`.  PIECES: record,
# shape, t0, t1.  inside() is the other program's definition, written from its manual:
# negative inside, positive outside.  Along a line its sign must change within
# 1e-7 (1 + |t|) of each end of a piece, and nowhere else.

function max(a, b) { return a > b ? a : b }
function min(a, b) { return a < b ? a : b }
function square(a) { return a * a }
function radius() { return sqrt(x * x + y * y) }

# A layer between two radii and the planes z = -h and z = h.
function layer(inner, outer, h)
{
    return max(max(radius() - outer, inner > 0 ? inner - radius() : -1),
               max(z, -z) - h)
}

# The sector from the angle p[i] on, p[i + 1] wide, in degrees.
function sector(i,   angle)
{
    angle = (atan2(y, x) / atan2(0, -1) * 180 - p[i] + 720) % 360
    return p[i + 1] >= 360 || angle < p[i + 1] ? -1 : 1
}

function polycone(   n, i, s, f)
{
    n = p[3]
    f = 1
    for (i = 4; i < 3 + n; i++) {
        s = (z - p[i]) / (p[i + 1] - p[i])
        f = min(f, max(max(-s, s - 1),
            max(radius() - p[i + 2 * n] - s * (p[i + 1 + 2 * n] - p[i + 2 * n]),
                p[i + n] + s * (p[i + 1 + n] - p[i + n]) - radius())))
    }
    return f
}

# A surface of MCNP, `CZ 10` for example: its negative sense is negative.
function surface(card,   c)
{
    split(card, c, " ")
    if (c[2] == "CZ") return radius() - c[3]
    if (c[2] == "SO") return x * x + y * y + z * z - square(c[3])
    if (c[2] == "PX") return x - c[3]
    if (c[2] == "PY") return y - c[3]
    if (c[2] == "PZ") return z - c[3]
    unknown[card] = 1
    return 0
}

# Surfaces with senses: a blank is `and`, a colon within parentheses `or`.
function cell(text,   card, n, term, terms, part, parts, i, j, k, f, g)
{
    n = split(text, card, /[|]/)
    sub(/^ *MCNP */, "", card[1])
    terms = split(card[1], term, " ")
    f = -1
    for (i = 1; i <= terms; i++) {
        gsub(/[()]/, "", term[i])
        parts = split(term[i], part, ":")
        g = 1
        for (j = 1; j <= parts; j++) {
            k = part[j] < 0 ? -part[j] : part[j]
            g = min(g, surface(card[k + 1]) * (part[j] < 0 ? 1 : -1))
        }
        f = max(f, g)
    }
    return f
}

function inside(name,   s, f)
{
    if (name == "G4Tubs")
        return max(layer(p[1], p[2], p[3]), sector(4))
    if (name == "G4Cons") {
        s = (z + p[5]) / (2 * p[5])
        return max(layer(p[1] + s * (p[3] - p[1]), p[2] + s * (p[4] - p[2]),
                         p[5]), sector(6))
    }
    if (name == "G4CutTubs") {
        f = max(p[6] * x + p[7] * y + p[8] * (z + p[3]),
                p[9] * x + p[10] * y + p[11] * (z - p[3]))
        return max(max(layer(p[1], p[2], 1000), sector(4)), f)
    }
    if (name == "G4Polycone")
        return max(polycone(), sector(1))
    if (name == "G4Sphere") {
        s = sqrt(x * x + y * y + z * z)
        return max(s - p[2], p[1] - s)
    }
    if (name == "G4SubtractionSolid") { # a ball and a tube beside the axis
        f = max(sqrt(square(x - p[9]) + square(y - p[10])) - p[5],
                max(z - p[11], p[11] - z) - p[6])
        return max(x * x + y * y + z * z - square(p[2]), -f)
    }
    if (name == "MCNP")
        return cell(text_of[solid])
    if (name == "tee") {
        f = min(max(square(y) + square(z) - 25, max(x, -x) - 20),
                max(square(x) + square(y) - 16, max(-z, z - 20)))
        s = min(max(square(y) + square(z) - 20.25, max(x, -x) - 20),
                max(square(x) + square(y) - 12.25, max(-z, z - 20)))
        return max(f, -s)
    }
    unknown[name] = 1
    return 0
}

function at(t)
{
    x = o[1] + t * d[1]
    y = o[2] + t * d[2]
    z = o[3] + t * d[3]
    return inside(p[0])
}

function near(t) { return 1e-7 * (1 + max(t, -t)) }

# Whether the sign is `sign` from t = a to t = b.
function constant(a, b, sign,   i)
{
    for (i = 0; i <= 30; i++)
        if (at(a + i * (b - a) / 30) * sign <= 0)
            return 0
    return 1
}

function check(text,   v, n, i, from, fine)
{
    n = split(ends[line, solid], v, " ")
    split(text_of[solid], p, " ")
    for (i = 0; (i + 1) in p; i++)
        p[i] = p[i + 1]
    from = -9
    fine = 1
    for (i = 1; i <= n; i++) {
        fine = fine && constant(from, v[i] - near(v[i]), i % 2 ? 1 : -1)
        from = v[i] + near(v[i])
    }
    if (!fine || !constant(from, 9, 1)) {
        print "wrong: line " line " " line_text[line] ": " text ": " ends[line, solid]
        wrong++
    }
    hits[solid] += n > 0
    many[solid] += n > 2
}

FNR == 1 { file++ }

file == 1 && /^[a-z]/ {
    shape++
    match($0, /(in|out)=[a-z0-9\/]*/)
    name = substr($0, RSTART, RLENGTH)
    rest = substr($0, RSTART + RLENGTH)
    sub(/^[a-z]*=/, "", name)
    sub(/\/.*/, "", name)
    if (!(name in seen)) {
        seen[name] = 1
        text_of[shape] = rest
    }
}
file == 2 { line_text[++lines] = $0 }
file == 3 { ends[$1, $2] = ends[$1, $2] " " $3 " " $4 }

END {
    for (line = 1; line <= lines; line++) {
        split(line_text[line], v, " ")
        for (i = 1; i <= 3; i++) {
            o[i] = v[1 + i]
            d[i] = v[4 + i]
        }
        for (solid in text_of)
            check(text_of[solid])
    }
    for (name in unknown) {
        print "no definition of " name
        wrong++
    }
    for (solid in text_of) {
        solids++
        if (hits[solid] < 20 || many[solid] < 5) {
            print text_of[solid] ": hit by " hits[solid] + 0 ", twice by " many[solid] + 0
            wrong++
        }
    }
    print solids + 0 " solids, " lines " lines, " wrong + 0 " wrong"
    exit wrong > 0 || solids < 8
}
