/*
 * answer.c - answers the records of a block, good and bad ones
 *
 * Answers are collected in the task.  If they fill it, they are written before
 * the block is finished: one line may hit a million shapes of a scene.
 */
#include <stdlib.h>

#include "answer.h"

struct task *task_make(struct job *job)
{
    const struct options *o = job->options;
    const size_t longest = job->scene.labels.longest;
    const size_t lines = row_capacity(&o->fields, &o->style, longest);
    const size_t points = row_capacity(&o->point_fields, &o->style, longest);
    const size_t row = lines > points ? lines : points;
    struct task *task = calloc(1, sizeof *task);
    if (!task)
        return NULL;
    task->job = job;
    task->row.unit = 1;
    task->out.data = malloc(TEXT_FULL + LINE_MOST + row + 2);
    if (o->sum)
        task->row.sums = malloc(o->fields.count * sizeof *task->row.sums);
    if (block_make(&task->block) && task->out.data &&
        (task->row.sums || !o->sum))
        return task;
    task_free(task);
    return NULL;
}

void task_free(struct task *task)
{
    free(task->block.text);
    free(task->out.data);
    free(task->row.sums);
    piece_memory_free(&task->pieces);
    free(task);
}

/* ------------------------------------------------------------- delivery -- */

/* Keeps the ticket, because the other answers of the block follow. */
static void deliver(struct task *task)
{
    struct job *job = task->job;
    task->ends = !wait_for_turn(job, task->ticket);
    if (task->ends)
        return;
    job->status = output_write(&job->out, task->out.data, task->out.length);
    task->out.length = 0;
    report_notes(&job->report, &task->notes, task->block.name);
    task->ends = job->status != 0;
}

static void deliver_if_full(struct task *task)
{
    if (task->out.length >= TEXT_FULL && !task->ends)
        deliver(task);
}

int end_without_memory(struct task *task)
{
    deliver(task);
    if (!task->ends)
        task->job->status = out_of_memory();
    task->ends = 1;
    return 0;
}

/* row: NULL for a bad record. */
static void put_and_deliver(struct task *task, int is_of_point,
                            const struct row *row)
{
    const struct options *o = task->job->options;
    put_row(&task->out, is_of_point ? &o->point_fields : &o->fields, &o->style,
            row);
    deliver_if_full(task);
}

void put_answer(struct task *task, int is_hit)
{
    if (is_hit || !task->job->options->hits_only)
        put_and_deliver(task, task->record.is_point, &task->row);
}

/* --------------------------------------------------------- good and bad -- */

/* A point where only lines are allowed has the columns of lines, and the
 * reverse. */
static void mark_bad(struct task *task)
{
    const struct options *o = task->job->options;
    const struct grammar *g = &o->grammar;
    count_bad(&task->notes);
    task->is_stopped = o->bad_policy == BAD_STOP;
    if (o->bad_policy == BAD_MARK)
        put_and_deliver(task,
                        g->no_lines || (!g->no_points && task->record.is_point),
                        NULL);
}

/* status: of reading the record. */
static void answer_or_mark(struct task *task, int status)
{
    const struct job *job = task->job;
    task->row.tail = task->record.tail;
    if (status == 0)
        status = left_out_read(&task->left_out, &job->groups,
                               job->options->not_label, task->record.words,
                               &task->notes);
    if (status == 0)
        status = answer_record(task);
    if (status != 0)
        mark_bad(task);
    task->row.record++;
    task->notes.record++;
}

static void copy_comment(struct task *task, const char *line, const char *end)
{
    put_string(&task->out, between(line, before_return(line, end)));
    put_char(&task->out, '\n');
    deliver_if_full(task);
}

static void answer_text(struct task *task)
{
    const struct options *o = task->job->options;
    const struct block *b = &task->block;
    const char *const end = b->text + b->length, *stop;
    task->notes.end = end;
    for (const char *line = b->text;
         line < end && !task->ends && !task->is_stopped;
         line = stop + 1, task->notes.line++) {
        stop = end_of_line(line, end);
        task->notes.text = line;
        if (is_record(line, stop))
            answer_or_mark(task, read_record(&o->grammar, line, stop,
                                             &task->record, &task->notes));
        else if (o->copies_comments)
            copy_comment(task, line, stop);
    }
}

static int read_doubles(struct task *task, const char *bytes, size_t size,
                        size_t available)
{
    double numbers[MOST_NUMBERS];
    if (available < size)
        return refuse(&task->notes, NULL, "the input ends within it");
    for (size_t i = 0; i < size / 8; i++)
        copy_little_endian(&numbers[i], bytes + 8 * i);
    return record_of_numbers(&task->job->options->grammar, numbers,
                             &task->record, &task->notes);
}

static void answer_doubles(struct task *task)
{
    const struct block *b = &task->block;
    const size_t size = task->job->in.record_size;
    for (size_t at = 0; at < b->length && !task->ends && !task->is_stopped;
         at += size)
        answer_or_mark(task,
                       read_doubles(task, b->text + at, size, b->length - at));
}

/* The end of the input, an input failure and -e stop end the work. */
static void finish_block(struct task *task)
{
    struct job *job = task->job;
    const struct block *b = &task->block;
    progress_add(&job->progress, b->records, (double)b->bytes_read,
                 job->in.total);
    if (b->fault[0])
        job->status = complain(EXIT_IO, b->name, "%s", b->fault);
    task->ends = b->length == 0 || task->is_stopped;
}

void answer_block(struct task *task)
{
    const struct block *b = &task->block;
    task->ends = task->is_stopped = 0;
    task->row.record = (double)b->record;
    task->notes.record = b->record_of_file;
    task->notes.line = b->line;
    task->notes.text = task->notes.end = NULL;
    task->notes.wanted = task->job->options->remarks;
    if (task->job->in.record_size > 0)
        answer_doubles(task);
    else
        answer_text(task);
    if (!task->ends)
        deliver(task);
    if (!task->ends)
        finish_block(task);
}
