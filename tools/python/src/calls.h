/*
 * calls.h - what the module's files share
 *
 * The Python code has checked all arrays; they broadcast.  Arrays named shapes are
 * the member `kind` of arrays of cylint_shape.  columns: arrays for the answers.
 */
#ifndef CYLINT_PYTHON_CALLS_H
#define CYLINT_PYTHON_CALLS_H

#include <cstddef>
#include <limits>
#include <new>
#include <string>

#include "elements.h"

extern "C" {
#include "scene.h"
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

static_assert(offsetof(cylint_shape, kind) == 0,
              "an array of `kind` has shapes");

inline const cylint_shape *as_shape(const void *p)
{
    return static_cast<const cylint_shape *>(p);
}

/* The members of a hit that there is not. */
inline const cylint_hit no_hit = {not_a_number,
                                  {not_a_number, not_a_number, not_a_number},
                                  {not_a_number, not_a_number, not_a_number},
                                  not_a_number,
                                  not_a_number,
                                  -1,
                                  -1};

/* Element i of shapes (n). */
inline const cylint_shape *shape_of(const Input &shapes, size_t i)
{
    return as_shape(static_cast<const char *>(shapes.data()) +
                    static_cast<ptrdiff_t>(i) * last_step(shapes));
}

/* A shape that was refused: it has no hits and no distance. */
inline const cylint_shape no_shape = {};

/* The shapes that an index numbers; nullptr if there is none. */
inline const cylint_shape *numbered_shapes(const Input &shapes,
                                           const std::optional<Input> &index)
{
    return !index               ? nullptr
           : shapes.size() == 0 ? &no_shape
                                : as_shape(shapes.data());
}

/* The shape of element i.  The array of the part has the shapes or, if `numbered`
 * is not nullptr, their numbers there; -1 is no shape. */
inline const cylint_shape *shape_at(const Part &part, int array, size_t i,
                                    const cylint_shape *numbered)
{
    if (!numbered)
        return as_shape(part.at(array, i));
    const auto number = part.value<int64_t>(array, i);
    return number < 0 ? &no_shape : numbered + number;
}

/* A line, and the number of the shape that it leaves out, below 0 for none. */
struct Ray {
    cylint_line line;
    int64_t left_out;
};

/*
 * Arrays of lines: origins and directions (..., 3), tmin and tmax (...), and the
 * numbers of shapes that lines leave out (...), int64.
 * segments: the directions are end points, b, and the lines are exact.
 * masked: refused lines are accepted; they hit nothing.
 */
struct Lines {
    enum { ORIGINS, DIRECTIONS, STARTS, ENDS, LEFT_OUT, ARRAYS };
    using Element = Ray;
    /* Adds the arrays, which get these numbers, to an empty grid. */
    void add_to(Grid &grid) const;
    /* Makes line i of a part.  Returns the status of its constructor. */
    int make(const Part &part, size_t i, Ray *ray) const;

    const Input origins, directions, starts, ends, left_out;
    const bool segments, masked;
};

/* A scene with the memory that it needs. */
struct Scene {
    /* Takes a scene that was begun or opened; nullptr: there was no memory. */
    explicit Scene(cylint_scene *taken)
    {
        if (!taken)
            throw std::bad_alloc();
        data.shapes = taken;
    }
    /* Begins a scene.  expected: the number of shapes, if it is known; else 0. */
    explicit Scene(size_t expected) : Scene(cylint_scene_begin(expected))
    {
    }
    Scene(const Scene &) = delete;
    Scene &operator=(const Scene &) = delete;
    ~Scene()
    {
        scene_free(&data);
    }
    cylint_scene *get() const
    {
        return data.shapes;
    }
    size_t size() const
    {
        return cylint_scene_size(get());
    }

    /* Queries, save() and to_bytes() hold a reference while they run without
     * Python's lock; set_solids() then refuses. */
    std::shared_ptr<char> use = std::make_shared<char>();
    nb::object memory; /* of the scene, if it was opened there */
    /* Labels and solids are those of a scene that is not opened; finish() gives
     * them to the shapes. */
    struct scene data = {};
};

/* Each adds what its file offers to Python: shapes.cc, intersect.cc and so on. */
void register_shapes(nb::module_ &module);
void register_intersect(nb::module_ &module);
void register_points(nb::module_ &module);
void register_scene(nb::module_ &module);
void register_queries(nb::module_ &module, nb::class_<Scene> &scene);
void register_text(nb::module_ &module);

/* A text in UTF-8; other bytes become surrogates. */
nb::object decoded(struct string text);

#endif
