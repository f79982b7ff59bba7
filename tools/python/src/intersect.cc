/*
 * intersect.cc - lines and shapes, element by element, in batches
 *
 * A block is a part of a row of the grid.  If the shape does not change in it,
 * its lines go to cylint_intersect_lines(); if the line does not change, its
 * shapes to cylint_intersect_shapes(); else both to cylint_intersect_pairs().
 * Batches have no exact segments: these go to cylint_intersect() one by one.
 */
#include <cmath>
#include <limits>

#include "calls.h"
#include "elements.h"

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();

/* Lines of a block: its columns fit the first cache. */
constexpr size_t BLOCK = 512;

/* The places of the arrays in the grid. */
struct Places {
    int shapes, lines, relation, n, t, part, origins, directions;
};

/* What a worker keeps from block to block. */
class Block
{
  public:
    Block(const Grid &grid, const Places &p, const Lines &l)
        : row(grid), place(p), source(l)
    {
    }

    /* Returns false if a line is refused and not masked. */
    bool run(size_t number, size_t begin, size_t count)
    {
        row.locate(number, begin, count);
        if (!answer()) {
            if (!source.masked)
                return false;
            mark_refused();
        }
        write();
        return true;
    }

  private:
    /* Returns false if a line is refused; the other answers are right. */
    bool answer()
    {
        if (source.segments) {
            gather_lines();
            return run_segments();
        }
        const bool one_shape = row.stride(place.shapes) == 0;
        const bool one_line = row.stride(place.lines) == 0 &&
                              row.stride(place.lines + 1) == 0 &&
                              row.stride(place.lines + 2) == 0 &&
                              row.stride(place.lines + 3) == 0;
        if (one_line && !one_shape)
            return run_shapes();
        gather_lines();
        if (one_shape) {
            cylint_intersect_lines(shape_at(0), &lines, &columns());
        } else {
            pack_shapes();
            cylint_intersect_pairs(&pack, &lines, &columns());
        }
        return lines_valid;
    }

    bool run_shapes()
    {
        cylint_line line;
        const bool valid = make(0, &line);
        pack_shapes();
        cylint_intersect_shapes(&pack, &line, &columns());
        return valid;
    }

    bool run_segments()
    {
        bool valid = true;
        for (size_t i = 0; i < row.size(); i++) {
            cylint_line line;
            valid &= make(i, &line);
            cylint_answer answer;
            cylint_intersect(shape_at(i), &line,
                             CYLINT_WANT_T | CYLINT_WANT_PART, &answer);
            write_answer(i, answer);
        }
        return valid;
    }

    /* Makes line i.  Returns false if it is refused. */
    bool make(size_t i, cylint_line *line) const
    {
        const char *at[4];
        for (int k = 0; k < 4; k++)
            at[k] = row.at(place.lines + k, i);
        return source.make(at, line) == CYLINT_OK;
    }

    /* A refused line has no relation. */
    void mark_refused()
    {
        cylint_line line;
        for (size_t i = 0; i < row.size(); i++)
            if (!make(i, &line))
                relation[i] = -1;
    }

    void write_answer(size_t i, const cylint_answer &answer)
    {
        relation[i] = static_cast<signed char>(answer.relation);
        n[i] = static_cast<signed char>(answer.n);
        for (int k = 0; k < 2; k++) {
            const bool there = k < answer.n;
            t[k][i] = there ? answer.hit[k].t : not_a_number;
            part[k][i] =
                static_cast<signed char>(there ? answer.hit[k].part : -1);
        }
    }

    const cylint_shape *shape_at(size_t i) const
    {
        return as_shape(row.at(place.shapes, i));
    }

    /* Consecutive blocks often have the same shapes. */
    void pack_shapes()
    {
        const cylint_shape *shapes = shape_at(0);
        if (shapes == packed && pack.n == row.size())
            return;
        packed = shapes;
        if (row.stride(place.shapes) !=
            static_cast<ptrdiff_t>(sizeof(cylint_shape))) {
            gathered.resize(row.size());
            for (size_t i = 0; i < row.size(); i++)
                gathered[i] = *shape_at(i);
            shapes = gathered.data();
        }
        memory.resize(cylint_pack_bytes(row.size()));
        cylint_pack_shapes(&pack, memory.data(), shapes, row.size());
    }

    /* Whether an array is one number, and which. */
    bool is_constant(int array, double value) const
    {
        return row.stride(array) == 0 && number(row.at(array)) == value;
    }

    /* Reads the lines into columns and tests whether they are valid. */
    void gather_lines()
    {
        const char *const *const at = row.addresses(place.lines);
        const std::vector<const char *> from(at, at + 4);
        if (from == lines_from && row.size() == lines.n)
            return;
        for (int axis = 0; axis < 3; axis++) {
            row.read(column[axis], place.lines, axis * source.o_step());
            row.read(column[3 + axis], place.lines + 1, axis * source.d_step());
            lines.o[axis] = column[axis];
            lines.d[axis] = column[3 + axis];
        }
        lines.tmin = lines.tmax = nullptr;
        if (!is_constant(place.lines + 2, 0)) {
            row.read(column[6], place.lines + 2, 0);
            lines.tmin = column[6];
        }
        if (!is_constant(place.lines + 3, infinity)) {
            row.read(column[7], place.lines + 3, 0);
            lines.tmax = column[7];
        }
        lines.n = row.size();
        lines_from = from;
        lines_valid = are_valid();
    }

    bool are_valid() const
    {
        int bad = 0;
        for (size_t i = 0; i < row.size(); i++) {
            double sum = 0; /* NaN if a coordinate is not finite */
            for (int k = 0; k < 6; k++)
                sum += column[k][i] * 0;
            bad |= (!(sum == 0)) | ((column[3][i] == 0) & (column[4][i] == 0) &
                                    (column[5][i] == 0));
        }
        for (size_t i = 0; i < row.size() && (lines.tmin || lines.tmax); i++)
            bad |= !((lines.tmin ? lines.tmin[i] : 0) <=
                     (lines.tmax ? lines.tmax[i] : infinity));
        return !bad;
    }

    const cylint_columns &columns()
    {
        answers = {relation, n, t[0], t[1], part[0], part[1]};
        return answers;
    }

    void write() const
    {
        row.write(relation, place.relation, 0);
        row.write(n, place.n, 0);
        for (size_t k = 0; k < 2; k++) {
            row.write(t[k], place.t, k);
            row.write(part[k], place.part, k);
        }
        for (size_t axis = 0; axis < 3; axis++) {
            row.write(column[axis], place.origins, axis);
            row.write(column[3 + axis], place.directions, axis);
        }
    }

    RowPart row;
    const Places place;
    const Lines &source;
    std::vector<const char *> lines_from;
    cylint_lines lines{};
    bool lines_valid = true;
    cylint_pack pack{};
    const cylint_shape *packed = nullptr;
    std::vector<cylint_shape> gathered;
    std::vector<char> memory;
    cylint_columns answers{};
    double column[8][BLOCK], t[2][BLOCK];
    signed char relation[BLOCK], n[BLOCK], part[2][BLOCK];
};

} // namespace

int Lines::add_to(Grid &grid) const
{
    const int number_of_first = grid.add(origins);
    grid.add(directions), grid.add(starts), grid.add(ends);
    return number_of_first;
}

int Lines::make(const char *const *at, cylint_line *line) const
{
    double o[3], d[3];
    read_point(at[0], o_step(), o);
    read_point(at[1], d_step(), d);
    return segments ? cylint_segment(line, o, d)
                    : cylint_span(line, o, d, number(at[2]), number(at[3]));
}

/* columns: relation, n, t (..., 2), part (..., 2), and copies of the origins
 * and the directions (..., 3), None where they are not wanted.  Returns false
 * if a line is refused and not masked; the answers are then not complete. */
bool intersect(nb::handle shapes, const Lines &lines, nb::tuple columns,
               int threads, nb::handle progress)
{
    const Array s(shapes), relation(columns[0], true), n(columns[1], true),
        t(columns[2], true), part(columns[3], true), o(columns[4], true),
        d(columns[5], true);
    Grid grid(relation, 0);
    Places place{};
    place.shapes = grid.add(s);
    place.lines = lines.add_to(grid);
    place.relation = grid.add(relation);
    place.n = grid.add(n);
    place.t = grid.add(t);
    place.part = grid.add(part);
    place.origins = grid.add(o);
    place.directions = grid.add(d);
    grid.prepare();
    return each_block<Block>(grid, BLOCK, threads, progress, place, lines);
}

namespace
{

unsigned bit(bool wanted, unsigned value)
{
    return wanted ? value : 0;
}

double *doubles(char *p)
{
    return reinterpret_cast<double *>(p);
}

/* Copies three numbers, or NaN where there are none, to those of hit k, unless
 * the array is not wanted. */
void put(char *array, size_t k, const double *from)
{
    for (size_t axis = 0; array && axis < 3; axis++)
        doubles(array)[3 * k + axis] = from ? from[axis] : not_a_number;
}

/* The numbers of the columns in the grid.  They are in the order of _MEMBERS in
 * _hits.py. */
struct Members {
    int point, normal, z, phi, side, outside, inside;
};

/* Writes the members of hit k that are wanted.  hit: NULL if there is none. */
void write_hit(const Members &m, char *const *to, size_t k,
               const cylint_shape *shape, const cylint_hit *hit)
{
    put(to[m.point], k, hit ? hit->point : nullptr);
    put(to[m.normal], k, hit ? hit->normal : nullptr);
    if (to[m.z])
        doubles(to[m.z])[k] = hit ? hit->z : not_a_number;
    if (to[m.phi])
        doubles(to[m.phi])[k] = hit ? hit->phi : not_a_number;
    if (to[m.side])
        to[m.side][k] = static_cast<char>(hit ? hit->side : -1);
    for (const int side : {-1, 1}) {
        char *const moved = to[side < 0 ? m.outside : m.inside];
        double point[3];
        if (moved)
            put(moved, k,
                hit && cylint_outside(shape, hit, side, point) ? point
                                                               : nullptr);
    }
}

} // namespace

/*
 * Computes members of hits one by one.  columns: point (..., 2, 3), normal,
 * z (..., 2), phi, side, outside (..., 2, 3), inside; None where it is not
 * wanted.  With `index` the shapes are numbered by it, -1 is a miss, and there
 * is one hit, not two: the first.
 */
void describe(nb::handle shapes, nb::handle index, const Lines &lines,
              bool nearest, nb::tuple columns, int threads, nb::handle progress)
{
    const Array s(shapes), number_of(index), point(columns[0], true),
        normal(columns[1], true), z(columns[2], true), phi(columns[3], true),
        side(columns[4], true), outside(columns[5], true),
        inside(columns[6], true);
    Grid grid(lines.starts, 0);
    const int of = nearest ? grid.add(number_of) : grid.add(s);
    const int line = lines.add_to(grid);
    Members m{};
    m.point = grid.add(point);
    m.normal = grid.add(normal);
    m.z = grid.add(z);
    m.phi = grid.add(phi);
    m.side = grid.add(side);
    m.outside = grid.add(outside);
    m.inside = grid.add(inside);
    const bool moved = outside || inside;
    const unsigned want =
        bit(point || moved, CYLINT_WANT_POINT) |
        bit(normal || moved, CYLINT_WANT_NORMAL) | bit(bool(z), CYLINT_WANT_Z) |
        bit(bool(phi), CYLINT_WANT_PHI) | bit(side || moved, CYLINT_WANT_PART) |
        bit(nearest, CYLINT_WANT_NEAREST);
    grid.prepare();
    const size_t hits = nearest ? 1 : 2;
    each_element(grid, BLOCK, threads, progress, [&](char *const *at, size_t) {
        const cylint_shape *const shape =
            nearest ? numbered(s, at[of]) : as_shape(at[of]);
        cylint_answer answer;
        answer.n = 0;
        cylint_line l;
        lines.make(at + line, &l); /* a refused line hits nothing */
        if (shape)
            cylint_intersect(shape, &l, want, &answer);
        for (size_t h = 0; h < hits; h++)
            write_hit(m, at, h, shape,
                      static_cast<int>(h) < answer.n ? &answer.hit[h]
                                                     : nullptr);
        return true;
    });
}

/* Returns (number of the first refused line in C order, status), or (-1, 0). */
nb::tuple first_bad_line(const Lines &lines)
{
    const Array &model = lines.starts;
    size_t count = 1;
    for (int axis = 0; axis < model.axes(); axis++)
        count *= static_cast<size_t>(model.size(axis));
    const Array *const arrays[] = {&lines.origins, &lines.directions,
                                   &lines.starts, &lines.ends};
    for (size_t i = 0; i < count; i++) {
        const char *at[4];
        for (int k = 0; k < 4; k++) {
            at[k] = arrays[k]->data();
            size_t rest = i;
            for (int axis = model.axes(); axis-- > 0;) {
                const auto size = static_cast<size_t>(model.size(axis));
                at[k] += static_cast<ptrdiff_t>(rest % size) *
                         arrays[k]->stride(axis);
                rest /= size;
            }
        }
        cylint_line line;
        const int status = lines.make(at, &line);
        if (status != CYLINT_OK)
            return nb::make_tuple(i, status);
    }
    return nb::make_tuple(-1, 0);
}
