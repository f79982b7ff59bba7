/*
 * batch.c - many shapes or many lines: pack, nearest, count, columns
 *
 * Shapes are sorted into runs, each for one kernel, keeping their order
 * within a run; lanes carry the shapes' numbers.
 */
#include "signs/sign.h"
#include "dispatch.h"
#include "intersect.h"

/* A run for each solid.  That of none is for shapes that the filter does not
 * serve. */
enum { RUNS = CYLINT_SOLIDS, PADDING = 8 };

static int run_of(const cylint_shape *s)
{
    return cylint_surface(s) == CYLINT_PART_LATERAL ? cylint_prepared(s)
                                                    : CYLINT_SOLID_NONE;
}

/* Room for the runs, the numbers, and columns, which have less than PADDING more
 * lanes a run; and for moving all to an aligned address. */
size_t cylint_pack_bytes(size_t n)
{
    const size_t lane = sizeof(size_t) + COLUMNS * sizeof(double);
    const size_t fixed = RUNS * (sizeof(cylint_run) + PADDING * lane) + 3 * 64;
    return n <= (SIZE_MAX - fixed) / lane ? fixed + n * lane : SIZE_MAX;
}

static char *aligned(char *p)
{
    /* mutant '-' -> '+': unaligned loads are right, but slower */
    return p + (64 - (uintptr_t)p % 64) % 64;
}

static cylint_run *runs_of(void *memory)
{
    return (cylint_run *)(void *)aligned(memory);
}

static void fill_lane(double *column, size_t stride, const cylint_shape *s)
{
    double center[3];
    column[COLUMN_BALL * stride] = cylint_ball_about(s, center);
    for (int i = 0; i < 3; i++)
        column[(size_t)(COLUMN_CENTER + i) * stride] = center[i];
}

void cylint_pack_shapes(cylint_pack *pack, void *memory,
                        const cylint_shape *shapes, size_t n)
{
    cylint_run *runs = runs_of(memory);
    size_t *number = (size_t *)(void *)aligned((char *)(runs + RUNS));
    double *column = (double *)(void *)aligned(
        (char *)(number + n + (size_t)RUNS * PADDING));
    size_t *fill[RUNS];
    pack->n = n;
    pack->shapes = shapes;
    pack->memory = memory;
    memset(runs, 0, RUNS * sizeof *runs);
    for (size_t i = 0; i < n; i++)
        runs[run_of(&shapes[i])].n++;
    for (int r = 0; r < RUNS; r++) {
        cylint_run *run = &runs[r];
        run->solid = r;
        run->stride = (run->n + PADDING - 1) / PADDING * PADDING;
        run->number = fill[r] = number;
        run->column = column;
        number += run->stride;
        column += run->stride * COLUMNS;
    }
    for (size_t i = 0; i < n; i++)
        *fill[run_of(&shapes[i])]++ = i;
    for (int r = 0; r < RUNS; r++) {
        const cylint_run *run = &runs[r];
        for (size_t i = run->n; i < run->stride; i++)
            *fill[r]++ = run->number[run->n - 1];
        for (size_t i = 0; i < run->stride; i++)
            fill_lane((double *)run->column + i, run->stride,
                      &shapes[run->number[i]]);
    }
}

/* ------------------------------------------------------ the questions -- */

/* The columns of one of the hits; NULL: not wanted. */
typedef struct {
    double *t;
    signed char *part;
    double *number[CYLINT_HIT_NUMBERS];
} hit_columns;

/* A batch query, the use of its answers, and the result so far. */
typedef struct {
    enum { FIND_NEAREST, COUNT_HITS, FILL_COLUMNS } purpose;
    const cylint_line *line;   /* one line for all shapes, or NULL */
    const cylint_lines *lines; /* else one for each number */
    unsigned want;
    int relations;  /* wanted even where there is no hit */
    double nearest; /* t of the nearest hit so far, else infinite */
    size_t best, count, enough;
    int part, side; /* of the nearest hit */
    int stopped;    /* no more answers are wanted */
    const cylint_columns *columns;
    hit_columns of_hit[2];
} batch_job;

static void keep_nearest(batch_job *job, size_t number, const cylint_answer *a)
{
    if (a->n == 0)
        return;
    /* by the bits: subnormal t may count as zero */
    const int64_t t = cylint_rank(a->hit[0].t);
    const int64_t nearest = cylint_rank(job->nearest);
    if (t < nearest || (t == nearest && number < job->best)) {
        job->nearest = a->hit[0].t;
        job->best = number;
        job->part = a->hit[0].part;
        job->side = a->hit[0].side;
    }
}

/* Before this, the columns have the values of a miss. */
static void fill_columns(const batch_job *job, size_t i, const cylint_answer *a)
{
    if (job->columns->relation)
        job->columns->relation[i] = (signed char)a->relation;
    if (job->columns->n)
        job->columns->n[i] = (signed char)a->n;
    for (int k = 0; k < a->n; k++) {
        const hit_columns *to = &job->of_hit[k];
        const cylint_hit *hit = &a->hit[k];
        if (to->t)
            to->t[i] = hit->t;
        if (to->part)
            to->part[i] = (signed char)hit->part;
        if (!(job->want & CYLINT_WANT_BESIDE_T))
            continue;
        const double number[CYLINT_HIT_NUMBERS] = {
            hit->point[0],  hit->point[1],  hit->point[2], hit->normal[0],
            hit->normal[1], hit->normal[2], hit->z,        hit->phi};
        for (int j = 0; j < CYLINT_HIT_NUMBERS; j++)
            if (to->number[j])
                to->number[j][i] = number[j];
    }
}

/* Uses an answer.  Returns 1 when no more are wanted. */
CYLINT_INLINE int use_answer(batch_job *job, size_t number,
                             const cylint_answer *a)
{
    switch (job->purpose) {
    case FIND_NEAREST:
        keep_nearest(job, number, a);
        return 0;
    case COUNT_HITS:
        job->count += a->n > 0;
        return job->enough != 0 && job->count == job->enough;
    default:
        fill_columns(job, number, a);
        return 0;
    }
}

/* One question by itself.  Returns 1 when no more are wanted. */
static int answer_alone(batch_job *job, const cylint_shape *shape,
                        size_t number)
{
    cylint_line own;
    cylint_answer a;
    if (!job->line && cylint_read_line(job->lines, number, &own) != CYLINT_OK)
        return 0;
    cylint_intersect(shape, job->line ? job->line : &own,
                     job->want | CYLINT_WANT_PART, &a);
    return use_answer(job, number, &a);
}

/* The nearest hit in a lane that the filter decided. */
CYLINT_INLINE void nearest_of_lane(const cylint_filter_group *g, int lane,
                                   cylint_answer *a)
{
    const int first = g->hit[0] >> lane & 1 ? 0 : 1;
    const int swapped = (int)(g->leaving_first >> lane & 1);
    a->relation = CYLINT_RELATION_CROSS;
    a->n = (int)(g->hit[first] >> lane & 1);
    if (a->n > 0) {
        a->hit[0].t = g->t[first][lane];
        a->hit[0].part = (int)g->part[first][lane];
        a->hit[0].side = swapped ? !first : first;
    }
}

/* fill_columns() for lanes that the filter decided and that do not miss. */
static void fill_lanes(const batch_job *job, const cylint_filter_group *g,
                       unsigned lanes)
{
    signed char *const relation = job->columns->relation;
    EACH_BIT(lane, lanes) {
        const size_t i = g->number[lane];
        int n = 0;
        for (int k = 0; k < 2; k++) {
            if (!(g->hit[k] >> lane & 1))
                continue;
            const hit_columns *to = &job->of_hit[n++];
            if (to->t)
                to->t[i] = g->t[k][lane];
            if (to->part)
                to->part[i] = (signed char)g->part[k][lane];
            if (job->want & CYLINT_WANT_BESIDE_T)
                EACH(j, CYLINT_HIT_NUMBERS)
                    if (to->number[j])
                        to->number[j][i] = g->member[k].number[j][lane];
        }
        if (job->columns->n)
            job->columns->n[i] = (signed char)n;
        if (relation)
            relation[i] = (signed char)(g->in_cap_plane >> lane & 1
                                            ? CYLINT_RELATION_ALONG
                                            : CYLINT_RELATION_CROSS);
    }
}

static int use_group(void *self, cylint_filter_batch *from,
                     const cylint_filter_group *g)
{
    batch_job *job = self;
    unsigned all = g->found;
    if (job->purpose == FILL_COLUMNS) {
        fill_lanes(job, g, all & ~g->undecided);
        all &= g->undecided;
    }
    EACH_BIT(lane, all) {
        const size_t number = g->number[lane];
        cylint_answer answer;
        int enough;
        if (g->undecided >> lane & 1) {
            enough = answer_alone(job, &from->shapes[from->run ? number : 0],
                                  number);
        } else {
            nearest_of_lane(g, lane, &answer);
            enough = use_answer(job, number, &answer);
        }
        if (enough)
            return job->stopped = 1;
    }
    from->nearest = job->nearest;
    return 0;
}

/* Questions of one solid.  Returns 1 when no more are wanted. */
static int answer_by_filter(batch_job *job, const cylint_shape *shapes,
                            const cylint_run *run, size_t n)
{
    const cylint_line *l = job->line;
    cylint_filter_batch from;
    from.shapes = shapes;
    from.records = NULL;
    from.run = run;
    from.line = l;
    from.lines = job->lines;
    from.solid = run ? run->solid : cylint_prepared(shapes);
    from.n = n;
    from.want = job->want;
    from.relations = job->relations;
    /* Where a hit can end the batch, groups grow from one number on: few shapes
     * are then tested in vain. */
    from.awaited = job->enough != 0 ? 1 : PADDING;
    from.nearest = job->nearest;
    from.speed = l ? sqrt(cylint_dot(l->d, l->d)) * CYLINT_SLACK : 0;
    from.lane = from.first = from.end = 0;
    if (!run)
        from.radius = cylint_ball_about(shapes, from.center);
    CYLINT_OF_LANES(n >= CYLINT_LANES_AVX512, cylint_many)
    (&from, use_group, job);
    return job->stopped;
}

/* Lanes round only where rounding is to nearest.  Members of a line with subnormal
 * coordinates are certain only where the processor reads these. */
static int lanes_serve(const batch_job *job)
{
    return cylint_rounds_to_nearest() &&
           !(job->want & CYLINT_WANT_BESIDE_T && cylint_flushes_subnormals());
}

static void answer_pack(const cylint_pack *pack, batch_job *job)
{
    const cylint_run *runs = runs_of(pack->memory);
    if (job->line && !job->line->valid)
        return;
    const int scalar = (job->line && !job->line->in_range) || !lanes_serve(job);
    for (int r = 0; r < RUNS; r++) {
        const cylint_run *run = &runs[r];
        if (run->n == 0)
            continue;
        if (!scalar && run->solid != CYLINT_SOLID_NONE) {
            if (answer_by_filter(job, pack->shapes, run, run->n))
                return;
            continue;
        }
        for (size_t i = 0; i < run->n; i++) {
            const size_t number = run->number[i];
            if (answer_alone(job, &pack->shapes[number], number))
                return;
        }
    }
}

size_t cylint_nearest(const cylint_pack *pack, const cylint_line *line,
                      unsigned want, cylint_hit *hit)
{
    batch_job job = {.purpose = FIND_NEAREST,
                     .nearest = HUGE_VAL,
                     .line = line,
                     .best = pack->n,
                     .want = CYLINT_WANT_T | CYLINT_WANT_NEAREST};
    answer_pack(pack, &job);
    if (job.best == pack->n)
        return pack->n;
    const cylint_hit partial = {
        .t = job.nearest, .part = job.part, .side = job.side};
    cylint_write_hit(&pack->shapes[job.best], line, &partial, want, hit);
    return job.best;
}

size_t cylint_count(const cylint_pack *pack, const cylint_line *line,
                    size_t enough)
{
    batch_job job = {.purpose = COUNT_HITS,
                     .nearest = HUGE_VAL,
                     .line = line,
                     .enough = enough,
                     .want = CYLINT_WANT_NEAREST};
    answer_pack(pack, &job);
    return job.count;
}

/* ------------------------------------------------------------ columns -- */

static void fill_with_nan(double *to, size_t n)
{
    static const double nans[8] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN};
    size_t i = 0;
    for (; i + 8 <= n; i += 8)
        memcpy(to + i, nans, sizeof nans);
    memcpy(to + i, nans, (n - i) * sizeof *nans);
}

/* Writes that the hit misses.  Returns what is wanted of it. */
static unsigned start_columns(const hit_columns *to, size_t n)
{
    static const unsigned wanted[CYLINT_HIT_NUMBERS] = {
        CYLINT_WANT_POINT,  CYLINT_WANT_POINT,  CYLINT_WANT_POINT,
        CYLINT_WANT_NORMAL, CYLINT_WANT_NORMAL, CYLINT_WANT_NORMAL,
        CYLINT_WANT_Z,      CYLINT_WANT_PHI};
    unsigned want = 0;
    if (to->part) {
        memset(to->part, -1, n);
        want |= CYLINT_WANT_PART;
    }
    if (to->t) {
        fill_with_nan(to->t, n);
        want |= CYLINT_WANT_T;
    }
    for (int j = 0; j < CYLINT_HIT_NUMBERS; j++)
        if (to->number[j]) {
            fill_with_nan(to->number[j], n);
            want |= wanted[j] | CYLINT_WANT_T;
        }
    return want;
}

/* Everything misses until something is found. */
static batch_job columns_job(const cylint_columns *c, size_t n)
{
    batch_job job = {
        .purpose = FILL_COLUMNS,
        .nearest = HUGE_VAL,
        .columns = c,
        .relations = c->relation != NULL,
        .of_hit = {{c->t0,
                    c->part0,
                    {c->point0[0], c->point0[1], c->point0[2], c->normal0[0],
                     c->normal0[1], c->normal0[2], c->z0, c->phi0}},
                   {c->t1,
                    c->part1,
                    {c->point1[0], c->point1[1], c->point1[2], c->normal1[0],
                     c->normal1[1], c->normal1[2], c->z1, c->phi1}}}};
    const unsigned first = start_columns(&job.of_hit[0], n),
                   second = start_columns(&job.of_hit[1], n);
    job.want = first | second;
    if (!second && !c->n)
        job.want |= CYLINT_WANT_NEAREST;
    if (c->relation)
        memset(c->relation, CYLINT_RELATION_MISS, n);
    if (c->n)
        memset(c->n, 0, n);
    return job;
}

void cylint_intersect_shapes(const cylint_pack *pack, const cylint_line *line,
                             const cylint_columns *answers)
{
    batch_job job = columns_job(answers, pack->n);
    job.line = line;
    answer_pack(pack, &job);
}

void cylint_intersect_pairs(const cylint_pack *pack, const cylint_lines *lines,
                            const cylint_columns *answers)
{
    batch_job job = columns_job(answers, pack->n);
    job.lines = lines;
    answer_pack(pack, &job);
}

void cylint_intersect_lines(const cylint_shape *shape,
                            const cylint_lines *lines,
                            const cylint_columns *answers)
{
    batch_job job = columns_job(answers, lines->n);
    job.lines = lines;
    if (run_of(shape) != CYLINT_SOLID_NONE && lanes_serve(&job)) {
        answer_by_filter(&job, shape, NULL, lines->n);
        return;
    }
    for (size_t i = 0; i < lines->n; i++)
        answer_alone(&job, shape, i);
}

/* ------------------------------------------------------------- points -- */

/* On which side of its shape, number each * i, point i lies. */
static int side_alone(const cylint_shape *shapes, size_t each,
                      const cylint_points *points, size_t i)
{
    double point[3];
    cylint_read_point(points, i, point);
    return cylint_contains(shapes + each * i, point);
}

static void write_sides(const cylint_shape *shapes, size_t each,
                        const cylint_points *points, signed char *side)
{
    const size_t n = points->n;
    CYLINT_OF_LANES(n >= CYLINT_LANES_AVX512, cylint_sides)
    (shapes, each, points, side);
#if CYLINT_IS_PARANOID
    for (size_t i = 0; i < n; i++)
        cylint_contradiction(side[i] != CYLINT_SIGN_UNDECIDED &&
                             side[i] != side_alone(shapes, each, points, i));
#endif
    for (size_t i = 0; i < n; i++)
        if (side[i] == CYLINT_SIGN_UNDECIDED)
            side[i] = (signed char)side_alone(shapes, each, points, i);
}

void cylint_contains_points(const cylint_shape *shape,
                            const cylint_points *points, signed char *side)
{
    write_sides(shape, 0, points, side);
}

void cylint_contains_pairs(const cylint_shape *shapes,
                           const cylint_points *points, signed char *side)
{
    write_sides(shapes, 1, points, side);
}
