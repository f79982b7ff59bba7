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

NB_MODULE(_core, m)
{
    check_is_first();
    m.attr("version") = cylint_version();
    m.def("strerror", &cylint_strerror);
    m.def("end_calls", &end_calls);
    m.def("forget_calls", &forget_calls);
    register_shapes(m);
    register_intersect(m);
    register_points(m);
    register_text(m);
    register_scene(m);
}
