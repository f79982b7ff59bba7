/*
 * records.c - random records for the command, in hexadecimal
 *
 *   records SEED COUNT         COUNT records, from all families in turn
 *
 * Cases with an infinite end of the domain have no record and are left out.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "families.h"

static int has_record(const struct family_case *c)
{
    return c->line_word != FAMILY_SPAN ||
           (isfinite(c->line_data[6]) && isfinite(c->line_data[7]));
}

int main(int argc, char **argv)
{
    const uint64_t seed = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    const uint64_t count = argc > 2 ? strtoull(argv[2], NULL, 10) : 1000;
    const uint64_t families = (uint64_t)family_count();
    uint64_t printed = 0;
    for (uint64_t i = 0; printed < count; i++) {
        struct family_case c;
        family_case(seed, (int)(i % families), i / families, &c);
        if (!has_record(&c))
            continue;
        printed++;
        family_print(stdout, &c);
        putchar('\n');
    }
    return fclose(stdout) != 0;
}
