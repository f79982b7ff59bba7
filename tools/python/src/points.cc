/*
 * points.cc - points and shapes, element by element
 *
 * Distances are computed in batches: if the shape does not change in a block, by
 * cylint_distance_points(); if the shapes lie one behind the other, by
 * cylint_distance_pairs(); else pair by pair.
 */
#include "calls.h"
#include "cylint_distance.h"
#include "elements.h"

namespace
{

/* Points of a block: the columns of distances fit the first cache. */
constexpr size_t BLOCK = 512;

/* Writes function(shape, point, address in numbers) for each element.  numbers:
 * None, or an array of doubles. */
template <class Answer, class Function>
void each_pair(nb::handle shapes, nb::handle points, nb::handle numbers,
               nb::handle answers, int threads, nb::handle progress,
               const Function &function)
{
    const Array s(shapes), p(points), x(numbers), a(answers, true);
    Grid grid(a, 0);
    grid.add(s), grid.add(p), grid.add(x), grid.add(a);
    grid.prepare();
    const ptrdiff_t step = p.last_stride();
    each_element(grid, BLOCK, threads, progress, [&](char *const *at, size_t) {
        double point[3];
        read_point(at[1], step, point);
        const auto answer =
            static_cast<Answer>(function(as_shape(at[0]), point, at[2]));
        std::memcpy(at[3], &answer, sizeof answer);
        return true;
    });
}

/* The places of the arrays in the grid; of the shapes or of their numbers. */
struct Places {
    int shapes, points, distance, part, feature, point, normal;
};

/* The shapes that are numbered, if they are, and the points. */
struct Source {
    const Array *numbered_shapes;
    const Array &points;
};

/* A shape that was refused: it has no distance. */
const cylint_shape none = {};

/* What a worker keeps from block to block. */
class Block
{
  public:
    Block(const Grid &grid, const Places &p, const Source &s)
        : row(grid), place(p), source(s)
    {
    }

    bool run(size_t number, size_t begin, size_t count)
    {
        row.locate(number, begin, count);
        for (int axis = 0; axis < 3; axis++)
            row.read(xyz[axis], place.points,
                     axis * source.points.last_stride());
        const cylint_points points = points_from(0, count);
        const cylint_closest_columns columns = columns_from(0);
        const ptrdiff_t stride = row.stride(place.shapes);
        if (!source.numbered_shapes && stride == 0)
            cylint_distance_points(shape(0), &points, &columns);
        else if (!source.numbered_shapes && stride == sizeof(cylint_shape))
            cylint_distance_pairs(shape(0), &points, &columns);
        else
            run_singly();
        write();
        return true;
    }

  private:
    const cylint_shape *shape(size_t i) const
    {
        const char *const p = row.at(place.shapes, i);
        if (!source.numbered_shapes)
            return as_shape(p);
        const cylint_shape *found = numbered(*source.numbered_shapes, p);
        return found ? found : &none;
    }

    cylint_points points_from(size_t i, size_t n) const
    {
        return {n, {xyz[0] + i, xyz[1] + i, xyz[2] + i}};
    }

    /* The columns that are wanted, from element i. */
    cylint_closest_columns columns_from(size_t i)
    {
        cylint_closest_columns to{};
        to.distance = row.at(place.distance) ? distance + i : nullptr;
        to.part = row.at(place.part) ? part + i : nullptr;
        to.feature = row.at(place.feature) ? feature + i : nullptr;
        for (int axis = 0; axis < 3; axis++) {
            to.point[axis] = row.at(place.point) ? point[axis] + i : nullptr;
            to.normal[axis] = row.at(place.normal) ? normal[axis] + i : nullptr;
        }
        return to;
    }

    void run_singly()
    {
        for (size_t i = 0; i < row.size(); i++) {
            const cylint_points points = points_from(i, 1);
            const cylint_closest_columns columns = columns_from(i);
            cylint_distance_pairs(shape(i), &points, &columns);
        }
    }

    void write() const
    {
        row.write(distance, place.distance, 0);
        row.write(part, place.part, 0);
        row.write(feature, place.feature, 0);
        for (size_t axis = 0; axis < 3; axis++) {
            row.write(point[axis], place.point, axis);
            row.write(normal[axis], place.normal, axis);
        }
    }

    RowPart row;
    const Places place;
    const Source source;
    double xyz[3][BLOCK], distance[BLOCK], point[3][BLOCK], normal[3][BLOCK];
    signed char part[BLOCK], feature[BLOCK];
};

} // namespace

void contains(nb::handle shapes, nb::handle points, nb::handle answers,
              int threads, nb::handle progress)
{
    each_pair<signed char>(shapes, points, nb::none(), answers, threads,
                           progress,
                           [](const cylint_shape *s, const double(&p)[3],
                              const char *) { return cylint_contains(s, p); });
}

void safety(nb::handle shapes, nb::handle points, nb::handle answers,
            int threads, nb::handle progress)
{
    each_pair<double>(shapes, points, nb::none(), answers, threads, progress,
                      [](const cylint_shape *s, const double(&p)[3],
                         const char *) { return cylint_safety(s, p); });
}

void on_surface(nb::handle shapes, nb::handle points, nb::handle ulps,
                nb::handle answers, int threads, nb::handle progress)
{
    each_pair<bool>(
        shapes, points, ulps, answers, threads, progress,
        [](const cylint_shape *s, const double(&p)[3], const char *x) {
            return cylint_on_surface(s, p, number(x)) != 0;
        });
}

/*
 * columns: distance (...), part, feature, point (..., 3), normal; None where it
 * is not wanted.  With `index` the shapes are numbered by it, and -1 stands for
 * a shape that was refused.
 */
void closest(nb::handle shapes, nb::handle index, nb::handle points,
             nb::tuple columns, int threads, nb::handle progress)
{
    const Array s(shapes), number_of(index), p(points),
        distance(columns[0], true), part(columns[1], true),
        feature(columns[2], true), point(columns[3], true),
        normal(columns[4], true);
    Grid grid(p, 1);
    Places place{};
    place.shapes = grid.add(number_of ? number_of : s);
    place.points = grid.add(p);
    place.distance = grid.add(distance);
    place.part = grid.add(part);
    place.feature = grid.add(feature);
    place.point = grid.add(point);
    place.normal = grid.add(normal);
    grid.prepare();
    const Source source = {number_of ? &s : nullptr, p};
    each_block<Block>(grid, BLOCK, threads, progress, place, source);
}
