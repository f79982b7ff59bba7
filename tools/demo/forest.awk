# forest.awk - plants a small forest: a scene for `cylint -s` and cylint-render
#
# A spruce is a tapering stem with pointed cones of foliage; a beech in winter
# consists of frusta; the ground is a flat cylinder whose upper cap is visible.
# z is up, units are metres, and no tree stands near the scanner at the origin.
# A shape's label is tree-part, for instance spruce7-stem, and its colour.
#
# Random numbers: x -> 16807 x mod 2^31 - 1 [Park & Miller 1988].  Every product
# is below 2^53, so it is exact in any awk.  Coordinates are printed to the
# millimetre, so all awks print the same.

BEGIN {
    state = 5150
    pi = atan2(0, -1)
    colour["stem"] = colour["branch"] = "#8a7763"
    colour["twig"] = "#9c8a74"
    colour["foliage"] = "#5d8a5c"
    print "# a forest of " trees " trees, by tools/demo/forest.awk"
    print "cylinder 0 0 -0.2  0 0 0  60  ground #a39b6f"
    for (n = 1; n <= trees; n++)
        plant(n)
}

function random(low, high)
{
    state = state * 16807 % 2147483647
    return low + (high - low) * state / 2147483647
}

# Tries places until one is far from all other trees.
function plant(n,   x, y, angle, range, crowded, i)
{
    do {
        range = sqrt(random(49, 900)) # uniform over the ring of 7 to 30 m
        angle = random(-0.45, 0.45) * pi
        x = range * cos(angle)
        y = range * sin(angle)
        crowded = 0
        for (i = 1; i < n; i++)
            if ((x - stem_x[i]) ^ 2 + (y - stem_y[i]) ^ 2 < 9)
                crowded = 1
    } while (crowded)
    stem_x[n] = x
    stem_y[n] = y
    if (random(0, 1) < 0.5)
        spruce("spruce" n, x, y, random(9, 18))
    else
        beech("beech" n, x, y, random(9, 15))
}

function frustum(x0, y0, z0, r0, x1, y1, z1, r1, tree, part)
{
    printf "cone %.3f %.3f %.3f %.3f  %.3f %.3f %.3f %.3f  %s-%s %s\n",
           x0, y0, z0, r0, x1, y1, z1, r1, tree, part, colour[part]
}

function spruce(name, x, y, height,   base, low, high, width, tiers, i)
{
    base = 0.13 * height
    frustum(x, y, 0, 0.014 * height, x, y, base * 1.6, 0.011 * height,
            name, "stem")
    tiers = int(height / 2.6)
    width = 0.19 * height
    for (i = 0; i < tiers; i++) {
        low = base + (height - base) * i / tiers * 0.92
        high = low + (height - base) * 1.75 / tiers
        if (i == tiers - 1 || high > height)
            high = height
        frustum(x, y, low, width * (1 - i / (tiers + 0.4)), x, y, high, 0,
                name, "foliage")
    }
}

function beech(name, x, y, height,   i, pieces, z, r, next_x, next_y, next_r)
{
    pieces = 5
    r = 0.018 * height
    z = 0
    for (i = 1; i <= pieces; i++) {
        next_x = x + random(-0.02, 0.02) * height
        next_y = y + random(-0.02, 0.02) * height
        next_r = 0.018 * height * (1 - 0.8 * i / pieces)
        frustum(x, y, z, r, next_x, next_y, z + height / pieces, next_r,
                name, "stem")
        x = next_x
        y = next_y
        r = next_r
        z += height / pieces
        if (i >= 2)
            whorl(name, x, y, z, r, 0.30 * height * (1.25 - 0.16 * i))
    }
}

# Branches around a point of the stem, each bent upward once and forked.
function whorl(name, x, y, z, r, reach,   count, turn, i, a, x1, y1, z1, r1)
{
    count = 4
    turn = random(0, 2 * pi)
    for (i = 0; i < count; i++) {
        a = turn + (i + random(-0.25, 0.25)) * 2 * pi / count
        r1 = r * 0.38
        x1 = x + reach * 0.55 * cos(a)
        y1 = y + reach * 0.55 * sin(a)
        z1 = z + reach * random(0.20, 0.40)
        frustum(x, y, z, r * 0.6, x1, y1, z1, r1, name, "branch")
        twig(name, x1, y1, z1, r1, a + random(0.2, 0.7), reach * 0.6)
        twig(name, x1, y1, z1, r1, a - random(0.2, 0.7), reach * 0.6)
    }
}

function twig(name, x, y, z, r, a, reach)
{
    frustum(x, y, z, r, x + reach * cos(a), y + reach * sin(a),
            z + reach * random(0.5, 1.0), 0, name, "twig")
}
