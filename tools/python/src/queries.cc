/*
 * queries.cc - queries of scenes, for many lines or points
 */
#include <array>
#include <new>

#include "scene.h"

namespace
{

enum { CAPACITY = 128 }; /* shapes of one call of the library */

/* Answers that are rows, any number of them for each line or point, by blocks. */
template <size_t INTEGERS, size_t DOUBLES> struct Rows {
    struct Row {
        int64_t integer[INTEGERS];
        double number[DOUBLES];
    };
    explicit Rows(const Grid &grid) : blocks(blocks_of(grid))
    {
    }

    /* Arrays of NumPy: one for each integer, and one for each double, or one of
     * pairs of them. */
    nb::tuple columns(bool pairs) const
    {
        size_t size = 0;
        for (const auto &block : blocks)
            size += block.size();
        nb::list list;
        for (size_t k = 0; k < INTEGERS; k++)
            fill<int64_t>(list, nb::make_tuple(size), "i8", 1,
                          [k](const Row &row) { return row.integer + k; });
        if (pairs)
            fill<double>(list, nb::make_tuple(size, DOUBLES), "f8", DOUBLES,
                         [](const Row &row) { return row.number; });
        for (size_t k = 0; k < DOUBLES && !pairs; k++)
            fill<double>(list, nb::make_tuple(size), "f8", 1,
                         [k](const Row &row) { return row.number + k; });
        return nb::tuple(list);
    }

    std::vector<std::vector<Row>> blocks;

  private:
    template <class Value, class Get>
    void fill(nb::list &list, const nb::tuple &shape, const char *type,
              size_t width, const Get &get) const
    {
        const nb::object made =
            nb::module_::import_("numpy").attr("empty")(shape, type);
        auto *to = static_cast<Value *>(nb::cast<Output>(made).data());
        for (const auto &block : blocks)
            for (const Row &row : block)
                to = std::copy_n(get(row), width, to);
        list.append(made);
    }
};

/* Memory of the thread for one query at a time, which query(work) uses; it is
 * called again as long as it returns CYLINT_NO_ROOM. */
template <class Query> size_t with_workspace(const Query &query)
{
    thread_local std::vector<double> memory(2048);
    for (;;) {
        cylint_workspace work{memory.data(), memory.size() * sizeof(double), 0};
        const size_t answer = query(&work);
        if (answer != CYLINT_NO_ROOM)
            return answer;
        memory.resize(work.wanted / sizeof(double) + 1);
    }
}

/* Writes an answer to element i of the arrays from number `array` on. */
class Answer
{
  public:
    Answer(const Part &p, size_t element, int first)
        : part(p), i(element), array(first)
    {
    }
    template <class... Values> void operator()(const Values &...values) const
    {
        int to = array;
        (put(to++, values), ...);
    }

    double *doubles() const
    {
        return &part.value<double>(array, i);
    }

  private:
    template <class Value> void put(int to, const Value &value) const
    {
        part.value<Value>(to, i) = value;
    }
    void put(int to, const std::array<double, 3> &vector) const
    {
        std::copy(vector.begin(), vector.end(), &part.value<double>(to, i));
    }

    const Part &part;
    const size_t i;
    const int array;
};

using Byte = signed char;
using Vector = std::array<double, 3>;
constexpr Vector nowhere = {not_a_number, not_a_number, not_a_number};

int64_t integer(size_t value)
{
    return static_cast<int64_t>(value);
}

Byte byte(int value)
{
    return static_cast<Byte>(value);
}

Vector vector(const double (&v)[3])
{
    return {v[0], v[1], v[2]};
}

using Integers = std::optional<Input>; /* int32 for each shape, contiguous */

/* What a query needs beside lines or points. */
struct Rule {
    Rule(int m, Integers ranks, Integers label, size_t first, bool is_set)
        : mode(m), rank_of(ranks), label_of(label), most(first), flag(is_set)
    {
    }
    const int *rank() const
    {
        return rank_of ? static_cast<const int *>(rank_of->data()) : nullptr;
    }
    const int *label() const
    {
        return label_of ? static_cast<const int *>(label_of->data()) : nullptr;
    }
    cylint_piece_rule pieces() const
    {
        return {static_cast<cylint_piece_mode>(mode), rank(), nullptr};
    }

    const int mode; /* of pieces */
    const Integers rank_of, label_of;
    const size_t most; /* pieces, 0: all; or the number of labels */
    const bool flag;   /* signed distances; sums in the units of the scene */
};

/* A scene and the rule of a call. */
struct Asked {
    const cylint_scene *scene;
    size_t n;
    const Rule &rule;
    unsigned want_of_points;
};

/* ---------------------------------------------------- one line, columns -- */

/* index, t, part */
void nearest(const Asked &q, const cylint_line &line, size_t except,
             const Answer &put)
{
    cylint_hit hit;
    const size_t found = cylint_scene_nearest_other(
        q.scene, &line, except, CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
    if (found < q.n)
        put(integer(found), hit.t, byte(hit.part));
    else
        put(int64_t{-1}, not_a_number, Byte{-1});
}

/* bool */
void any(const Asked &q, const cylint_line &line, size_t except,
         const Answer &put)
{
    put(cylint_scene_occluded(q.scene, &line, except) != 0);
}

/* int64 */
void count(const Asked &q, const cylint_line &line, size_t except,
           const Answer &put)
{
    cylint_shape shape;
    size_t hits = cylint_scene_count(q.scene, &line, 0);
    if (except < q.n) {
        cylint_scene_shape(q.scene, except, &shape);
        hits -= cylint_occluded(&shape, &line) != 0;
    }
    put(integer(hits));
}

/* sums (..., labels), the last axis contiguous */
void sums(const Asked &q, const cylint_line &line, size_t, const Answer &put)
{
    const cylint_piece_rule rule = q.rule.pieces();
    if (cylint_scene_line_sums(q.scene, &line, &rule, q.rule.label(),
                               q.rule.most, q.rule.flag,
                               put.doubles()) != CYLINT_SCENE_OK)
        throw std::bad_alloc();
}

/* index, t, part, side, point (..., 3), normal (..., 3) */
void first_boundary(const Asked &q, const cylint_line &line, size_t,
                    const Answer &put)
{
    cylint_hit hit;
    const size_t found = with_workspace([&](cylint_workspace *work) {
        return cylint_scene_first_boundary(q.scene, &line, CYLINT_WANT_ALL,
                                           &hit, work);
    });
    if (found < q.n)
        put(integer(found), hit.t, byte(hit.part), byte(hit.side),
            vector(hit.point), vector(hit.normal));
    else
        put(int64_t{-1}, not_a_number, Byte{-1}, Byte{-1}, nowhere, nowhere);
}

/* ------------------------------------------------------- one line, rows -- */

/* Calls query(from, numbers), which finds at most CAPACITY shapes, until all
 * are found, and write(number) for each one. */
template <class Query, class Write>
void each_found(const Query &query, const Write &write)
{
    size_t numbers[CAPACITY], found, from = 0;
    do {
        found = query(from, numbers);
        for (size_t i = 0; i < found; i++)
            write(numbers[i]);
        from = found > 0 ? numbers[found - 1] + 1 : 0;
    } while (found == CAPACITY);
}

using Hit = Rows<2, 2>; /* line, index, both t */
void all(const Asked &q, const cylint_line &line, size_t except, int64_t number,
         std::vector<Hit::Row> &to)
{
    const auto query = [&](size_t from, size_t *numbers) {
        return cylint_scene_all(q.scene, &line, from, numbers, CAPACITY);
    };
    each_found(query, [&](size_t index) {
        double t[2] = {not_a_number, not_a_number};
        cylint_shape shape;
        cylint_answer answer;
        if (index == except)
            return;
        cylint_scene_shape(q.scene, index, &shape);
        cylint_intersect(&shape, &line, CYLINT_WANT_T, &answer);
        for (int k = 0; k < answer.n; k++)
            t[k] = answer.hit[k].t;
        to.push_back({{number, integer(index)}, {t[0], t[1]}});
    });
}

using Piece = Rows<3, 2>; /* line, shape, depth, t0, t1 */
void pieces(const Asked &q, const cylint_line &line, size_t, int64_t number,
            std::vector<Piece::Row> &to)
{
    const cylint_piece_rule rule = q.rule.pieces();
    const size_t most = q.rule.most;
    std::vector<cylint_piece> some(most > 0 ? most : CAPACITY);
    size_t found;
    for (;; some.resize(2 * some.size())) {
        found = with_workspace([&](cylint_workspace *work) {
            return cylint_scene_pieces(q.scene, &line, &rule, some.data(),
                                       some.size(), work);
        });
        if (most > 0 || found < some.size())
            break;
    }
    for (size_t k = 0; k < found; k++)
        to.push_back({{number, integer(some[k].shape), integer(some[k].depth)},
                      {some[k].t0, some[k].t1}});
}

/* ------------------------------------------------- one point, a radius -- */

/* index, distance */
void closest(const Asked &q, const double *point, double radius,
             const Answer &put)
{
    cylint_closest answer;
    const size_t found =
        cylint_scene_closest(q.scene, point, radius, q.want_of_points, &answer);
    if (found < q.n)
        put(integer(found), answer.distance);
    else
        put(int64_t{-1}, not_a_number);
}

/* int64 */
void within_count(const Asked &q, const double *point, double radius,
                  const Answer &put)
{
    put(integer(cylint_scene_within_count(q.scene, point, radius,
                                          q.want_of_points, 0)));
}

/* int64; the radius has no effect */
void contains(const Asked &q, const double *point, double, const Answer &put)
{
    put(integer(cylint_scene_contains(q.scene, point, 0)));
}

/* depth, index; the radius has no effect */
void depth(const Asked &q, const double *point, double, const Answer &put)
{
    size_t owner = q.n;
    const size_t deep = with_workspace([&](cylint_workspace *work) {
        return cylint_scene_depth(q.scene, point, q.rule.rank(), &owner, work);
    });
    put(integer(deep), owner < q.n ? integer(owner) : -1);
}

using Near = Rows<2, 1>; /* point, index, distance */
void within(const Asked &q, const double *point, double radius, int64_t number,
            std::vector<Near::Row> &to)
{
    const auto query = [&](size_t from, size_t *numbers) {
        return cylint_scene_within(q.scene, point, radius, q.want_of_points,
                                   from, numbers, nullptr, CAPACITY);
    };
    each_found(query, [&](size_t index) {
        cylint_shape shape;
        cylint_closest answer;
        cylint_scene_shape(q.scene, index, &shape);
        to.push_back(
            {{number, integer(index)},
             {cylint_distance(&shape, point, q.want_of_points, &answer)}});
    });
}

/* ------------------------------------------------ many lines or points -- */

Asked asked_of(const Scene &scene, const Rule &rule)
{
    return {scene.scene.get(), scene.n, rule, rule.flag ? CYLINT_SIGNED : 0u};
}

/* The shape that a line leaves out, or n. */
size_t left_out(const Asked &q, const Part &part, size_t i)
{
    const auto index = part.value<int64_t>(LEFT_OUT, i);
    return index < 0 ? q.n : static_cast<size_t>(index);
}

/* Returns false if a line is refused and not masked. */
template <auto query>
bool line_columns(const Scene &scene, const Lines &lines, const Rule &rule,
                  Outputs columns, int threads, const Callback &progress)
{
    const Asked q = asked_of(scene, rule);
    Grid grid;
    lines.add_to(grid);
    for (const auto &column : columns)
        grid.add(column, column->ndim() - lines.axes());
    grid.finish(false);
    return each_line(grid, lines, threads, progress,
                     [&q](const Part &part, size_t i, const cylint_line &line) {
                         query(q, line, left_out(q, part, i),
                               Answer(part, i, BEHIND_LINES));
                     });
}

/* Returns the rows in the order of the lines; None if a line is refused. */
template <auto query, class Found, bool pairs>
nb::object line_rows(const Scene &scene, const Lines &lines, const Rule &rule,
                     int threads, const Callback &progress)
{
    const Asked q = asked_of(scene, rule);
    Grid grid;
    lines.add_to(grid);
    grid.finish(true);
    Found found(grid);
    const bool good =
        each_line(grid, lines, threads, progress,
                  [&](const Part &part, size_t i, const cylint_line &line) {
                      query(q, line, left_out(q, part, i),
                            integer(part.number + i), found.blocks[part.block]);
                  });
    return good ? nb::object(found.columns(pairs)) : nb::none();
}

/* The points (..., 3) and radii (...) of a block. */
enum { POINTS, RADII, BEHIND_BALLS };

/* Calls function(part, i, point, radius) for each point. */
template <class Function> class EachBall
{
  public:
    EachBall(ptrdiff_t s, const Function &f) : step(s), function(f)
    {
    }
    bool run(const Part &part)
    {
        for (size_t i = 0; i < part.size; i++) {
            double point[3];
            for (int axis = 0; axis < 3; axis++)
                std::memcpy(&point[axis], part.at(POINTS, i) + axis * step,
                            sizeof *point);
            function(part, i, point, part.value<double>(RADII, i));
        }
        return true;
    }

  private:
    const ptrdiff_t step;
    const Function &function;
};

/* columns: empty for a query that returns rows in the order of the points */
template <auto query, class Found>
nb::object points_of(const Scene &scene, Input points, Input radii,
                     const Rule &rule, Outputs columns, int threads,
                     const Callback &progress)
{
    const Asked q = asked_of(scene, rule);
    Grid grid;
    grid.add(points, 1), grid.add(radii);
    for (const auto &column : columns)
        grid.add(column);
    grid.finish(columns.empty());
    Found found(grid);
    const auto ask = [&](const Part &part, size_t i, const double *point,
                         double radius) {
        if constexpr (std::is_same_v<Found, Near>)
            query(q, point, radius, integer(part.number + i),
                  found.blocks[part.block]);
        else
            query(q, point, radius, Answer(part, i, BEHIND_BALLS));
    };
    each_block<EachBall<decltype(ask)>>(grid, threads, progress,
                                        coordinate_step(points), ask);
    return found.columns(false);
}

struct NoRows {
    explicit NoRows(const Grid &)
    {
    }
    static nb::object columns(bool)
    {
        return nb::none();
    }
};

} // namespace

void register_queries(nb::class_<Scene> &scene)
{
    nb::class_<Rule>(scene, "Rule")
        .def(nb::init<int, Integers, Integers, size_t, bool>());
    scene.def("nearest", &line_columns<nearest>)
        .def("any", &line_columns<any>)
        .def("count", &line_columns<count>)
        .def("sums", &line_columns<sums>)
        .def("first_boundary", &line_columns<first_boundary>)
        .def("all", &line_rows<all, Hit, true>)
        .def("pieces", &line_rows<pieces, Piece, false>)
        .def("closest", &points_of<closest, NoRows>)
        .def("within_count", &points_of<within_count, NoRows>)
        .def("contains", &points_of<contains, NoRows>)
        .def("depth", &points_of<depth, NoRows>)
        .def("within", &points_of<within, Near>);
}
