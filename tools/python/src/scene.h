/*
 * scene.h - libcylint-scene: many lines or points, and many shapes
 */
#ifndef CYLINT_PYTHON_SCENE_H
#define CYLINT_PYTHON_SCENE_H

#include <string>

#include "calls.h"

/* A scene with the memory that it needs. */
struct Scene {
    /* expected: the number of shapes, if it is known; else 0 */
    explicit Scene(size_t expected) : Scene(cylint_scene_begin(expected))
    {
    }
    /* Takes a scene that was begun or opened. */
    explicit Scene(cylint_scene *begun);

    void add(Input shapes);
    void finish(int threads, const Callback &progress);
    static std::unique_ptr<Scene> open(const nb::bytes &path,
                                       const nb::object &name, bool read,
                                       bool trusted);
    static std::unique_ptr<Scene> open_bytes(const nb::bytes &bytes);
    void save(const nb::bytes &path, const nb::object &name) const;
    nb::object to_bytes() const;
    void set_labels(const nb::list &labels);
    nb::object labels() const;
    void take(std::optional<Input> numbers, Output shapes, bool closed) const;
    void set_solids(Input members);
    nb::list solids() const;
    size_t size() const
    {
        return n;
    }
    size_t bytes() const
    {
        return cylint_scene_bytes(scene.get());
    }

    struct Free {
        void operator()(cylint_scene *p) const
        {
            cylint_scene_free(p);
        }
    };
    nb::object memory; /* of the scene, if it was opened there */
    std::vector<uint64_t> label_ends;
    std::string label_text;
    std::unique_ptr<cylint_scene, Free> scene;
    size_t n;
};

void register_queries(nb::module_ &module, nb::class_<Scene> &scene);

#endif
