/*
 * points.cc - points and shapes, element by element, in batches
 *
 * If the shape does not change in a block, the batch is that of points and one
 * shape; if the shapes lie one behind the other, that of pairs; else there is a
 * batch for each pair.
 */
#include "calls.h"
#include "cylint_distance.h"

namespace
{

/* The numbers of the arrays in the grid; SHAPES: of the shapes or their numbers. */
enum { POINTS, SHAPES, COLUMNS };
enum { DISTANCE, PART, FEATURE, POINT, NORMAL };

enum Query { CLOSEST, CONTAINS, SAFETY, ON_SURFACE };

/* What a worker keeps from block to block. */
class Block
{
  public:
    Block(Query q, const Input &of, double most, const cylint_shape *shapes)
        : query(q), step(last_step(of)), ulps(most), numbered(shapes)
    {
    }

    bool operator()(const Part &p)
    {
        part = &p;
        for (int axis = 0; axis < 3; axis++)
            part->read(xyz[axis], POINTS, axis * step);
        const ptrdiff_t stride = part->stride(SHAPES);
        if (!numbered && stride == 0)
            answer(true, 0, part->size);
        else if (!numbered && stride == sizeof(cylint_shape))
            answer(false, 0, part->size);
        else
            for (size_t i = 0; i < part->size; i++)
                answer(true, i, 1);
        write();
        return true;
    }

  private:
    /* Of count elements from element i, which have one shape or one each. */
    void answer(bool one_shape, size_t i, size_t count)
    {
        const cylint_shape *s = shape_at(*part, SHAPES, i, numbered);
        const cylint_points p = {count, {xyz[0] + i, xyz[1] + i, xyz[2] + i}};
        switch (query) {
        case CONTAINS:
            return (one_shape ? cylint_contains_points
                              : cylint_contains_pairs)(s, &p, small[PART] + i);
        case SAFETY:
            return (one_shape ? cylint_safety_points
                              : cylint_safety_pairs)(s, &p, distance + i);
        case ON_SURFACE:
            return (one_shape ? cylint_on_surface_points
                              : cylint_on_surface_pairs)(s, &p, ulps,
                                                         small[PART] + i);
        default:
            const cylint_closest_columns to = columns(i);
            (one_shape ? cylint_distance_points : cylint_distance_pairs)(s, &p,
                                                                         &to);
        }
    }

    bool is_wanted(int column) const
    {
        return part->at(COLUMNS + column) != nullptr;
    }

    /* The wanted columns, from element i. */
    cylint_closest_columns columns(size_t i)
    {
        cylint_closest_columns to{};
        to.distance = is_wanted(DISTANCE) ? distance + i : nullptr;
        to.part =
            is_wanted(PART) || is_wanted(FEATURE) ? small[PART] + i : nullptr;
        to.feature = is_wanted(FEATURE) ? small[FEATURE] + i : nullptr;
        for (int axis = 0; axis < 3; axis++) {
            to.point[axis] = is_wanted(POINT) ? vector[0][axis] + i : nullptr;
            to.normal[axis] = is_wanted(NORMAL) ? vector[1][axis] + i : nullptr;
        }
        return to;
    }

    /* Where there is no part, there is no feature. */
    void write()
    {
        for (size_t i = 0; i < part->size && is_wanted(FEATURE); i++)
            if (small[PART][i] < 0)
                small[FEATURE][i] = -1;
        part->write(distance, COLUMNS + DISTANCE);
        part->write(small[PART], COLUMNS + PART);
        part->write(small[FEATURE], COLUMNS + FEATURE);
        for (size_t axis = 0; axis < 3; axis++) {
            part->write(vector[0][axis], COLUMNS + POINT, axis);
            part->write(vector[1][axis], COLUMNS + NORMAL, axis);
        }
    }

    const Part *part = nullptr;
    const Query query;
    const ptrdiff_t step;         /* of coordinates */
    const double ulps;            /* of on_surface() */
    const cylint_shape *numbered; /* shapes that are numbered, or nullptr */
    double xyz[3][BLOCK], distance[BLOCK], vector[2][3][BLOCK];
    signed char small[FEATURE + 1][BLOCK];
};

/*
 * columns: distance or safety (...), part, or what contains() and on_surface()
 * return, feature, point (..., 3), normal; None where it is not wanted.  With
 * `index` the shapes are numbered by it, and -1 stands for a refused shape.
 */
template <Query query>
void answer(Input shapes, std::optional<Input> index, Input points, double ulps,
            Outputs columns, int threads, const Callback &progress)
{
    Grid grid;
    grid.add(points, 1);
    grid.add(index ? *index : shapes);
    columns.resize(NORMAL + 1);
    for (size_t k = 0; k < columns.size(); k++)
        grid.add(columns[k], k >= POINT);
    grid.finish(false);
    const cylint_shape *numbered = numbered_shapes(shapes, index);
    each_block(grid, threads, progress,
               [&] { return Block(query, points, ulps, numbered); });
}

} // namespace

void register_points(nb::module_ &module)
{
    module.def("closest", &answer<CLOSEST>);
    module.def("contains", &answer<CONTAINS>);
    module.def("safety", &answer<SAFETY>);
    module.def("on_surface", &answer<ON_SURFACE>);
}
