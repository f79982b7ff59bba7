/*
 * reader.cc - reads scenes and neurons by the command's own reader
 *
 * tools/cylint/message.c is left out of the module: the reader's messages come
 * to message() below, and Python raises them or warns of them.
 */
#include <nanobind/stl/string.h>

#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "calls.h"

extern "C" {
#include "message.h"
#include "reader_scene.h"

extern const char *const program;
const char *const program = "cylint";
}

namespace
{
thread_local std::vector<std::string> *messages;
}

extern "C" void message(const char *format, ...)
{
    char text[2048];
    va_list list;
    va_start(list, format);
    std::vsnprintf(text, sizeof text, format, list);
    va_end(list);
    if (messages)
        messages->emplace_back(text);
}

/* The labels as texts, or None if there are none. */
static nb::object labels_of(const cylint_python_scene &scene)
{
    return scene.label_bytes
               ? label_texts(scene.label_end, scene.label_bytes, scene.count)
               : nb::none();
}

/* The members of solids: (shape, solid, clause). */
static nb::list members_of(const cylint_python_scene &scene)
{
    nb::list members;
    for (size_t i = 0; i < scene.n_members; i++) {
        const cylint_member &m = scene.members[i];
        members.append(nb::make_tuple(m.shape, m.solid, m.clause));
    }
    return members;
}

/* Returns (status, a scene that is begun, labels, members of solids, messages); None instead of a scene
 * without shapes. */
nb::tuple read_scene(const char *file, int ends, bool round)
{
    std::vector<std::string> said;
    cylint_python_scene scene;
    int status;
    {
        nb::gil_scoped_release released;
        messages = &said;
        status = cylint_python_read(file, ends, round, &scene);
        messages = nullptr;
    }
    const nb::object begun = scene_object(scene.shapes);
    const nb::object labels = labels_of(scene);
    const nb::list members = members_of(scene);
    std::free(scene.members);
    std::free(scene.label_bytes);
    std::free(scene.label_end);
    nb::list texts;
    for (const std::string &text : said)
        texts.append(nb::str(text.data(), text.size()));
    return nb::make_tuple(status, begun, labels, members, texts);
}
