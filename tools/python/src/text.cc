/*
 * text.cc - reads scenes and neurons, and writes scenes, by the command's own code
 *
 * tools/cylint/message.c is left out of the module: the reader's messages come
 * to message() below, and Python raises them or warns of them; a signal's exception
 * ends the reading.
 */
#include <cstdarg>
#include <cstdio>
#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif
#include <string>

#include <nanobind/stl/unique_ptr.h>

#include "calls.h"

extern "C" {
#include "numbers.h"

extern const char *const program;
const char *const program = "cylint";
}

namespace
{
thread_local std::vector<std::string> *messages;

/* While one exists, numbers of its thread have a decimal point, whatever locale the
 * process has set.  Windows has no locale of a thread; its from_chars() reads all
 * but numbers out of range. */
struct DecimalPoint {
#ifndef _WIN32
    DecimalPoint()
    {
        static const locale_t c = newlocale(LC_ALL_MASK, "C", nullptr);
        before = uselocale(c);
    }
    ~DecimalPoint()
    {
        uselocale(before);
    }

    locale_t before;
#endif
};
} // namespace

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

nb::object decoded(struct string text)
{
    return nb::steal(PyUnicode_DecodeUTF8(
        text.text, static_cast<Py_ssize_t>(text.length), "surrogateescape"));
}

namespace
{

/* ends: of shapes whose line has no ends=, or -1; swc: enum swc_form, or -1.
 * Returns (status, a scene that is begun, or None, messages). */
nb::tuple read_scene(const nb::bytes &file, int ends, int swc)
{
    std::vector<std::string> printed;
    auto begun = std::make_unique<Scene>(size_t{0});
    struct scene &scene = begun->data;
    int status;
    {
        const Unlocked unlocked;
        const DecimalPoint locale{};
        messages = &printed;
        scene.file = file.c_str();
        scene.ends = ends;
        scene.swc_form = swc;
        scene.keeps_labels = 1;
        status = scene_read(&scene);
        messages = nullptr;
    }
    if (PyErr_Occurred())
        throw nb::python_error();
    if (scene.labels.texts.length == 0)
        labels_free(&scene.labels);
    nb::list texts;
    for (const std::string &text : printed)
        texts.append(decoded({text.data(), text.size()}));
    const nb::object made =
        status == 0 ? nb::cast(std::move(begun)) : nb::none();
    return nb::make_tuple(status, made, texts);
}

/* shapes: (n), the first of which has the number `first`; labels: a list of n
 * bytes, or None. */
nb::bytes write_scene(Input shapes, size_t first,
                      std::optional<nb::list> labels)
{
    const DecimalPoint locale{};
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

} // namespace

void register_text(nb::module_ &module)
{
    module.def("read_scene", &read_scene);
    module.def("write_scene", &write_scene);
}
