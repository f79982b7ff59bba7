# autumn.awk - plants a forest in autumn: a scene for cylint-render
#
#   LC_ALL=C awk -v trees=48 -f autumn.awk > forest.scene
#
# A broadleaf tree has forking branches of frusta, and leaves of thin elliptic
# cylinders.  A spruce has a stem, whorls of drooping branches and twigs, all
# frusta and cones.  Fallen leaves and grass cover the ground.  Each shape has
# its colour.  z is up, units are metres.  Each tree has about 4000 shapes and
# 14 square metres of ground; the forest is twice as wide as deep.
#
# Random numbers: x -> 16807 x mod 2^31 - 1 [Park & Miller 1988].  A fork keeps
# the sum of the cross sections (Leonardo's rule).

BEGIN {
    state = 2026
    pi = atan2(0, -1)
    width = sqrt(2 * 14 * trees)
    depth = width / 2
    print "# an autumn forest of " trees " trees, by tools/render/autumn.awk"
    for (n = 1; n <= trees; n++)
        plant(n)
    litter(220 * trees)
    grass(260 * trees)
}

function random(low, high)
{
    state = state * 16807 % 2147483647
    return low + (high - low) * state / 2147483647
}

# ------------------------------------------------------------------ shapes --

# A colour from red, green and blue up to 255, varied a little.
function colour(red, green, blue, spread,   f)
{
    f = random(1 - spread, 1 + spread)
    return sprintf("#%02x%02x%02x", byte(red * f),
                   byte(green * f * random(1 - spread / 3, 1 + spread / 3)),
                   byte(blue * f))
}

function byte(x)
{
    return x < 0 ? 0 : x > 255 ? 255 : int(x)
}

function frustum(x0, y0, z0, r0, x1, y1, z1, r1, tint)
{
    printf "cone %.3f %.3f %.3f %.4f  %.3f %.3f %.3f %.4f  %s\n",
           x0, y0, z0, r0, x1, y1, z1, r1, tint
}

# A very thin ellipse with the semi-axes size and 0.6 size, in the plane of the
# unit vectors p and q, which are perpendicular to n.
function leaf(x, y, z, size, nx, ny, nz, tint,   k, turn, c, s, a, b)
{
    k = sqrt(nx * nx + ny * ny + nz * nz)
    nx /= k; ny /= k; nz /= k
    # p is level, q = n x p
    k = sqrt(nx * nx + ny * ny) + 1e-9
    px = -ny / k; py = nx / k + (k < 1e-6); pz = 0
    qx = ny * pz - nz * py; qy = nz * px - nx * pz; qz = nx * py - ny * px
    turn = random(0, 2 * pi)
    c = cos(turn); s = sin(turn)
    a = size; b = 0.6 * size
    printf "ecylinder %.3f %.3f %.3f  %.4f %.4f %.4f  %.4f %.4f %.4f  " \
           "%.4f %.4f %.4f  %s\n", x, y, z,
           a * (c * px + s * qx), a * (c * py + s * qy), a * (c * pz + s * qz),
           b * (c * qx - s * px), b * (c * qy - s * py), b * (c * qz - s * pz),
           0.012 * nx, 0.012 * ny, 0.012 * nz, tint
}

# ------------------------------------------------------------------- trees --

# Tries up to 200 places for one at least 2.2 m from the last 400 trees.
function plant(n,   x, y, i, crowded, tries)
{
    do {
        x = random(-0.5, 0.5) * width
        y = random(-0.5, 0.5) * depth
        crowded = 0
        for (i = n - 1; i >= 1 && i > n - 400; i--)
            if ((x - tree_x[i]) ^ 2 + (y - tree_y[i]) ^ 2 < 5)
                crowded = 1
    } while (crowded && ++tries < 200)
    tree_x[n] = x
    tree_y[n] = y
    if (random(0, 1) < 0.36)
        spruce(x, y, random(7, 15))
    else
        broadleaf(x, y, random(6, 12.5))
}

function broadleaf(x, y, height,   kind)
{
    kind = int(random(0, 5))
    red = kind == 0 ? 214 : kind == 1 ? 232 : kind == 2 ? 196 : \
          kind == 3 ? 226 : 150
    green = kind == 0 ? 92 : kind == 1 ? 170 : kind == 2 ? 60 : \
            kind == 3 ? 134 : 160
    blue = kind == 0 ? 34 : kind == 1 ? 48 : kind == 2 ? 40 : \
           kind == 3 ? 36 : 62
    bark = colour(132, 112, 92, 0.15)
    branch(x, y, -0.1, random(-0.06, 0.06), random(-0.06, 0.06), 1,
           0.016 * height, 0.30 * height, 0)
}

# A branch from x, y, z along d.  It bends towards the light, then forks.
function branch(x, y, z, dx, dy, dz, r, len, level,
                i, k, x1, y1, z1, r1, forks, ex, ey, ez, turn, open)
{
    for (i = 1; i <= 3; i++) {
        dx += random(-0.16, 0.16)
        dy += random(-0.16, 0.16)
        dz += random(-0.10, 0.14) + 0.05 * (level > 0)
        k = sqrt(dx * dx + dy * dy + dz * dz)
        dx /= k; dy /= k; dz /= k
        x1 = x + dx * len / 3; y1 = y + dy * len / 3; z1 = z + dz * len / 3
        r1 = r * 0.93
        frustum(x, y, z, r, x1, y1, z1, r1, bark)
        if (level >= 3)
            foliage(x1, y1, z1, level)
        x = x1; y = y1; z = z1; r = r1
    }
    if (level == 5)
        return
    forks = level == 0 ? 4 : random(0, 1) < 0.35 ? 3 : 2
    turn = random(0, 2 * pi)
    for (i = 0; i < forks; i++) {
        open = random(0.45, 0.85)
        # perpendicular to d, evenly around it
        turn += 2 * pi / forks + random(-0.3, 0.3)
        aside(dx, dy, dz, turn)
        branch(x, y, z, dx + open * side_x, dy + open * side_y,
               dz + open * side_z, r / sqrt(forks) * 1.06,
               len * random(0.68, 0.84), level + 1)
    }
}

# A unit vector perpendicular to d, at the angle `turn` about it.
function aside(dx, dy, dz, turn,   k, px, py, pz, qx, qy, qz)
{
    k = sqrt(dx * dx + dz * dz) + 1e-9
    px = dz / k; py = 0; pz = -dx / k
    qx = dy * pz - dz * py; qy = dz * px - dx * pz; qz = dx * py - dy * px
    side_x = cos(turn) * px + sin(turn) * qx
    side_y = cos(turn) * py + sin(turn) * qy
    side_z = cos(turn) * pz + sin(turn) * qz
}

function foliage(x, y, z, level,   i)
{
    for (i = 0; i < (level == 3 ? 4 : 7); i++)
        leaf(x + random(-0.3, 0.3), y + random(-0.3, 0.3),
             z + random(-0.25, 0.25), random(0.07, 0.13),
             random(-1, 1), random(-1, 1), random(0.2, 1.6),
             colour(red, green, blue, 0.22))
}

function spruce(x, y, height,   z, r, reach, i, count, turn, a)
{
    bark = colour(108, 88, 70, 0.12)
    r = 0.012 * height
    frustum(x, y, -0.1, r, x, y, height, 0.004, bark)
    for (z = 0.10 * height; z < 0.985 * height; z += random(0.22, 0.32)) {
        reach = 0.21 * height * (1 - z / height) ^ 0.85 + 0.08
        count = 7
        turn = random(0, 2 * pi)
        for (i = 0; i < count; i++) {
            a = turn + (i + random(-0.3, 0.3)) * 2 * pi / count
            spray(x, y, z, a, reach * random(0.8, 1.08))
        }
    }
}

# A drooping branch with twigs on both sides, shorter towards its tip.
function spray(x, y, z, a, reach,
               steps, i, t, s, x1, y1, z1, tint, heading, twig)
{
    steps = int(reach / 0.16) + 2
    frustum(x, y, z, 0.012 + 0.006 * reach, x + reach * cos(a),
            y + reach * sin(a), z - 0.22 * reach, 0.004, bark)
    for (i = 1; i <= steps; i++) {
        t = i / steps
        x1 = x + t * reach * cos(a)
        y1 = y + t * reach * sin(a)
        z1 = z - 0.22 * reach * t
        twig = 0.10 + 0.36 * reach * (1.05 - t)
        for (s = -1; s <= 1; s += 2) {
            heading = a + s * random(0.6, 0.95)
            tint = colour(58, 92, 58, 0.25)
            frustum(x1, y1, z1, 0.045, x1 + twig * cos(heading),
                    y1 + twig * sin(heading), z1 - twig * random(0.05, 0.35),
                    0, tint)
        }
    }
}

# -------------------------------------------------------------- the ground --

function litter(count,   i, kind)
{
    for (i = 0; i < count; i++) {
        kind = random(0, 1)
        leaf(random(-0.53, 0.53) * width, random(-0.56, 0.56) * depth,
             random(0.004, 0.03), random(0.06, 0.12), random(-0.3, 0.3),
             random(-0.3, 0.3), 1,
             kind < 0.5 ? colour(186, 104, 48, 0.25) \
                        : colour(214, 160, 70, 0.2))
    }
}

function grass(count,   i, x, y, k, h)
{
    for (i = 0; i < count; i += 5) {
        x = random(-0.54, 0.54) * width
        y = random(-0.58, 0.58) * depth
        for (k = 0; k < 5; k++) {
            h = random(0.12, 0.4)
            frustum(x, y, 0, 0.012, x + random(-0.5, 0.5) * h,
                    y + random(-0.5, 0.5) * h, h, 0,
                    colour(140, 150, 74, 0.25))
        }
    }
}
