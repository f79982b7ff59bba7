/*
 * records.h - files of cases with known answers
 *
 * A line is a record of a case, then => and what is known of it.  Lines that begin
 * with # and empty ones are comments.
 */
#ifndef CYLINT_TEST_RECORDS_H
#define CYLINT_TEST_RECORDS_H

#include "check.h"
#include "families.h"

/* Calls take() with both parts of each record; there are `least` or more.  take()
 * returns the end of what it read in the second part, or NULL if the record is
 * wrong. */
static inline void each_record(const char *path, int least,
                               const char *take(const char *record,
                                                const char *known))
{
    char text[1500];
    int n = 0;
    FILE *f = fopen(path, "r");
    if (!CHECK(f))
        return;
    while (fgets(text, sizeof text, f)) {
        char *arrow = strstr(text, "=>");
        if (text[0] == '#' || text[0] == '\n')
            continue;
        if (arrow)
            *arrow = '\0';
        const char *end = arrow ? take(text, arrow + 2) : NULL;
        if (CHECK(end && end[strspn(end, " \n")] == '\0'))
            n++;
        else
            REPORT("%s: %s", path, text);
    }
    fclose(f);
    CHECK(n >= least);
}

#endif
