/*
 * classes.h - the families, one kind of shape at a time
 *
 * A family holds all kinds of shapes, ends and lines; a published method
 * answers for some.  So that methods can be compared, a class takes from a
 * family the cases of one kind, gives them one kind of ends and makes the
 * lines whole, but for the family that is about segments.
 */
#ifndef BENCH_CLASSES_H
#define BENCH_CLASSES_H

#include "contestants.h"
#include "families.h"

int class_count(void);
const char *class_name(int class_number);

/* Case `index` of that kind out of a family; 0 if the family has none. */
int class_question(int class_number, int family, uint64_t *index,
                   struct question *q);

/* A family's name without commas, which separate columns of CSV. */
const char *family_label(int family);

/* Of the family as it is, per cent of the cases a contestant answers. */
double share_answered(const struct contestant *c, int family);

#endif
