/*
 * shapes.cc - constructors, their inverse, boxes
 */
#include "calls.h"

namespace
{

/* The rows of an array of doubles (n, k), contiguous. */
template <class Array> auto row(const Array &array, size_t i)
{
    using Number = std::remove_pointer_t<decltype(array.data())>;
    using Double =
        std::conditional_t<std::is_const_v<Number>, const double, double>;
    return static_cast<Double *>(array.data()) + i * array.shape(1);
}

/* The member `kind` of writable shapes (n). */
cylint_shape *shape_at(const Output &shapes, size_t i)
{
    return static_cast<cylint_shape *>(shapes.data()) + i;
}

/* constructor: a row of the table in _shapes.py.  numbers (n, k) and ends (n),
 * contiguous; writes statuses (n), and returns how many are not CYLINT_OK. */
int make_shapes(int constructor, Input numbers, Input ends, Output shapes,
                Output statuses)
{
    const auto *const words = static_cast<const signed char *>(ends.data());
    auto *const status = static_cast<signed char *>(statuses.data());
    const int acone = NUMBER_OF_KIND(CYLINT_KIND_ACONE);
    const cylint_kind kind = KIND_OF_NUMBER(
        constructor < CYLINT_KIND_HALFSPACE ? constructor : acone);
    int refused = 0;
    const Unlocked unlocked;
    for (size_t i = 0; i < numbers.shape(0); i++) {
        cylint_shape *const s = shape_at(shapes, i);
        const double *const x = row(numbers, i);
        std::memset(static_cast<void *>(s), 0, sizeof *s);
        status[i] = static_cast<signed char>(
            constructor == acone
                ? cylint_tangent_cone(s, x, x + 3, x[6],
                                      static_cast<cylint_ends>(words[i]))
                : shape_of_numbers(kind, words[i], x, s));
        refused += status[i] != CYLINT_OK;
    }
    return refused;
}

/* numbers (16): p0, p1, outer, inner, sector; shapes and clauses (4).  Returns how
 * many members the tube has, and "" or what is wrong. */
nb::tuple make_tube(Input numbers, bool is_sector, Output shapes,
                    Output clauses)
{
    const auto *const from = static_cast<const double *>(numbers.data());
    double sector[2][3];
    size_t n = 0;
    std::memcpy(sector, from + 10, sizeof sector);
    std::memset(shapes.data(), 0, CYLINT_TUBE_MEMBERS * sizeof(cylint_shape));
    const int status = cylint_tube(
        from, from + 3, from + 6, from + 8, is_sector ? sector : nullptr,
        shape_at(shapes, 0), static_cast<int *>(clauses.data()), &n);
    const char *wrong = status == CYLINT_OK ? "" : cylint_strerror(status);
    if (status == CYLINT_EDIRECTION)
        wrong =
            "a direction of the sector is parallel to the axis, or both are "
            "in one half plane from it";
    return nb::make_tuple(n, wrong);
}

/* Calls function(i, shape) for each of shapes (n). */
template <class Function>
void each_shape(const Input &shapes, const Function &function)
{
    const Unlocked unlocked;
    for (size_t i = 0; i < shapes.shape(0); i++)
        function(i, shape_of(shapes, i));
}

/* The inverse of make_shapes: shapes (n) to kinds (n) and numbers (n, 13). */
void read_shapes(Input shapes, Output kinds, Output numbers)
{
    auto *const kind = static_cast<signed char *>(kinds.data());
    each_shape(shapes, [&](size_t i, const cylint_shape *s) {
        kind[i] = static_cast<signed char>(
            NUMBER_OF_KIND(cylint_arguments(s, row(numbers, i))));
    });
}

/* shapes (n), boxes (n, 6) */
void bounds(Input shapes, Output boxes)
{
    each_shape(shapes, [&](size_t i, const cylint_shape *s) {
        cylint_bounds(s, row(boxes, i), row(boxes, i) + 3);
    });
}

} // namespace

void register_shapes(nb::module_ &module)
{
    module.attr("shape_size") = sizeof(cylint_shape);
    module.attr("shape_ends") = offsetof(cylint_shape, ends);
    module.def("make_shapes", &make_shapes);
    module.def("make_tube", &make_tube);
    module.def("read_shapes", &read_shapes);
    module.def("bounds", &bounds);
}
