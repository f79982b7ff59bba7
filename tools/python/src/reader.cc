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

int cylint_python_read(const char *file, int ends, int round,
                       cylint_shape **shapes, size_t *count);
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

/* Returns (status, shapes as bytes, messages). */
nb::tuple read_scene(const char *file, int ends, bool round)
{
    std::vector<std::string> said;
    cylint_shape *shapes = nullptr;
    size_t count = 0;
    int status;
    {
        nb::gil_scoped_release released;
        messages = &said;
        status = cylint_python_read(file, ends, round, &shapes, &count);
        messages = nullptr;
    }
    const nb::bytes data(shapes ? static_cast<const void *>(shapes) : "",
                         count * sizeof *shapes);
    std::free(shapes);
    nb::list texts;
    for (const std::string &text : said)
        texts.append(nb::str(text.data(), text.size()));
    return nb::make_tuple(status, data, texts);
}
