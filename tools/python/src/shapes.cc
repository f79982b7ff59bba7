/*
 * shapes.cc - constructors, their inverse, boxes
 */
#include <cstddef>
#include <cstring>

#include "calls.h"
#include "shapes/layout.h"

namespace
{

using Shape = cylint_shape;
using Ends = cylint_ends;
using Numbers = const double *;

double *put(double *to, const double *from)
{
    std::memcpy(to, from, 3 * sizeof *to);
    return to + 3;
}

/* The ball about p1 has its base there. */
void read_round_cone(const Shape &s, double *x)
{
    const bool turned =
        s.kind == CYLINT_KIND_SPHERE && cylint_surface(&s) == CYLINT_PART_CAP1;
    *put(x, turned ? cylint_top(&s) : cylint_base(&s)) =
        turned ? cylint_r1(&s) : cylint_r0(&s);
    *put(x + 4, turned ? cylint_base(&s) : cylint_top(&s)) =
        turned ? cylint_r0(&s) : cylint_r1(&s);
}

/* The kind of shape that the constructor made: a round cone can be a ball. */
int made_as(const Shape &s)
{
    return s.kind == CYLINT_KIND_SPHERE &&
                   cylint_surface(&s) != CYLINT_PART_LATERAL
               ? CYLINT_KIND_RCONE
               : s.kind;
}

/*
 * A row for each constructor: its name; its arguments, each with its width; the
 * word and the kind of its shapes; shape from numbers; numbers from shape.  A
 * shape of a kind is read by the first row of that kind.
 */
struct Constructor {
    const char *name, *arguments, *word;
    int kind;
    int (*make)(Shape *s, Numbers x, Ends e);
    void (*read)(const Shape &s, double *x);
};

#define MAKE(call) [](Shape *s, Numbers x, Ends e) -> int { return call; }
#define READ(...) [](const Shape &s, double *x) { __VA_ARGS__; }

const Constructor table[] = {
    {"cylinder", "p0:3 p1:3 r:1", "cylinder", CYLINT_KIND_CYLINDER,
     MAKE(cylint_cylinder(s, x, x + 3, x[6], e)),
     READ(*put(put(x, cylint_base(&s)), cylint_top(&s)) = cylint_r0(&s))},
    {"cone", "p0:3 r0:1 p1:3 r1:1", "cone", CYLINT_KIND_CONE,
     MAKE(cylint_cone(s, x, x[3], x + 4, x[7], e)),
     READ(*put(x, cylint_base(&s)) = cylint_r0(&s),
          *put(x + 4, cylint_top(&s)) = cylint_r1(&s))},
    {"elliptic_cylinder", "c:3 a:3 b:3 h:3", "ecylinder", CYLINT_KIND_ECYLINDER,
     MAKE(cylint_elliptic_cylinder(s, x, x + 3, x + 6, x + 9, e)),
     READ(put(put(put(put(x, cylint_base(&s)), cylint_a(&s)), cylint_b(&s)),
              cylint_axis(&s)))},
    {"elliptic_cone", "c:3 a:3 b:3 h:3 k:1", "econe", CYLINT_KIND_ECONE,
     MAKE(cylint_elliptic_cone(s, x, x + 3, x + 6, x + 9, x[12], e)),
     READ(*put(put(put(put(x, cylint_base(&s)), cylint_a(&s)), cylint_b(&s)),
               cylint_axis(&s)) = cylint_r1(&s))},
    {"sphere", "c:3 r:1", "sphere", CYLINT_KIND_SPHERE,
     MAKE(cylint_sphere(s, x, x[3], e)),
     READ(*put(x, cylint_base(&s)) = cylint_r0(&s))},
    {"capsule", "p0:3 p1:3 r:1", "capsule", CYLINT_KIND_CAPSULE,
     MAKE(cylint_capsule(s, x, x + 3, x[6], e)),
     READ(*put(put(x, cylint_base(&s)), cylint_top(&s)) = cylint_r0(&s))},
    {"round_cone", "p0:3 r0:1 p1:3 r1:1", "rcone", CYLINT_KIND_RCONE,
     MAKE(cylint_round_cone(s, x, x[3], x + 4, x[7], e)), read_round_cone},
    {"tangent_cone", "v:3 u:3 tangent:1", "acone", CYLINT_KIND_ACONE,
     MAKE(cylint_tangent_cone(s, x, x + 3, x[6], e)),
     READ(*put(put(x, cylint_base(&s)), cylint_axis(&s)) = cylint_r1(&s))},
    {"halfspace", "p:3 n:3", "halfspace", CYLINT_KIND_HALFSPACE,
     [](Shape *s, Numbers x, Ends) -> int {
         return cylint_halfspace(s, x, x + 3);
     },
     READ(put(put(x, cylint_base(&s)), cylint_axis(&s)))},
    {"angle_cone", "v:3 u:3 degrees:1", "acone", CYLINT_KIND_ACONE,
     MAKE(cylint_angle_cone(s, x, x + 3, x[6], e)), nullptr},
};
#undef MAKE
#undef READ

const Constructor &find(const char *name)
{
    for (const Constructor &c : table) {
        if (std::strcmp(c.name, name) == 0)
            return c;
    }
    throw nb::value_error("no such constructor");
}

/* The row of the constructor that made the shape. */
const Constructor &constructor_of(const Shape &shape)
{
    const Constructor *c = table;
    while (c->kind != made_as(shape))
        c++;
    return *c;
}

int numbers_of(const Constructor &c)
{
    int count = 0;
    for (const char *p = c.arguments; (p = std::strchr(p, ':')); p++)
        count += p[1] - '0';
    return count;
}

} // namespace

Arguments arguments_of(const cylint_shape &shape)
{
    const Constructor &c = constructor_of(shape);
    Arguments arguments{c.word, numbers_of(c), {}};
    c.read(shape, arguments.number);
    return arguments;
}

nb::tuple constructors()
{
    nb::list list;
    for (const Constructor &c : table)
        list.append(nb::make_tuple(c.name, c.arguments));
    return nb::tuple(list);
}

/* The members that Python reads: names and offsets. */
nb::dict shape_members()
{
    nb::dict members;
    members["kind"] = offsetof(cylint_shape, kind);
    members["ends"] = offsetof(cylint_shape, ends);
    members["size"] = sizeof(cylint_shape);
    return members;
}

/* numbers (n, k) and ends (n), contiguous; writes statuses (n), and returns how
 * many are not CYLINT_OK. */
int make_shapes(const char *name, nb::handle numbers, nb::handle ends,
                nb::handle shapes, nb::handle statuses)
{
    const Constructor &c = find(name);
    const Array x(numbers), e(ends), s(shapes, true), status(statuses, true);
    int refused = 0;
    nb::gil_scoped_release released;
    for (ptrdiff_t i = 0; i < x.size(0); i++) {
        const auto row =
            reinterpret_cast<const double *>(x.data() + i * x.stride(0));
        const auto shape =
            reinterpret_cast<cylint_shape *>(s.data() + i * s.stride(0));
        const signed char word =
            *reinterpret_cast<signed char *>(e.data() + i * e.stride(0));
        std::memset(static_cast<void *>(shape), 0, sizeof *shape);
        const int answer = c.make(shape, row, static_cast<Ends>(word));
        status.data()[i * status.stride(0)] = static_cast<char>(answer);
        refused += answer != CYLINT_OK;
    }
    return refused;
}

/* numbers (16): p0, p1, outer, inner, sector; shapes and clauses (4).  Returns the
 * status and how many members the tube has. */
nb::tuple make_tube(nb::handle numbers, bool is_sector, nb::handle shapes,
                    nb::handle clauses)
{
    const Array x(numbers), s(shapes, true), c(clauses, true);
    const auto from = reinterpret_cast<const double *>(x.data());
    const double sector[2][3] = {{from[10], from[11], from[12]},
                                 {from[13], from[14], from[15]}};
    size_t n = 0;
    std::memset(s.data(), 0, CYLINT_TUBE_MEMBERS * sizeof(cylint_shape));
    const int status =
        cylint_tube(from, from + 3, from + 6, from + 8,
                    is_sector ? sector : nullptr,
                    reinterpret_cast<cylint_shape *>(s.data()),
                    reinterpret_cast<int *>(c.data()), &n);
    return nb::make_tuple(status, n);
}

/* The inverse of make_shapes: shapes (n) to kinds, as rows of the table, and numbers (n, k). */
void read_shapes(nb::handle shapes, nb::handle kinds, nb::handle numbers)
{
    const Array s(shapes), k(kinds, true), x(numbers, true);
    nb::gil_scoped_release released;
    for (ptrdiff_t i = 0; i < s.size(0); i++) {
        const cylint_shape &shape = *as_shape(s.data() + i * s.stride(0));
        const Constructor &c = constructor_of(shape);
        k.data()[i * k.stride(0)] = static_cast<char>(&c - table);
        c.read(shape, reinterpret_cast<double *>(x.data() + i * x.stride(0)));
    }
}

/* shapes (n), boxes (n, 2, 3) contiguous */
void bounds(nb::handle shapes, nb::handle boxes)
{
    const Array s(shapes), b(boxes, true);
    nb::gil_scoped_release released;
    for (ptrdiff_t i = 0; i < s.size(0); i++) {
        const auto box = reinterpret_cast<double *>(b.data()) + 6 * i;
        cylint_bounds(as_shape(s.data() + i * s.stride(0)), box, box + 3);
    }
}
