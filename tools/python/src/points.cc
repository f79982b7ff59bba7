/*
 * points.cc - points and shapes, element by element, in batches
 *
 * If the shape does not change in a block, the batch is that of points and one
 * shape; if the shapes lie one behind the other, that of pairs; else there is a
 * batch for each pair.
 */
#include <type_traits>

#include "calls.h"
#include "cylint_distance.h"
#include "elements.h"

namespace
{

/* Points of a block: the columns of distances fit the first cache. */
constexpr size_t BLOCK = 512;

/* The shapes that are numbered, if they are, and the points. */
struct Source {
    const Array *numbered_shapes;
    const Array &points;
};

/* A shape that was refused: it has no distance. */
const cylint_shape none = {};

/* The points of a block of the grid, and their shapes.  `shapes` and `points`
 * are the numbers of the arrays in the grid, `shapes` that of the shapes or of
 * their numbers. */
class PointBlock
{
  protected:
    PointBlock(const Grid &grid, int shapes, int points, const Source &s)
        : row(grid), shapes_at(shapes), points_at(points), source(s)
    {
    }

    void locate(size_t number, size_t begin, size_t count)
    {
        row.locate(number, begin, count);
        for (int axis = 0; axis < 3; axis++)
            row.read(xyz[axis], points_at, axis * source.points.last_stride());
    }

    /* Calls points(shape, points, 0), or pairs(shapes, points, first) as often as
     * it takes; once for each element if `singly`. */
    template <class OneShape, class Pairs>
    void ask(bool singly, const OneShape &points, const Pairs &pairs) const
    {
        const ptrdiff_t stride = row.stride(shapes_at);
        singly = singly || source.numbered_shapes;
        if (!singly && stride == 0)
            points(shape(0), points_from(0, row.size()), 0);
        else if (!singly && stride == sizeof(cylint_shape))
            pairs(shape(0), points_from(0, row.size()), 0);
        else
            for (size_t i = 0; i < row.size(); i++)
                pairs(shape(i), points_from(i, 1), i);
    }

    RowPart row;

  private:
    const cylint_shape *shape(size_t i) const
    {
        const char *const p = row.at(shapes_at, i);
        if (!source.numbered_shapes)
            return as_shape(p);
        const cylint_shape *found = numbered(*source.numbered_shapes, p);
        return found ? found : &none;
    }

    cylint_points points_from(size_t i, size_t n) const
    {
        return {n, {xyz[0] + i, xyz[1] + i, xyz[2] + i}};
    }

    const int shapes_at, points_at;
    const Source source;
    double xyz[3][BLOCK];
};

/* ------------------------------------ one number for each point and shape -- */

/* The places of the arrays in the grid; numbers: doubles, or None. */
struct NumberPlaces {
    int shapes, points, numbers, answers;
};

/* points, pairs: batches of the library; they take one of the numbers if there
 * are numbers. */
template <class Answer, auto points, auto pairs> class NumberBlock : PointBlock
{
  public:
    NumberBlock(const Grid &grid, const NumberPlaces &p, const Source &s)
        : PointBlock(grid, p.shapes, p.points, s), place(p)
    {
    }

    bool run(size_t row_number, size_t begin, size_t count)
    {
        locate(row_number, begin, count);
        const auto to = [this](auto batch) {
            return [this, batch](const cylint_shape *s, const cylint_points &p,
                                 size_t i) {
                if constexpr (std::is_invocable_v<decltype(batch), decltype(s),
                                                  decltype(&p), Answer *>)
                    batch(s, &p, answers + i);
                else
                    batch(s, &p, number(row.at(place.numbers, i)), answers + i);
            };
        };
        ask(row.stride(place.numbers) != 0, to(points), to(pairs));
        row.write(answers, place.answers, 0);
        return true;
    }

  private:
    const NumberPlaces place;
    Answer answers[BLOCK];
};

/* Writes an answer for each element.  numbers: None, or an array of doubles. */
template <class Answer, auto points, auto pairs>
void each_pair(nb::handle shapes, nb::handle places, nb::handle numbers,
               nb::handle answers, int threads, nb::handle progress)
{
    const Array s(shapes), p(places), x(numbers), a(answers, true);
    Grid grid(a, 0);
    NumberPlaces place{};
    place.shapes = grid.add(s);
    place.points = grid.add(p);
    place.numbers = grid.add(x);
    place.answers = grid.add(a);
    grid.prepare();
    const Source source = {nullptr, p};
    each_block<NumberBlock<Answer, points, pairs>>(grid, BLOCK, threads,
                                                   progress, place, source);
}

/* ----------------------------------------------------------- distances -- */

/* The places of the arrays in the grid; of the shapes or of their numbers. */
struct Places {
    int shapes, points, distance, part, feature, point, normal;
};

/* What a worker keeps from block to block. */
class DistanceBlock : PointBlock
{
  public:
    DistanceBlock(const Grid &grid, const Places &p, const Source &s)
        : PointBlock(grid, p.shapes, p.points, s), place(p)
    {
    }

    bool run(size_t number, size_t begin, size_t count)
    {
        locate(number, begin, count);
        const auto to = [this](auto batch) {
            return [this, batch](const cylint_shape *s, const cylint_points &p,
                                 size_t i) {
                const cylint_closest_columns columns = columns_from(i);
                batch(s, &p, &columns);
            };
        };
        ask(false, to(cylint_distance_points), to(cylint_distance_pairs));
        write();
        return true;
    }

  private:
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

    const Places place;
    double distance[BLOCK], point[3][BLOCK], normal[3][BLOCK];
    signed char part[BLOCK], feature[BLOCK];
};

} // namespace

void contains(nb::handle shapes, nb::handle points, nb::handle answers,
              int threads, nb::handle progress)
{
    each_pair<signed char, cylint_contains_points, cylint_contains_pairs>(
        shapes, points, nb::none(), answers, threads, progress);
}

void safety(nb::handle shapes, nb::handle points, nb::handle answers,
            int threads, nb::handle progress)
{
    each_pair<double, cylint_safety_points, cylint_safety_pairs>(
        shapes, points, nb::none(), answers, threads, progress);
}

/* A bool of NumPy is a byte, 0 or 1. */
void on_surface(nb::handle shapes, nb::handle points, nb::handle ulps,
                nb::handle answers, int threads, nb::handle progress)
{
    each_pair<signed char, cylint_on_surface_points, cylint_on_surface_pairs>(
        shapes, points, ulps, answers, threads, progress);
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
    each_block<DistanceBlock>(grid, BLOCK, threads, progress, place, source);
}
