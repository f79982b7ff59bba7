/*
 * scene.cc - libcylint-scene: many lines or points, and many shapes
 */
#include <cerrno>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include <nanobind/stl/unique_ptr.h>

#include "calls.h"

namespace
{

enum { CAPACITY = 128 }; /* shapes of one call of the library */

using Integers = std::optional<Input>; /* int32 for each shape, contiguous */

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

/* Memory of the thread for one query at a time, which query(work) uses; it is called
 * again as long as it returns CYLINT_NO_ROOM. */
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

/* The points (..., 3) and radii (...) of a block. */
enum { POINTS, RADII, BEHIND_BALLS };

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

/* Calls function(part, i, point, radius) for each point. */
template <class Function>
void each_ball(const Grid &grid, const Input &points, int threads,
               const Callback &progress, const Function &function)
{
    each_block<EachBall<Function>>(grid, threads, progress,
                                   coordinate_step(points), function);
}

/* The build of a scene, which the library reports to listen(). */
struct Build {
    Listener listener;
    std::exception_ptr failure;

    static int listen(void *self, double part)
    {
        auto *const build = static_cast<Build *>(self);
        try {
            build->listener.listen(part);
        } catch (...) {
            build->failure = std::current_exception();
        }
        return !build->failure;
    }
};

class Scene
{
  public:
    /* expected: the number of shapes, if it is known; else 0 */
    explicit Scene(size_t expected) : Scene(cylint_scene_begin(expected))
    {
    }

    /* Takes a scene that was begun. */
    explicit Scene(cylint_scene *begun) : scene(begun), n(0)
    {
        if (!scene)
            throw std::bad_alloc();
        n = cylint_scene_size(begun);
    }

    /* shapes: (n), contiguous */
    void add(Input shapes)
    {
        const size_t more = shapes.shape(0);
        cylint_scene_status status;
        {
            nb::gil_scoped_release released;
            status =
                cylint_scene_add(scene.get(), as_shape(shapes.data()), more);
        }
        check(status);
        n += more;
    }

    /* Opens a file, or the bytes of one.  Returns (Scene or None, errno or 0, a
     * message or None). */
    static nb::tuple open(const nb::bytes &path, bool read, bool trusted)
    {
        const unsigned flags =
            read * static_cast<unsigned>(CYLINT_SCENE_READ) |
            trusted * static_cast<unsigned>(CYLINT_SCENE_TRUSTED);
        cylint_scene_status status;
        cylint_scene *opened;
        int error;
        {
            nb::gil_scoped_release released;
            opened = cylint_scene_open(path.c_str(), flags, &status);
            error = errno;
        }
        return opened_or_not(opened, status, error, nb::object());
    }

    static nb::tuple open_bytes(const nb::bytes &bytes)
    {
        cylint_scene_status status;
        cylint_scene *opened;
        {
            nb::gil_scoped_release released;
            opened = cylint_scene_open_memory(bytes.data(), bytes.size(), 0,
                                              &status);
        }
        /* The library copies bytes at other addresses. */
        const bool in_place =
            reinterpret_cast<uintptr_t>(bytes.data()) % 64 == 0;
        return opened_or_not(opened, status, 0,
                             in_place ? nb::object(bytes) : nb::object());
    }

    /* Returns errno, or 0. */
    int save(const nb::bytes &path) const
    {
        cylint_scene_status status;
        int error;
        {
            nb::gil_scoped_release released;
            status = cylint_scene_save(scene.get(), path.c_str());
            error = errno;
        }
        if (status == CYLINT_SCENE_EFILE)
            return error;
        check(status);
        return 0;
    }

    /* The bytes of the file that save() writes. */
    nb::object to_bytes() const
    {
        size_t size = 0;
        check(cylint_scene_write(scene.get(), count_bytes, &size));
        nb::object bytes = nb::steal(
            PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
        if (!bytes.is_valid())
            throw std::bad_alloc();
        char *to = PyBytes_AsString(bytes.ptr());
        nb::gil_scoped_release released;
        cylint_scene_write(scene.get(), copy_bytes, &to);
        return bytes;
    }

    /* Gives a finished scene its labels, a list of bytes, once. */
    void set_labels(const nb::list &labels)
    {
        if (cylint_scene_get_labels(scene.get()))
            return;
        std::vector<uint64_t> ends;
        std::string text;
        for (nb::handle label : labels) {
            const auto bytes = nb::cast<nb::bytes>(label);
            text.append(bytes.c_str(), bytes.size());
            ends.push_back(text.size());
        }
        label_ends = std::move(ends);
        label_text = std::move(text);
        const cylint_scene_labels all{label_ends.data(), label_text.data()};
        cylint_scene_set_labels(scene.get(), &all);
    }

    /* The labels as texts, or None if there are none. */
    nb::object labels() const
    {
        const cylint_scene_labels *const all =
            cylint_scene_get_labels(scene.get());
        return all ? label_texts(all->end, all->text, n) : nb::none();
    }

    void finish(int threads, const Callback &progress)
    {
        cylint_scene_status status;
        Build build{Listener(progress, n), nullptr};
        {
            nb::gil_scoped_release released;
            status = cylint_scene_finish(scene.get(), threads, Build::listen,
                                         &build);
        }
        if (build.failure)
            std::rethrow_exception(build.failure);
        check(status);
        build.listener.end();
    }

    size_t size() const
    {
        return n;
    }

    /* Writes the shapes with these numbers (int64, contiguous), -1 for a shape
     * that nothing hits, or all shapes if numbers is None.  closed: as closed
     * solids. */
    void take(std::optional<Input> numbers, Output shapes, bool closed) const
    {
        auto *const shape = static_cast<cylint_shape *>(shapes.data());
        const auto *const number =
            numbers ? static_cast<const int64_t *>(numbers->data()) : nullptr;
        nb::gil_scoped_release released;
        for (size_t i = 0; i < shapes.shape(0); i++) {
            const int64_t at = number ? number[i] : static_cast<int64_t>(i);
            if (at < 0)
                shape[i] = cylint_shape{};
            else
                cylint_scene_shape(scene.get(), static_cast<size_t>(at),
                                   &shape[i]);
            if (closed && shape[i].ends < CYLINT_ENDS_INFINITE)
                shape[i].ends = CYLINT_ENDS_CAPPED;
        }
    }

    size_t bytes() const
    {
        return cylint_scene_bytes(scene.get());
    }

    /* columns: index (int64), t, part.  All return false, or None, if a line is
     * refused and not masked. */
    bool nearest(const Lines &lines, Outputs columns, int threads,
                 const Callback &progress) const
    {
        return ask(lines, columns, {0, 0, 0}, threads, progress,
                   [this](const Part &part, size_t i, const cylint_line &line) {
                       cylint_hit hit;
                       const size_t found = cylint_scene_nearest_other(
                           scene.get(), &line, left_out(part, i),
                           CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
                       write_hit(part, i, found, found < n ? &hit : nullptr);
                   });
    }

    /* columns: bool */
    bool any(const Lines &lines, Outputs columns, int threads,
             const Callback &progress) const
    {
        return ask(lines, columns, {0}, threads, progress,
                   [this](const Part &part, size_t i, const cylint_line &line) {
                       part.value<bool>(COLUMNS, i) = cylint_scene_occluded(
                           scene.get(), &line, left_out(part, i));
                   });
    }

    /* columns: int64 */
    bool count(const Lines &lines, Outputs columns, int threads,
               const Callback &progress) const
    {
        return ask(lines, columns, {0}, threads, progress,
                   [this](const Part &part, size_t i, const cylint_line &line) {
                       const size_t except = left_out(part, i);
                       const size_t count =
                           cylint_scene_count(scene.get(), &line, 0);
                       const bool less = except < n && is_hit(except, line);
                       part.value<int64_t>(COLUMNS, i) =
                           static_cast<int64_t>(count - less);
                   });
    }

    /* Returns (line, index, t (..., 2)). */
    nb::object all(const Lines &lines, int threads,
                   const Callback &progress) const
    {
        return rows<2, 2>(
            lines, true, threads, progress,
            [this](auto &to, const Part &part, size_t i,
                   const cylint_line &line) {
                const size_t except = left_out(part, i);
                const auto query = [&](size_t from, size_t *numbers) {
                    return cylint_scene_all(scene.get(), &line, from, numbers,
                                            CAPACITY);
                };
                each_found(query, [&](size_t index) {
                    if (index == except)
                        return;
                    cylint_shape shape;
                    cylint_answer answer;
                    cylint_scene_shape(scene.get(), index, &shape);
                    cylint_intersect(&shape, &line, CYLINT_WANT_T, &answer);
                    to.push_back(
                        {{number(part, i), integer(index)},
                         {answer.n > 0 ? answer.hit[0].t : not_a_number,
                          answer.n > 1 ? answer.hit[1].t : not_a_number}});
                });
            });
    }

    /* Members of solids: (k, 3) int64, contiguous: shape, solid, clause. */
    void set_solids(Input members)
    {
        const auto *const row = static_cast<const int64_t *>(members.data());
        std::vector<cylint_member> all;
        for (size_t i = 0; i < members.shape(0); i++)
            all.push_back({static_cast<size_t>(row[3 * i]),
                           static_cast<size_t>(row[3 * i + 1]),
                           static_cast<int>(row[3 * i + 2])});
        check(cylint_scene_set_solids(scene.get(), all.data(), all.size()));
    }

    size_t members() const
    {
        return cylint_scene_members(scene.get());
    }

    void solids(Output members) const
    {
        auto *const row = static_cast<int64_t *>(members.data());
        for (size_t i = 0; i < members.shape(0); i++) {
            cylint_member member;
            cylint_scene_member(scene.get(), i, &member);
            row[3 * i] = integer(member.shape);
            row[3 * i + 1] = integer(member.solid);
            row[3 * i + 2] = member.clause;
        }
    }

    /* first: 0 for all pieces.  Returns (line, shape, depth, t0, t1). */
    nb::object pieces(const Lines &lines, int mode, Integers rank, size_t first,
                      int threads, const Callback &progress) const
    {
        const cylint_piece_rule rule = rule_of(mode, rank);
        return rows<3, 2>(
            lines, false, threads, progress,
            [&](auto &to, const Part &part, size_t i, const cylint_line &line) {
                std::vector<cylint_piece> some(first > 0 ? first : CAPACITY);
                size_t found;
                for (;;) {
                    found = with_workspace([&](cylint_workspace *work) {
                        return cylint_scene_pieces(scene.get(), &line, &rule,
                                                   some.data(), some.size(),
                                                   work);
                    });
                    if (first > 0 || found < some.size())
                        break;
                    some.resize(2 * some.size());
                }
                for (size_t k = 0; k < found; k++)
                    to.push_back({{number(part, i), integer(some[k].shape),
                                   integer(some[k].depth)},
                                  {some[k].t0, some[k].t1}});
            });
    }

    /* sums: (..., labels), the last axis contiguous. */
    bool sums(const Lines &lines, int mode, Integers rank, Integers label,
              bool in_units, Output sums, int threads,
              const Callback &progress) const
    {
        const cylint_piece_rule rule = rule_of(mode, rank);
        const size_t labels = sums.shape(sums.ndim() - 1);
        return ask(
            lines, {sums}, {1}, threads, progress,
            [&](const Part &part, size_t i, const cylint_line &line) {
                if (cylint_scene_line_sums(scene.get(), &line, &rule,
                                           integers_of(label), labels, in_units,
                                           &part.value<double>(COLUMNS, i)) !=
                    CYLINT_SCENE_OK)
                    throw std::bad_alloc();
            });
    }

    /* columns: index (int64), t, part, side, point (..., 3), normal (..., 3) */
    bool first_boundary(const Lines &lines, Outputs columns, int threads,
                        const Callback &progress) const
    {
        return ask(
            lines, columns, {0, 0, 0, 0, 1, 1}, threads, progress,
            [this](const Part &part, size_t i, const cylint_line &line) {
                cylint_hit hit;
                const size_t found =
                    with_workspace([&](cylint_workspace *work) {
                        return cylint_scene_first_boundary(
                            scene.get(), &line, CYLINT_WANT_ALL, &hit, work);
                    });
                const bool is_found = found < n;
                const int side = is_found ? static_cast<int>(hit.side) : -1;
                write_hit(part, i, found, is_found ? &hit : nullptr);
                part.value<signed char>(COLUMNS + 3, i) =
                    static_cast<signed char>(side);
                for (size_t k = 0; k < 3; k++) {
                    part.value<double>(COLUMNS + 4, i, k) =
                        is_found ? hit.point[k] : not_a_number;
                    part.value<double>(COLUMNS + 5, i, k) =
                        is_found ? hit.normal[k] : not_a_number;
                }
            });
    }

    /* columns: depth, index (int64).  radii: of no effect. */
    void depth(Input points, Input radii, Integers rank, Outputs columns,
               int threads, const Callback &progress) const
    {
        each_ball(balls(points, radii, columns), points, threads, progress,
                  [&](const Part &part, size_t i, const double *point, double) {
                      size_t owner = n;
                      const size_t count =
                          with_workspace([&](cylint_workspace *work) {
                              return cylint_scene_depth(scene.get(), point,
                                                        integers_of(rank),
                                                        &owner, work);
                          });
                      part.value<int64_t>(BEHIND_BALLS, i) = integer(count);
                      part.value<int64_t>(BEHIND_BALLS + 1, i) =
                          number_of(owner);
                  });
    }

    /* columns: index (int64), distance */
    void closest(Input points, Input radii, bool is_signed, Outputs columns,
                 int threads, const Callback &progress) const
    {
        const unsigned want = is_signed ? CYLINT_SIGNED : 0;
        each_ball(balls(points, radii, columns), points, threads, progress,
                  [this, want](const Part &part, size_t i, const double *point,
                               double radius) {
                      cylint_closest answer;
                      const size_t found = cylint_scene_closest(
                          scene.get(), point, radius, want, &answer);
                      part.value<int64_t>(BEHIND_BALLS, i) = number_of(found);
                      part.value<double>(BEHIND_BALLS + 1, i) =
                          found < n ? answer.distance : not_a_number;
                  });
    }

    /* columns: int64 */
    void within_count(Input points, Input radii, bool is_signed,
                      Outputs columns, int threads,
                      const Callback &progress) const
    {
        const unsigned want = is_signed ? CYLINT_SIGNED : 0;
        each_ball(balls(points, radii, columns), points, threads, progress,
                  [this, want](const Part &part, size_t i, const double *point,
                               double radius) {
                      part.value<int64_t>(BEHIND_BALLS, i) =
                          integer(cylint_scene_within_count(scene.get(), point,
                                                            radius, want, 0));
                  });
    }

    /* columns: int64.  radii: of no effect. */
    void contains(Input points, Input radii, Outputs columns, int threads,
                  const Callback &progress) const
    {
        each_ball(
            balls(points, radii, columns), points, threads, progress,
            [this](const Part &part, size_t i, const double *point, double) {
                part.value<int64_t>(BEHIND_BALLS, i) =
                    integer(cylint_scene_contains(scene.get(), point, 0));
            });
    }

    /* Returns (point, index, distance). */
    nb::tuple within(Input points, Input radii, bool is_signed, int threads,
                     const Callback &progress) const
    {
        const unsigned want = is_signed ? CYLINT_SIGNED : 0;
        const Grid grid = balls(points, radii, {}, true);
        Rows<2, 1> found(grid);
        each_ball(
            grid, points, threads, progress,
            [&](const Part &part, size_t i, const double *point,
                double radius) {
                const auto query = [&](size_t from, size_t *numbers) {
                    return cylint_scene_within(scene.get(), point, radius, want,
                                               from, numbers, nullptr,
                                               CAPACITY);
                };
                each_found(query, [&](size_t index) {
                    cylint_shape shape;
                    cylint_closest answer;
                    cylint_scene_shape(scene.get(), index, &shape);
                    found.blocks[part.block].push_back(
                        {{number(part, i), integer(index)},
                         {cylint_distance(&shape, point, want, &answer)}});
                });
            });
        return found.columns(false);
    }

  private:
    enum { COLUMNS = BEHIND_LINES };
    struct Free {
        void operator()(cylint_scene *p) const
        {
            cylint_scene_free(p);
        }
    };

    static int64_t integer(size_t value)
    {
        return static_cast<int64_t>(value);
    }

    static int64_t number(const Part &part, size_t i)
    {
        return integer(part.number + i);
    }

    /* -1 if none is found */
    int64_t number_of(size_t found) const
    {
        return found < n ? integer(found) : -1;
    }

    /* The shape that a line leaves out, or n. */
    size_t left_out(const Part &part, size_t i) const
    {
        const auto index = part.value<int64_t>(LEFT_OUT, i);
        return index < 0 ? n : static_cast<size_t>(index);
    }

    static const int *integers_of(const Integers &array)
    {
        return array ? static_cast<const int *>(array->data()) : nullptr;
    }

    static cylint_piece_rule rule_of(int mode, const Integers &rank)
    {
        return {static_cast<cylint_piece_mode>(mode), integers_of(rank),
                nullptr};
    }

    /* Writes index, t and part. */
    void write_hit(const Part &part, size_t i, size_t found,
                   const cylint_hit *hit) const
    {
        part.value<int64_t>(COLUMNS, i) = number_of(found);
        part.value<double>(COLUMNS + 1, i) = hit ? hit->t : not_a_number;
        const int of = hit ? static_cast<int>(hit->part) : -1;
        part.value<signed char>(COLUMNS + 2, i) = static_cast<signed char>(of);
    }

    /* Calls function(part, i, line) for each line.  inner: the axes of an element of
     * each column. */
    template <class Function>
    static bool ask(const Lines &lines, const Outputs &columns,
                    const std::vector<size_t> &inner, int threads,
                    const Callback &progress, const Function &function)
    {
        Grid grid;
        lines.add_to(grid);
        for (size_t k = 0; k < columns.size(); k++)
            grid.add(columns[k], inner[k]);
        grid.finish(false);
        return each_line(grid, lines, threads, progress, function);
    }

    /* Calls function(rows, part, i, line) for each line.  Returns the rows in the
     * order of the lines, as Rows::columns(), or None. */
    template <size_t INTEGERS, size_t DOUBLES, class Function>
    static nb::object rows(const Lines &lines, bool pairs, int threads,
                           const Callback &progress, const Function &function)
    {
        Grid grid;
        lines.add_to(grid);
        grid.finish(true);
        Rows<INTEGERS, DOUBLES> found(grid);
        const bool good =
            each_line(grid, lines, threads, progress,
                      [&](const Part &part, size_t i, const cylint_line &line) {
                          function(found.blocks[part.block], part, i, line);
                      });
        return good ? nb::object(found.columns(pairs)) : nb::none();
    }

    static Grid balls(const Input &points, const Input &radii,
                      const Outputs &columns, bool in_order = false)
    {
        Grid grid;
        grid.add(points, 1);
        grid.add(radii);
        for (const auto &column : columns)
            grid.add(column);
        grid.finish(in_order);
        return grid;
    }

    /* Calls query(from, numbers), which finds at most CAPACITY shapes, until all
     * are found, and write(number) for each one. */
    template <class Query, class Write>
    static void each_found(const Query &query, const Write &write)
    {
        size_t numbers[CAPACITY], found, from = 0;
        do {
            found = query(from, numbers);
            for (size_t i = 0; i < found; i++)
                write(numbers[i]);
            from = found > 0 ? numbers[found - 1] + 1 : 0;
        } while (found == CAPACITY);
    }

    bool is_hit(size_t index, const cylint_line &line) const
    {
        cylint_shape shape;
        cylint_scene_shape(scene.get(), index, &shape);
        return cylint_occluded(&shape, &line) != 0;
    }

    static nb::tuple opened_or_not(cylint_scene *opened,
                                   cylint_scene_status status, int error,
                                   nb::object memory)
    {
        if (opened) {
            auto made = std::make_unique<Scene>(opened);
            made->memory = std::move(memory);
            return nb::make_tuple(nb::cast(std::move(made)), 0, nb::none());
        }
        if (status == CYLINT_SCENE_EMEMORY)
            throw std::bad_alloc();
        return nb::make_tuple(nb::none(),
                              status == CYLINT_SCENE_EFILE ? error : 0,
                              nb::str(cylint_scene_strerror(status)));
    }

    static int count_bytes(void *size, const void *, size_t more)
    {
        *static_cast<size_t *>(size) += more;
        return 1;
    }

    static int copy_bytes(void *to, const void *from, size_t size)
    {
        std::memcpy(*static_cast<char **>(to), from, size);
        *static_cast<char **>(to) += size;
        return 1;
    }

    static void check(cylint_scene_status status)
    {
        if (status == CYLINT_SCENE_EMEMORY)
            throw std::bad_alloc();
        if (status != CYLINT_SCENE_OK)
            throw nb::value_error(cylint_scene_strerror(status));
    }

    nb::object memory; /* of the scene, if it was opened there */
    std::vector<uint64_t> label_ends;
    std::string label_text;
    std::unique_ptr<cylint_scene, Free> scene;
    size_t n;
};

} // namespace

nb::object scene_object(cylint_scene *begun)
{
    return begun ? nb::cast(std::make_unique<Scene>(begun)) : nb::none();
}

void register_scene(nb::module_ &module)
{
    nb::class_<Scene>(module, "Scene")
        .def(nb::init<size_t>())
        .def("add", &Scene::add)
        .def("finish", &Scene::finish)
        .def_static("open", &Scene::open)
        .def_static("open_bytes", &Scene::open_bytes)
        .def("save", &Scene::save)
        .def("to_bytes", &Scene::to_bytes)
        .def("set_labels", &Scene::set_labels)
        .def("labels", &Scene::labels)
        .def("size", &Scene::size)
        .def("take", &Scene::take)
        .def("bytes", &Scene::bytes)
        .def("nearest", &Scene::nearest)
        .def("any", &Scene::any)
        .def("count", &Scene::count)
        .def("all", &Scene::all)
        .def("set_solids", &Scene::set_solids)
        .def("members", &Scene::members)
        .def("solids", &Scene::solids)
        .def("pieces", &Scene::pieces)
        .def("sums", &Scene::sums)
        .def("depth", &Scene::depth)
        .def("first_boundary", &Scene::first_boundary)
        .def("closest", &Scene::closest)
        .def("within_count", &Scene::within_count)
        .def("contains", &Scene::contains)
        .def("within", &Scene::within);
}
