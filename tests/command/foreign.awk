# foreign.awk - compares hits with the solids of other programs
#
# An input line has an answer of cylint, the other program's name and parameters
# of the solid, `|`, and the line:
#
#     relation n t0 t1  NAME PARAMETER...  |  ox oy oz  dx dy dz
#
# inside() is the other program's definition, written from its manual, not from
# this library: negative inside, positive outside.  Along the line its sign must
# change within 1e-7 (1 + |t|) of each hit, and nowhere else.

function max(a, b) { return a > b ? a : b }

function square(a) { return a * a }

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

# The parameters are in the order of the card; x, y, z is the point.
function inside(name,   d, slope)
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
    if (name == "G4Tubs")
        return max(x * x + y * y - square(p[2]), max(z, -z) - p[3])
    if (name == "G4Cons") {
        slope = (p[4] - p[2]) / (2 * p[5])
        d = p[2] + slope * (z + p[5])
        return max(sqrt(x * x + y * y) - d, max(z, -z) - p[5])
    }
    if (name == "G4EllipticalTube")
        return max(square(x / p[1]) + square(y / p[2]) - 1,
                   max(z, -z) - p[3])
    if (name == "G4EllipticalCone")
        return max(square(x / p[1]) + square(y / p[2]) - square(p[3] - z),
                   max(z, -z) - p[4])
    unknown[name] = 1
    return 0
}

function at(t)
{
    x = $(bar + 1) + t * $(bar + 4)
    y = $(bar + 2) + t * $(bar + 5)
    z = $(bar + 3) + t * $(bar + 6)
    return inside($5)
}

# Whether the sign is constant from t = a to t = b.
function constant(a, b,   i, sign)
{
    sign = at(a)
    for (i = 1; i <= 20; i++)
        if (at(a + i * (b - a) / 20) * sign <= 0)
            return 0
    return 1
}

function changes(a)
{
    return at(a - near(a)) * at(a + near(a)) < 0
}

function near(t) { return 1e-7 * (1 + max(t, -t)) }

{
    gsub(/[{}<>,]/, " ")
    sub(/linear_spline 2/, "")
    for (bar = 5; $bar != "|"; bar++)
        ;
    split("", p)
    for (i = 6; i < bar; i++)
        p[i - 5] = $i
    lines_of[$5]++
    hits_of[$5] += $2 == 2
    fine = $1 == "miss" ? $2 == 0 : $1 == "cross"
    from = ($2 > 0 && $3 < 0 ? $3 : 0) - 100
    to = ($2 > 0 && $(2 + $2) > 0 ? $(2 + $2) : 0) + 100
    for (i = 1; i <= $2; i++) {
        t = $(2 + i)
        fine = fine && changes(t) && constant(from, t - near(t))
        from = t + near(t)
    }
    if (!fine || !constant(from, to)) {
        print "wrong: " $0
        wrong++
    }
}

END {
    for (name in unknown) {
        print "no definition of " name
        wrong++
    }
    for (name in lines_of) {
        kinds++
        if (hits_of[name] < 20 || hits_of[name] > lines_of[name] - 20) {
            print name ": hit by " hits_of[name] + 0 " of " lines_of[name]
            wrong++
        }
    }
    print kinds " kinds, " NR " lines, " wrong + 0 " wrong"
    exit wrong > 0 || NR == 0
}
