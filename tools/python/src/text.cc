/*
 * text.cc - reads scenes and neurons, and writes scenes, by the command's own code
 *
 * tools/cylint/message.c is left out of the module: the reader's messages come
 * to message() below, and Python raises them or warns of them; a signal's exception
 * ends the reading.
 */
#include <cstdarg>
#include <cstdio>
#include <string>

#include "calls.h"

extern "C" {
#include "numbers.h"
#include "scene.h"

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

extern "C" int is_interrupted(void)
{
    const nb::gil_scoped_acquire acquired;
    return PyErr_CheckSignals() != 0;
}

static nb::object decoded(const char *text, size_t length)
{
    return nb::steal(PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(length),
                                          "surrogateescape"));
}

nb::object label_texts(const uint64_t *end, const char *text, size_t count)
{
    nb::list labels;
    uint64_t begin = 0;
    for (size_t i = 0; i < count; i++) {
        labels.append(decoded(text + begin, end[i] - begin));
        begin = end[i];
    }
    return labels;
}

/* ends: of shapes whose line has no ends=, or -1.  Returns (status, a scene that is
 * begun, labels, members of solids, messages); None instead of a scene without
 * shapes and instead of labels that are all empty. */
nb::tuple read_scene(const nb::bytes &file, int ends, bool round)
{
    std::vector<std::string> printed;
    struct scene scene = {};
    int status;
    {
        const Unlocked unlocked;
        messages = &printed;
        scene.file = file.c_str();
        scene.ends = ends;
        scene.swc_form = round ? SWC_ROUND : SWC_CONES;
        scene.keeps_labels = 1;
        status = scene_read(&scene);
        messages = nullptr;
    }
    if (PyErr_Occurred()) {
        scene_free(&scene);
        throw nb::python_error();
    }
    nb::object begun = nb::none(), labels = nb::none();
    nb::list members, texts;
    for (const std::string &text : printed)
        texts.append(decoded(text.data(), text.size()));
    if (status == 0) {
        begun = scene_object(scene.shapes);
        scene.shapes = nullptr; /* the object's now */
        if (scene.labels.texts.length > 0)
            labels = label_texts(scene.labels.table.end,
                                 scene.labels.table.text, scene.count);
        for (size_t i = 0; i < scene.solids.count; i++) {
            const cylint_member &m = scene.solids.member[i];
            members.append(nb::make_tuple(m.shape, m.solid, m.clause));
        }
    }
    scene_free(&scene);
    return nb::make_tuple(status, begun, labels, members, texts);
}

/* shapes: (n), the first of which has the number `first`; labels: a list of n
 * bytes, or None. */
nb::bytes write_scene(Input shapes, size_t first,
                      std::optional<nb::list> labels)
{
    std::string text;
    std::vector<char> line(RECORD_MOST);
    const struct solids none = {};
    for (size_t i = 0; i < shapes.shape(0); i++) {
        struct shape_record r = {};
        r.shape = shape_of(shapes, i);
        r.solids = &none;
        nb::bytes label;
        if (labels) {
            label = nb::cast<nb::bytes>((*labels)[i]);
            r.label = {label.c_str(), label.size()};
        }
        struct text record = {line.data(), 0};
        if (const char *fault = put_record(&record, &r, NUMBER_SHORTEST)) {
            const std::string why =
                "shape " + std::to_string(first + i) + ": " + fault;
            throw nb::value_error(why.c_str());
        }
        text.append(record.data, record.length);
    }
    return nb::bytes(text.data(), text.size());
}
