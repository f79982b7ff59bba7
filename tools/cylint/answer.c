/*
 * answer.c - computes the answers to a block of records
 *
 * Answers are collected in the block.  If they fill it, they are written before
 * the block is finished: one line may hit a million shapes of a scene.
 */
#include <stdio.h>
#include <stdlib.h>

#include "answer.h"
#include "main.h"
#include "nearby.h"
#include "sums.h"

void job_prepare(struct job *job, const struct options *options,
                 const struct scene *scene, const struct labels *labels,
                 const struct groups *groups, const struct names *names)
{
    memset(job, 0, sizeof *job);
    job->options = options;
    job->scene = scene;
    job->labels = labels;
    job->groups = groups;
    job->names = names;
    if (options->method) {
        snprintf(job->refusal, sizeof job->refusal,
                 "method '%s' does not support this shape",
                 options->method->name);
    }
    write_order_prepare(&job->order);
}

/* Whether pairs of records go to the batch functions. */
static int answers_by_batches(const struct options *o)
{
    return o->query == QUERY_PAIRS && !o->method &&
           o->grammar.line != LINE_POINT &&
           pairs_can_answer(o->grammar.line, o->fields.want,
                            fields_need_sides(&o->fields));
}

int job_block(const struct job *job, struct block *block)
{
    const struct options *o = job->options;
    const size_t longest = job->labels->longest;
    const size_t lines = row_capacity(&o->fields, &o->style, longest);
    const size_t points = row_capacity(&o->point_fields, &o->style, longest);
    const size_t row = o->sum           ? sums_capacity(job->names, &o->style)
                       : lines > points ? lines
                                        : points;
    if (!block_allocate(block, row, search_bytes(&job->scene->search)))
        return 0;
    if (o->sum) {
        block->sums = malloc(job->names->columns * sizeof *block->sums);
        return block->sums != NULL;
    }
    if (answers_by_batches(o)) {
        block->pairs = pairs_make();
        return block->pairs != NULL;
    }
    return 1;
}

/* Keeps the ticket, because the other answers of the block follow. */
static enum answered deliver(struct job *job, struct block *b)
{
    if (!write_order_wait(&job->order, b->ticket))
        return OVERTAKEN;
    job->status = output_write(&job->out, b->out.data, b->out.length);
    b->out.length = 0;
    report_notes(&job->report, &b->notes, b->name);
    return job->status == 0 ? ANSWERED : ANSWERED_LAST;
}

static enum answered deliver_if_full(struct job *job, struct block *b)
{
    return b->out.length >= TEXT_FULL ? deliver(job, b) : ANSWERED;
}

static solver solver_of(const struct options *o)
{
    return o->method ? o->method->answer : NULL;
}

static struct scene_query query_of(const struct job *job, struct block *b)
{
    return (struct scene_query){solver_of(job->options), &b->parsed.line,
                                &b->left_out, b->hits};
}

/* ------------------------------------------------------------ records -- */

/* The present record and its result. */
struct task {
    struct job *job;
    struct block *block;
    struct row row;
    struct parts parts; /* the places for the record */
    struct fault fault;
    enum answered status; /* of the last delivery */
};

/* The columns of the present record.  A record that the options do not allow has
 * those of the others. */
static const struct fields *fields_of(const struct task *task)
{
    const struct options *o = task->job->options;
    const int of_point = o->grammar.no_lines || (!o->grammar.no_points &&
                                                 task->block->parsed.is_point);
    return of_point ? &o->point_fields : &o->fields;
}

static void put_answer(struct task *task, int hit)
{
    const struct options *o = task->job->options;
    if (hit || !o->hits_only)
        put_row(&task->block->out, fields_of(task), &o->style, &task->row);
}

/* Ends the work after the answers so far. */
static void end_without_memory(struct task *task)
{
    task->status = deliver(task->job, task->block);
    if (task->status == ANSWERED) {
        task->job->status = out_of_memory();
        task->status = ANSWERED_LAST;
    }
}

/* If a column needs it, sets the row's label to that of its shape. */
static void find_label(struct task *task)
{
    const struct job *job = task->job;
    task->row.label_length = 0;
    if (fields_of(task)->labels > 0 && task->row.shape > 0) {
        const struct label label =
            labels_get(job->labels, (size_t)task->row.shape - 1);
        task->row.label = label.text;
        task->row.label_length = label.length;
    }
}

/* Records the fault that the method does not support this shape.  Returns 0. */
static int refuse_method(struct task *task, size_t shape)
{
    task->fault = (struct fault){.what = task->job->refusal, .shape = shape};
    return 0;
}

static int answer_pair(struct task *task)
{
    const struct options *o = task->job->options;
    const struct record *r = &task->block->parsed;
    cylint_answer answer;
    if (!solve(solver_of(o), &r->shape, &r->line, o->fields.want, &answer))
        return refuse_method(task, 0);
    task->row.answer = &answer;
    put_answer(task, answer.n > 0);
    return 1;
}

static int answer_nearest(struct task *task)
{
    const struct options *o = task->job->options;
    cylint_answer answer;
    const struct scene_query q = query_of(task->job, task->block);
    const size_t refused =
        scene_nearest(task->job->scene, &q, &o->fields, &answer, &task->row);
    if (refused > 0)
        return refuse_method(task, refused);
    find_label(task);
    put_answer(task, task->row.shape > 0);
    return 1;
}

static int answer_count(struct task *task, unsigned long long most)
{
    const struct scene_query q = query_of(task->job, task->block);
    const size_t refused = scene_count(task->job->scene, &q, most, &task->row);
    if (refused > 0)
        return refuse_method(task, refused);
    put_answer(task, task->row.count > 0);
    return 1;
}

/* Writes a row if the line hits the shape. */
static void answer_one_of_all(struct task *task, size_t shape)
{
    const struct options *o = task->job->options;
    cylint_shape made;
    cylint_answer answer;
    if (left_out_has(&task->block->left_out, shape))
        return;
    scene_shape(task->job->scene, shape, &made);
    solve(solver_of(o), &made, &task->block->parsed.line, o->fields.want,
          &answer);
    if (answer.n > 0) {
        task->row.shape = shape + 1;
        task->row.answer = &answer;
        find_label(task);
        put_answer(task, 1);
        task->status = deliver_if_full(task->job, task->block);
    }
}

/* Tests first that the method supports all shapes, so that a bad record has no
 * partial answer. */
static int answer_all_by_method(struct task *task)
{
    const struct scene *scene = task->job->scene;
    const struct scene_query q = query_of(task->job, task->block);
    const size_t refused = scene_count(scene, &q, ~0ULL, &task->row);
    if (refused > 0)
        return refuse_method(task, refused);
    for (size_t i = 0; i < scene->count && task->status == ANSWERED; i++)
        answer_one_of_all(task, i);
    return 1;
}

enum { HITS_AT_ONCE = 256 };

static int answer_all(struct task *task)
{
    size_t number[HITS_AT_ONCE], found, first = 0;
    if (task->job->options->method)
        return answer_all_by_method(task);
    do {
        found =
            search_hits(&task->job->scene->search, &task->block->parsed.line,
                        task->block->hits, first, number, HITS_AT_ONCE);
        for (size_t i = 0; i < found && task->status == ANSWERED; i++)
            answer_one_of_all(task, number[i]);
        first = found > 0 ? number[found - 1] + 1 : 0;
    } while (found == HITS_AT_ONCE && task->status == ANSWERED);
    return 1;
}

/* ------------------------------------------------------------- solids -- */

static void answer_first(struct task *task)
{
    const struct options *o = task->job->options;
    struct block *b = task->block;
    cylint_answer answer = {.n = 1};
    if (!first_boundary(task->job->scene->shapes, &b->parsed.line,
                        o->fields.want, &answer.hit[0], &b->pieces,
                        &task->row.shape)) {
        end_without_memory(task);
        return;
    }
    task->row.answer = task->row.shape > 0 ? &answer : NULL;
    find_label(task);
    put_answer(task, task->row.shape > 0);
    task->row.answer = NULL;
}

static cylint_piece_rule rule_of(const struct job *job)
{
    return (cylint_piece_rule){.mode = job->options->mode,
                               .rank = job->names->rank};
}

static void answer_one_piece(struct task *task, const cylint_piece *piece)
{
    task->row.piece = piece;
    task->row.shape = piece->shape + 1;
    task->row.depth = piece->depth;
    find_label(task);
    put_answer(task, 1);
    task->status = deliver_if_full(task->job, task->block);
}

static void answer_pieces(struct task *task)
{
    struct piece_memory *found = &task->block->pieces;
    const cylint_line *line = &task->block->parsed.line;
    const cylint_piece_rule rule = rule_of(task->job);
    struct piece_search search;
    task->row.unit = cylint_line_length(line);
    pieces_begin(&search, task->job->scene->shapes, line, &rule,
                 task->job->options->most_pieces);
    do {
        if (!pieces_next(&search, found)) {
            end_without_memory(task);
            break;
        }
        for (size_t i = 0; i < found->count && task->status == ANSWERED; i++)
            answer_one_piece(task, &found->piece[i]);
    } while (found->count > 0 && task->status == ANSWERED);
    task->row.piece = NULL;
}

static void answer_sums(struct task *task)
{
    const struct job *job = task->job;
    const struct names *names = job->names;
    double *sums = task->block->sums;
    const cylint_piece_rule rule = rule_of(job);
    int hit = 0;
    if (cylint_scene_line_sums(job->scene->shapes, &task->block->parsed.line,
                               &rule, names->column, names->columns,
                               job->options->sum == SUM_LENGTH,
                               sums) != CYLINT_SCENE_OK) {
        end_without_memory(task);
        return;
    }
    for (size_t i = 0; i < names->columns; i++)
        hit |= sums[i] > 0;
    if (hit || !job->options->hits_only) {
        put_sums(&task->block->out, names, &job->options->style, sums,
                 &task->row);
    }
}

/* Writes the depth of a point and its owner.  Returns 0 if there is no memory. */
static int find_depth(struct task *task)
{
    struct row *row = &task->row;
    if (!depth_of_point(task->job->scene->shapes, task->block->parsed.point,
                        task->job->names->rank, &task->block->pieces,
                        &row->depth, &row->shape)) {
        end_without_memory(task);
        return 0;
    }
    find_label(task);
    return 1;
}

/* ------------------------------------------------------------- points -- */

static struct nearby nearby_of(const struct task *task)
{
    const struct job *job = task->job;
    return (struct nearby){&job->scene->search, task->block->parsed.point,
                           job->options->radius, job->options->point_want,
                           &task->block->left_out};
}

/* Writes the columns' members; part is -1 only if there is no surface. */
static void measure(const struct task *task, const cylint_shape *shape,
                    cylint_closest *closest)
{
    closest->part = 0;
    cylint_distance(shape, task->block->parsed.point,
                    fields_of(task)->want | task->job->options->point_want,
                    closest);
}

static void answer_point_pair(struct task *task)
{
    cylint_closest closest;
    measure(task, &task->block->parsed.shape, &closest);
    task->row.closest = &closest;
    put_answer(task, 1);
}

static void answer_closest(struct task *task)
{
    const struct nearby n = nearby_of(task);
    cylint_shape shape;
    cylint_closest closest;
    task->row.shape = nearby_closest(&n);
    task->row.closest = NULL;
    if (task->row.shape > 0) {
        scene_shape(task->job->scene, task->row.shape - 1, &shape);
        measure(task, &shape, &closest);
        task->row.closest = &closest;
    }
    find_label(task);
    put_answer(task, task->row.shape > 0);
}

static void answer_within_count(struct task *task, unsigned long long most)
{
    const struct nearby n = nearby_of(task);
    task->row.count = nearby_count(&n, most);
    put_answer(task, task->row.count > 0);
}

/* A shape holds the point if its signed distance is at most 0. */
static void answer_inside(struct task *task)
{
    const struct fields *fields = fields_of(task);
    struct nearby n = nearby_of(task);
    n.radius = 0;
    n.want = CYLINT_SIGNED;
    task->row.count = fields->counts ? nearby_count(&n, ~0ULL) : 0;
    task->row.depth = 0;
    if (!fields->solids || find_depth(task))
        put_answer(task, task->row.count > 0 || task->row.depth > 0);
}

/* Writes a row for a shape within the radius. */
static void answer_one_within(struct task *task, size_t shape)
{
    cylint_shape made;
    cylint_closest closest;
    if (left_out_has(&task->block->left_out, shape))
        return;
    scene_shape(task->job->scene, shape, &made);
    measure(task, &made, &closest);
    task->row.closest = &closest;
    task->row.shape = shape + 1;
    find_label(task);
    put_answer(task, 1);
    task->status = deliver_if_full(task->job, task->block);
}

static void answer_all_within(struct task *task)
{
    const struct nearby n = nearby_of(task);
    size_t number[HITS_AT_ONCE], found, first = 0;
    double distance[HITS_AT_ONCE];
    do {
        found = search_within(n.search, n.point, n.radius, n.want, first,
                              number, distance, HITS_AT_ONCE);
        for (size_t i = 0; i < found && task->status == ANSWERED; i++)
            answer_one_within(task, number[i]);
        first = found > 0 ? number[found - 1] + 1 : 0;
    } while (found == HITS_AT_ONCE && task->status == ANSWERED);
}

static void answer_point(struct task *task)
{
    switch (task->job->options->query) {
    case QUERY_PAIRS:
        answer_point_pair(task);
        break;
    case QUERY_NEAREST:
        answer_closest(task);
        break;
    case QUERY_ANY:
        answer_within_count(task, 1);
        break;
    case QUERY_COUNT:
        answer_within_count(task, ~0ULL);
        break;
    case QUERY_INSIDE:
        answer_inside(task);
        break;
    default:
        answer_all_within(task);
    }
    task->row.closest = NULL;
}

/* ------------------------------------------------------- good and bad -- */

/* Answers the parsed record.  Returns 0 if it is bad. */
static int answer_record(struct task *task)
{
    const struct record *r = &task->block->parsed;
    task->row.tail = r->tail;
    task->row.tail_length = r->tail_length;
    if (r->is_point) {
        task->row.answer = NULL;
        answer_point(task);
        return 1;
    }
    switch (task->job->options->query) {
    case QUERY_PAIRS:
        return answer_pair(task);
    case QUERY_NEAREST:
        return answer_nearest(task);
    case QUERY_ANY:
        return answer_count(task, 1);
    case QUERY_COUNT:
        return answer_count(task, ~0ULL);
    case QUERY_FIRST:
        answer_first(task);
        return 1;
    case QUERY_PIECES:
        (task->job->options->sum ? answer_sums : answer_pieces)(task);
        return 1;
    default:
        return answer_all(task);
    }
}

/* Answers the pairs collected for a batch. */
static void answer_pairs(struct task *task)
{
    struct pairs *p = task->block->pairs;
    const unsigned want = task->job->options->fields.want;
    if (!p || p->count == 0)
        return;
    pairs_intersect(p, want);
    for (int i = 0; i < p->count && task->status == ANSWERED; i++) {
        cylint_answer answer;
        pairs_get(p, i, want, &answer);
        task->row.answer = &answer;
        task->row.tail = p->tail[i];
        task->row.tail_length = p->tail_length[i];
        put_answer(task, answer.n > 0);
        task->row.record++;
        task->status = deliver_if_full(task->job, task->block);
    }
    p->count = 0;
}

/* Adds a good pair to the batch; answers the batch when it is full. */
static void take_pair(struct task *task)
{
    struct pairs *p = task->block->pairs;
    pairs_take(p);
    if (p->count == PAIRS_MOST)
        answer_pairs(task);
}

static void mark_bad(struct task *task, unsigned long long line,
                     const char *text)
{
    const struct options *o = task->job->options;
    struct block *b = task->block;
    answer_pairs(task);
    take_note(&b->notes, line, task->row.record, text, b->text + b->length,
              &task->fault);
    if (o->bad == BAD_MARK && o->sum)
        put_sums_error(&b->out, task->job->names, &o->style);
    else if (o->bad == BAD_MARK)
        put_error(&b->out, fields_of(task), &o->style);
    b->stopped = o->bad == BAD_STOP;
    task->row.record++;
}

static void answer_or_mark(struct task *task, int good, unsigned long long line,
                           const char *text)
{
    struct block *b = task->block;
    if (good && b->remarks.found) {
        const unsigned long long waiting =
            b->pairs ? (unsigned long long)b->pairs->count : 0;
        take_remarks(&b->notes, &b->remarks, line, task->row.record + waiting,
                     text);
    }
    if (good && b->pairs)
        take_pair(task);
    else if (good && answer_record(task))
        task->row.record++;
    else
        mark_bad(task, line, text);
    if (task->status == ANSWERED)
        task->status = deliver_if_full(task->job, task->block);
}

/* ------------------------------------------------------------- blocks -- */

static void copy_comment(struct task *task, const char *line, const char *end)
{
    struct block *b = task->block;
    answer_pairs(task);
    if (end > line && end[-1] == '\r')
        end--;
    put_bytes(&b->out, line, (size_t)(end - line));
    put_char(&b->out, '\n');
    if (task->status == ANSWERED)
        task->status = deliver_if_full(task->job, b);
}

/* Returns the places for the next record. */
static const struct parts *next_places(struct task *task)
{
    if (task->block->pairs)
        pairs_place(task->block->pairs, &task->parts);
    return &task->parts;
}

static int leave_out_none(struct block *b)
{
    b->left_out.count = 0;
    return 1;
}

static int read_left_out(struct task *task)
{
    struct block *b = task->block;
    return left_out_read(&b->left_out, task->job->groups, b->parsed.left_out,
                         b->parsed.left_out_length, &b->remarks, &task->fault);
}

/* Returns whether the record is good. */
static int read_text(struct task *task, const char *line, const char *end)
{
    const struct grammar *g = &task->job->options->grammar;
    struct block *b = task->block;
    return read_parts(g, line, end, next_places(task), &task->fault) &&
           (b->parsed.left_out_length == 0 ? leave_out_none(b)
                                           : read_left_out(task));
}

static void answer_text(struct task *task)
{
    const struct options *o = task->job->options;
    struct block *b = task->block;
    const char *end = b->text + b->length;
    unsigned long long number = b->line;
    const char *stop;
    for (const char *line = b->text;
         line < end && task->status == ANSWERED && !b->stopped;
         line = stop + 1, number++) {
        stop = end_of_line(line, end);
        if (is_record(line, stop))
            answer_or_mark(task, read_text(task, line, stop), number, line);
        else if (o->comments)
            copy_comment(task, line, stop);
    }
}

static int take_doubles(struct task *task, const char *bytes, size_t size,
                        size_t left)
{
    const struct grammar *g = &task->job->options->grammar;
    double numbers[MOST_NUMBERS];
    if (left < size) {
        task->fault = (struct fault){.what = "the input ends within it"};
        return 0;
    }
    for (size_t i = 0; i < size / 8; i++)
        numbers[i] = get_little_endian(bytes + 8 * i);
    return take_parts(g, numbers, next_places(task), &task->fault);
}

static void answer_doubles(struct task *task)
{
    struct block *b = task->block;
    const size_t size = task->job->in.record_size;
    for (size_t at = 0;
         at < b->length && task->status == ANSWERED && !b->stopped;
         at += size) {
        answer_or_mark(task,
                       take_doubles(task, b->text + at, size, b->length - at),
                       0, NULL);
    }
}

/* The end of the input, an input failure and -e stop end the work. */
static enum answered finish_block(struct job *job, const struct block *b)
{
    progress_add(&job->progress, b->records, (double)b->input, job->in.total);
    if (b->failure.status != 0) {
        job->status = b->failure.status;
        input_complain(b);
    }
    return b->length == 0 || b->stopped ? ANSWERED_LAST : ANSWERED;
}

enum answered answer_block(struct job *job, struct block *b)
{
    struct task task;
    memset(&task, 0, sizeof task);
    task.job = job;
    task.block = b;
    task.row.record = b->record;
    b->remarks.wanted = job->options->remarks;
    b->remarks.found = 0;
    task.parts = parts_of(&b->parsed);
    task.parts.remarks = b->remarks.wanted ? &b->remarks : NULL;
    if (job->in.record_size > 0)
        answer_doubles(&task);
    else
        answer_text(&task);
    if (task.status == ANSWERED)
        answer_pairs(&task);
    if (task.status == ANSWERED)
        task.status = deliver(job, b);
    return task.status == ANSWERED ? finish_block(job, b) : task.status;
}
