/*
 * scene.cc - libcylint-scene: many lines at many shapes
 */
#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include <nanobind/stl/unique_ptr.h>

#include "calls.h"
#include "cylint_scene.h"
#include "work.h"

namespace
{

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr size_t BLOCK = 256; /* lines */

/* A shape that a line hits, and its t: NaN for none. */
struct Hit {
    int64_t line, index;
    double t[2];
};

/* The hits of each block of lines. */
struct Hits {
    explicit Hits(size_t count) : blocks(count)
    {
    }
    std::vector<std::vector<Hit>> blocks;

    size_t size() const
    {
        size_t sum = 0;
        for (const auto &block : blocks)
            sum += block.size();
        return sum;
    }

    /* columns: line, index, t (..., 2), contiguous */
    void write(nb::tuple columns) const
    {
        const Array line(columns[0], true), index(columns[1], true),
            t(columns[2], true);
        auto *to_line = reinterpret_cast<int64_t *>(line.data());
        auto *to_index = reinterpret_cast<int64_t *>(index.data());
        auto *to_t = reinterpret_cast<double *>(t.data());
        for (const auto &block : blocks) {
            for (const Hit &hit : block) {
                *to_line++ = hit.line;
                *to_index++ = hit.index;
                *to_t++ = hit.t[0];
                *to_t++ = hit.t[1];
            }
        }
    }
};

class Scene
{
  public:
    /* records: a contiguous array of shapes (n), which must not change */
    Scene(nb::handle records, int threads)
        : shapes(records), n(static_cast<size_t>(shapes.size(0)))
    {
        cylint_scene_status status;
        {
            nb::gil_scoped_release released;
            scene.reset(cylint_scene_new(
                reinterpret_cast<const cylint_shape *>(shapes.data()), n,
                threads, &status));
        }
        if (!scene && status == CYLINT_SCENE_EMEMORY)
            throw std::bad_alloc();
        if (!scene)
            throw nb::value_error(cylint_scene_strerror(status));
    }

    size_t bytes() const
    {
        return cylint_scene_bytes(scene.get());
    }

    /* columns: index (int64), t, part.  All return false if a line is
     * refused. */
    bool nearest(const Lines &lines, nb::tuple columns, int threads,
                 nb::handle progress) const
    {
        const Array index(columns[0], true), t(columns[1], true),
            part(columns[2], true);
        const Array *const outputs[] = {&index, &t, &part};
        return each(lines, outputs, threads, progress,
                    [this](const cylint_line &line, char *const *to, size_t) {
                        cylint_hit hit;
                        const size_t found = cylint_scene_nearest(
                            scene.get(), &line,
                            CYLINT_WANT_T | CYLINT_WANT_PART, &hit);
                        const bool any = found < n;
                        *reinterpret_cast<int64_t *>(to[0]) =
                            any ? static_cast<int64_t>(found) : -1;
                        *reinterpret_cast<double *>(to[1]) = any ? hit.t : nan;
                        *to[2] = static_cast<char>(any ? hit.part : -1);
                    });
    }

    /* columns: an array of int64, or of bool if enough = 1 */
    bool count(const Lines &lines, nb::handle counts, size_t enough,
               int threads, nb::handle progress) const
    {
        const Array to(counts, true);
        const Array *const outputs[] = {&to};
        if (enough == 1)
            return each(
                lines, outputs, threads, progress,
                [this](const cylint_line &line, char *const *at, size_t) {
                    *at[0] = static_cast<char>(
                        cylint_scene_occluded(scene.get(), &line, n));
                });
        return each(
            lines, outputs, threads, progress,
            [this, enough](const cylint_line &line, char *const *at, size_t) {
                *reinterpret_cast<int64_t *>(at[0]) = static_cast<int64_t>(
                    cylint_scene_count(scene.get(), &line, enough));
            });
    }

    /* The hits of all lines, which have one axis, in order; nullptr if a line
     * is refused. */
    std::unique_ptr<Hits> all(const Lines &lines, int threads,
                              nb::handle progress) const
    {
        const Array *const none[] = {&lines.starts};
        const size_t count = static_cast<size_t>(lines.starts.size(0));
        auto hits = std::make_unique<Hits>((count + BLOCK - 1) / BLOCK);
        const bool good =
            each(lines, none, threads, progress,
                 [&](const cylint_line &line, char *const *, size_t number) {
                     add_hits(line, static_cast<int64_t>(number),
                              hits->blocks[number / BLOCK]);
                 });
        return good ? std::move(hits) : nullptr;
    }

  private:
    struct Free {
        void operator()(cylint_scene *p) const
        {
            cylint_scene_free(p);
        }
    };

    void add_hits(const cylint_line &line, int64_t number,
                  std::vector<Hit> &hits) const
    {
        enum { CAPACITY = 128 };
        size_t numbers[CAPACITY], found, from = 0;
        const auto *const first =
            reinterpret_cast<const cylint_shape *>(shapes.data());
        do {
            found =
                cylint_scene_all(scene.get(), &line, from, numbers, CAPACITY);
            for (size_t i = 0; i < found; i++) {
                cylint_answer answer;
                cylint_intersect(first + numbers[i], &line, CYLINT_WANT_T,
                                 &answer);
                hits.push_back({number,
                                static_cast<int64_t>(numbers[i]),
                                {answer.n > 0 ? answer.hit[0].t : nan,
                                 answer.n > 1 ? answer.hit[1].t : nan}});
            }
            from = found > 0 ? numbers[found - 1] + 1 : 0;
        } while (found == CAPACITY);
    }

    /* Calls function(line, addresses, number) for each line and the elements of
     * the arrays that belong to it.  Returns false if a line is refused. */
    template <size_t N, class Function>
    static bool each(const Lines &lines, const Array *const (&arrays)[N],
                     int threads, nb::handle progress, const Function &function)
    {
        Grid grid(lines.starts, 0);
        lines.add_to(grid);
        for (const Array *array : arrays)
            grid.add(*array);
        grid.prepare();
        const size_t pieces = (grid.row() + BLOCK - 1) / BLOCK;
        std::atomic<bool> good{true};
        work(grid.rows() * pieces, grid.elements(), threads, progress,
             [&](int, size_t block) {
                 std::vector<char *> p;
                 grid.locate(block / pieces, p);
                 const size_t begin = block % pieces * BLOCK;
                 const size_t end = std::min(begin + BLOCK, grid.row());
                 for (size_t a = 0; a < p.size(); a++)
                     p[a] += static_cast<ptrdiff_t>(begin) *
                             grid.stride(static_cast<int>(a));
                 for (size_t i = begin; i < end && good; i++) {
                     cylint_line line;
                     if (lines.make(p.data(), &line) != CYLINT_OK) {
                         good = false;
                         break;
                     }
                     function(line, &p[4], block / pieces * grid.row() + i);
                     for (size_t a = 0; a < p.size(); a++)
                         p[a] += grid.stride(static_cast<int>(a));
                 }
                 return good.load();
             });
        return good;
    }

    const Array shapes;
    const size_t n;
    std::unique_ptr<cylint_scene, Free> scene;
};

} // namespace

void register_scene(nb::module_ &module)
{
    nb::class_<Scene>(module, "Scene")
        .def(nb::init<nb::handle, int>())
        .def("bytes", &Scene::bytes)
        .def("nearest", &Scene::nearest, nb::arg("lines"), nb::arg("columns"),
             nb::arg("threads"), nb::arg("progress").none())
        .def("count", &Scene::count, nb::arg("lines"), nb::arg("counts"),
             nb::arg("enough"), nb::arg("threads"), nb::arg("progress").none())
        .def("all", &Scene::all, nb::arg("lines"), nb::arg("threads"),
             nb::arg("progress").none());
    nb::class_<Hits>(module, "Hits")
        .def("size", &Hits::size)
        .def("write", &Hits::write, nb::arg("columns"));
}
