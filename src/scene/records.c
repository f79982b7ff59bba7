/*
 * records.c - the shapes of a scene: the arguments of their constructors
 */
#include "records.h"

#include <stdlib.h>
#include <string.h>

#include "../bvh/memory.h"
#include "../intersect.h"
#include "../shapes/local.h"
#include "../shapes/shape_facts.h"

/* ------------------------------------------------------------- memory -- */

static int resize_shapes(cylint_records *r, size_t capacity)
{
    void *record = cylint_resized(r->record, capacity, sizeof *r->record);
    r->record = record ? record : r->record;
    void *tag =
        record ? cylint_resized(r->tag, capacity, sizeof *r->tag) : NULL;
    r->tag = tag ? tag : r->tag;
    r->capacity = tag ? capacity : r->capacity;
    return tag != NULL;
}

static int resize_elliptic(cylint_records *r, size_t capacity)
{
    void *semi_axes =
        cylint_resized(r->semi_axes, capacity, sizeof *r->semi_axes);
    r->semi_axes = semi_axes ? semi_axes : r->semi_axes;
    r->elliptic_capacity = semi_axes ? capacity : r->elliptic_capacity;
    return semi_axes != NULL;
}

/* The capacity grows by a half at least, so that adding many blocks takes time
 * in proportion to the number of shapes. */
static size_t grown(size_t capacity, size_t wanted)
{
    const size_t by_half = capacity + capacity / 2;
    return by_half > wanted ? by_half : wanted;
}

int cylint_records_reserve(cylint_records *r, size_t n)
{
    return n <= r->capacity || resize_shapes(r, n);
}

void cylint_records_trim(cylint_records *r)
{
    if (r->n < r->capacity)
        resize_shapes(r, r->n);
    if (r->n_elliptic < r->elliptic_capacity)
        resize_elliptic(r, r->n_elliptic);
}

void cylint_records_free(cylint_records *r)
{
    free(r->record);
    free(r->tag);
    free(r->semi_axes);
}

size_t cylint_records_bytes(const cylint_records *r)
{
    return r->capacity * (sizeof *r->record + sizeof *r->tag) +
           r->elliptic_capacity * sizeof *r->semi_axes;
}

/* ------------------------------------------------------------- shapes -- */

static uint8_t tag_of(const cylint_shape *s)
{
    const int plain = cylint_prepared(s) != CYLINT_SOLID_NONE &&
                      cylint_is_bounded(s) && cylint_has_end_points(s->kind) &&
                      s->kind != CYLINT_KIND_SPHERE;
    return (uint8_t)(cylint_made_kind(s) + s->ends * CYLINT_TAG_ENDS +
                     (plain ? CYLINT_TAG_PLAIN : 0));
}

/* axes: the number of an elliptic shape among these. */
static void write_record(cylint_records *r, size_t number,
                         const cylint_shape *s, size_t axes)
{
    cylint_record *to = &r->record[number];
    r->tag[number] = tag_of(s);
    cylint_set_record(to, s);
    if (!cylint_is_elliptic(s->kind))
        return;
    to->r0 = (double)axes;
    cylint_set_semi_axes(&r->semi_axes[axes], s);
}

int cylint_records_add(cylint_records *r, const cylint_shape *shapes, size_t n)
{
    size_t elliptic = r->n_elliptic;
    for (size_t i = 0; i < n; i++)
        elliptic += (size_t)cylint_is_elliptic(shapes[i].kind);
    if ((r->n + n > r->capacity &&
         !resize_shapes(r, grown(r->capacity, r->n + n))) ||
        (elliptic > r->elliptic_capacity &&
         !resize_elliptic(r, grown(r->elliptic_capacity, elliptic))))
        return 0;
    for (size_t i = 0; i < n; i++) {
        write_record(r, r->n++, &shapes[i], r->n_elliptic);
        r->n_elliptic += (size_t)cylint_is_elliptic(shapes[i].kind);
    }
    return 1;
}

int cylint_record_takes(const cylint_records *r, size_t number,
                        const cylint_shape *s)
{
    const int kind = cylint_record_kind(r, number);
    return cylint_is_elliptic(kind) == cylint_is_elliptic(s->kind) &&
           (kind == CYLINT_KIND_NONE) == (s->kind == CYLINT_KIND_NONE);
}

void cylint_record_replace(cylint_records *r, size_t number,
                           const cylint_shape *s)
{
    const int has_axes = cylint_is_elliptic(s->kind);
    write_record(r, number, s, has_axes ? (size_t)r->record[number].r0 : 0);
}

void cylint_record_shape(const cylint_records *r, size_t number,
                         cylint_shape *shape)
{
    const cylint_record *from = &r->record[number];
    const int kind = cylint_record_kind(r, number);
    const int ends = cylint_record_ends(r, number);
    cylint_make_of_record(
        shape, kind, ends, from,
        cylint_is_elliptic(kind) ? &r->semi_axes[(size_t)from->r0] : NULL);
}

void cylint_record_data(const cylint_records *r, size_t number,
                        cylint_shape *shape)
{
    const cylint_record *from = &r->record[number];
    double *x = shape->library.number;
    if (!(r->tag[number] & CYLINT_TAG_PLAIN)) {
        cylint_record_shape(r, number, shape);
        return;
    }
    shape->kind = cylint_record_kind(r, number);
    shape->ends = cylint_record_ends(r, number);
    memcpy(x + CYLINT_AT_BASE, from->p0, sizeof from->p0);
    memcpy(x + CYLINT_AT_TOP, from->p1, sizeof from->p1);
    x[CYLINT_AT_R0] = from->r0;
    x[CYLINT_AT_R1] = from->r1;
    for (int i = 0; i < 3; i++)
        x[CYLINT_AT_AXIS + i] = from->p1[i] - from->p0[i];
}

/* ------------------------------------------------------------- checks -- */

static int is_radius(double x)
{
    return cylint_sign(x) >= 0 && x <= CYLINT_WINDOW;
}

/* What is true of each record whose tag has CYLINT_TAG_PLAIN.  The limits are wider
 * than the constructor's, that of lengths by a factor 2, that of squared sines
 * CYLINT_LOCAL_STEEPEST in place of its square, so that the rounding mode does not
 * matter.  A shape so made is one that its constructor accepts. */
static int is_plain(const cylint_records *r, size_t number)
{
    const cylint_record *at = &r->record[number];
    const int kind = cylint_record_kind(r, number),
              ends = cylint_record_ends(r, number);
    const int is_straight =
        kind == CYLINT_KIND_CYLINDER || kind == CYLINT_KIND_CAPSULE;
    const int is_tapered =
        kind == CYLINT_KIND_CONE || kind == CYLINT_KIND_RCONE;
    const double w[3] = {2 * (at->p1[0] - at->p0[0]),
                         2 * (at->p1[1] - at->p0[1]),
                         2 * (at->p1[2] - at->p0[2])};
    const double growth = fabs(at->r1 - at->r0), size = cylint_largest(w);
    const double length2 = cylint_dot(w, w);
    return (cylint_rank(at->r0) == cylint_rank(at->r1) ? is_straight
                                                       : is_tapered) &&
           cylint_ends_fit(kind, ends) && cylint_ends_are_planes(ends) &&
           is_radius(at->r0) && is_radius(at->r1) &&
           cylint_sign(at->r0) + cylint_sign(at->r1) > 0 &&
           cylint_is_finite(at->p0) && cylint_is_finite(at->p1) &&
           cylint_largest(at->p0) <= CYLINT_FAR && size <= 4 * CYLINT_WINDOW &&
           cylint_is_long_enough(w) && growth <= CYLINT_LOCAL_MOST * size &&
           (kind != CYLINT_KIND_RCONE ||
            growth * growth <= CYLINT_LOCAL_STEEPEST * (length2 / 4));
}

/* Whether a record that is not plain makes a shape of its tag.  Whether a shape is
 * plain depends on the rounding mode. */
static int is_made_again(const cylint_records *r, size_t number)
{
    cylint_shape shape;
    cylint_record_shape(r, number, &shape);
    return (tag_of(&shape) & ~CYLINT_TAG_PLAIN) == r->tag[number];
}

int cylint_records_are_sound(const cylint_records *r)
{
    size_t elliptic = 0;
    for (size_t i = 0; i < r->n; i++) {
        const int has_axes = cylint_is_elliptic(cylint_record_kind(r, i));
        if (has_axes && (elliptic >= r->n_elliptic ||
                         r->record[i].r0 != (double)elliptic++))
            return 0;
        if (r->tag[i] & CYLINT_TAG_PLAIN ? !is_plain(r, i)
                                         : !is_made_again(r, i))
            return 0;
    }
    return elliptic == r->n_elliptic;
}
