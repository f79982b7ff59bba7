/*
 * array.h - arrays of NumPy, in place, and the elements that they broadcast to
 *
 * An array arrives by the buffer protocol with strides in bytes.  The Python
 * code has broadcast all arrays of a call to one shape; an axis along which an
 * array does not change has stride 0.
 */
#ifndef CYLINT_PYTHON_ARRAY_H
#define CYLINT_PYTHON_ARRAY_H

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace nb = nanobind;

inline double number(const char *p)
{
    double value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

/* Reads the coordinates of a point that are `step` bytes apart. */
inline void read_point(const char *p, ptrdiff_t step, double (&point)[3])
{
    for (int axis = 0; axis < 3; axis++)
        point[axis] = number(p + axis * step);
}

/* An exported buffer.  It keeps the array alive and in its place. */
class Array
{
  public:
    /* None gives an array without data. */
    explicit Array(nb::handle object, bool writable = false);
    ~Array();
    Array(const Array &) = delete;
    Array &operator=(const Array &) = delete;

    explicit operator bool() const
    {
        return present;
    }
    char *data() const
    {
        return static_cast<char *>(view.buf);
    }
    int axes() const
    {
        return view.ndim;
    }
    ptrdiff_t size(int axis) const
    {
        return view.shape[axis];
    }
    ptrdiff_t stride(int axis) const
    {
        return view.strides[axis];
    }
    ptrdiff_t last_stride() const
    {
        return view.strides[view.ndim - 1];
    }

  private:
    Py_buffer view;
    bool present;
};

/*
 * The elements of a call.  add() takes the arrays, all with the same first
 * axes; `inner` further axes of an array belong to its element.  prepare() joins
 * axes that run through all arrays with one stride, and moves the longest to
 * the end: the row.
 */
class Grid
{
  public:
    /* The shape is that of the first axes of `model`. */
    Grid(const Array &model, int inner);
    /* Returns the number of the array in offsets. */
    int add(const Array &array);
    void prepare();

    size_t elements() const
    {
        return count;
    }
    size_t row() const
    {
        return lengths.back();
    }
    size_t rows() const
    {
        return count > 0 ? count / row() : 0;
    }
    ptrdiff_t stride(int array) const /* along the row */
    {
        return steps[static_cast<size_t>(array)];
    }
    /* Writes the address of element i of row r for each array. */
    void locate(size_t r, size_t i, std::vector<char *> &at) const;
    /* Moves the addresses to the next element of the row. */
    void advance(std::vector<char *> &at) const
    {
        for (size_t a = 0; a < at.size(); a++)
            at[a] += steps[a];
    }
    size_t arrays() const
    {
        return bases.size();
    }

  private:
    std::vector<size_t> lengths;
    std::vector<std::vector<ptrdiff_t>> strides; /* 0 without data */
    std::vector<ptrdiff_t> steps;                /* along the row */
    std::vector<char *> bases;
    size_t count;
};

#endif
