/*
 * intersect.cc - lines and shapes, element by element, in batches
 *
 * If the shape does not change in a block, its lines go to
 * cylint_intersect_lines(); if the line does not change, its shapes to
 * cylint_intersect_shapes(); else both to cylint_intersect_pairs().  Batches have
 * no exact segments: these go to cylint_intersect() one by one.
 */
#include "calls.h"

void Lines::add_to(Grid &grid) const
{
    grid.add(origins, 1);
    grid.add(directions, 1);
    grid.add(starts);
    grid.add(ends);
    grid.add(left_out);
}

int Lines::make(const Part &part, size_t i, Ray *ray) const
{
    double o[3], d[3];
    part.read_vector(o, ORIGINS, i, origins);
    part.read_vector(d, DIRECTIONS, i, directions);
    ray->left_out = part.value<int64_t>(LEFT_OUT, i);
    return segments
               ? cylint_segment(&ray->line, o, d)
               : cylint_span(&ray->line, o, d, part.value<double>(STARTS, i),
                             part.value<double>(ENDS, i));
}

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/* The numbers of further arrays in the grid. */
enum { SHAPES = Lines::ARRAYS, COLUMNS };
enum { RELATION, N, T, PART, COPIED_ORIGINS, COPIED_DIRECTIONS };

/* What a worker keeps from block to block. */
class Block
{
  public:
    explicit Block(const Lines &l) : source(l)
    {
    }
    bool operator()(const Part &p)
    {
        part = &p;
        gather();
        const bool valid = answer();
        if (!valid && !source.masked)
            return false;
        if (!valid)
            mark_refused();
        write();
        return true;
    }

  private:
    /* Reads the lines, unless they are those of the last block. */
    void gather()
    {
        const char *at[4];
        for (int array = Lines::ORIGINS; array <= Lines::ENDS; array++)
            at[array] = part->at(array);
        if (lines.n == part->size && std::equal(at, at + 4, from))
            return;
        std::copy(at, at + 4, from);
        const ptrdiff_t o_step = last_step(source.origins);
        const ptrdiff_t d_step = last_step(source.directions);
        for (int axis = 0; axis < 3; axis++) {
            part->read(column[axis], Lines::ORIGINS, axis * o_step);
            part->read(column[3 + axis], Lines::DIRECTIONS, axis * d_step);
        }
        part->read(column[6], Lines::STARTS);
        part->read(column[7], Lines::ENDS);
        lines_valid = set_lines();
    }

    /* Returns false if a line is refused; the other answers are right. */
    bool answer()
    {
        if (source.segments)
            return run_segments();
        bool one_line = part->stride(SHAPES) != 0;
        for (int array = Lines::ORIGINS; array <= Lines::ENDS; array++)
            one_line = one_line && part->stride(array) == 0;
        cylint_columns to{};
        to.relation = relation, to.n = n, to.t0 = t[0], to.t1 = t[1];
        to.part0 = parts[0], to.part1 = parts[1];
        if (part->stride(SHAPES) == 0) {
            cylint_intersect_lines(shape_at(0), &lines, &to);
        } else if (pack_shapes(); one_line) {
            Ray ray;
            source.make(*part, 0, &ray);
            cylint_intersect_shapes(&pack, &ray.line, &to);
        } else {
            cylint_intersect_pairs(&pack, &lines, &to);
        }
        return lines_valid;
    }

    bool run_segments()
    {
        bool valid = true;
        for (size_t i = 0; i < part->size; i++) {
            Ray ray;
            valid &= source.make(*part, i, &ray) == CYLINT_OK;
            cylint_answer answer;
            cylint_intersect(shape_at(i), &ray.line,
                             CYLINT_WANT_T | CYLINT_WANT_PART, &answer);
            relation[i] = static_cast<signed char>(answer.relation);
            n[i] = static_cast<signed char>(answer.n);
            for (int k = 0; k < 2; k++) {
                const bool there = k < answer.n;
                t[k][i] = there ? answer.hit[k].t : not_a_number;
                parts[k][i] =
                    static_cast<signed char>(there ? answer.hit[k].part : -1);
            }
        }
        return valid;
    }

    /* A refused line has no relation. */
    void mark_refused()
    {
        Ray ray;
        for (size_t i = 0; i < part->size; i++)
            if (source.make(*part, i, &ray) != CYLINT_OK)
                relation[i] = -1;
    }

    const cylint_shape *shape_at(size_t i) const
    {
        return as_shape(part->at(SHAPES, i));
    }

    /* Consecutive blocks often have the same shapes. */
    void pack_shapes()
    {
        const cylint_shape *shapes = shape_at(0);
        if (shapes == packed && pack.n == part->size)
            return;
        packed = shapes;
        if (part->stride(SHAPES) != sizeof(cylint_shape)) {
            gathered.resize(part->size);
            for (size_t i = 0; i < part->size; i++)
                gathered[i] = *shape_at(i);
            shapes = gathered.data();
        }
        memory.resize(cylint_pack_bytes(part->size));
        cylint_pack_shapes(&pack, memory.data(), shapes, part->size);
    }

    /* Whether an array is one number, and which. */
    bool is_constant(int array, double value) const
    {
        return part->stride(array) == 0 &&
               column[array == Lines::STARTS ? 6 : 7][0] == value;
    }

    /* Returns whether all lines are valid. */
    bool set_lines()
    {
        lines.n = part->size;
        for (int axis = 0; axis < 3; axis++) {
            lines.o[axis] = column[axis];
            lines.d[axis] = column[3 + axis];
        }
        lines.tmin = is_constant(Lines::STARTS, 0) ? nullptr : column[6];
        lines.tmax = is_constant(Lines::ENDS, infinity) ? nullptr : column[7];
        int bad = 0;
        for (size_t i = 0; i < lines.n; i++) {
            double sum = 0; /* NaN if a coordinate is not finite */
            for (int k = 0; k < 6; k++)
                sum += column[k][i] * 0;
            bad |= (!(sum == 0)) | ((column[3][i] == 0) & (column[4][i] == 0) &
                                    (column[5][i] == 0));
        }
        for (size_t i = 0; i < lines.n && (lines.tmin || lines.tmax); i++)
            bad |= !(column[6][i] <= column[7][i]);
        return !bad;
    }

    void write() const
    {
        part->write(relation, COLUMNS + RELATION);
        part->write(n, COLUMNS + N);
        for (size_t k = 0; k < 2; k++) {
            part->write(t[k], COLUMNS + T, k);
            part->write(parts[k], COLUMNS + PART, k);
        }
        for (size_t axis = 0; axis < 3; axis++) {
            part->write(column[axis], COLUMNS + COPIED_ORIGINS, axis);
            part->write(column[3 + axis], COLUMNS + COPIED_DIRECTIONS, axis);
        }
    }

    const Part *part = nullptr;
    const Lines &source;
    const char *from[4] = {};
    double column[8][BLOCK]; /* o, d, tmin, tmax */
    cylint_lines lines{};
    bool lines_valid = true;
    cylint_pack pack{};
    const cylint_shape *packed = nullptr;
    std::vector<cylint_shape> gathered;
    std::vector<char> memory;
    double t[2][BLOCK];
    signed char relation[BLOCK], n[BLOCK], parts[2][BLOCK];
};

/* columns: relation, n, t (..., 2), part (..., 2), and copies of the origins
 * and the directions (..., 3), None where they are not wanted.  Returns false
 * if a line is refused and not masked; the answers are then not complete. */
bool intersect(Input shapes, const Lines &lines, Outputs columns, int threads,
               const Callback &progress)
{
    static const size_t inner[] = {0, 0, 1, 1, 1, 1};
    Grid grid;
    lines.add_to(grid);
    grid.add(shapes);
    for (size_t k = 0; k < columns.size(); k++)
        grid.add(columns[k], inner[k]);
    grid.finish(false);
    return each_block(grid, threads, progress, [&] { return Block(lines); });
}

/* The columns of describe(), in the order of _MEMBERS in _hits.py. */
enum { POINT, NORMAL, Z, PHI, SIDE, OUTSIDE, INSIDE, MEMBERS };

/* Writes hit k of an element to the wanted columns.  hit: NULL if there is none. */
void write_hit(const Part &part, size_t i, size_t k, const cylint_shape *shape,
               const cylint_hit *hit)
{
    for (int member = 0; member < MEMBERS; member++) {
        const int array = COLUMNS + member;
        const double none[3] = {not_a_number, not_a_number, not_a_number};
        double moved[3];
        const double *from = none;
        if (!part.at(array))
            continue;
        if (member == SIDE) {
            part.value<signed char>(array, i, k) = static_cast<signed char>(
                hit ? static_cast<int>(hit->side) : -1);
            continue;
        }
        if (hit && (member == OUTSIDE || member == INSIDE))
            from = cylint_outside(shape, hit, member == OUTSIDE ? -1 : 1, moved)
                       ? moved
                       : none;
        else if (hit)
            from = member == POINT    ? hit->point
                   : member == NORMAL ? hit->normal
                   : member == Z      ? &hit->z
                                      : &hit->phi;
        const size_t width = member == Z || member == PHI ? 1 : 3;
        std::copy(from, from + width, &part.value<double>(array, i, k * width));
    }
}

/*
 * Computes members of hits one by one.  columns: point (..., 2, 3), normal,
 * z (..., 2), phi, side, outside (..., 2, 3), inside; None where it is not
 * wanted.  With `index` the shapes are numbered by it, -1 is a miss, and there
 * is one hit, not two: the first.
 */
void describe(Input shapes, std::optional<Input> index, const Lines &lines,
              Outputs columns, int threads, const Callback &progress)
{
    static const unsigned wants[] = {CYLINT_WANT_POINT, CYLINT_WANT_NORMAL,
                                     CYLINT_WANT_Z, CYLINT_WANT_PHI,
                                     CYLINT_WANT_PART};
    const bool nearest = index.has_value();
    const auto *const records = static_cast<const char *>(shapes.data());
    unsigned want = nearest ? CYLINT_WANT_NEAREST : 0;
    Grid grid;
    lines.add_to(grid);
    grid.add(nearest ? *index : shapes);
    for (size_t member = 0; member < columns.size(); member++) {
        grid.add(columns[member], (member < Z || member > SIDE) + !nearest);
        if (columns[member])
            want |= member <= SIDE ? wants[member]
                                   : CYLINT_WANT_POINT | CYLINT_WANT_NORMAL |
                                         CYLINT_WANT_PART;
    }
    grid.finish(false);
    each(grid, lines, threads, progress,
         [&](const Part &part, size_t i, const Ray &ray) {
             const cylint_shape *shape = as_shape(part.at(SHAPES, i));
             if (nearest) {
                 const auto number = part.value<int64_t>(SHAPES, i);
                 shape = number < 0 ? nullptr : as_shape(records) + number;
             }
             cylint_answer answer;
             answer.n = 0;
             if (shape) /* of a refused line cylint_intersect() writes no hit */
                 cylint_intersect(shape, &ray.line, want, &answer);
             for (int k = 0; k < (nearest ? 1 : 2); k++)
                 write_hit(part, i, static_cast<size_t>(k), shape,
                           k < answer.n ? &answer.hit[k] : nullptr);
         });
}

/* Returns (number of the first refused line in C order, status), or (-1, 0). */
nb::tuple first_bad_line(const Lines &lines)
{
    Grid grid;
    lines.add_to(grid);
    grid.finish(true);
    Part part(grid);
    for (size_t row = 0; row * grid.row() < grid.size(); row++) {
        part.locate(row, 0, grid.row());
        for (size_t i = 0; i < part.size; i++) {
            Ray ray;
            const int status = lines.make(part, i, &ray);
            if (status != CYLINT_OK)
                return nb::make_tuple(part.number + i, status);
        }
    }
    return nb::make_tuple(-1, 0);
}

} // namespace

void register_intersect(nb::module_ &module)
{
    nb::class_<Lines>(module, "Lines")
        .def(nb::init<Input, Input, Input, Input, Input, bool, bool>());
    module.def("first_bad_line", &first_bad_line);
    module.def("intersect", &intersect);
    module.def("describe", &describe);
}
