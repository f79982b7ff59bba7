/*
 * calls.h - what the module's files offer to module.cc
 *
 * All arguments named like arrays are arrays of NumPy that the Python code has
 * checked and broadcast.  Shapes are arrays of raw cylint_shape.
 */
#ifndef CYLINT_PYTHON_CALLS_H
#define CYLINT_PYTHON_CALLS_H

#include <nanobind/nanobind.h>

#include "array.h"
#include "cylint.h"

/* Arrays of lines: origins and directions (..., 3), tmin and tmax (...). */
class Lines
{
  public:
    Lines(nb::handle o, nb::handle d, nb::handle tmin, nb::handle tmax)
        : origins(o), directions(d), starts(tmin), ends(tmax)
    {
    }
    const Array origins, directions, starts, ends;

    /* Adds the four arrays; returns the number of the first. */
    int add_to(Grid &grid) const;
};

/* Where the numbers of a line stand.  `step` is that of the coordinates. */
struct LineAt {
    const char *o, *d, *tmin, *tmax;
    ptrdiff_t o_step, d_step;
};

/* Returns the status of cylint_span(). */
int make_line(const LineAt &at, cylint_line *line);

/* shapes.cc */
int make_shapes(const char *name, nb::handle numbers, nb::handle ends,
                nb::handle shapes, nb::handle statuses);
void read_shapes(nb::handle shapes, nb::handle kinds, nb::handle numbers);
nb::tuple constructors();
nb::dict shape_members();
void contains(nb::handle shapes, nb::handle points, nb::handle answers,
              int threads, nb::handle progress);
void bounds(nb::handle shapes, nb::handle boxes);

/* intersect.cc */
bool intersect(nb::handle shapes, const Lines &lines, nb::tuple columns,
               int threads, nb::handle progress);
void describe(nb::handle shapes, nb::handle index, const Lines &lines,
              bool nearest, nb::tuple columns, int threads,
              nb::handle progress);
nb::tuple first_bad_line(const Lines &lines);

/* scene.cc, reader.cc */
void register_scene(nb::module_ &module);
nb::tuple read_scene(const char *file, int ends, bool round);

#endif
