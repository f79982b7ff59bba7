/*
 * module.cc - libcylint._core, which the package's Python code calls
 *
 * The functions expect arrays that are checked and converted, and that broadcast;
 * only the Python code calls them.
 */
#include "calls.h"

/* Refuses to load into a second interpreter, or once more into one whose
 * sys.modules has lost the module. */
static void check_is_first()
{
    static bool is_loaded;
    if (PyInterpreterState_GetID(PyInterpreterState_Get()) != 0)
        throw std::runtime_error(
            "libcylint works in Python's main interpreter alone");
    if (is_loaded)
        throw std::runtime_error("a process can load libcylint._core once");
    is_loaded = true;
}

/* Whether a value, or one in its lists and tuples, is an array of the type `masked`
 * with a masked element.  levels: of lists in lists, as many as NumPy has axes. */
static bool is_masked(nb::handle value, nb::handle masked, int levels)
{
    PyObject *const p = value.ptr();
    if (PyFloat_CheckExact(p) || PyLong_CheckExact(p))
        return false; /* as most values */
    const bool is_list = PyList_Check(p);
    if (is_list || PyTuple_Check(p)) {
        bool found = false;
        for (Py_ssize_t i = 0; !found && levels > 0 && i < PySequence_Size(p);
             i++)
            found = is_masked(is_list ? PyList_GetItem(p, i)
                                      : PyTuple_GetItem(p, i),
                              masked, levels - 1);
        return found;
    }
    return nb::isinstance(value, masked) &&
           static_cast<bool>(nb::bool_(value.attr("mask").attr("any")()));
}

NB_MODULE(_core, m)
{
    check_is_first();
    m.attr("version") = cylint_version();
    m.def("strerror", &cylint_strerror);
    m.def("is_masked", &is_masked, nb::arg("value").none(), nb::arg("masked"),
          nb::arg("levels") = 64);
    m.def("end_calls", &end_calls);
    m.def("forget_calls", &forget_calls);
    register_shapes(m);
    register_intersect(m);
    register_points(m);
    register_text(m);
    register_scene(m);
}
