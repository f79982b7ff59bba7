// numbers.cc - decimal numbers by the C++17 library: fast, locale-free, shortest
#include <charconv>
#include <cstdlib>

#include "numbers.h"

extern "C" const char *cylint_read_decimal(const char *text, const char *end,
                                           double *value)
{
    const auto [after, error] = std::from_chars(text, end, *value);
    if (error == std::errc::invalid_argument)
        return nullptr;
    // Too large or too small: from_chars returns the same error for both.
    if (error == std::errc::result_out_of_range)
        *value = std::strtod(text, nullptr);
    return after;
}

extern "C" size_t cylint_write_digits(char *out, double value, int digits)
{
    char *const end = out + NUMBER_CAPACITY;
    const auto written =
        digits == NUMBER_SHORTEST
            ? std::to_chars(out, end, value)
            : std::to_chars(out, end, value, std::chars_format::general,
                            digits);
    return static_cast<size_t>(written.ptr - out);
}
