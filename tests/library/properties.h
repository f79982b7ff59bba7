/*
 * properties.h - properties of the answer to one line and one shape
 *
 * The library is compared with itself on changed input whose answer changes in
 * a known manner.  Each function returns whether its property holds for the
 * case, and 1 for a case that has no such property.
 */
#ifndef CYLINT_TEST_PROPERTIES_H
#define CYLINT_TEST_PROPERTIES_H

#include <float.h>
#include <math.h>

#include "cylint_pieces.h"
#include "same.h"
#include "shapes/shape_facts.h"
#include "ulps.h"
#include "vectors.h"

/* All members but phi, whose reference direction may change. */
static const unsigned without_phi = CYLINT_WANT_ALL & ~CYLINT_WANT_PHI;

static inline cylint_answer answer_to(const struct family_case *c)
{
    cylint_answer a;
    memset(&a, 0, sizeof a);
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &a);
    return a;
}

/* Equal or neighbours: a component of a normal, or phi, may be either double where
 * the real number is in the middle. */
static inline int is_beside(double x, double y)
{
    return x == y || nextafter(x, y) == y;
}

static inline int has_same_normal(const cylint_hit *x, const cylint_hit *y)
{
    return is_beside(x->normal[0], y->normal[0]) &&
           is_beside(x->normal[1], y->normal[1]) &&
           is_beside(x->normal[2], y->normal[2]);
}

/* The relation, and these members of the hits. */
static inline int same_members(const cylint_answer *x, const cylint_answer *y,
                               unsigned want)
{
    int same = same_answer(
        x, y, want & ~(unsigned)(CYLINT_WANT_NORMAL | CYLINT_WANT_PHI));
    for (int i = 0; i < x->n && same; i++)
        same = (!(want & CYLINT_WANT_NORMAL) ||
                has_same_normal(&x->hit[i], &y->hit[i])) &&
               (!(want & CYLINT_WANT_PHI) ||
                is_beside(x->hit[i].phi, y->hit[i].phi));
    return same;
}

/* At the apex of a double cone the normal depends on the direction of the line. */
static inline int is_between_nappes(const struct family_case *c,
                                    const cylint_hit *h)
{
    return h->side == CYLINT_SIDE_BOTH &&
           c->shape.ends == CYLINT_ENDS_INFINITE &&
           cylint_is_tapered(c->shape.kind);
}

static inline int is_good_hit(const cylint_hit *h, const cylint_line *line)
{
    const double x[] = {h->t,         h->z,         h->phi,
                        h->point[0],  h->point[1],  h->point[2],
                        h->normal[0], h->normal[1], h->normal[2]};
    int good = line->tmin <= h->t && h->t <= line->tmax && h->phi >= 0 &&
               h->phi < 1 && h->part >= CYLINT_PART_LATERAL &&
               h->part <= CYLINT_PART_CAP1 && h->side >= CYLINT_SIDE_ENTERING &&
               h->side <= CYLINT_SIDE_BOTH &&
               fmax(fabs(x[6]), fmax(fabs(x[7]), fabs(x[8]))) > 0.5;
    for (int i = 0; i < 9; i++)
        good = good && x[i] == x[i] && !(x[i] == 0 && signbit(x[i])) &&
               (i < 6 || fabs(x[i]) <= 1);
    return good;
}

/* Hits ascend within the domain; numbers are in their ranges, and none is -0. */
static inline int has_good_members(const struct family_case *c)
{
    const cylint_answer a = answer_to(c);
    const int refused = c->shape.kind == CYLINT_KIND_NONE || !c->line.valid;
    int good = a.n >= 0 && a.n <= 2 && a.relation >= CYLINT_RELATION_MISS &&
               a.relation <= CYLINT_RELATION_CROSS &&
               a.flags == (refused ? CYLINT_FLAG_INVALID : 0) &&
               (!refused || a.relation == CYLINT_RELATION_MISS) &&
               (a.relation != CYLINT_RELATION_MISS || a.n == 0) &&
               (a.relation != CYLINT_RELATION_TOUCH || a.n <= 1) &&
               (a.n < 2 || a.hit[0].t <= a.hit[1].t);
    for (int i = 0; i < a.n && good; i++)
        good = is_good_hit(&a.hit[i], &c->line);
    return good;
}

/* Wanted members have the bits of the full answer; the others keep their bytes. */
static inline int has_wanted_members(const struct family_case *c, unsigned want)
{
    const cylint_answer full = answer_to(c);
    cylint_answer some, before;
    memset(&before, 0x5a, sizeof before);
    some = before;
    const int n = cylint_intersect(&c->shape, &c->line, want, &some);
    int good = n == some.n && same_answer(&some, &full, want);
    for (int i = 0; i < 2; i++)
        good =
            good && same_hit(&some.hit[i], &before.hit[i],
                             i < n ? CYLINT_WANT_ALL & ~want : CYLINT_WANT_ALL);
    return good;
}

static inline int has_all_wanted_members(const struct family_case *c)
{
    for (unsigned want = 0; want < 2 * CYLINT_WANT_NEAREST; want++)
        if (!has_wanted_members(c, want))
            return 0;
    return cylint_occluded(&c->shape, &c->line) == (answer_to(c).n > 0);
}

/* The place of the origin, if t = 0 is no end of a chord; -2: it is one, or the
 * overlap is too short for a chord. */
static inline int place_by_chords(const struct family_case *c)
{
    struct family_case whole = *c;
    cylint_interval chord[2];
    whole.line = whole_of(c->line);
    const cylint_answer a = answer_to(&whole);
    const int n = cylint_chord(&c->shape, &whole.line, chord);
    int place = n > 0 || a.relation == CYLINT_RELATION_MISS ? -1 : -2;
    for (int i = 0; i < a.n; i++)
        if (a.hit[i].t == 0)
            return -2;
    for (int i = 0; i < n; i++)
        if (chord[i].t0 == 0 || chord[i].t1 == 0)
            return -2;
        else if (chord[i].t0 < 0 && 0 < chord[i].t1)
            place = a.relation == CYLINT_RELATION_CROSS;
    return place;
}

/* The origin is inside if it is in a chord; its place bounds the relation.  The box
 * has it. */
static inline int has_its_origin(const struct family_case *c)
{
    double lo[3], hi[3];
    const int where = cylint_contains(&c->shape, c->line.o);
    if (!c->line.valid)
        return 1;
    const int relation = answer_to(c).relation, place = place_by_chords(c);
    cylint_bounds(&c->shape, lo, hi);
    int good = (place == -2 || where == place) &&
               (where < 0 || relation != CYLINT_RELATION_MISS) &&
               (where < 1 || relation == CYLINT_RELATION_CROSS);
    for (int i = 0; i < 3; i++)
        good = good &&
               (where < 0 || (lo[i] <= c->line.o[i] && c->line.o[i] <= hi[i]));
    return good;
}

/* -------------------------------------------------- changes of the line -- */

/* The hits of y, in reverse order, are those of x, at t or with a segment at 1
 * - t. */
static inline int is_reverse(const struct family_case *c,
                             const cylint_answer *x, const cylint_answer *y)
{
    int good = x->relation == y->relation && x->n == y->n;
    for (int i = 0; i < x->n && good; i++) {
        const cylint_hit *a = &x->hit[i], *b = &y->hit[x->n - 1 - i];
        good = (c->line.segment ? fabs(a->t - (1 - b->t)) <= DBL_EPSILON
                                : a->t == -b->t) &&
               a->part == b->part &&
               a->side == (b->side == CYLINT_SIDE_BOTH ? CYLINT_SIDE_BOTH
                                                       : 1 - b->side) &&
               same_hit(a, b, CYLINT_WANT_POINT | CYLINT_WANT_Z) &&
               is_beside(a->phi, b->phi) &&
               (has_same_normal(a, b) || is_between_nappes(c, a));
    }
    return good;
}

static inline int is_reversed_with_its_line(const struct family_case *given)
{
    struct family_case c = *given;
    const int segment = c.line_word == FAMILY_SEGMENT;
    for (int i = 0; i < 3; i++) {
        c.line_data[i] = given->line_data[segment ? i + 3 : i];
        c.line_data[i + 3] =
            segment ? given->line_data[i] : -given->line_data[i + 3];
    }
    if (!family_make(&c) && c.line_word != FAMILY_SPAN)
        return 1;
    if (!segment) {
        cylint_span(&c.line, c.line_data, c.line_data + 3, -given->line.tmax,
                    -given->line.tmin);
        if (!given->line.valid)
            return 1;
    }
    const cylint_answer a = answer_to(given), b = answer_to(&c);
    return is_reverse(given, &a, &b);
}

/* Each hit is in the part of the domain where its t lies; if the domain is cut at
 * its t, in one part or in both. */
static inline int may_be_cut(const struct family_case *given, double cut)
{
    struct family_case parts[2] = {*given, *given};
    if (!(given->line.tmin <= cut && cut <= given->line.tmax))
        return 1;
    parts[0].line.tmax = parts[1].line.tmin = cut;
    const cylint_answer all = answer_to(given),
                        some[2] = {answer_to(&parts[0]), answer_to(&parts[1])};
    int good = 1, n[2] = {0, 0}, in[2];
    for (int i = 0; i < all.n; i++) {
        const double t = all.hit[i].t;
        for (int k = 0; k < 2; k++) {
            in[k] = n[k] < some[k].n &&
                    same_hit(&some[k].hit[n[k]], &all.hit[i], CYLINT_WANT_ALL);
            n[k] += in[k];
        }
        good = good && (in[0] || in[1]) && (t <= cut || !in[0]) &&
               (t >= cut || !in[1]);
    }
    return good && n[0] == some[0].n && n[1] == some[1].n;
}

static inline int may_be_cut_at_hits(const struct family_case *c)
{
    const cylint_answer a = answer_to(c);
    int good = 1;
    for (int i = 0; i < a.n; i++)
        good = good && may_be_cut(c, a.hit[i].t) &&
               may_be_cut(c, nextafter(a.hit[i].t, HUGE_VAL)) &&
               may_be_cut(c, nextafter(a.hit[i].t, -HUGE_VAL));
    return good;
}

/* ------------------------------------------------- changes of the whole -- */

/* Rotates the coordinates, (x, y, z) to (z, x, y), `round` times, and changes
 * the signs by the bits of `flip`. */
static inline void turn3(double v[3], int round, int flip)
{
    const double x[3] = {v[0], v[1], v[2]};
    for (int i = 0; i < 3; i++)
        v[(i + round) % 3] = flip >> i & 1 ? -x[i] : x[i];
}

static inline int is_moved(const struct family_case *given, int round, int flip)
{
    struct family_case c = *given;
    const int axis = family_axis(c.shape_word), /* after 1 or 3 vectors */
        step = family_lengths(c.shape_word) == 12 ? 3 : axis; /* elliptic */
    for (int at = 0; at < axis; at += step)
        turn3(c.shape_data + at, round, flip);
    turn3(c.shape_data + axis, round, flip);
    turn3(c.line_data, round, flip);
    turn3(c.line_data + 3, round, flip);
    family_make(&c);
    cylint_answer a = answer_to(given);
    const cylint_answer b = answer_to(&c);
    for (int i = 0; i < a.n; i++) {
        turn3(a.hit[i].point, round, flip);
        turn3(a.hit[i].normal, round, flip);
        for (int k = 0; k < 3; k++)
            a.hit[i].point[k] += 0; /* -0 becomes 0 */
    }
    return same_members(&a, &b, without_phi);
}

static inline int may_be_permuted_and_mirrored(const struct family_case *c)
{
    return is_moved(c, 1, 0) && is_moved(c, 2, 0) && is_moved(c, 0, 1) &&
           is_moved(c, 0, 6) && is_moved(c, 1, 4);
}

/* Whether y is 2^e x, or one of them may be rounded: it is no normal number. */
static inline int is_scaled(double x, double y, int e)
{
    const double s = ldexp(x, e);
    return s == y || !(fabs(s) <= DBL_MAX && fabs(x) <= DBL_MAX) ||
           fabs(s) < DBL_MIN || fabs(x) < DBL_MIN;
}

/* All lengths times 2^e and d times 2^f give t times 2^(e - f) and points times
 * 2^e. */
static inline int is_scaled_by(const struct family_case *given, int e, int f)
{
    struct family_case c = *given, whole = *given;
    const int segment = c.line_word == FAMILY_SEGMENT;
    if (!scale_exactly(c.shape_data, family_lengths(c.shape_word), e) ||
        !scale_exactly(c.line_data, 3, e) ||
        !scale_exactly(c.line_data + 3, 3, segment ? e : f))
        return 1;
    family_make(&c);
    if (!segment) {
        whole.line = whole_of(whole.line);
        c.line = whole_of(c.line);
    }
    const cylint_answer a = answer_to(&whole), b = answer_to(&c);
    int good = a.relation == b.relation && a.n == b.n;
    for (int i = 0; i < a.n && good; i++) {
        const cylint_hit *h = &a.hit[i], *k = &b.hit[i];
        good = is_scaled(h->t, k->t, segment ? 0 : e - f) &&
               same_hit(h, k, CYLINT_WANT_PART | CYLINT_WANT_Z) &&
               has_same_normal(h, k) && is_beside(h->phi, k->phi);
        for (int j = 0; j < 3; j++)
            good = good && is_scaled(h->point[j], k->point[j], e);
    }
    return good;
}

static inline int is_scaled_by_powers_of_two(const struct family_case *c)
{
    static const int by[][2] = {
        {1, 1}, {-7, 3}, {300, -200}, {-500, 500}, {900, 0}};
    int good = 1;
    for (int i = 0; i < 5; i++)
        good = good && is_scaled_by(c, by[i][0], by[i][1]);
    return good;
}

#endif
