/*
 * elements.h - the elements that arrays of NumPy broadcast to, in blocks, by
 * several threads
 */
#ifndef CYLINT_PYTHON_ELEMENTS_H
#define CYLINT_PYTHON_ELEMENTS_H

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>

namespace nb = nanobind;

/* Arrays in place, with their strides. */
using Input = nb::ndarray<nb::ro, nb::device::cpu>;
using Output = nb::ndarray<nb::device::cpu>;
using Outputs = std::vector<std::optional<Output>>; /* None: not wanted */
/* Contiguous arrays, whose data() has this type. */
template <class Value>
using Array = nb::ndarray<Value, nb::c_contig, nb::device::cpu>;

/* Bytes from one element of the last axis to the next. */
inline ptrdiff_t last_step(const Input &array)
{
    return static_cast<ptrdiff_t>(array.stride(array.ndim() - 1) *
                                  static_cast<int64_t>(array.itemsize()));
}

/*
 * The elements of a call.  Arrays are added, then finish() is called.  An array has
 * the stride 0 along an axis in which it does not change.
 */
class Grid
{
  public:
    /* Returns the number of the array.  `inner` last axes belong to elements. */
    template <class Array> int add(const Array &array, size_t inner = 0)
    {
        const size_t outer = array.ndim() - inner;
        const int number = add_none(outer);
        bases.back() = static_cast<char *>(
            const_cast<void *>(static_cast<const void *>(array.data())));
        for (size_t i = 0; i < outer; i++) {
            if (array.shape(outer - 1 - i) == 1)
                continue;
            axes[i].length = array.shape(outer - 1 - i);
            axes[i].strides.back() =
                static_cast<ptrdiff_t>(array.stride(outer - 1 - i)) *
                static_cast<ptrdiff_t>(array.itemsize());
        }
        return number;
    }
    template <class Array>
    int add(const std::optional<Array> &array, size_t inner = 0)
    {
        return array ? add(*array, inner) : add_none(0);
    }
    /* Joins axes along which all arrays go on with one stride, and moves the
     * longest to the front: the row.  in_order: elements stay in C order. */
    void finish(bool in_order);

    /* The number of axes to which the arrays broadcast, before finish(). */
    size_t ndim() const
    {
        return axes.size();
    }
    size_t size() const
    {
        return count;
    }
    size_t row() const
    {
        return axes[0].length;
    }
    const std::vector<ptrdiff_t> &strides() const /* along the row */
    {
        return axes[0].strides;
    }
    /* Writes the address of element i of a row for each array; nullptr for none. */
    void locate(size_t row, size_t i, std::vector<char *> &at) const;

  private:
    int add_none(size_t outer);
    struct Axis {
        size_t length;
        std::vector<ptrdiff_t> strides; /* in bytes, of each array */
    };
    std::vector<Axis> axes; /* the last one first */
    std::vector<char *> bases;
    size_t count = 0;
};

enum { BLOCK = 512 }; /* elements of a block at most; its columns have 75 kB */

/* A block: successive elements of a row. */
class Part
{
  public:
    explicit Part(const Grid &g) : grid(g)
    {
    }
    void locate(size_t row, size_t begin, size_t count)
    {
        grid.locate(row, begin, first);
        strides = grid.strides().data();
        number = row * grid.row() + begin;
        block = row * ((grid.row() + BLOCK - 1) / BLOCK) + begin / BLOCK;
        size = count;
    }
    ptrdiff_t stride(int array) const
    {
        return strides[array];
    }
    /* The address of element i; nullptr if the array has no data. */
    char *at(int array, size_t i = 0) const
    {
        char *const p = first[static_cast<size_t>(array)];
        return p ? p + static_cast<ptrdiff_t>(i) * stride(array) : p;
    }
    /* Value k of element i. */
    template <class Value> Value &value(int array, size_t i, size_t k = 0) const
    {
        return reinterpret_cast<Value *>(at(array, i))[k];
    }
    /* Reads element i of an array (..., 3). */
    void read_vector(double to[3], int array, size_t i,
                     const Input &vectors) const
    {
        const ptrdiff_t step = last_step(vectors);
        for (int axis = 0; axis < 3; axis++)
            std::memcpy(&to[axis], at(array, i) + axis * step, sizeof *to);
    }
    /* Reads the double that is `offset` bytes into each element. */
    void read(double *to, int array, ptrdiff_t offset = 0) const
    {
        const char *p = at(array) + offset;
        const ptrdiff_t step = stride(array);
        const size_t n = size;
        for (size_t i = 0; i < n; i++, p += step)
            std::memcpy(&to[i], p, sizeof *to);
    }
    /* Writes value k of each element, unless the array has no data. */
    template <class Value>
    void write(const Value *from, int array, size_t k = 0) const
    {
        char *p = at(array);
        if (!p)
            return;
        p += k * sizeof(Value);
        const ptrdiff_t step = stride(array);
        const size_t n = size;
        for (size_t i = 0; i < n; i++, p += step)
            *reinterpret_cast<Value *>(p) = from[i];
    }

    size_t size = 0;
    size_t number = 0; /* of the first element, in C order if the grid is */
    size_t block = 0;  /* the number of this block */

  private:
    const Grid &grid;
    std::vector<char *> first;
    const ptrdiff_t *strides = nullptr;
};

/* ------------------------------------------------------------- threads -- */

/*
 * Releases Python's lock as long as it lives.  end_calls(), at Python's exit, waits
 * for all of these: then Python frees what the calls read.
 */
class Unlocked
{
  public:
    Unlocked();
    ~Unlocked();
    Unlocked(const Unlocked &) = delete;
    Unlocked &operator=(const Unlocked &) = delete;

  private:
    PyThreadState *const state;
};

/* Ends the calls in other threads, which raise SystemExit, and waits for them. */
void end_calls();
/* In the child of a fork: the calls of the parent's other threads do not run. */
void forget_calls();

/* progress(done, total), or nothing */
using Callback = std::optional<nb::object>;

/*
 * Lets Python handle signals and calls progress(done, total), unless progress is
 * None, several times a second during work without Python's lock.
 */
class Listener
{
  public:
    Listener(const Callback &callback, size_t elements);
    /* `part` of the work is done, 0 to 1.  Throws exceptions of Python. */
    void listen(double part);
    /* All is done. */
    void end() const;

  private:
    using Clock = std::chrono::steady_clock;
    const Callback progress;
    const size_t total;
    Clock::time_point due;
};

/* The number of threads for so many blocks, 1 to `threads`; 0 stands for one per
 * processor. */
int workers_for(size_t blocks, int threads);

/*
 * Calls task(worker, block) for all blocks, in their order, from `workers`
 * threads at most; worker is below `workers`.  Python's lock is released.  The
 * calling thread works too, and it listens: done counts elements, of which a
 * block has total / blocks on average.  The last call of progress has done =
 * total.  An exception of Python or of a task ends the work and is passed on.  A
 * task that returns false ends it, too.
 */
void work(size_t blocks, size_t total, int workers, const Callback &progress,
          const std::function<bool(int worker, size_t block)> &task);

/* The number of blocks. */
inline size_t blocks_of(const Grid &grid)
{
    return (grid.row() + BLOCK - 1) / BLOCK *
           (grid.size() > 0 ? grid.size() / grid.row() : 0);
}

/*
 * Calls block(part) for all blocks of a grid.  Each thread has a block of its own,
 * make().  Parts of different rows that begin at the same element come one after
 * the other: they often have the same shapes or points.  A block that returns false
 * ends the call, which then returns false.
 */
template <class Make>
bool each_block(const Grid &grid, int threads, const Callback &progress,
                const Make &make)
{
    struct Worker {
        Part part;
        decltype(make()) block;
    };
    const size_t blocks = blocks_of(grid);
    const int n = workers_for(blocks, threads);
    std::vector<std::unique_ptr<Worker>> workers(static_cast<size_t>(n));
    std::atomic<bool> good{true};
    const size_t rows = grid.size() > 0 ? grid.size() / grid.row() : 0;
    work(blocks, grid.size(), n, progress, [&](int number, size_t i) {
        auto &worker = workers[static_cast<size_t>(number)];
        if (!worker)
            worker.reset(new Worker{Part(grid), make()});
        const size_t begin = i / rows * BLOCK;
        worker->part.locate(i % rows, begin,
                            std::min<size_t>(BLOCK, grid.row() - begin));
        if (!worker->block(worker->part))
            good = false;
        return good.load();
    });
    return good;
}

#endif
