/*
 * array.cc - arrays of NumPy, in place, and the elements that they broadcast to
 */
#include "array.h"

#include <algorithm>

Array::Array(nb::handle object, bool writable) : view(), present(false)
{
    if (!object.is_none()) {
        const int flags = writable ? PyBUF_STRIDED : PyBUF_STRIDED_RO;
        if (PyObject_GetBuffer(object.ptr(), &view, flags) != 0)
            throw nb::python_error();
        present = true;
    }
}

Array::~Array()
{
    if (present)
        PyBuffer_Release(&view);
}

Grid::Grid(const Array &model, int inner) : count(1)
{
    for (int axis = 0; axis < model.axes() - inner; axis++) {
        lengths.push_back(static_cast<size_t>(model.size(axis)));
        count *= lengths.back();
    }
}

int Grid::add(const Array &array)
{
    std::vector<ptrdiff_t> along(lengths.size(), 0);
    for (size_t axis = 0; array && axis < lengths.size(); axis++)
        along[axis] = array.stride(static_cast<int>(axis));
    bases.push_back(array ? array.data() : nullptr);
    strides.push_back(along);
    return static_cast<int>(bases.size()) - 1;
}

void Grid::prepare()
{
    const auto drop = [this](size_t axis) {
        const auto at = static_cast<ptrdiff_t>(axis);
        lengths.erase(lengths.begin() + at);
        for (auto &along : strides)
            along.erase(along.begin() + at);
    };
    for (size_t axis = lengths.size(); axis-- > 0;) {
        if (lengths[axis] == 1)
            drop(axis);
    }
    for (size_t axis = lengths.size(); axis-- > 1;) {
        const auto length = static_cast<ptrdiff_t>(lengths[axis]);
        const bool joined =
            std::all_of(strides.begin(), strides.end(), [&](const auto &along) {
                return along[axis - 1] == along[axis] * length;
            });
        if (joined) {
            lengths[axis] *= lengths[axis - 1];
            drop(axis - 1);
        }
    }
    if (lengths.empty()) {
        lengths.push_back(1);
        for (auto &along : strides)
            along.push_back(0);
    }
    const size_t longest = static_cast<size_t>(
        std::max_element(lengths.begin(), lengths.end()) - lengths.begin());
    std::swap(lengths[longest], lengths.back());
    for (auto &along : strides) {
        std::swap(along[longest], along.back());
        steps.push_back(along.back());
    }
}

void Grid::locate(size_t r, size_t i, std::vector<char *> &at) const
{
    at = bases;
    const auto move = [&](size_t axis, size_t to) {
        for (size_t a = 0; a < at.size(); a++)
            at[a] += static_cast<ptrdiff_t>(to) * strides[a][axis];
    };
    move(lengths.size() - 1, i);
    for (size_t axis = lengths.size() - 1; axis-- > 0;) {
        move(axis, r % lengths[axis]);
        r /= lengths[axis];
    }
}
