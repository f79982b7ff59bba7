/*
 * scene.cc - libcylint-scene: many lines or points, and many shapes
 */
#include <cerrno>
#include <exception>
#include <initializer_list>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/stl/unique_ptr.h>

#include "calls.h"
#include "cylint_scene.h"
#include "elements.h"

namespace
{

constexpr size_t BLOCK = 256; /* lines or points */
enum { CAPACITY = 128 };      /* shapes of one call of the library */

/* A shape that belongs to a line or point: both t, NaN for none; or the
 * distance. */
struct Row {
    int64_t asked, index;
    double value[2];
};

/* The shapes of each block of lines or points. */
struct Found {
    Found(size_t count, size_t values)
        : blocks((count + BLOCK - 1) / BLOCK), width(values)
    {
    }
    std::vector<std::vector<Row>> blocks;
    const size_t width; /* values of a row */

    size_t size() const
    {
        size_t sum = 0;
        for (const auto &block : blocks)
            sum += block.size();
        return sum;
    }

    /* columns: number of the line or point, index, values (..., width),
     * contiguous */
    void write(nb::tuple columns) const
    {
        const Array asked(columns[0], true), index(columns[1], true),
            value(columns[2], true);
        auto *to_asked = reinterpret_cast<int64_t *>(asked.data());
        auto *to_index = reinterpret_cast<int64_t *>(index.data());
        auto *to_value = reinterpret_cast<double *>(value.data());
        for (const auto &block : blocks) {
            for (const Row &row : block) {
                *to_asked++ = row.asked;
                *to_index++ = row.index;
                for (size_t k = 0; k < width; k++)
                    *to_value++ = row.value[k];
            }
        }
    }
};

/* The pieces of each block of lines. */
struct Pieces {
    struct Row {
        int64_t line;
        cylint_piece piece;
    };
    explicit Pieces(size_t count) : blocks((count + BLOCK - 1) / BLOCK)
    {
    }
    std::vector<std::vector<Row>> blocks;

    size_t size() const
    {
        size_t sum = 0;
        for (const auto &block : blocks)
            sum += block.size();
        return sum;
    }

    /* columns: line, shape, depth (int64), t0, t1, contiguous */
    void write(nb::tuple columns) const
    {
        const Array line(columns[0], true), shape(columns[1], true),
            depth(columns[2], true), t0(columns[3], true), t1(columns[4], true);
        size_t i = 0;
        for (const auto &block : blocks) {
            for (const Row &row : block) {
                at<int64_t>(line, i) = row.line;
                at<int64_t>(shape, i) = static_cast<int64_t>(row.piece.shape);
                at<int64_t>(depth, i) = static_cast<int64_t>(row.piece.depth);
                at<double>(t0, i) = row.piece.t0;
                at<double>(t1, i++) = row.piece.t1;
            }
        }
    }

  private:
    template <class T> static T &at(const Array &array, size_t i)
    {
        return reinterpret_cast<T *>(array.data())[i];
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

void put(char *to, int64_t value)
{
    *reinterpret_cast<int64_t *>(to) = value;
}

void put(char *to, double value)
{
    *reinterpret_cast<double *>(to) = value;
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

    /* records: a contiguous array of shapes */
    void add(nb::handle records)
    {
        const Array shapes(records);
        const auto more = static_cast<size_t>(shapes.size(0));
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
        const unsigned flags = (read ? CYLINT_SCENE_READ : 0U) |
                               (trusted ? CYLINT_SCENE_TRUSTED : 0U);
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

    void finish(int threads, nb::handle progress)
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
    void take(nb::handle numbers, nb::handle records, bool closed) const
    {
        const Array wanted(numbers), to(records, true);
        auto *const shape = reinterpret_cast<cylint_shape *>(to.data());
        const auto *const number =
            reinterpret_cast<const int64_t *>(wanted.data());
        const auto count = static_cast<size_t>(to.size(0));
        nb::gil_scoped_release released;
        for (size_t i = 0; i < count; i++) {
            const int64_t at = wanted ? number[i] : static_cast<int64_t>(i);
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

    /* exclude: for each line the number (int64) of a shape that is left out,
     * below 0 for none.  columns: index (int64), t, part.  All return false if a
     * line is refused and not masked. */
    bool nearest(const Lines &lines, nb::handle exclude, nb::tuple columns,
                 int threads, nb::handle progress) const
    {
        const Array index(columns[0], true), t(columns[1], true),
            part(columns[2], true);
        return each_line(lines, exclude, {&index, &t, &part}, threads, progress,
                         [this](const cylint_line &line, size_t except,
                                char *const *to, size_t) {
                             cylint_hit hit;
                             const size_t found = cylint_scene_nearest_other(
                                 scene.get(), &line, except,
                                 CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
                             put(to[0], number_of(found));
                             put(to[1], found < n ? hit.t : not_a_number);
                             *to[2] =
                                 static_cast<char>(found < n ? hit.part : -1);
                         });
    }

    /* answers: bool */
    bool any(const Lines &lines, nb::handle exclude, nb::handle answers,
             int threads, nb::handle progress) const
    {
        const Array to(answers, true);
        return each_line(lines, exclude, {&to}, threads, progress,
                         [this](const cylint_line &line, size_t except,
                                char *const *at, size_t) {
                             *at[0] = static_cast<char>(cylint_scene_occluded(
                                 scene.get(), &line, except));
                         });
    }

    /* counts: int64 */
    bool count(const Lines &lines, nb::handle exclude, nb::handle counts,
               int threads, nb::handle progress) const
    {
        const Array to(counts, true);
        return each_line(lines, exclude, {&to}, threads, progress,
                         [this](const cylint_line &line, size_t except,
                                char *const *at, size_t) {
                             const size_t count =
                                 cylint_scene_count(scene.get(), &line, 0);
                             const int left_out =
                                 except < n && is_hit(except, line);
                             put(at[0], static_cast<int64_t>(count) - left_out);
                         });
    }

    /* The hits of all lines, which have one axis, in order; nullptr if a line
     * is refused and not masked. */
    std::unique_ptr<Found> all(const Lines &lines, nb::handle exclude,
                               int threads, nb::handle progress) const
    {
        auto found = std::make_unique<Found>(
            static_cast<size_t>(lines.starts.size(0)), 2);
        const bool good = each_line(lines, exclude, {}, threads, progress,
                                    [&](const cylint_line &line, size_t except,
                                        char *const *, size_t number) {
                                        add_hits(line, except, number,
                                                 found->blocks[number / BLOCK]);
                                    });
        return good ? std::move(found) : nullptr;
    }

    /* Members of solids: (k, 3) int64, contiguous: shape, solid, clause. */
    void set_solids(nb::handle members)
    {
        const Array from(members);
        const auto *const row = reinterpret_cast<const int64_t *>(from.data());
        std::vector<cylint_member> all;
        for (ptrdiff_t i = 0; i < from.size(0); i++)
            all.push_back({static_cast<size_t>(row[3 * i]),
                           static_cast<size_t>(row[3 * i + 1]),
                           static_cast<int>(row[3 * i + 2])});
        check(cylint_scene_set_solids(scene.get(), all.data(), all.size()));
    }

    size_t members() const
    {
        return cylint_scene_members(scene.get());
    }

    void solids(nb::handle members) const
    {
        const Array to(members, true);
        auto *const row = reinterpret_cast<int64_t *>(to.data());
        for (ptrdiff_t i = 0; i < to.size(0); i++) {
            cylint_member member;
            cylint_scene_member(scene.get(), static_cast<size_t>(i), &member);
            row[3 * i] = static_cast<int64_t>(member.shape);
            row[3 * i + 1] = static_cast<int64_t>(member.solid);
            row[3 * i + 2] = member.clause;
        }
    }

    /* rank: int32 for each shape, contiguous, or None; first: 0 for all.  The
     * lines have one axis. */
    std::unique_ptr<Pieces> pieces(const Lines &lines, nb::handle exclude,
                                   int mode, nb::handle rank, size_t first,
                                   int threads, nb::handle progress) const
    {
        const Array ranks(rank);
        const cylint_piece_rule rule = rule_of(mode, ranks);
        auto found =
            std::make_unique<Pieces>(static_cast<size_t>(lines.starts.size(0)));
        const bool good = each_line(
            lines, exclude, {}, threads, progress,
            [&](const cylint_line &line, size_t, char *const *, size_t number) {
                add_pieces(line, rule, first, number,
                           found->blocks[number / BLOCK]);
            });
        return good ? std::move(found) : nullptr;
    }

    /* label: int32 for each shape, contiguous, or None; sums: (..., labels), the
     * last axis contiguous. */
    bool sums(const Lines &lines, nb::handle exclude, int mode, nb::handle rank,
              nb::handle label, bool in_units, nb::handle sums, int threads,
              nb::handle progress) const
    {
        const Array ranks(rank), labels(label), to(sums, true);
        const cylint_piece_rule rule = rule_of(mode, ranks);
        const auto columns = static_cast<size_t>(to.size(to.axes() - 1));
        return each_line(
            lines, exclude, {&to}, threads, progress,
            [&](const cylint_line &line, size_t, char *const *at, size_t) {
                if (cylint_scene_line_sums(
                        scene.get(), &line, &rule, integers_of(labels), columns,
                        in_units,
                        reinterpret_cast<double *>(at[0])) != CYLINT_SCENE_OK)
                    throw std::bad_alloc();
            });
    }

    /* columns: depth, index (int64).  radii: of no effect. */
    void depth(nb::handle points, nb::handle radii, nb::handle rank,
               nb::tuple columns, int threads, nb::handle progress) const
    {
        const Array ranks(rank), deep(columns[0], true),
            index(columns[1], true);
        each_ball(
            points, radii, {&deep, &index}, threads, progress,
            [&](const double(&point)[3], double, char *const *to, size_t) {
                size_t owner = n;
                const size_t count =
                    with_workspace([&](cylint_workspace *work) {
                        return cylint_scene_depth(scene.get(), point,
                                                  integers_of(ranks), &owner,
                                                  work);
                    });
                put(to[0], static_cast<int64_t>(count));
                put(to[1], number_of(owner));
            });
    }

    /* columns: index (int64), t, point (..., 3), normal (..., 3), side */
    bool first_boundary(const Lines &lines, nb::handle exclude,
                        nb::tuple columns, int threads,
                        nb::handle progress) const
    {
        const Array index(columns[0], true), t(columns[1], true),
            point(columns[2], true), normal(columns[3], true),
            side(columns[4], true), part(columns[5], true);
        return each_line(
            lines, exclude, {&index, &t, &point, &normal, &side, &part},
            threads, progress,
            [this](const cylint_line &line, size_t, char *const *to, size_t) {
                cylint_hit hit;
                const size_t found =
                    with_workspace([&](cylint_workspace *work) {
                        return cylint_scene_first_boundary(
                            scene.get(), &line, CYLINT_WANT_ALL, &hit, work);
                    });
                const bool is_found = found < n;
                put(to[0], number_of(found));
                put(to[1], is_found ? hit.t : not_a_number);
                for (size_t j = 0; j < 3; j++) {
                    put(to[2] + 8 * j, is_found ? hit.point[j] : not_a_number);
                    put(to[3] + 8 * j, is_found ? hit.normal[j] : not_a_number);
                }
                *to[4] = static_cast<char>(is_found ? hit.side : -1);
                *to[5] = static_cast<char>(is_found ? hit.part : -1);
            });
    }

    /* columns: index (int64), distance */
    void closest(nb::handle points, nb::handle radii, bool is_signed,
                 nb::tuple columns, int threads, nb::handle progress) const
    {
        const unsigned want = is_signed ? CYLINT_SIGNED : 0;
        const Array index(columns[0], true), distance(columns[1], true);
        each_ball(points, radii, {&index, &distance}, threads, progress,
                  [this, want](const double(&point)[3], double radius,
                               char *const *to, size_t) {
                      cylint_closest answer;
                      const size_t found = cylint_scene_closest(
                          scene.get(), point, radius, want, &answer);
                      put(to[0], number_of(found));
                      put(to[1], found < n ? answer.distance : not_a_number);
                  });
    }

    /* counts: int64 */
    void within_count(nb::handle points, nb::handle radii, bool is_signed,
                      nb::handle counts, int threads, nb::handle progress) const
    {
        const unsigned want = is_signed ? CYLINT_SIGNED : 0;
        const Array to(counts, true);
        each_ball(points, radii, {&to}, threads, progress,
                  [this, want](const double(&point)[3], double radius,
                               char *const *at, size_t) {
                      put(at[0], static_cast<int64_t>(cylint_scene_within_count(
                                     scene.get(), point, radius, want, 0)));
                  });
    }

    /* counts: int64.  radii: of no effect. */
    void contains(nb::handle points, nb::handle radii, nb::handle counts,
                  int threads, nb::handle progress) const
    {
        const Array to(counts, true);
        each_ball(
            points, radii, {&to}, threads, progress,
            [this](const double(&point)[3], double, char *const *at, size_t) {
                put(at[0], static_cast<int64_t>(
                               cylint_scene_contains(scene.get(), point, 0)));
            });
    }

    /* The shapes within the radius of each point, in order.  Points and radii
     * have one axis. */
    std::unique_ptr<Found> within(nb::handle points, nb::handle radii,
                                  bool is_signed, int threads,
                                  nb::handle progress) const
    {
        const unsigned want = is_signed ? CYLINT_SIGNED : 0;
        auto found = std::make_unique<Found>(nb::len(radii), 1);
        each_ball(points, radii, {}, threads, progress,
                  [&](const double(&point)[3], double radius, char *const *,
                      size_t number) {
                      add_shapes(point, radius, want, number,
                                 found->blocks[number / BLOCK]);
                  });
        return found;
    }

  private:
    struct Free {
        void operator()(cylint_scene *p) const
        {
            cylint_scene_free(p);
        }
    };
    using Arrays = std::initializer_list<const Array *>;

    /* int32, or nullptr for no array */
    static const int *integers_of(const Array &array)
    {
        return array ? reinterpret_cast<const int *>(array.data()) : nullptr;
    }

    static cylint_piece_rule rule_of(int mode, const Array &ranks)
    {
        return {static_cast<cylint_piece_mode>(mode), integers_of(ranks),
                nullptr};
    }

    void add_pieces(const cylint_line &line, const cylint_piece_rule &rule,
                    size_t most, size_t number,
                    std::vector<Pieces::Row> &rows) const
    {
        std::vector<cylint_piece> some(most > 0 ? most : CAPACITY);
        size_t found;
        for (;;) {
            found = with_workspace([&](cylint_workspace *work) {
                return cylint_scene_pieces(scene.get(), &line, &rule,
                                           some.data(), some.size(), work);
            });
            if (most > 0 || found < some.size())
                break;
            some.resize(2 * some.size());
        }
        for (size_t i = 0; i < found; i++)
            rows.push_back({static_cast<int64_t>(number), some[i]});
    }

    /* -1 if none is found */
    int64_t number_of(size_t found) const
    {
        return found < n ? static_cast<int64_t>(found) : -1;
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

    void add_hits(const cylint_line &line, size_t except, size_t asked,
                  std::vector<Row> &rows) const
    {
        each_found(
            [&](size_t from, size_t *numbers) {
                return cylint_scene_all(scene.get(), &line, from, numbers,
                                        CAPACITY);
            },
            [&](size_t index) {
                if (index == except)
                    return;
                cylint_shape shape;
                cylint_answer answer;
                cylint_scene_shape(scene.get(), index, &shape);
                cylint_intersect(&shape, &line, CYLINT_WANT_T, &answer);
                rows.push_back(
                    {static_cast<int64_t>(asked),
                     static_cast<int64_t>(index),
                     {answer.n > 0 ? answer.hit[0].t : not_a_number,
                      answer.n > 1 ? answer.hit[1].t : not_a_number}});
            });
    }

    void add_shapes(const double (&point)[3], double radius, unsigned want,
                    size_t asked, std::vector<Row> &rows) const
    {
        each_found(
            [&](size_t from, size_t *numbers) {
                return cylint_scene_within(scene.get(), point, radius, want,
                                           from, numbers, nullptr, CAPACITY);
            },
            [&](size_t index) {
                cylint_shape shape;
                cylint_closest answer;
                cylint_scene_shape(scene.get(), index, &shape);
                rows.push_back(
                    {static_cast<int64_t>(asked),
                     static_cast<int64_t>(index),
                     {cylint_distance(&shape, point, want, &answer)}});
            });
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

    /* Calls function(line, except, addresses, number) for each line, the number
     * of the shape that it leaves out, or n, and the elements of the arrays that
     * belong to it.  Returns false if a line is refused and not masked. */
    template <class Function>
    bool each_line(const Lines &lines, nb::handle exclude, Arrays arrays,
                   int threads, nb::handle progress,
                   const Function &function) const
    {
        const Array excluded(exclude);
        Grid grid(lines.starts, 0);
        lines.add_to(grid);
        grid.add(excluded);
        for (const Array *array : arrays)
            grid.add(*array);
        grid.prepare();
        return each_element(grid, BLOCK, threads, progress,
                            [&](char *const *at, size_t number) {
                                cylint_line line;
                                if (lines.make(at, &line) != CYLINT_OK &&
                                    !lines.masked)
                                    return false;
                                int64_t index;
                                std::memcpy(&index, at[4], sizeof index);
                                const size_t except =
                                    index < 0 ? n : static_cast<size_t>(index);
                                function(line, except, at + 5, number);
                                return true;
                            });
    }

    /* The same for points (..., 3) and radii (...):
     * function(point, radius, addresses, number). */
    template <class Function>
    static void each_ball(nb::handle points, nb::handle radii, Arrays arrays,
                          int threads, nb::handle progress,
                          const Function &function)
    {
        const Array p(points), r(radii);
        Grid grid(r, 0);
        grid.add(p), grid.add(r);
        for (const Array *array : arrays)
            grid.add(*array);
        grid.prepare();
        each_element(grid, BLOCK, threads, progress,
                     [&](char *const *at, size_t i) {
                         double point[3];
                         read_point(at[0], p.last_stride(), point);
                         function(point, number(at[1]), at + 2, i);
                         return true;
                     });
    }

    nb::object memory; /* of the scene, if it was opened there */
    std::vector<uint64_t> label_ends;
    std::string label_text;
    std::unique_ptr<cylint_scene, Free> scene;
    size_t n;
};

} // namespace

nb::object label_texts(const uint64_t *end, const char *text, size_t count)
{
    nb::list labels;
    uint64_t begin = 0;
    for (size_t i = 0; i < count; i++) {
        labels.append(nb::steal(PyUnicode_DecodeUTF8(
            text + begin, static_cast<Py_ssize_t>(end[i] - begin),
            "surrogateescape")));
        begin = end[i];
    }
    return labels;
}

nb::object scene_object(cylint_scene *begun)
{
    return begun ? nb::cast(std::make_unique<Scene>(begun)) : nb::none();
}

void register_scene(nb::module_ &module)
{
    nb::class_<Scene>(module, "Scene")
        .def(nb::init<size_t>(), nb::arg("expected"))
        .def("add", &Scene::add, nb::arg("records"))
        .def("finish", &Scene::finish, nb::arg("threads"),
             nb::arg("progress").none())
        .def_static("open", &Scene::open, nb::arg("path"), nb::arg("read"),
                    nb::arg("trusted"))
        .def_static("open_bytes", &Scene::open_bytes, nb::arg("bytes"))
        .def("save", &Scene::save, nb::arg("path"))
        .def("to_bytes", &Scene::to_bytes)
        .def("set_labels", &Scene::set_labels, nb::arg("labels"))
        .def("labels", &Scene::labels)
        .def("size", &Scene::size)
        .def("take", &Scene::take, nb::arg("numbers").none(),
             nb::arg("records"), nb::arg("closed"))
        .def("bytes", &Scene::bytes)
        .def("nearest", &Scene::nearest, nb::arg("lines"), nb::arg("exclude"),
             nb::arg("columns"), nb::arg("threads"), nb::arg("progress").none())
        .def("any", &Scene::any, nb::arg("lines"), nb::arg("exclude"),
             nb::arg("answers"), nb::arg("threads"), nb::arg("progress").none())
        .def("count", &Scene::count, nb::arg("lines"), nb::arg("exclude"),
             nb::arg("counts"), nb::arg("threads"), nb::arg("progress").none())
        .def("all", &Scene::all, nb::arg("lines"), nb::arg("exclude"),
             nb::arg("threads"), nb::arg("progress").none())
        .def("set_solids", &Scene::set_solids, nb::arg("members"))
        .def("members", &Scene::members)
        .def("solids", &Scene::solids, nb::arg("members"))
        .def("pieces", &Scene::pieces, nb::arg("lines"), nb::arg("exclude"),
             nb::arg("mode"), nb::arg("rank").none(), nb::arg("first"),
             nb::arg("threads"), nb::arg("progress").none())
        .def("sums", &Scene::sums, nb::arg("lines"), nb::arg("exclude"),
             nb::arg("mode"), nb::arg("rank").none(), nb::arg("label").none(),
             nb::arg("in_units"), nb::arg("sums"), nb::arg("threads"),
             nb::arg("progress").none())
        .def("depth", &Scene::depth, nb::arg("points"), nb::arg("radii"),
             nb::arg("rank").none(), nb::arg("columns"), nb::arg("threads"),
             nb::arg("progress").none())
        .def("first_boundary", &Scene::first_boundary, nb::arg("lines"),
             nb::arg("exclude"), nb::arg("columns"), nb::arg("threads"),
             nb::arg("progress").none())
        .def("closest", &Scene::closest, nb::arg("points"), nb::arg("radii"),
             nb::arg("is_signed"), nb::arg("columns"), nb::arg("threads"),
             nb::arg("progress").none())
        .def("within_count", &Scene::within_count, nb::arg("points"),
             nb::arg("radii"), nb::arg("is_signed"), nb::arg("counts"),
             nb::arg("threads"), nb::arg("progress").none())
        .def("contains", &Scene::contains, nb::arg("points"), nb::arg("radii"),
             nb::arg("counts"), nb::arg("threads"), nb::arg("progress").none())
        .def("within", &Scene::within, nb::arg("points"), nb::arg("radii"),
             nb::arg("is_signed"), nb::arg("threads"),
             nb::arg("progress").none());
    nb::class_<Pieces>(module, "Pieces")
        .def("size", &Pieces::size)
        .def("write", &Pieces::write, nb::arg("columns"));
    nb::class_<Found>(module, "Found")
        .def("size", &Found::size)
        .def("write", &Found::write, nb::arg("columns"));
}
