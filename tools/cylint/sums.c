/*
 * sums.c - rows of sums of lengths, one column for each name of shapes
 */
#include <math.h>

#include "numbers.h"
#include "sums.h"

size_t sums_capacity(const struct names *names, const struct style *style)
{
    const size_t missing = style->missing ? strlen(style->missing) : 0;
    size_t bytes = 0;
    for (size_t i = 0; i < names->columns; i++) {
        const size_t name = names_of_column(names, i).length;
        const size_t longer = name > missing ? name : missing;
        bytes += (longer > NUMBER_CAPACITY ? longer : NUMBER_CAPACITY) + 1;
    }
    return bytes;
}

static void put_separator(struct text *out, const struct style *style, size_t i)
{
    if (i > 0)
        put_char(out, style->separator);
}

void put_sums(struct text *out, const struct names *names,
              const struct style *style, const double *sums,
              const struct row *row)
{
    for (size_t i = 0; i < names->columns; i++) {
        if (style->binary) {
            put_little_endian(out, sums[i]);
        } else {
            put_separator(out, style, i);
            out->length += cylint_write_number(out->data + out->length, sums[i],
                                               style->digits);
        }
    }
    if (style->binary)
        return;
    if (row->tail_length > 0) {
        put_char(out, style->separator);
        put_bytes(out, row->tail, row->tail_length);
    }
    put_char(out, '\n');
}

void put_sums_error(struct text *out, const struct names *names,
                    const struct style *style)
{
    for (size_t i = 0; i < names->columns; i++) {
        if (style->binary) {
            put_little_endian(out, NAN);
        } else {
            put_separator(out, style, i);
            put_string(out, i == 0           ? "error"
                            : style->missing ? style->missing
                                             : "nan");
        }
    }
    if (!style->binary)
        put_char(out, '\n');
}

void put_sums_header(struct text *out, const struct names *names,
                     const struct style *style)
{
    for (size_t i = 0; i < names->columns; i++) {
        const struct label name = names_of_column(names, i);
        put_separator(out, style, i);
        if (name.length > 0)
            put_bytes(out, name.text, name.length);
        else
            put_string(out, style->missing ? style->missing : "-");
    }
    put_char(out, '\n');
}
