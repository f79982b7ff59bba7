/*
 * module.cc - libcylint._core, which the package's Python code calls
 *
 * The functions expect arrays that are checked and converted, and that broadcast;
 * only the Python code calls them.
 */
#include "calls.h"

NB_MODULE(_core, m)
{
    m.attr("version") = cylint_version();
    m.def("strerror", &cylint_strerror);
    m.def("shape_members", &shape_members);
    m.def("make_shapes", &make_shapes);
    m.def("make_tube", &make_tube);
    m.def("read_shapes", &read_shapes);
    m.def("bounds", &bounds);

    nb::class_<Lines>(m, "Lines")
        .def(nb::init<Input, Input, Input, Input, Input, bool, bool>());
    m.def("first_bad_line", &first_bad_line);
    m.def("intersect", &intersect);
    m.def("describe", &describe);
    register_points(m);
    m.def("read_scene", &read_scene);
    m.def("write_scene", &write_scene);
    register_scene(m);
}
