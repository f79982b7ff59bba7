/*
 * same.h - whether answers are equal, bit for bit
 *
 * A struct has padding, and members that are not wanted have any values, so the
 * wanted members are compared one by one.
 */
#ifndef CYLINT_TEST_SAME_H
#define CYLINT_TEST_SAME_H

#include <stddef.h>
#include <string.h>

#include "check.h"
#include "cylint.h"
#include "families.h"

enum { EVERY_WANT = CYLINT_WANT_ALL | CYLINT_WANT_NEAREST };

/* The place of each member of a hit, and the want that names it. */
static const struct {
    unsigned want;
    size_t at, size;
} hit_members[] = {
    {CYLINT_WANT_T, offsetof(cylint_hit, t), sizeof(double)},
    {CYLINT_WANT_PART, offsetof(cylint_hit, part), sizeof(int)},
    {CYLINT_WANT_PART, offsetof(cylint_hit, side), sizeof(int)},
    {CYLINT_WANT_POINT, offsetof(cylint_hit, point), 3 * sizeof(double)},
    {CYLINT_WANT_NORMAL, offsetof(cylint_hit, normal), 3 * sizeof(double)},
    {CYLINT_WANT_Z, offsetof(cylint_hit, z), sizeof(double)},
    {CYLINT_WANT_PHI, offsetof(cylint_hit, phi), sizeof(double)},
};

enum { HIT_MEMBERS = sizeof hit_members / sizeof *hit_members };

enum { UNTOUCHED = 0x55 }; /* the bytes of what is not written */

/* The hit as a query that wants fewer members writes it. */
static inline cylint_hit with_members(const cylint_hit *all, unsigned want)
{
    cylint_hit hit;
    memset(&hit, UNTOUCHED, sizeof hit);
    for (int k = 0; k < HIT_MEMBERS; k++)
        if (want & hit_members[k].want)
            memcpy((char *)&hit + hit_members[k].at,
                   (const char *)all + hit_members[k].at, hit_members[k].size);
    return hit;
}

static inline int same_bytes(const void *x, const void *y, size_t n)
{
    return memcmp(x, y, n) == 0;
}

static inline int same_double(double x, double y)
{
    return same_bytes(&x, &y, sizeof x);
}

static inline int same_hit(const cylint_hit *x, const cylint_hit *y,
                           unsigned want)
{
    for (int k = 0; k < HIT_MEMBERS; k++)
        if (want & hit_members[k].want &&
            !same_bytes((const char *)x + hit_members[k].at,
                        (const char *)y + hit_members[k].at,
                        hit_members[k].size))
            return 0;
    return 1;
}

/* Whether `got`, of which the members `want` are wanted, is the part of `all`
 * that it should be. */
static inline int same_answer(const cylint_answer *got,
                              const cylint_answer *all, unsigned want)
{
    const int most = want & CYLINT_WANT_NEAREST ? 1 : 2;
    int same = got->relation == all->relation && got->flags == all->flags &&
               got->n == (all->n < most ? all->n : most);
    for (int i = 0; i < got->n && same; i++)
        same = same_hit(&got->hit[i], &all->hit[i], want);
    return same;
}

/* The same; a normal or a phi of `other`, of the oracle, is right, too. */
static inline int is_right(const cylint_answer *got, const cylint_answer *want,
                           const cylint_hit other[2])
{
    cylint_answer due = *want;
    for (int i = 0; i < want->n; i++) {
        const cylint_hit *g = &got->hit[i];
        for (int k = 0; k < 3; k++)
            if (g->normal[k] == other[i].normal[k])
                due.hit[i].normal[k] = other[i].normal[k];
        if (g->phi == other[i].phi)
            due.hit[i].phi = other[i].phi;
    }
    return same_answer(got, &due, CYLINT_WANT_ALL);
}

/* Whether members that are wanted have the bits that they have among all, and the
 * others keep their bytes. */
static inline int has_wanted_members(const struct family_case *c, unsigned want)
{
    cylint_answer all, some;
    memset(&some, UNTOUCHED, sizeof some);
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &all);
    const int n = cylint_intersect(&c->shape, &c->line, want, &some);
    int good = n == some.n && same_answer(&some, &all, want);
    for (int i = 0; i < 2; i++) {
        const cylint_hit due = with_members(&all.hit[i], i < n ? want : 0);
        good = good && same_hit(&some.hit[i], &due, CYLINT_WANT_ALL);
    }
    return good && cylint_occluded(&c->shape, &c->line) == (all.n > 0);
}

/* Prints what was got and what should be, below a failed check. */
static inline void report_answers(const struct family_case *c, const char *what,
                                  const cylint_answer *got,
                                  const cylint_answer *all)
{
    const cylint_answer *const both[2] = {got, all};
    if (check_bad > CHECK_SHOWN)
        return;
    fprintf(stderr, "# %s\n", what);
    family_report(c);
    for (int k = 0; k < 2; k++) {
        fprintf(stderr, "#   %s relation %d n %d flags %d\n",
                k ? "want" : "got ", both[k]->relation, both[k]->n,
                both[k]->flags);
        for (int i = 0; i < both[k]->n && i < 2; i++) {
            const cylint_hit *h = &both[k]->hit[i];
            fprintf(stderr,
                    "#     t %a part %d side %d point %a %a %a normal %a %a %a "
                    "z %a phi %a\n",
                    h->t, h->part, h->side, h->point[0], h->point[1],
                    h->point[2], h->normal[0], h->normal[1], h->normal[2], h->z,
                    h->phi);
        }
    }
}

#endif
