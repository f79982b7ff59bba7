/*
 * shapes.c - the shapes of a geometry: what their constructors got
 */
#include "shapes.h"

#include <float.h>

#include "../bvh/threads.h"
#include "../intersect.h"

/* The sign of the radii in a record; NaN: the filter does not decide.  Of balls
 * about one centre the filter reads the first. */
static double radii_sign(const cylint_shape *s)
{
    if (!cylint_is_bounded(s) || !cylint_has_end_points(s->kind))
        return NAN;
    if (!cylint_is_round(s->kind))
        return 1;
    return cylint_is_hull(s->kind) ||
                   (cylint_has_no_axis(s) && s->ends == CYLINT_ENDS_CAPPED &&
                    !cylint_is_reversed(s))
               ? -1
               : NAN;
}

void cylint_filter_record_of(cylint_record *to, const cylint_shape *s)
{
    cylint_set_record(to, s);
    const double sign = cylint_filter_serves(to) ? radii_sign(s) : NAN;
    to->r0 *= sign;
    to->r1 *= sign;
}

/* Whether x is a float and not subnormal. */
static int is_float(double x, float *to)
{
    *to = (float)x;
    return (double)*to == x &&
           (fabs(x) >= (double)FLT_MIN || cylint_sign(x) == 0);
}

int cylint_small_record_of(cylint_small_record *to, const cylint_shape *s)
{
    cylint_record large;
    cylint_filter_record_of(&large, s);
    int is = is_float(large.r0, &to->r0) & is_float(large.r1, &to->r1);
    EACH(j, 3)
        is &= is_float(large.p0[j], &to->p0[j]) &
              is_float(large.p1[j], &to->p1[j]);
    return is;
}

/* --------------------------------------------------------------- copying -- */

typedef struct {
    const cylint_view *from;
    const uint32_t *number;
    cylint_embree_shapes *to;
    uint8_t *ends;
} copying;

/* In place of the ends of a shape that does not fit into a small record. */
enum { TOO_LARGE = 255 };

static const cylint_shape *source_of(const copying *c, size_t i,
                                     cylint_shape *spare)
{
    return cylint_view_shape(c->from, c->number ? c->number[i] : (uint32_t)i,
                             spare);
}

static void copy_some(void *self, size_t from, size_t to)
{
    copying *c = self;
    cylint_small_record *floats = c->to->memory.data;
    cylint_record *doubles = c->to->memory.data;
    for (size_t i = from; i < to; i++) {
        cylint_shape spare;
        const cylint_shape *shape = source_of(c, i, &spare);
        c->ends[i] = (uint8_t)shape->ends;
        if (!c->to->small)
            cylint_filter_record_of(&doubles[i], shape);
        else if (!cylint_small_record_of(&floats[i], shape))
            c->ends[i] = TOO_LARGE;
    }
}

/* Makes small records or, if a shape does not fit, large ones; usually the first
 * shape decides. */
static int copy_records(copying *c, size_t n, int threads,
                        const cylint_memory_source *source)
{
    cylint_embree_shapes *to = c->to;
    cylint_small_record first;
    cylint_shape spare;
    to->small = cylint_small_record_of(&first, source_of(c, 0, &spare));
    for (;; to->small = 0) {
        const size_t size =
            to->small ? sizeof(cylint_small_record) : sizeof(cylint_record);
        if (!cylint_memory_allocate(&to->memory, source, n * (size + 1)))
            return 0;
        to->ends = c->ends = (uint8_t *)to->memory.data + n * size;
        cylint_threads_run(cylint_threads_for(n, threads), n, copy_some, c);
        if (!to->small || !memchr(to->ends, TOO_LARGE, n))
            return 1;
        cylint_memory_free(&to->memory);
    }
}

static int keep_whole(copying *c, size_t n, const cylint_memory_source *source)
{
    cylint_embree_shapes *to = c->to;
    cylint_record *records = to->memory.data;
    cylint_shape *whole;
    size_t next = 0, n_whole = 0;
    for (size_t i = 0; i < n && !to->small; i++)
        n_whole += records[i].r0 != records[i].r0;
    if (n_whole == 0)
        return 1;
    if (!cylint_memory_allocate(&to->whole_memory, source,
                                n_whole * sizeof *whole))
        return 0;
    to->whole = whole = to->whole_memory.data;
    for (size_t i = 0; i < n; i++)
        if (records[i].r0 != records[i].r0) {
            records[i].p0[0] = (double)next;
            const cylint_shape *shape = source_of(c, i, &whole[next]);
            if (shape != &whole[next])
                whole[next] = *shape;
            next++;
        }
    return 1;
}

int cylint_embree_shapes_copy(cylint_embree_shapes *to, const cylint_view *from,
                              const uint32_t *number, size_t n, int threads,
                              const cylint_memory_source *source)
{
    copying c = {.from = from, .number = number, .to = to};
    return copy_records(&c, n, threads, source) && keep_whole(&c, n, source);
}

void cylint_embree_shapes_free(cylint_embree_shapes *s)
{
    cylint_memory_free(&s->memory);
    cylint_memory_free(&s->whole_memory);
}

/* --------------------------------------------------------------- reading -- */

void cylint_embree_shape(const cylint_embree_shapes *s, size_t at,
                         cylint_shape *shape)
{
    cylint_record x;
    int kind = CYLINT_KIND_CONE;
    cylint_embree_record(s, at, &x);
    if (x.r0 != x.r0) {
        *shape = s->whole[(size_t)x.p0[0]];
        return;
    }
    if (x.r0 + x.r1 < 0) {
        const int is_sphere = x.r0 == x.r1 && cylint_record_is_point(&x);
        kind = is_sphere ? CYLINT_KIND_SPHERE : CYLINT_KIND_RCONE;
        x.r0 = -x.r0;
        x.r1 = -x.r1;
    }
    cylint_make_of_record(shape, kind, s->ends[at], &x, NULL);
}
