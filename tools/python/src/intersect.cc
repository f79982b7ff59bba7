/*
 * intersect.cc - lines and shapes, element by element, in batches
 *
 * If the shape does not change in a block, its lines go to
 * cylint_intersect_lines(), else both to cylint_intersect_pairs().  Exact segments,
 * shapes that are numbered, and members that batches do not compute go to
 * cylint_intersect() one by one.
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

/* The numbers of further arrays in the grid; SHAPES: shapes or their numbers. */
enum { SHAPES = Lines::ARRAYS, COLUMNS };
enum {
    RELATION,
    N,
    T,
    PART,
    /* the members, in the order of _columns in _hits.py: first the vectors */
    POINT,
    NORMAL,
    OUTSIDE,
    INSIDE,
    Z,
    PHI,
    SIDE,
    END,
    MEMBERS = POINT
};

/* What a worker keeps from block to block. */
class Block
{
  public:
    Block(const Lines &l, const cylint_shape *shapes)
        : source(l), numbered(shapes)
    {
    }
    bool operator()(const Part &p)
    {
        part = &p;
        for (int column = MEMBERS; column < END; column++)
            if (part->at(COLUMNS + column))
                member = column;
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
        if (source.segments || numbered || member == OUTSIDE ||
            member == INSIDE || member == SIDE)
            return answer_singly();
        const cylint_columns to = columns();
        if (part->stride(SHAPES) == 0) {
            cylint_intersect_lines(shape_of_element(0), &lines, &to);
        } else {
            pack_shapes();
            cylint_intersect_pairs(&pack, &lines, &to);
        }
        return lines_valid;
    }

    /* The wanted columns. */
    cylint_columns columns()
    {
        const auto wanted = [this](int column, auto *array) {
            return part->at(COLUMNS + column) ? array : nullptr;
        };
        cylint_columns to{};
        to.relation = wanted(RELATION, relation), to.n = wanted(N, n);
        to.t0 = wanted(T, number[0]), to.t1 = wanted(T, number[1]);
        to.part0 = wanted(PART, small[0]), to.part1 = wanted(PART, small[1]);
        to.z0 = wanted(Z, number[0]), to.z1 = wanted(Z, number[1]);
        to.phi0 = wanted(PHI, number[0]), to.phi1 = wanted(PHI, number[1]);
        for (int axis = 0; axis < 3; axis++) {
            to.point0[axis] = wanted(POINT, vector[0][axis]);
            to.point1[axis] = wanted(POINT, vector[1][axis]);
            to.normal0[axis] = wanted(NORMAL, vector[0][axis]);
            to.normal1[axis] = wanted(NORMAL, vector[1][axis]);
        }
        return to;
    }

    /* Of cylint_intersect(). */
    unsigned want() const
    {
        constexpr unsigned first = CYLINT_WANT_T | CYLINT_WANT_PART,
                           moved = CYLINT_WANT_POINT | CYLINT_WANT_NORMAL |
                                   CYLINT_WANT_PART;
        static const unsigned wants[] = {
            CYLINT_WANT_POINT, CYLINT_WANT_NORMAL, moved,           moved,
            CYLINT_WANT_Z,     CYLINT_WANT_PHI,    CYLINT_WANT_PART};
        return (numbered ? unsigned{CYLINT_WANT_NEAREST} : 0U) |
               (member == 0 ? first : wants[member - MEMBERS]);
    }

    bool answer_singly()
    {
        const unsigned wanted = want();
        bool valid = true;
        for (size_t i = 0; i < part->size; i++) {
            const cylint_shape *shape = shape_of_element(i);
            Ray ray;
            cylint_answer answer; /* of a refused line or shape without hits */
            valid &= source.make(*part, i, &ray) == CYLINT_OK;
            cylint_intersect(shape, &ray.line, wanted, &answer);
            relation[i] = static_cast<signed char>(answer.relation);
            n[i] = static_cast<signed char>(answer.n);
            for (int k = 0; k < 2; k++)
                set_hit(i, k, shape, k < answer.n ? answer.hit[k] : no_hit);
        }
        return valid;
    }

    /* Sets the member, or t and part. */
    void set_hit(size_t i, int k, const cylint_shape *shape,
                 const cylint_hit &hit)
    {
        if (member == 0) {
            number[k][i] = hit.t;
            small[k][i] = static_cast<signed char>(hit.part);
        } else if (member == SIDE) {
            small[k][i] = static_cast<signed char>(hit.side);
        } else if (member == Z || member == PHI) {
            number[k][i] = member == Z ? hit.z : hit.phi;
        } else {
            double moved[3];
            const double *from = member == POINT ? hit.point : hit.normal;
            if (member == OUTSIDE || member == INSIDE)
                from = hit.part >= 0 &&
                               cylint_outside(shape, &hit,
                                              member == OUTSIDE ? -1 : 1, moved)
                           ? moved
                           : no_hit.point;
            for (int axis = 0; axis < 3; axis++)
                vector[k][axis][i] = from[axis];
        }
    }

    /* A refused line has no relation. */
    void mark_refused()
    {
        Ray ray;
        for (size_t i = 0; i < part->size; i++)
            if (source.make(*part, i, &ray) != CYLINT_OK)
                relation[i] = -1;
    }

    const cylint_shape *shape_of_element(size_t i) const
    {
        return shape_at(*part, SHAPES, i, numbered);
    }

    /* Consecutive blocks often have the same shapes. */
    void pack_shapes()
    {
        const cylint_shape *shapes = shape_of_element(0);
        if (shapes == packed && pack.n == part->size)
            return;
        packed = shapes;
        if (part->stride(SHAPES) != sizeof(cylint_shape)) {
            gathered.resize(part->size);
            for (size_t i = 0; i < part->size; i++)
                gathered[i] = *shape_of_element(i);
            shapes = gathered.data();
        }
        memory.resize(cylint_pack_bytes(part->size));
        cylint_pack_shapes(&pack, memory.data(), shapes, part->size);
    }

    /* Returns whether all lines are valid. */
    bool set_lines()
    {
        lines.n = part->size;
        for (int axis = 0; axis < 3; axis++) {
            lines.o[axis] = column[axis];
            lines.d[axis] = column[3 + axis];
        }
        const auto unless = [this](int array, double *limits, double usual) {
            return part->stride(array) == 0 && *limits == usual ? nullptr
                                                                : limits;
        };
        lines.tmin = unless(Lines::STARTS, column[6], 0);
        lines.tmax = unless(Lines::ENDS, column[7], infinity);
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
        for (size_t k = 0; k < (numbered ? 1 : 2); k++) {
            for (int of : {T, Z, PHI})
                part->write(number[k], COLUMNS + of, k);
            for (int of : {PART, SIDE})
                part->write(small[k], COLUMNS + of, k);
            for (int column = POINT; column < Z; column++)
                for (size_t axis = 0; axis < 3; axis++)
                    part->write(vector[k][axis], COLUMNS + column,
                                3 * k + axis);
        }
    }

    const Part *part = nullptr;
    const Lines &source;
    const cylint_shape *numbered; /* shapes that are numbered, or nullptr */
    int member = 0; /* the one that is wanted; 0: the columns before them */
    const char *from[4] = {};
    double column[8][BLOCK]; /* o, d, tmin, tmax */
    cylint_lines lines{};
    bool lines_valid = true;
    cylint_pack pack{};
    const cylint_shape *packed = nullptr;
    std::vector<cylint_shape> gathered;
    std::vector<char> memory;
    double number[2][BLOCK], vector[2][3][BLOCK]; /* number: t, z or phi */
    signed char relation[BLOCK], n[BLOCK], small[2][BLOCK]; /* part or side */
};

/*
 * columns: relation, n, t (..., 2), part (..., 2), then at most one of the members
 * (..., 2), vectors with one axis more; None where it is not wanted.  With `index`
 * the shapes are numbered by it, -1 is a miss, and there is one hit, not two: the
 * first.  Returns false if a line is refused and not masked; the answers are then
 * not complete.
 */
bool intersect(Input shapes, std::optional<Input> index, const Lines &lines,
               Outputs columns, int threads, const Callback &progress)
{
    Grid grid;
    lines.add_to(grid);
    grid.add(index ? *index : shapes);
    columns.resize(END);
    for (size_t k = 0; k < END; k++) {
        const bool is_vector = k >= POINT && k < Z;
        grid.add(columns[k], k < MEMBERS ? k >= T : is_vector + !index);
    }
    grid.finish(false);
    const cylint_shape *numbered = numbered_shapes(shapes, index);
    return each_block(grid, threads, progress,
                      [&] { return Block(lines, numbered); });
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
}
