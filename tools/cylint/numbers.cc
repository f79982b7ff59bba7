// numbers.cc - numbers by the C++17 library: fast, locale-free, shortest
//
// Where the library lacks std::from_chars for double, the C back-end below
// takes its place; the bytes are the same.
#include <charconv>

#if !defined(__cpp_lib_to_chars)
#include "numbers_c.c"
#else

#include "numbers_common.h"

// std::from_chars takes no '+' and no "0x", but does take inf and nan.
extern "C" const char *cylint_read_number(const char *text, const char *end,
                                          double *value)
{
    const char *const after_short = read_short(text, end, value);
    if (after_short) {
        return after_short;
    }
    const bool plus = text < end && *text == '+';
    const bool minus = text < end && *text == '-';
    const char *const digits = text + (plus || minus);
    if (digits == end || !(is_digit(*digits) || *digits == '.')) {
        return nullptr;
    }
    if (begins_hex(digits, end)) {
        return read_hex(text, digits + 2, end, value);
    }
    const auto [after, error] = std::from_chars(text + plus, end, *value);
    if (error == std::errc::invalid_argument) {
        return nullptr;
    }
    // Too large or too small: from_chars returns the same error for both.
    if (error == std::errc::result_out_of_range) {
        *value = std::strtod(text, nullptr);
    }
    return after;
}

extern "C" size_t cylint_write_number(char out[NUMBER_CAPACITY], double value,
                                      int digits)
{
    if (!is_finite(value)) {
        return write_not_finite(out, value);
    }
    if (digits == NUMBER_HEX) {
        return write_hex(out, value);
    }
    const auto written =
        digits == NUMBER_SHORTEST
            ? std::to_chars(out, out + NUMBER_CAPACITY, value)
            : std::to_chars(out, out + NUMBER_CAPACITY, value,
                            std::chars_format::general, digits);
    return static_cast<size_t>(written.ptr - out);
}

#endif
