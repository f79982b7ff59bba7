/*
 * shapes.cc - constructors, their inverse, boxes
 */
#include "calls.h"

namespace
{

/* Row i of an array (n, k). */
template <class Value> Value *row(const Array<Value> &array, size_t i)
{
    return array.data() + i * array.shape(1);
}

/* The member `kind` of writable shapes (n). */
cylint_shape *shape_at(const Output &shapes, size_t i)
{
    return static_cast<cylint_shape *>(shapes.data()) + i;
}

/* constructor: a row of the table in _shapes.py.  numbers (n, k), ends (n); writes
 * statuses (n), and returns how many are not CYLINT_OK. */
int make_shapes(int constructor, Array<const double> numbers,
                Array<const signed char> ends, Output shapes,
                Array<signed char> statuses)
{
    const int acone = NUMBER_OF_KIND(CYLINT_KIND_ACONE);
    const cylint_kind kind = KIND_OF_NUMBER(
        constructor < CYLINT_KIND_HALFSPACE ? constructor : acone);
    int refused = 0;
    const Unlocked unlocked;
    for (size_t i = 0; i < numbers.shape(0); i++) {
        cylint_shape *const s = shape_at(shapes, i);
        const double *const x = row(numbers, i);
        const signed char word = ends.data()[i];
        std::memset(static_cast<void *>(s), 0, sizeof *s);
        const int status =
            constructor == acone
                ? cylint_tangent_cone(s, x, x + 3, x[6],
                                      static_cast<cylint_ends>(word))
                : shape_of_numbers(kind, word, x, s);
        statuses.data()[i] = static_cast<signed char>(status);
        refused += status != CYLINT_OK;
    }
    return refused;
}

/* numbers (16): p0, p1, outer, inner, sector; shapes and clauses (4).  Returns how
 * many members the tube has, and "" or what is wrong. */
nb::tuple make_tube(Array<const double> numbers, bool is_sector, Output shapes,
                    Array<int> clauses)
{
    const double *const from = numbers.data();
    double sector[2][3];
    size_t n = 0;
    std::memcpy(sector, from + 10, sizeof sector);
    std::memset(shapes.data(), 0, CYLINT_TUBE_MEMBERS * sizeof(cylint_shape));
    const int status = cylint_tube(from, from + 3, from + 6, from + 8,
                                   is_sector ? sector : nullptr,
                                   shape_at(shapes, 0), clauses.data(), &n);
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
void read_shapes(Input shapes, Array<signed char> kinds, Array<double> numbers)
{
    each_shape(shapes, [&](size_t i, const cylint_shape *s) {
        kinds.data()[i] = static_cast<signed char>(
            NUMBER_OF_KIND(cylint_arguments(s, row(numbers, i))));
    });
}

/* shapes (n), boxes (n, 6) */
void bounds(Input shapes, Array<double> boxes)
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
