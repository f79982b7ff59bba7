/*
 * main.c - cylint, the command: records in, answers out
 *
 * The locale is never set, so the decimal separator is always a point.
 */
#include <unistd.h>

#include "main.h"
#include "message.h"
#include "processors.h"
#include "saved.h"
#include "scene_read.h"
#include "scene_text.h"
#include "sums.h"
#include "workers.h"

const char *const program = "cylint";

/* Writes the header line, before the workers start. */
static int put_first_line(struct job *job)
{
    const struct options *o = job->options;
    struct block b;
    if (!o->header) {
        return 0;
    }
    int status =
        block_make(&b,
                   o->sum ? sums_capacity(job->names, &o->style)
                          : row_capacity(options_fields(o), &o->style, 0),
                   0);
    if (status == 0) {
        if (o->sum) {
            put_sums_header(&b.out, job->names, &o->style);
        } else {
            put_header(&b.out, options_fields(o), &o->style);
        }
        status = output_write(&job->out, b.out.data, b.out.length);
    }
    block_free(&b);
    return status;
}

static int open_input(struct job *job)
{
    const struct options *o = job->options;
    const size_t size =
        o->binary_in ? 8 * (size_t)numbers_of_record(&o->grammar) : 0;
    return input_open(&job->in, o->files, o->file_count, size);
}

static int needs_labels(const struct options *o)
{
    return (!o->grammar.no_lines && o->fields.labels > 0) ||
           (!o->grammar.no_points && o->point_fields.labels > 0);
}

/* What all records are answered from.  It has no shapes without -s. */
struct shapes {
    struct scene scene;
    struct labels labels;
    struct groups groups;
    struct names names;
};

/* Whether the answers are about solids, so that the hierarchy is needed. */
static int is_about_solids(const struct options *o)
{
    return o->query == QUERY_FIRST || o->query == QUERY_PIECES ||
           o->point_fields.solids;
}

static int load_shapes(const struct options *o, struct scene *scene,
                       struct labels *labels)
{
    const int uses_labels =
        needs_labels(o) || o->not_label || o->rank || o->sum;
    int status = saved_open(scene, o->scene, o->grammar.ends);
    if (status != NOT_SAVED) {
        return status == 0 && uses_labels ? labels_take(labels, scene, o->scene)
                                          : status;
    }
    if (uses_labels || o->save) {
        labels_collect(labels, scene);
    }
    status = scene_read_text(scene, o->scene, o->grammar.ends,
                             (enum swc_form)o->swc);
    if (status == 0) {
        labels_give(labels, scene);
    }
    return status;
}

static int read_scene(const struct options *o, struct shapes *shapes)
{
    struct scene *scene = &shapes->scene;
    struct labels *labels = &shapes->labels;
    int status = load_shapes(o, scene, labels);
    if (status == 0) {
        status = names_make(&shapes->names, labels, scene->count, o->rank,
                            o->sum != SUM_NONE);
    }
    if (status == 0 && (!o->method || o->save)) {
        status = scene_prepare(
            scene, is_about_solids(o) ? ACCEL_TREE : o->accel, o->workers);
    }
    return status == 0 ? groups_make(&shapes->groups, scene->count,
                                     o->not_label ? labels : NULL)
                       : status;
}

static int is_terminal(const struct options *o)
{
    return strcmp(o->files[0], "-") == 0 && isatty(0);
}

static int save_scene(const struct options *o, struct shapes *shapes)
{
    int status = output_is_input(o->save, o) ? EXIT_IO : read_scene(o, shapes);
    return status == 0 ? saved_write(&shapes->scene, o->workers, o->save)
                       : status;
}

/* The scene of an input without a byte is not read, unless its labels are the
 * columns.  It must exist. */
static int read_scene_if_needed(struct job *job, struct shapes *shapes)
{
    const struct options *o = job->options;
    if (!o->scene || o->save) {
        return 0;
    }
    if (is_terminal(o) || o->sum || !input_is_empty(&job->in)) {
        return read_scene(o, shapes);
    }
    if (strcmp(o->scene, "-") != 0 && access(o->scene, R_OK) != 0) {
        complain_errno(o->scene);
        return EXIT_IO;
    }
    return 0;
}

static int answer_input(struct job *job, struct shapes *shapes)
{
    const struct options *o = job->options;
    int status = open_input(job);
    if (status == 0) {
        status = read_scene_if_needed(job, shapes);
    }
    if (o->sum && o->style.binary) {
        job->out.row = sizeof(double) * shapes->names.columns;
    }
    if (status == 0) {
        status = put_first_line(job);
    }
    if (status == 0 && is_terminal(o)) {
        message("waiting for records from the terminal, %s, one a line (see "
                "--help); Ctrl-D ends them",
                o->scene ? "LINE" : "LINE SHAPE");
    }
    if (status == 0) {
        progress_start(&job->progress, o->progress, "records", 1);
        status = workers_run(job, o->workers > 0 ? o->workers : processors());
    }
    input_close(&job->in);
    progress_end(&job->progress);
    report_end(&job->report);
    return status;
}

static int write_text(struct job *job, struct shapes *shapes)
{
    const struct options *o = job->options;
    struct scene *scene = &shapes->scene;
    struct labels *labels = &shapes->labels;
    labels_collect(labels, scene);
    const int status =
        scene_read(scene, o->scene, o->grammar.ends, (enum swc_form)o->swc);
    if (status != 0) {
        return status;
    }
    labels_give(labels, scene);
    return scene_write_text(scene, labels, o->scene, o->style.digits,
                            &job->out);
}

static int run(struct job *job, struct shapes *shapes)
{
    const struct options *o = job->options;
    int status = o->save ? save_scene(o, shapes) : 0;
    if (status != 0 || o->only_saves) {
        return status;
    }
    status = output_open(&job->out, o);
    if (status != 0) {
        return status;
    }
    status = o->text ? write_text(job, shapes) : answer_input(job, shapes);
    const int closed = output_close(&job->out, status == 0);
    if (status != 0 || closed != 0) {
        return status != 0 ? status : closed;
    }
    return job->report.bad > 0 ? EXIT_BAD : EXIT_ANSWERED;
}

int main(int argc, char **argv)
{
    struct options options;
    struct shapes shapes;
    struct job job;
    memset(&shapes, 0, sizeof shapes);
    guard_standard_streams();
    int status = read_options(&options, argc, argv);
    if (status != 0) {
        return status;
    }
    if (options.print) {
        return print_about(options.print);
    }
    job_prepare(&job, &options, &shapes.scene, &shapes.labels, &shapes.groups,
                &shapes.names);
    status = run(&job, &shapes);
    write_order_destroy(&job.order);
    scene_free(&shapes.scene);
    labels_free(&shapes.labels);
    groups_free(&shapes.groups);
    names_free(&shapes.names);
    return status;
}
