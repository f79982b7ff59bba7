/*
 * queries.c - the answer to a record, by query
 *
 * The library finds the shapes of a scene.  A published method, and --accel
 * none, intersect all of them, one by one.  Both choose the lower number at
 * equal t.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "answer.h"

/* The fields of the present record's columns. */
static const struct fields *fields_of(const struct task *task)
{
    const struct options *o = task->job->options;
    return task->record.is_point ? &o->point_fields : &o->fields;
}

static int is_left_out(const struct task *task, size_t shape)
{
    const struct job *job = task->job;
    return left_out_has(
        &task->left_out,
        job->options->not_label ? (size_t)job->groups.group_of[shape] : shape);
}

/* ------------------------------------------------------------ one shape -- */

/* part is -1 only if there is no surface. */
static void measure_point(struct task *task, const cylint_shape *shape)
{
    struct row *row = &task->row;
    cylint_closest closest = {.part = 0};
    row->distance = cylint_distance(
        shape, task->record.point,
        fields_of(task)->want | task->job->options->signed_flag, &closest);
    row->answer.n = closest.part >= 0;
    row->answer.hit[0].part = closest.part;
    row->feature = closest.feature;
    memcpy(row->answer.hit[0].point, closest.point, sizeof closest.point);
    memcpy(row->answer.hit[0].normal, closest.normal, sizeof closest.normal);
}

/* Returns EXIT_BAD and writes a note if the method does not support the shape.
 * number: of the shape, from 1; 0: it is in the record. */
static int intersect_shape(struct task *task, const cylint_shape *shape,
                           size_t number, unsigned want, cylint_answer *answer)
{
    const cylint_method *method = task->job->options->method;
    char where[48] = "";
    if (!method) {
        cylint_intersect(shape, &task->record.line, want, answer);
        return 0;
    }
    if (method->answer(shape, &task->record.line, want, answer) == CYLINT_OK)
        return 0;
    if (number > 0)
        snprintf(where, sizeof where, ": shape %llu of the scene",
                 (unsigned long long)number);
    return refuse(&task->notes, NULL,
                  "method '%s' does not support this shape%s", method->name,
                  where);
}

/* Sets the row's label to that of its shape. */
static void set_label(struct task *task)
{
    struct row *row = &task->row;
    row->label.length = 0;
    if (row->shape > 0)
        row->label =
            labels_get(&task->job->scene.labels, (size_t)row->shape - 1);
}

/* Writes a row for the shape with this number, from 1; 0: there is none. */
static void put_shape(struct task *task, size_t number)
{
    cylint_shape shape;
    task->row.shape = (double)number;
    task->row.answer.n = -1;
    if (number > 0) {
        cylint_scene_shape(task->job->scene.shapes, number - 1, &shape);
        if (task->record.is_point)
            measure_point(task, &shape);
        else
            intersect_shape(task, &shape, number, fields_of(task)->want,
                            &task->row.answer);
    }
    set_label(task);
    put_answer(task, number > 0);
}

static int answer_pair(struct task *task)
{
    const struct record *r = &task->record;
    if (r->is_point)
        measure_point(task, &r->shape);
    else if (intersect_shape(task, &r->shape, 0, fields_of(task)->want,
                             &task->row.answer))
        return EXIT_BAD;
    put_answer(task, task->row.answer.n > 0);
    return 0;
}

/* --------------------------------------------------------------- visits -- */

/* A visit of the shapes that a line hits or that are near a point, and what it
 * finds. */
struct search {
    struct task *task;
    /* Handles one of them; key: t or distance.  Returns as cylint_scene_hit(). */
    double (*handle_shape)(struct search *search, size_t number, double key);
    size_t shape; /* the one with the least key, from 1; 0: none */
    double least;
    size_t count, most; /* most: the visit ends; 0: it does not */
};

static double keep_nearest(struct search *s, size_t number, double key)
{
    if (s->shape == 0 || key < s->least ||
        (!(key > s->least) && number + 1 < s->shape)) {
        s->shape = number + 1;
        s->least = key;
    }
    return s->least;
}

static double count_one(struct search *s, size_t number, double key)
{
    (void)number;
    (void)key;
    return ++s->count == s->most ? (double)NAN : HUGE_VAL;
}

/* Without memory the visit ends, and the count is CYLINT_NO_ROOM. */
static double keep_number(struct search *s, size_t number, double key)
{
    struct piece_memory *m = &s->task->pieces;
    (void)key;
    if (s->count == m->number_capacity && !grow_numbers(m)) {
        s->count = CYLINT_NO_ROOM;
        return (double)NAN;
    }
    m->number[s->count++] = number;
    return HUGE_VAL;
}

/* A shape that the record leaves out does not change the reach of the visit. */
static double handle_if_not_left_out(struct search *s, size_t number,
                                     double key)
{
    return is_left_out(s->task, number) ? HUGE_VAL
                                        : s->handle_shape(s, number, key);
}

static double handle_hit(void *search, size_t number, const cylint_hit *hit)
{
    return handle_if_not_left_out(search, number, hit ? hit->t : 0);
}

static double handle_near(void *search, size_t number, double distance,
                          int flags)
{
    const struct search *s = search;
    (void)flags;
    return handle_if_not_left_out(
        search, number,
        s->task->job->options->signed_flag ? distance : fabs(distance));
}

static int is_one_by_one(const struct task *task)
{
    const struct options *o = task->job->options;
    return !task->record.is_point && (o->method || o->accel == ACCEL_NONE);
}

static int visit_one_by_one(struct search *s, unsigned want)
{
    const struct scene *scene = &s->task->job->scene;
    cylint_shape shape;
    cylint_answer answer;
    for (size_t i = 0; i < scene->count; i++) {
        if (is_left_out(s->task, i))
            continue;
        cylint_scene_shape(scene->shapes, i, &shape);
        if (intersect_shape(s->task, &shape, i + 1, want | CYLINT_WANT_NEAREST,
                            &answer))
            return EXIT_BAD;
        if (answer.n > 0 &&
            isnan(handle_hit(s, i, want ? &answer.hit[0] : NULL)))
            break;
    }
    return 0;
}

/* want: of the hits' members.  Returns EXIT_BAD and writes a note if the method
 * does not support a shape. */
static int visit_shapes(struct search *s, unsigned want)
{
    const struct record *r = &s->task->record;
    const struct options *o = s->task->job->options;
    const cylint_scene *scene = s->task->job->scene.shapes;
    if (is_one_by_one(s->task))
        return visit_one_by_one(s, want);
    if (r->is_point)
        cylint_scene_visit_point(scene, r->point, o->radius, o->signed_flag,
                                 handle_near, s);
    else
        cylint_scene_visit(scene, &r->line, want, handle_hit, s);
    return 0;
}

static int answer_nearest(struct task *task)
{
    struct search s = {.task = task, .handle_shape = keep_nearest};
    if (visit_shapes(&s, CYLINT_WANT_T))
        return EXIT_BAD;
    put_shape(task, s.shape);
    return 0;
}

/* Counts the shapes; of the query any at most one. */
static int answer_count(struct task *task)
{
    const struct record *r = &task->record;
    const size_t most = task->job->options->query == QUERY_ANY;
    struct search s = {.task = task, .handle_shape = count_one, .most = most};
    if (!r->is_point && !is_one_by_one(task) && task->left_out.count == 0)
        s.count = cylint_scene_count(task->job->scene.shapes, &r->line, most);
    else if (visit_shapes(&s, 0))
        return EXIT_BAD;
    task->row.count = (double)s.count;
    put_answer(task, s.count > 0);
    return 0;
}

static int compare_numbers(const void *a, const void *b)
{
    const size_t *m = a, *n = b;
    return (*m > *n) - (*m < *n);
}

/* The rows are written after the visit: a bad record has no partial answer. */
static int answer_all(struct task *task)
{
    const struct record *r = &task->record;
    struct search s = {.task = task, .handle_shape = keep_number};
    if (!r->is_point && !is_one_by_one(task))
        s.count = find_hit(task->job->scene.shapes, &r->line, &task->pieces);
    else if (visit_shapes(&s, 0))
        return EXIT_BAD;
    if (s.count == CYLINT_NO_ROOM)
        return end_without_memory(task);
    if (r->is_point && s.count > 0)
        qsort(task->pieces.number, s.count, sizeof *task->pieces.number,
              compare_numbers);
    for (size_t i = 0; i < s.count && !task->ends; i++)
        if (!is_left_out(task, task->pieces.number[i]))
            put_shape(task, task->pieces.number[i] + 1);
    return 0;
}

/* --------------------------------------------------------------- solids -- */

/* Sets the row's shape from a number of the library. */
static void set_owner(struct task *task, size_t number)
{
    task->row.shape = number < task->job->scene.count ? (double)number + 1 : 0;
    set_label(task);
}

static int answer_first(struct task *task)
{
    struct row *row = &task->row;
    const size_t number =
        first_boundary(task->job->scene.shapes, &task->record.line,
                       fields_of(task)->want, row->answer.hit, &task->pieces);
    if (number == CYLINT_NO_ROOM)
        return end_without_memory(task);
    set_owner(task, number);
    row->answer.n = row->shape > 0 ? 1 : -1;
    put_answer(task, row->shape > 0);
    return 0;
}

static cylint_piece_rule rule_of(const struct job *job)
{
    static const cylint_piece_mode modes[] = {
        CYLINT_PIECES_OWNER, CYLINT_PIECES_UNION, CYLINT_PIECES_CELLS,
        CYLINT_PIECES_CHORDS};
    return (cylint_piece_rule){.mode = modes[job->options->piece_mode],
                               .rank = job->groups.rank};
}

static int answer_sums(struct task *task)
{
    const struct job *job = task->job;
    const struct groups *groups = &job->groups;
    const cylint_piece_rule rule = rule_of(job);
    int is_hit = 0;
    if (cylint_scene_line_sums(
            job->scene.shapes, &task->record.line, &rule,
            groups->is_total ? NULL : groups->group_of, groups->columns,
            job->options->sum == SUM_LENGTH || job->options->sum == SUM_TOTAL,
            task->row.sums) != CYLINT_SCENE_OK)
        return end_without_memory(task);
    for (size_t i = 0; i < groups->columns; i++)
        is_hit |= task->row.sums[i] > 0;
    put_answer(task, is_hit);
    return 0;
}

static int answer_pieces(struct task *task)
{
    const struct job *job = task->job;
    const cylint_piece_rule rule = rule_of(job);
    struct row *row = &task->row;
    cylint_piece_memory *found = &task->pieces.found;
    if (job->options->sum)
        return answer_sums(task);
    found->n = 0;
    if (!cylint_add_pieces(job->scene.shapes, &task->record.line, &rule,
                           (size_t)job->options->most_pieces, found))
        return end_without_memory(task);
    row->answer.n = 2;
    row->unit = cylint_line_length(&task->record.line);
    for (size_t i = 0; i < found->n && !task->ends; i++) {
        const cylint_piece *piece = &found->piece[i];
        row->answer.hit[0].t = piece->t0;
        row->answer.hit[1].t = piece->t1;
        row->depth = (double)piece->depth;
        set_owner(task, piece->shape);
        put_answer(task, 1);
    }
    return 0;
}

/* A shape holds the point if its signed distance is at most 0. */
static int answer_inside(struct task *task)
{
    const struct fields *fields = fields_of(task);
    const struct job *job = task->job;
    struct search s = {.task = task, .handle_shape = count_one};
    size_t owner = job->scene.count, depth = 0;
    if (fields->has_count || !fields->has_solids)
        cylint_scene_visit_point(job->scene.shapes, task->record.point, 0,
                                 CYLINT_SIGNED, handle_near, &s);
    if (fields->has_solids)
        depth = depth_of_point(job->scene.shapes, task->record.point,
                               job->groups.rank, &owner, &task->pieces);
    if (depth == CYLINT_NO_ROOM)
        return end_without_memory(task);
    task->row.count = (double)s.count;
    task->row.depth = (double)depth;
    set_owner(task, owner);
    put_answer(task, fields->has_solids ? depth > 0 : s.count > 0);
    return 0;
}

int answer_record(struct task *task)
{
    static int (*const answers[])(struct task *) = {
        [QUERY_PAIRS] = answer_pair,    [QUERY_NEAREST] = answer_nearest,
        [QUERY_ANY] = answer_count,     [QUERY_COUNT] = answer_count,
        [QUERY_ALL] = answer_all,       [QUERY_FIRST] = answer_first,
        [QUERY_PIECES] = answer_pieces, [QUERY_INSIDE] = answer_inside};
    return answers[task->job->options->query](task);
}
