/*
 * classes.c - the families, one kind of shape at a time
 */
#include "classes.h"

#include <string.h>

enum { SEED = 1, DRAWS = 200, SHARE_DRAWS = 1000 };

static const struct {
    const char *name;
    family_shape word;
    cylint_ends ends;
} classes[] = {
    {"cylinder infinite", FAMILY_CYLINDER, CYLINT_ENDS_INFINITE},
    {"cylinder capped", FAMILY_CYLINDER, CYLINT_ENDS_CAPPED},
    {"cone infinite", FAMILY_CONE, CYLINT_ENDS_INFINITE},
    {"cone capped", FAMILY_CONE, CYLINT_ENDS_CAPPED},
    {"angle cone infinite", FAMILY_ACONE, CYLINT_ENDS_INFINITE},
    {"elliptic cylinder capped", FAMILY_ECYLINDER, CYLINT_ENDS_CAPPED},
    {"elliptic cone capped", FAMILY_ECONE, CYLINT_ENDS_CAPPED},
};

int class_count(void)
{
    return (int)(sizeof classes / sizeof classes[0]);
}

const char *class_name(int class_number)
{
    return classes[class_number].name;
}

static void make_line_whole(struct family_case *c)
{
    if (c->line_word == FAMILY_SEGMENT)
        for (int i = 0; i < 3; i++)
            c->line_data[i + 3] -= c->line_data[i];
    c->line_word = FAMILY_LINE;
}

static int belongs(int class_number, const struct family_case *c)
{
    return c->shape_word == classes[class_number].word &&
           (c->shape_word != FAMILY_CONE ||
            c->shape_data[3] != c->shape_data[7]);
}

int class_question(int class_number, int family, uint64_t *index,
                   struct question *q)
{
    const int segments = !strcmp(family_name(family), "exact differences");
    for (int i = 0; i < DRAWS; i++) {
        struct family_case c;
        family_case(SEED, family, (*index)++, &c);
        if (!belongs(class_number, &c))
            continue;
        c.ends = classes[class_number].ends;
        if (!segments)
            make_line_whole(&c);
        if (!family_make(&c))
            continue;
        q->subject.shape = c.shape;
        q->line = c.line;
        prepare_subject(&q->subject);
        return 1;
    }
    return 0;
}

const char *family_label(int family)
{
    static char label[64];
    size_t n = 0;
    for (const char *c = family_name(family); *c; c++)
        if (*c != ',' && n + 1 < sizeof label)
            label[n++] = *c;
    label[n] = 0;
    return label;
}

double share_answered(const struct contestant *c, int family)
{
    int taken = 0;
    for (uint64_t i = 0; i < SHARE_DRAWS; i++) {
        struct family_case k;
        family_case(SEED, family, i, &k);
        taken += contestant_takes(c, &k.shape);
    }
    return 100.0 * taken / SHARE_DRAWS;
}
