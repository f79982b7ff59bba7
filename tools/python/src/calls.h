/*
 * calls.h - what the module's files offer to module.cc
 *
 * All arguments named like arrays are arrays of NumPy that the Python code has
 * checked and broadcast.  Shapes are arrays of raw cylint_shape.
 */
#ifndef CYLINT_PYTHON_CALLS_H
#define CYLINT_PYTHON_CALLS_H

#include <nanobind/nanobind.h>

#include <limits>

#include "array.h"
#include "cylint_scene.h"

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

inline const cylint_shape *as_shape(const char *p)
{
    return reinterpret_cast<const cylint_shape *>(p);
}

/* The shape whose number is at p, or nullptr for a number below 0. */
inline const cylint_shape *numbered(const Array &shapes, const char *p)
{
    int64_t index;
    std::memcpy(&index, p, sizeof index);
    return index < 0 ? nullptr
                     : as_shape(shapes.data() + index * shapes.stride(0));
}

/* Arrays of lines: origins and directions (..., 3), tmin and tmax (...).
 * are_segments: the directions are end points, b, and the lines are exact.
 * mask: refused lines are accepted; they hit nothing. */
class Lines
{
  public:
    Lines(nb::handle o, nb::handle d, nb::handle tmin, nb::handle tmax,
          bool are_segments, bool mask)
        : origins(o), directions(d), starts(tmin), ends(tmax),
          segments(are_segments), masked(mask)
    {
    }
    const Array origins, directions, starts, ends;
    const bool segments, masked;

    /* Adds the four arrays; returns the number of the first. */
    int add_to(Grid &grid) const;

    /* The strides of coordinates. */
    ptrdiff_t o_step() const
    {
        return origins.last_stride();
    }
    ptrdiff_t d_step() const
    {
        return directions.last_stride();
    }

    /* Makes a line of the elements of the four arrays.  Returns the status of
     * its constructor. */
    int make(const char *const *at, cylint_line *line) const;
};

/* shapes.cc */
nb::tuple make_tube(nb::handle numbers, bool is_sector, nb::handle shapes,
                    nb::handle clauses);
int make_shapes(const char *name, nb::handle numbers, nb::handle ends,
                nb::handle shapes, nb::handle statuses);
void read_shapes(nb::handle shapes, nb::handle kinds, nb::handle numbers);
/* What a shape was made of: its word in text, and its numbers.  The last number
 * of a cone with an angle is the tangent. */
struct Arguments {
    const char *word;
    int count;
    double number[13];
};
Arguments arguments_of(const cylint_shape &shape);
nb::tuple constructors();
nb::dict shape_members();
void bounds(nb::handle shapes, nb::handle boxes);

/* intersect.cc */
bool intersect(nb::handle shapes, const Lines &lines, nb::tuple columns,
               int threads, nb::handle progress);
void describe(nb::handle shapes, nb::handle index, const Lines &lines,
              bool nearest, nb::tuple columns, int threads,
              nb::handle progress);
nb::tuple first_bad_line(const Lines &lines);

/* points.cc */
void contains(nb::handle shapes, nb::handle points, nb::handle answers,
              int threads, nb::handle progress);
void safety(nb::handle shapes, nb::handle points, nb::handle answers,
            int threads, nb::handle progress);
void on_surface(nb::handle shapes, nb::handle points, nb::handle ulps,
                nb::handle answers, int threads, nb::handle progress);
void closest(nb::handle shapes, nb::handle index, nb::handle points,
             nb::tuple columns, int threads, nb::handle progress);

/* scene.cc, reader.cc, writer.cc */
void register_scene(nb::module_ &module);
nb::tuple read_scene(const char *file, int ends, bool round);
nb::bytes write_scene(nb::handle shapes, size_t first, nb::handle labels);

/* Labels, one behind the other, as texts. */
nb::object label_texts(const uint64_t *end, const char *text, size_t count);

/* Takes a scene that was begun; None for NULL. */
nb::object scene_object(cylint_scene *begun);

#endif
