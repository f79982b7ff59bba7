/*
 * classes.h - the families, one kind of shape at a time
 *
 * A family has all kinds of shapes, ends and lines; a published method answers
 * for some of them.  To make methods comparable, a class takes the cases of
 * one kind from a family, gives them the same ends, and replaces the line by
 * the whole line, except in the family of segments.
 */
#ifndef BENCH_CLASSES_H
#define BENCH_CLASSES_H

#include "contestants.h"
#include "families.h"

int class_count(void);
const char *class_name(int class_number);

/* The next case of the class in the family from case *index on; returns 0 if
 * the family has none. */
int class_question(int class_number, int family, uint64_t *index,
                   struct question *q);

/* A family's name without commas, for CSV. */
const char *family_label(int family);

/* Percentage of the unchanged family's cases that a contestant answers. */
double share_answered(const struct contestant *c, int family);

#endif
