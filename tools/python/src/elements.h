/*
 * elements.h - the elements of a call, in blocks, by several threads
 */
#ifndef CYLINT_PYTHON_ELEMENTS_H
#define CYLINT_PYTHON_ELEMENTS_H

#include <algorithm>
#include <atomic>
#include <memory>

#include "array.h"
#include "work.h"

/*
 * Calls function(addresses, number) for each element of a grid that is prepared:
 * the addresses of the element in the arrays of the grid, and, of a grid with
 * one axis, the element's number.  One thread handles the elements of a block,
 * `block` consecutive ones, in their order.  A function that returns false ends
 * the call.  Returns false if one did.  work.h describes the other arguments.
 */
template <class Function>
bool each_element(const Grid &grid, size_t block, int threads,
                  nb::handle progress, const Function &function)
{
    const size_t pieces = (grid.row() + block - 1) / block;
    std::atomic<bool> good{true};
    work(grid.rows() * pieces, grid.elements(), threads, progress,
         [&](int, size_t i) {
             std::vector<char *> at;
             const size_t begin = i % pieces * block;
             const size_t end = std::min(begin + block, grid.row());
             grid.locate(i / pieces, begin, at);
             for (size_t k = begin; k < end && good; k++) {
                 if (!function(at.data(), i / pieces * grid.row() + k))
                     good = false;
                 grid.advance(at);
             }
             return good.load();
         });
    return good;
}

/*
 * Calls block.run(row, begin, count) for all parts of at most `size` elements of
 * the rows.  Each thread has a block of its own, Block(grid, from...).  Parts
 * of different rows that begin at the same element come one after the other:
 * they often have the same shapes or points.  Returns as each_element() does.
 */
template <class Block, class... From>
bool each_block(const Grid &grid, size_t size, int threads, nb::handle progress,
                const From &...from)
{
    std::vector<std::unique_ptr<Block>> blocks(
        static_cast<size_t>(std::max(threads, 1)));
    std::atomic<bool> good{true};
    const size_t rows = grid.rows();
    work(rows * ((grid.row() + size - 1) / size), grid.elements(), threads,
         progress, [&](int worker, size_t i) {
             auto &block = blocks[static_cast<size_t>(worker)];
             if (!block)
                 block = std::make_unique<Block>(grid, from...);
             const size_t begin = i / rows * size;
             if (!block->run(i % rows, begin,
                             std::min(size, grid.row() - begin)))
                 good = false;
             return good.load();
         });
    return good;
}

/* A part of a row: its elements in the arrays of a grid. */
class RowPart
{
  public:
    explicit RowPart(const Grid &g) : grid(g), length(0)
    {
    }
    void locate(size_t row, size_t begin, size_t count)
    {
        grid.locate(row, begin, first);
        length = count;
    }
    size_t size() const
    {
        return length;
    }
    ptrdiff_t stride(int array) const
    {
        return grid.stride(array);
    }
    /* The address of element i; nullptr if the array has no data. */
    char *at(int array, size_t i = 0) const
    {
        char *const p = first[static_cast<size_t>(array)];
        return p ? p + static_cast<ptrdiff_t>(i) * stride(array) : p;
    }
    const char *const *addresses(int array) const
    {
        return &first[static_cast<size_t>(array)];
    }

    /* Reads the double that is `offset` bytes into each element. */
    void read(double *to, int array, ptrdiff_t offset) const
    {
        const char *p = at(array) + offset;
        const ptrdiff_t step = stride(array);
        for (size_t i = 0; i < length; i++, p += step)
            to[i] = number(p);
    }

    /* Writes value number k of each element, unless the array has no data. */
    template <class Value>
    void write(const Value *from, int array, size_t k) const
    {
        char *p = at(array);
        if (!p)
            return;
        p += k * sizeof(Value);
        const ptrdiff_t step = stride(array);
        const size_t n = length;
        for (size_t i = 0; i < n; i++, p += step)
            *reinterpret_cast<Value *>(p) = from[i];
    }

  private:
    const Grid &grid;
    size_t length;
    std::vector<char *> first;
};

#endif
