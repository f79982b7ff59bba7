/*
 * scene.cc - builds, opens and saves scenes
 */
#include "calls.h"

#include <cerrno>
#include <exception>

#include <nanobind/stl/unique_ptr.h>

namespace
{

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

int count_bytes(void *sum, const void *, size_t size)
{
    *static_cast<size_t *>(sum) += size;
    return 1;
}

int copy_bytes(void *to, const void *from, size_t size)
{
    std::memcpy(*static_cast<char **>(to), from, size);
    *static_cast<char **>(to) += size;
    return 1;
}

/* Makes a call without Python's lock.  errno stays: taking the lock restores it. */
template <class Call> auto unlocked(const Call &call)
{
    const Unlocked released;
    return call();
}

/* Raises the exception of a status; name: the file that it is about, with errno. */
void check(cylint_scene_status status, const nb::object &name = nb::none())
{
    const char *const text = cylint_scene_strerror(status);
    if (status == CYLINT_SCENE_OK)
        return;
    if (status == CYLINT_SCENE_EMEMORY)
        throw std::bad_alloc();
    if (name.is_none())
        throw nb::value_error(text);
    if (status == CYLINT_SCENE_EFILE && errno != 0)
        PyErr_SetFromErrnoWithFilenameObject(PyExc_OSError, name.ptr());
    else
        PyErr_SetObject(PyExc_ValueError,
                        nb::str("{}: {}").format(name, text).ptr());
    throw nb::python_error();
}

/* shapes: (n), contiguous */
void add(Scene &s, Input shapes)
{
    check(unlocked([&] {
        return cylint_scene_add(s.get(), as_shape(shapes.data()),
                                shapes.shape(0));
    }));
}

bool has_solids(const Scene &s)
{
    return s.data.solids.count > 0;
}

void finish(Scene &s, int threads, const Callback &progress)
{
    cylint_scene_status status;
    Build build{Listener(progress, s.size()), nullptr};
    {
        const Unlocked unlocked;
        status = cylint_scene_finish(s.get(), threads, Build::listen, &build);
        if (status == CYLINT_SCENE_OK)
            build.listener.end();
    }
    if (build.failure)
        std::rethrow_exception(build.failure);
    check(status);
    if (s.data.labels.table.end)
        cylint_scene_set_labels(s.get(), &s.data.labels.table);
    if (has_solids(s))
        check(cylint_scene_set_solids(s.get(), s.data.solids.member,
                                      s.data.solids.count));
}

/* Opens a file.  name: of the path, in exceptions. */
std::unique_ptr<Scene> open_saved(const nb::bytes &path, const nb::object &name,
                                  bool read, bool trusted)
{
    const unsigned flags =
        read * static_cast<unsigned>(CYLINT_SCENE_READ) |
        trusted * static_cast<unsigned>(CYLINT_SCENE_TRUSTED);
    cylint_scene_status status;
    cylint_scene *const opened = unlocked(
        [&] { return cylint_scene_open(path.c_str(), flags, &status); });
    check(status, name);
    return std::make_unique<Scene>(opened);
}

/* Opens the bytes of a file. */
std::unique_ptr<Scene> open_bytes(const nb::bytes &bytes)
{
    cylint_scene_status status;
    cylint_scene *const opened = unlocked([&] {
        return cylint_scene_open_memory(bytes.data(), bytes.size(), 0, &status);
    });
    check(status, nb::str("pickled scene"));
    auto made = std::make_unique<Scene>(opened);
    /* The library copies bytes at other addresses. */
    if (reinterpret_cast<uintptr_t>(bytes.data()) % 64 == 0)
        made->memory = bytes;
    return made;
}

void save(const Scene &s, const nb::bytes &path, const nb::object &name)
{
    const auto held = s.use;
    check(unlocked([&] { return cylint_scene_save(s.get(), path.c_str()); }),
          name);
}

/* The bytes of the file that save() writes. */
nb::object to_bytes(const Scene &s)
{
    size_t size = 0;
    check(cylint_scene_write(s.get(), count_bytes, &size));
    nb::object bytes = nb::steal(
        PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
    if (!bytes.is_valid())
        throw std::bad_alloc();
    char *to = PyBytes_AsString(bytes.ptr());
    const auto held = s.use;
    const Unlocked unlocked;
    cylint_scene_write(s.get(), copy_bytes, &to);
    return bytes;
}

/* Gives a scene that is begun its labels, a list of bytes. */
void set_labels(Scene &s, const nb::list &labels)
{
    for (nb::handle label : labels) {
        const auto bytes = nb::cast<nb::bytes>(label);
        if (labels_add(&s.data.labels, {bytes.c_str(), bytes.size()}) != 0)
            throw std::bad_alloc();
    }
}

/* The labels as texts, or None if there are none. */
nb::object labels_of(const Scene &s)
{
    const cylint_scene_labels &own = s.data.labels.table;
    const cylint_scene_labels *const all =
        own.end ? &own : cylint_scene_get_labels(s.get());
    nb::list list;
    for (size_t i = 0; i < s.size() && all; i++)
        list.append(decoded(text_at(all->end, all->text, i)));
    return all ? nb::object(list) : nb::none();
}

/* Writes the shapes with these numbers, or all shapes if numbers is None.  closed:
 * as closed solids. */
void take(const Scene &s, std::optional<Array<const int64_t>> numbers,
          Output shapes, bool closed)
{
    auto *const shape = static_cast<cylint_shape *>(shapes.data());
    const Unlocked unlocked;
    for (size_t i = 0; i < shapes.shape(0); i++) {
        const size_t at = numbers ? static_cast<size_t>(numbers->data()[i]) : i;
        cylint_scene_shape(s.get(), at, &shape[i]);
        if (closed && shape[i].ends < CYLINT_ENDS_INFINITE)
            shape[i].ends = CYLINT_ENDS_CAPPED;
    }
}

/* Members of solids: (k, 3), each a shape, a solid and a clause. */
void set_solids(Scene &s, Array<const int64_t> members)
{
    const int64_t *const row = members.data();
    std::vector<cylint_member> all;
    for (size_t i = 0; i < members.shape(0); i++)
        all.push_back({static_cast<size_t>(row[3 * i]),
                       static_cast<size_t>(row[3 * i + 1]),
                       static_cast<int>(row[3 * i + 2])});
    if (s.use.use_count() > 1)
        throw nb::value_error("solids cannot be set during a query");
    check(cylint_scene_set_solids(s.get(), all.data(), all.size()));
}

/* The same as a list of tuples. */
nb::list solids_of(const Scene &s)
{
    nb::list list;
    for (size_t i = 0; i < cylint_scene_members(s.get()); i++) {
        cylint_member member;
        cylint_scene_member(s.get(), i, &member);
        list.append(nb::make_tuple(member.shape, member.solid, member.clause));
    }
    return list;
}

} // namespace

void register_scene(nb::module_ &module)
{
    nb::class_<Scene> scene(module, "Scene");
    scene.def(nb::init<size_t>())
        .def("add", &add)
        .def("finish", &finish)
        .def_static("open", &open_saved)
        .def_static("open_bytes", &open_bytes)
        .def("save", &save)
        .def("to_bytes", &to_bytes)
        .def("set_labels", &set_labels)
        .def("labels", &labels_of)
        .def("has_solids", &has_solids)
        .def("size", &Scene::size)
        .def("take", &take)
        .def("bytes",
             [](const Scene &s) { return cylint_scene_bytes(s.get()); })
        .def("set_solids", &set_solids)
        .def("solids", &solids_of);
    register_queries(module, scene);
}
