/*
 * queries.cc - queries of scenes, for many lines or points
 */
#include <new>

#include "calls.h"

namespace
{

/* Answers that are written to the columns of the call. */
struct Columns {
    enum { in_order = false };
    explicit Columns(const Grid &)
    {
    }
    static nb::object object()
    {
        return nb::bool_(true);
    }
};

/* Answers that are rows, any number of them for each line or point, by blocks.  The
 * types of their members are also in _scene.py. */
template <class Type> struct Rows {
    enum { in_order = true };
    using Row = Type;
    explicit Rows(const Grid &grid) : blocks(blocks_of(grid))
    {
    }

    /* An array of NumPy: the bytes of all rows. */
    nb::object object() const
    {
        size_t rows = 0;
        for (const auto &block : blocks)
            rows += block.size();
        nb::object made = nb::module_::import_("numpy").attr("empty")(
            rows * sizeof(Row), "u1");
        auto *to = static_cast<Row *>(nb::cast<Output>(made).data());
        for (const auto &block : blocks)
            to = std::copy(block.begin(), block.end(), to);
        return made;
    }

    std::vector<std::vector<Row>> blocks;
};

struct Hit {
    int64_t line, index;
    double t[2];
};

struct Piece {
    int64_t line, shape, depth;
    double t0, t1;
};

struct Near {
    int64_t point, index;
    double distance;
};

/* The memory of a thread for shapes and pieces. */
struct Memory : piece_memory {
    Memory() : piece_memory()
    {
    }
    ~Memory()
    {
        piece_memory_free(this);
    }
};
thread_local Memory memory;

/* What a function of pieces.c returns, unless there was no memory. */
size_t checked(size_t answer)
{
    if (answer == CYLINT_NO_ROOM)
        throw std::bad_alloc();
    return answer;
}

/* Writes an answer to element i of the arrays from number `array` on. */
struct Answer {
    const Part &part;
    const size_t i;
    const int array;

    template <class... Values> void operator()(const Values &...values) const
    {
        int to = array;
        (put(to++, values), ...);
    }

    double *doubles() const
    {
        return &part.value<double>(array, i);
    }

    template <class Value> void put(int to, Value value) const
    {
        part.value<Value>(to, i) = value;
    }
    void put(int to, int value) const /* int8 */
    {
        put(to, static_cast<signed char>(value));
    }
    void put(int to, const double (&vector)[3]) const
    {
        std::copy(vector, vector + 3, &part.value<double>(to, i));
    }
};

int64_t integer(size_t value)
{
    return static_cast<int64_t>(value);
}

using Integers = std::optional<Array<const int>>; /* for each shape */

const int *data_of(const Integers &given)
{
    return given ? given->data() : nullptr;
}

/* What a query needs beside lines or points. */
struct Rule {
    cylint_piece_rule pieces() const
    {
        return {static_cast<cylint_piece_mode>(mode), data_of(rank), nullptr};
    }

    const int mode; /* of pieces */
    const Integers rank, label;
    const size_t most;   /* pieces, 0: all; or the number of labels */
    const bool in_units; /* sums: of the scene */
};

/* A scene and the rule of a call. */
struct Question {
    const cylint_scene *scene;
    size_t n;
    const Rule &rule;

    /* The number of a shape in answers; -1 for none. */
    int64_t number(size_t found) const
    {
        return found < n ? integer(found) : -1;
    }
    size_t except(const Ray &ray) const
    {
        return ray.left_out < 0 ? n : static_cast<size_t>(ray.left_out);
    }
};

/* A point with a radius.  want: CYLINT_SIGNED or 0. */
struct Ball {
    double point[3], radius;
    unsigned want;
};

/* ---------------------------------------------------- one line, columns -- */

/* index, t, part */
void nearest(const Question &q, const Ray &ray, const Answer &put)
{
    cylint_hit hit;
    const size_t found =
        cylint_scene_nearest_other(q.scene, &ray.line, q.except(ray),
                                   CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
    if (found == q.n)
        hit = no_hit;
    put(q.number(found), hit.t, hit.part);
}

/* bool */
void any(const Question &q, const Ray &ray, const Answer &put)
{
    put(cylint_scene_occluded(q.scene, &ray.line, q.except(ray)) != 0);
}

/* int64 */
void count(const Question &q, const Ray &ray, const Answer &put)
{
    cylint_shape shape;
    size_t hits = cylint_scene_count(q.scene, &ray.line, 0);
    if (q.except(ray) < q.n) { /* `exclude` was checked, but another thread may
                                    * have changed it since */
        cylint_scene_shape(q.scene, q.except(ray), &shape);
        hits -= cylint_occluded(&shape, &ray.line) != 0;
    }
    put(integer(hits));
}

/* sums (..., labels), the last axis contiguous */
void sums(const Question &q, const Ray &ray, const Answer &put)
{
    const cylint_piece_rule rule = q.rule.pieces();
    if (cylint_scene_line_sums(q.scene, &ray.line, &rule, data_of(q.rule.label),
                               q.rule.most, q.rule.in_units,
                               put.doubles()) != CYLINT_SCENE_OK)
        throw std::bad_alloc();
}

/* As Boundaries: index, t, point (..., 3), normal (..., 3), side, part */
void boundary(const Question &q, const Ray &ray, const Answer &put)
{
    cylint_hit hit;
    const size_t found = checked(
        first_boundary(q.scene, &ray.line, CYLINT_WANT_ALL, &hit, &memory));
    if (found >= q.n)
        hit = no_hit;
    put(q.number(found), hit.t, hit.point, hit.normal, hit.side, hit.part);
}

/* ------------------------------------------------------- one line, rows -- */

void all(const Question &q, const Ray &ray, int64_t number,
         std::vector<Hit> &to)
{
    const size_t found = checked(find_hit(q.scene, &ray.line, &memory));
    for (size_t i = 0; i < found; i++) {
        const size_t index = memory.number[i];
        Hit hit = {number, integer(index), {not_a_number, not_a_number}};
        cylint_shape shape;
        cylint_answer answer;
        if (hit.index == ray.left_out)
            continue;
        cylint_scene_shape(q.scene, index, &shape);
        cylint_intersect(&shape, &ray.line, CYLINT_WANT_T, &answer);
        for (int k = 0; k < answer.n; k++)
            hit.t[k] = answer.hit[k].t;
        to.push_back(hit);
    }
}

void pieces(const Question &q, const Ray &ray, int64_t number,
            std::vector<Piece> &to)
{
    const cylint_piece_rule rule = q.rule.pieces();
    cylint_piece_memory &found = memory.found;
    found.n = 0;
    if (!cylint_add_pieces(q.scene, &ray.line, &rule, q.rule.most, &found))
        throw std::bad_alloc();
    for (size_t k = 0; k < found.n; k++) {
        const cylint_piece &p = found.piece[k];
        to.push_back({number, integer(p.shape), integer(p.depth), p.t0, p.t1});
    }
}

/* ------------------------------------------------- one point, a radius -- */

/* index, distance */
void closest(const Question &q, const Ball &ball, const Answer &put)
{
    cylint_closest answer;
    const size_t found = cylint_scene_closest(q.scene, ball.point, ball.radius,
                                              ball.want, &answer);
    put(q.number(found), found < q.n ? answer.distance : not_a_number);
}

/* int64 */
void within_count(const Question &q, const Ball &ball, const Answer &put)
{
    put(integer(cylint_scene_within_count(q.scene, ball.point, ball.radius,
                                          ball.want, 0)));
}

/* int64; the radius has no effect */
void contains(const Question &q, const Ball &ball, const Answer &put)
{
    put(integer(cylint_scene_contains(q.scene, ball.point, 0)));
}

/* depth, index; the radius has no effect */
void depth(const Question &q, const Ball &ball, const Answer &put)
{
    size_t owner = q.n;
    const size_t deep = checked(depth_of_point(
        q.scene, ball.point, data_of(q.rule.rank), &owner, &memory));
    put(integer(deep), q.number(owner));
}

/* A visit of the shapes near a point.  It is in C: no exception can cross it. */
struct NearVisit {
    const int64_t number;
    const double radius;
    std::vector<Near> &to;
    bool has_failed;
};

double add_near(void *context, size_t index, double distance, int)
{
    auto *const visit = static_cast<NearVisit *>(context);
    try {
        visit->to.push_back({visit->number, integer(index), distance});
    } catch (const std::bad_alloc &) {
        visit->has_failed = true;
        return not_a_number;
    }
    return visit->radius;
}

void within(const Question &q, const Ball &ball, int64_t number,
            std::vector<Near> &to)
{
    NearVisit visit = {number, ball.radius, to, false};
    const auto begin = static_cast<ptrdiff_t>(to.size());
    cylint_scene_visit_point(q.scene, ball.point, ball.radius, ball.want,
                             add_near, &visit);
    if (visit.has_failed)
        throw std::bad_alloc();
    std::sort(to.begin() + begin, to.end(),
              [](const Near &a, const Near &b) { return a.index < b.index; });
}

/* ------------------------------------------------ many lines or points -- */

/* Arrays of points (..., 3) and radii (...). */
struct Balls {
    enum { POINTS, RADII, ARRAYS };
    enum { masked = false }; /* none is refused */
    using Element = Ball;
    void add_to(Grid &grid) const
    {
        grid.add(points, 1);
        grid.add(radii);
    }
    int make(const Part &part, size_t i, Ball *ball) const
    {
        part.read_vector(ball->point, POINTS, i, points);
        ball->radius = part.value<double>(RADII, i);
        ball->want = is_signed ? unsigned{CYLINT_SIGNED} : 0U;
        return CYLINT_OK;
    }

    const Input points, radii;
    const bool is_signed;
};

/* Answers lines or points.  columns: for the answers, unless these are rows,
 * which are in the order of the lines or points.  Returns True or the rows; None if
 * a line is refused and not masked. */
template <class From, class Answers, auto query>
nb::object answer(const Scene &scene, const From &from,
                  const std::optional<Rule> &given, Outputs columns,
                  int threads, const Callback &progress)
{
    const Rule rule = given.value_or(Rule{0, {}, {}, 0, false});
    const Question q = {scene.get(), scene.size(), rule};
    const auto held = scene.use;
    Grid grid;
    from.add_to(grid);
    const size_t axes = grid.ndim();
    for (const auto &column : columns)
        grid.add(column, column->ndim() - axes);
    grid.finish(Answers::in_order);
    Answers answers(grid);
    const auto block = [&](const Part &part) {
        for (size_t i = 0; i < part.size; i++) {
            typename From::Element element;
            if (from.make(part, i, &element) != CYLINT_OK && !from.masked)
                return false;
            if constexpr (Answers::in_order)
                query(q, element, integer(part.number + i),
                      answers.blocks[part.block]);
            else
                query(q, element, Answer{part, i, From::ARRAYS});
        }
        return true;
    };
    const bool good =
        each_block(grid, threads, progress, [&] { return block; });
    return good ? answers.object() : nb::none();
}

} // namespace

void register_queries(nb::module_ &module, nb::class_<Scene> &scene)
{
    nb::class_<Balls>(module, "Balls").def(nb::init<Input, Input, bool>());
    nb::class_<Rule>(scene, "Rule")
        .def(nb::init<int, Integers, Integers, size_t, bool>());
    scene.def("nearest", &answer<Lines, Columns, nearest>)
        .def("any", &answer<Lines, Columns, any>)
        .def("count", &answer<Lines, Columns, count>)
        .def("sums", &answer<Lines, Columns, sums>)
        .def("first_boundary", &answer<Lines, Columns, boundary>)
        .def("all", &answer<Lines, Rows<Hit>, all>)
        .def("pieces", &answer<Lines, Rows<Piece>, pieces>)
        .def("closest", &answer<Balls, Columns, closest>)
        .def("within_count", &answer<Balls, Columns, within_count>)
        .def("contains", &answer<Balls, Columns, contains>)
        .def("depth", &answer<Balls, Columns, depth>)
        .def("within", &answer<Balls, Rows<Near>, within>);
}
