/*
 * module.cc - libcylint._core, which the package's Python code calls
 *
 * The functions expect arrays that are checked, converted and broadcast; only
 * the Python code calls them.
 */
#include "calls.h"

NB_MODULE(_core, m)
{
    m.attr("version") = cylint_version();
    m.def("strerror", &cylint_strerror, nb::arg("status"));
    m.def("constructors", &constructors);
    m.def("shape_members", &shape_members);

    nb::class_<Lines>(m, "Lines")
        .def(nb::init<nb::handle, nb::handle, nb::handle, nb::handle, bool,
                      bool>(),
             nb::arg("origins"), nb::arg("directions"), nb::arg("tmin"),
             nb::arg("tmax"), nb::arg("segments"), nb::arg("masked"));
    m.def("first_bad_line", &first_bad_line, nb::arg("lines"));

    m.def("make_shapes", &make_shapes, nb::arg("name"), nb::arg("numbers"),
          nb::arg("ends"), nb::arg("shapes"), nb::arg("statuses"));
    m.def("make_tube", &make_tube, nb::arg("numbers"), nb::arg("is_sector"),
          nb::arg("shapes"), nb::arg("clauses"));
    m.def("read_shapes", &read_shapes, nb::arg("shapes"), nb::arg("kinds"),
          nb::arg("numbers"));
    m.def("contains", &contains, nb::arg("shapes"), nb::arg("points"),
          nb::arg("answers"), nb::arg("threads"), nb::arg("progress").none());
    m.def("safety", &safety, nb::arg("shapes"), nb::arg("points"),
          nb::arg("answers"), nb::arg("threads"), nb::arg("progress").none());
    m.def("on_surface", &on_surface, nb::arg("shapes"), nb::arg("points"),
          nb::arg("ulps"), nb::arg("answers"), nb::arg("threads"),
          nb::arg("progress").none());
    m.def("closest", &closest, nb::arg("shapes"), nb::arg("index").none(),
          nb::arg("points"), nb::arg("columns"), nb::arg("threads"),
          nb::arg("progress").none());
    m.def("bounds", &bounds, nb::arg("shapes"), nb::arg("boxes"));

    m.def("intersect", &intersect, nb::arg("shapes"), nb::arg("lines"),
          nb::arg("columns"), nb::arg("threads"), nb::arg("progress").none());
    m.def("describe", &describe, nb::arg("shapes"), nb::arg("index").none(),
          nb::arg("lines"), nb::arg("nearest"), nb::arg("columns"),
          nb::arg("threads"), nb::arg("progress").none());
    m.def("read_scene", &read_scene, nb::arg("file"), nb::arg("ends"),
          nb::arg("round"));
    m.def("write_scene", &write_scene, nb::arg("shapes"), nb::arg("first"),
          nb::arg("labels").none());
    register_scene(m);
}
