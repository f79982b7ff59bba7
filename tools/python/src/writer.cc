/*
 * writer.cc - shapes as text of the command's grammar
 */
#include <cmath>
#include <cstring>
#include <string>

#include "calls.h"
#include "shapes/layout.h"
#include "numbers.h"

extern "C" {
#include "grammar.h"
}

namespace
{

/* Names a shape or label that cannot be written, and the reason. */
[[noreturn]] void refuse(const char *what, size_t number, const char *why)
{
    const std::string text =
        std::string(what) + ' ' + std::to_string(number) + ": " + why;
    throw nb::value_error(text.c_str());
}

/*
 * Text has the angle of a cone in degrees, a shape its tangent.  The tangent
 * grows with the angle, so this steps from an approximation to the first double
 * whose tangent is not on the same side.  Returns 0 if no angle has the tangent.
 */
double angle_of(const cylint_shape &shape, double tangent)
{
    const double degree = 57.29577951308232; /* 180 / pi */
    double angle =
        std::fmin(std::atan(tangent) * degree, std::nextafter(90.0, 0.0));
    for (int before = 0;;) {
        cylint_shape made;
        if (cylint_angle_cone(&made, cylint_base(&shape), cylint_axis(&shape),
                              angle, CYLINT_ENDS_INFINITE) != CYLINT_OK)
            return 0;
        const double reached = cylint_r1(&made);
        const int side = (reached < tangent) - (reached > tangent);
        if (side == 0)
            return angle;
        if (side == -before)
            return 0;
        before = side;
        angle = std::nextafter(angle, side * HUGE_VAL);
    }
}

void add_shape(std::string &text, const cylint_shape &shape, size_t number,
               bool with_ends)
{
    Arguments a = arguments_of(shape);
    const bool has_angle = shape.kind == CYLINT_KIND_ACONE;
    double &last = a.number[a.count - 1];
    if (has_angle && !(last = angle_of(shape, last)))
        refuse("shape", number,
               "text has angles, and no angle in degrees has its tangent");
    text += a.word;
    for (int i = 0; i < a.count; i++) {
        char digits[NUMBER_CAPACITY];
        text += ' ';
        text.append(digits,
                    cylint_write_number(digits, a.number[i], NUMBER_SHORTEST));
    }
    if (with_ends ||
        shape.ends != (has_angle ? CYLINT_ENDS_INFINITE : CYLINT_ENDS_CAPPED))
        text.append(" ends=").append(ends_words[shape.ends]);
}

/* A label is the rest of a line without the blanks around it. */
void check_label(const std::string &label, size_t number)
{
    if (label.find('\n') != label.npos || label.find('\0') != label.npos)
        refuse("label", number, "text has no line feed and no NUL in labels");
    if (is_blank(label.front()) || is_blank(label.back()) ||
        label.back() == '\r')
        refuse("label", number, "text has no blanks around labels");
}

} // namespace

/* shapes: (n), the first of which has the number `first`; labels: a list of n
 * bytes, or None. */
nb::bytes write_scene(nb::handle shapes, size_t first, nb::handle labels)
{
    const Array s(shapes);
    std::string text;
    for (ptrdiff_t i = 0; i < s.size(0); i++) {
        const size_t number = first + static_cast<size_t>(i),
                     begin = text.size();
        std::string label;
        if (!labels.is_none()) {
            const auto bytes = nb::cast<nb::bytes>(labels[i]);
            label.assign(bytes.c_str(), bytes.size());
        }
        /* A label of this form would be read as the ends. */
        add_shape(text, *as_shape(s.data() + i * s.stride(0)), number,
                  label.compare(0, 5, "ends=") == 0);
        if (!label.empty()) {
            check_label(label, number);
            /* The first comma after a field separates. */
            text += label.front() == ',' ? " ," : " ";
            text += label;
        }
        if (text.size() - begin > LINE_MOST)
            refuse("label", number, "the line would be longer than 1 MiB");
        text += '\n';
    }
    return nb::bytes(text.data(), text.size());
}
