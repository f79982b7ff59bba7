/*
 * scene.cc - builds, opens and saves scenes
 */
#include "calls.h"

#include <cerrno>
#include <exception>
#include <new>

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

/* Raises the exception of a status; name: what it is about, error: errno. */
void check(cylint_scene_status status, const nb::object &name = nb::none(),
           int error = 0)
{
    const char *const text = cylint_scene_strerror(status);
    if (status == CYLINT_SCENE_OK)
        return;
    if (status == CYLINT_SCENE_EMEMORY)
        throw std::bad_alloc();
    if (name.is_none())
        throw nb::value_error(text);
    errno = error;
    if (status == CYLINT_SCENE_EFILE && error != 0)
        PyErr_SetFromErrnoWithFilenameObject(PyExc_OSError, name.ptr());
    else
        PyErr_SetObject(PyExc_ValueError,
                        nb::str("{}: {}").format(name, text).ptr());
    throw nb::python_error();
}

} // namespace

Scene::Scene(cylint_scene *begun) : scene(begun), n(0)
{
    if (!scene)
        throw std::bad_alloc();
    n = cylint_scene_size(begun);
}

/* shapes: (n), contiguous */
void Scene::add(Input shapes)
{
    const size_t added = shapes.shape(0);
    cylint_scene_status status;
    {
        const Unlocked unlocked;
        status = cylint_scene_add(scene.get(), as_shape(shapes.data()), added);
    }
    check(status);
    n += added;
}

void Scene::finish(int threads, const Callback &progress)
{
    cylint_scene_status status;
    Build build{Listener(progress, n), nullptr};
    {
        const Unlocked unlocked;
        status =
            cylint_scene_finish(scene.get(), threads, Build::listen, &build);
        if (status == CYLINT_SCENE_OK)
            build.listener.end();
    }
    if (build.failure)
        std::rethrow_exception(build.failure);
    check(status);
    const cylint_scene_labels all{label_ends.data(), label_text.data()};
    if (has_labels)
        cylint_scene_set_labels(scene.get(), &all);
    if (has_solids())
        check(cylint_scene_set_solids(scene.get(), members.data(),
                                      members.size()));
}

/* Opens a file.  name: of the path, in exceptions. */
std::unique_ptr<Scene> Scene::open(const nb::bytes &path,
                                   const nb::object &name, bool read,
                                   bool trusted)
{
    const unsigned flags =
        read * static_cast<unsigned>(CYLINT_SCENE_READ) |
        trusted * static_cast<unsigned>(CYLINT_SCENE_TRUSTED);
    cylint_scene_status status;
    cylint_scene *opened;
    int error;
    {
        const Unlocked unlocked;
        opened = cylint_scene_open(path.c_str(), flags, &status);
        error = errno;
    }
    check(status, name, error);
    return std::make_unique<Scene>(opened);
}

/* Opens the bytes of a file. */
std::unique_ptr<Scene> Scene::open_bytes(const nb::bytes &bytes)
{
    cylint_scene_status status;
    cylint_scene *opened;
    {
        const Unlocked unlocked;
        opened =
            cylint_scene_open_memory(bytes.data(), bytes.size(), 0, &status);
    }
    check(status, nb::str("pickled scene"));
    auto made = std::make_unique<Scene>(opened);
    /* The library copies bytes at other addresses. */
    if (reinterpret_cast<uintptr_t>(bytes.data()) % 64 == 0)
        made->memory = bytes;
    return made;
}

void Scene::save(const nb::bytes &path, const nb::object &name) const
{
    const auto held = use;
    cylint_scene_status status;
    int error;
    {
        const Unlocked unlocked;
        status = cylint_scene_save(scene.get(), path.c_str());
        error = errno;
    }
    check(status, name, error);
}

/* The bytes of the file that save() writes. */
nb::object Scene::to_bytes() const
{
    size_t size = 0;
    check(cylint_scene_write(scene.get(), count_bytes, &size));
    nb::object bytes = nb::steal(
        PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
    if (!bytes.is_valid())
        throw std::bad_alloc();
    char *to = PyBytes_AsString(bytes.ptr());
    const auto held = use;
    const Unlocked unlocked;
    cylint_scene_write(scene.get(), copy_bytes, &to);
    return bytes;
}

/* Gives a scene that is begun its labels, a list of bytes. */
void Scene::set_labels(const nb::list &labels)
{
    has_labels = true;
    for (nb::handle label : labels) {
        const auto bytes = nb::cast<nb::bytes>(label);
        label_text.append(bytes.c_str(), bytes.size());
        label_ends.push_back(label_text.size());
    }
}

/* The labels as texts, or None if there are none. */
nb::object Scene::labels() const
{
    const cylint_scene_labels own{label_ends.data(), label_text.data()};
    const cylint_scene_labels *const all =
        has_labels ? &own : cylint_scene_get_labels(scene.get());
    nb::list list;
    uint64_t begin = 0;
    for (size_t i = 0; i < n && all; i++) {
        list.append(decoded(all->text + begin, all->end[i] - begin));
        begin = all->end[i];
    }
    return all ? nb::object(list) : nb::none();
}

/* Writes the shapes with these numbers (int64, contiguous), or all shapes if
 * numbers is None.  closed: as closed solids. */
void Scene::take(std::optional<Input> numbers, Output shapes, bool closed) const
{
    auto *const shape = static_cast<cylint_shape *>(shapes.data());
    const auto *const number =
        numbers ? static_cast<const int64_t *>(numbers->data()) : nullptr;
    const Unlocked unlocked;
    for (size_t i = 0; i < shapes.shape(0); i++) {
        const size_t at = number ? static_cast<size_t>(number[i]) : i;
        cylint_scene_shape(scene.get(), at, &shape[i]);
        if (closed && shape[i].ends < CYLINT_ENDS_INFINITE)
            shape[i].ends = CYLINT_ENDS_CAPPED;
    }
}

/* Members of solids: (k, 3) int64, contiguous: shape, solid, clause. */
void Scene::set_solids(Input members)
{
    const auto *const row = static_cast<const int64_t *>(members.data());
    std::vector<cylint_member> all;
    for (size_t i = 0; i < members.shape(0); i++)
        all.push_back({static_cast<size_t>(row[3 * i]),
                       static_cast<size_t>(row[3 * i + 1]),
                       static_cast<int>(row[3 * i + 2])});
    if (use.use_count() > 1)
        throw nb::value_error("solids cannot be set during a query");
    check(cylint_scene_set_solids(scene.get(), all.data(), all.size()));
}

/* The same as a list of tuples. */
nb::list Scene::solids() const
{
    nb::list list;
    for (size_t i = 0; i < cylint_scene_members(scene.get()); i++) {
        cylint_member member;
        cylint_scene_member(scene.get(), i, &member);
        list.append(nb::make_tuple(member.shape, member.solid, member.clause));
    }
    return list;
}

void register_scene(nb::module_ &module)
{
    nb::class_<Scene> scene(module, "Scene");
    scene.def(nb::init<size_t>())
        .def("add", &Scene::add)
        .def("finish", &Scene::finish)
        .def_static("open", &Scene::open)
        .def_static("open_bytes", &Scene::open_bytes)
        .def("save", &Scene::save)
        .def("to_bytes", &Scene::to_bytes)
        .def("set_labels", &Scene::set_labels)
        .def("labels", &Scene::labels)
        .def("has_solids", &Scene::has_solids)
        .def("size", &Scene::size)
        .def("take", &Scene::take)
        .def("bytes", &Scene::bytes)
        .def("set_solids", &Scene::set_solids)
        .def("solids", &Scene::solids);
    register_queries(module, scene);
}
