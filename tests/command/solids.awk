# solids.awk - compares pieces of lines with the solids of other programs
#
#     awk -v twice=LINES -f solids.awk SCENE LINES PIECES
#
# SCENE: a display of cylint(7).  The tail of a solid's first shape is the solid in
# the notation of the other program.  LINES: `line ox oy oz dx dy dz`.  PIECES: record,
# shape, t0, t1.  inside() is the other program's definition, written from its manual,
# not from this library: negative inside, positive outside.  Along a line its sign must
# change within 1e-7 (1 + |t|) of each end of a piece, and nowhere else.  Each solid must
# be hit by 20 lines and by so many in two pieces, and missed by 20 if it is no half-space.

function max(a, b) { return a > b ? a : b }
function min(a, b) { return a < b ? a : b }
function square(a) { return a * a }
function radius() { return sqrt(x * x + y * y) }

# Squared distance from the axis through p[i..i+2] along u.  Sets `along`, the
# coordinate along the axis in multiples of u.
function off_axis(i, ux, uy, uz,   dx, dy, dz)
{
    dx = x - p[i]; dy = y - p[i + 1]; dz = z - p[i + 2]
    along = (dx * ux + dy * uy + dz * uz) / (ux * ux + uy * uy + uz * uz)
    dx -= along * ux; dy -= along * uy; dz -= along * uz
    return dx * dx + dy * dy + dz * dz
}

# Bounds the solid by the planes along = 0 and along = 1.
function bounded(f) { return max(f, max(-along, along - 1)) }

function distance(cx, cy, cz)
{
    return sqrt(square(x - cx) + square(y - cy) + square(z - cz))
}

# The ball at s between two spheres: the least distance from its surface.  That
# is a convex function of s.
function from_ball(s)
{
    return distance(p[1] + s * (p[5] - p[1]), p[2] + s * (p[6] - p[2]),
                    p[3] + s * (p[7] - p[3])) - p[4] - s * (p[8] - p[4])
}

function from_sweep(   a, b, i)
{
    b = 1
    for (i = 0; i < 60; i++)
        if (from_ball(a + (b - a) / 3) < from_ball(b - (b - a) / 3))
            b -= (b - a) / 3
        else
            a += (b - a) / 3
    return from_ball(a)
}

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

# The parameters are in the order of the card; x, y, z is the point.
function inside(name,   s, f, d)
{
    if (name == "RCC")
        return bounded(off_axis(1, p[4], p[5], p[6]) - square(p[7]))
    if (name == "TRC" || name == "ConicalFrustum") {
        d = off_axis(1, p[4], p[5], p[6])
        return bounded(sqrt(d) - p[7] - along * (p[8] - p[7]))
    }
    if (name == "REC") {
        off_axis(1, p[7], p[8], p[9]); d = square(along)
        off_axis(1, p[10], p[11], p[12]); d += square(along)
        off_axis(1, p[4], p[5], p[6])
        return bounded(d - 1)
    }
    if (name == "C/X" || name == "XCylinder")
        return square(y - p[1]) + square(z - p[2]) - square(p[3])
    if (name == "C/Y" || name == "YCylinder")
        return square(x - p[1]) + square(z - p[2]) - square(p[3])
    if (name == "C/Z" || name == "ZCylinder")
        return square(x - p[1]) + square(y - p[2]) - square(p[3])
    if (name == "CZ")
        return x * x + y * y - square(p[1])
    if (name == "K/X" || name == "XCone")
        return square(y - p[2]) + square(z - p[3]) - p[4] * square(x - p[1])
    if (name == "K/Y" || name == "YCone")
        return square(x - p[1]) + square(z - p[3]) - p[4] * square(y - p[2])
    if (name == "K/Z" || name == "ZCone")
        return square(x - p[1]) + square(y - p[2]) - p[4] * square(z - p[3])
    if (name == "KZ")
        return max(x * x + y * y - p[2] * square(z - p[1]), (p[1] - z) * p[3])
    if (name == "ZConeOneSided") {
        d = square(x - p[1]) + square(y - p[2]) - p[4] * square(z - p[3])
        return max(d, p[5] ? p[3] - z : z - p[3])
    }
    if (name == "Cylinder")
        return off_axis(1, p[5], p[6], p[7]) - square(p[4])
    if (name == "Cone") {
        d = off_axis(1, p[5], p[6], p[7])
        along *= sqrt(square(p[5]) + square(p[6]) + square(p[7]))
        return d - p[4] * square(along)
    }
    if (name == "RightCircularCylinder")
        return max(square(x - p[1]) + square(y - p[2]) - square(p[5]),
                   max(p[3] - z, z - p[3] - p[4]))
    if (name == "SO" || name == "G4Orb")
        return x * x + y * y + z * z - square(p[1])
    if (name == "SX" || name == "SY" || name == "SZ")
        return distance(p[1] * (name == "SX"), p[1] * (name == "SY"), \
                        p[1] * (name == "SZ")) - p[2]
    if (name == "S" || name == "SPH" || name == "Sphere" || name == "sphere")
        return distance(p[1], p[2], p[3]) - p[4]
    if (name == "sphere_sweep")
        return from_sweep()
    if (name == "cylinder")
        return bounded(off_axis(1, p[4] - p[1], p[5] - p[2], p[6] - p[3]) - square(p[7]))
    if (name == "cone") {
        d = off_axis(1, p[5] - p[1], p[6] - p[2], p[7] - p[3])
        return bounded(sqrt(d) - p[4] - along * (p[8] - p[4]))
    }
    if (name == "plane")
        return p[1] * x + p[2] * y + p[3] * z - p[4]
    if (name == "G4EllipticalTube")
        return max(square(x / p[1]) + square(y / p[2]) - 1,
                   max(z, -z) - p[3])
    if (name == "G4EllipticalCone")
        return max(square(x / p[1]) + square(y / p[2]) - square(p[3] - z),
                   max(z, -z) - p[4])
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
    for (i = 0; i <= 30 && a <= b; i++)
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
    for (i = 1; i <= n && v[i] < 9; i++) {
        fine = fine && constant(from, v[i] - near(v[i]), i % 2 ? 1 : -1)
        from = max(from, v[i] + near(v[i]))
    }
    if (!fine || !constant(from, 9, i % 2 ? 1 : -1)) {
        print "wrong: line " line " " line_text[line] ": " text ": " ends[line, solid]
        wrong++
    }
    hits[solid] += n > 0
    many[solid] += n > 2
}

FNR == 1 { file++ }

file == 1 && /^[a-z]/ {
    shape++
    gsub(/[{}<>,]|linear_spline 2/, " ")
    sub(/^[a-z]+ +([-+.e0-9]+ +)*([-+.e0-9]+$)?/, "")
    sub(/^ends=[a-z0-9]+ */, "")
    name = shape
    if (match($0, /^(in|out)=[a-z0-9\/]+/)) {
        name = substr($0, 1, RLENGTH)
        $0 = substr($0, RLENGTH + 1)
        gsub(/^[a-z]*=|\/.*/, "", name)
    }
    if (!(name in seen)) {
        seen[name] = 1
        text_of[shape] = $0
    }
}
file == 2 { line_text[++lines] = $0 }
file == 3 {
    sub(/-inf/, -9)
    sub(/inf/, 9)
    ends[$1, $2] = ends[$1, $2] " " $3 " " $4
}

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
        missed = text_of[solid] ~ /^plane/ ? 20 : lines - hits[solid]
        if (hits[solid] < 20 || missed < 20 || many[solid] < twice) {
            print text_of[solid] ": hit by " hits[solid] + 0 ", twice by " many[solid] + 0
            wrong++
        }
    }
    print solids + 0 " solids, " lines " lines, " wrong + 0 " wrong"
}
