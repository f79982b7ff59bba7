/*
 * main.c - cylint, the command: records in, answers out
 *
 * The locale is never set, so the decimal separator is always a point.
 */
#include "main.h"
#include "processors.h"
#include "scene_read.h"
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
        block_make(&b, row_capacity(options_fields(o), &o->style, 0), 0);
    if (status == 0) {
        put_header(&b.out, options_fields(o), &o->style);
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

static int run(struct job *job)
{
    const struct options *o = job->options;
    int status = output_open(&job->out, o);
    if (status != 0) {
        return status;
    }
    status = open_input(job);
    if (status == 0) {
        status = put_first_line(job);
    }
    if (status == 0) {
        status = workers_run(job, o->workers > 0 ? o->workers : processors());
    }
    input_close(&job->in);
    progress_end(&job->progress);
    report_end(&job->report);
    const int closed = output_close(&job->out);
    if (status != 0 || closed != 0) {
        return status != 0 ? status : closed;
    }
    return job->report.bad > 0 ? EXIT_BAD : EXIT_ANSWERED;
}

static int needs_labels(const struct options *o)
{
    return (!o->grammar.no_lines && o->fields.labels > 0) ||
           (!o->grammar.no_points && o->point_fields.labels > 0);
}

static int read_scene(const struct options *o, struct scene *scene,
                      struct labels *labels, struct groups *groups)
{
    if (needs_labels(o) || o->not_label) {
        labels_collect(labels, scene);
    }
    int status =
        scene_read(scene, o->scene, o->grammar.ends, (enum swc_form)o->swc);
    if (status == 0 && !o->method) {
        status = scene_prepare(scene, o->accel, o->workers);
    }
    return status == 0
               ? groups_make(groups, scene->count, o->not_label ? labels : NULL)
               : status;
}

int main(int argc, char **argv)
{
    struct options options;
    struct scene scene;
    struct labels labels;
    struct groups groups;
    struct job job;
    memset(&scene, 0, sizeof scene);
    memset(&labels, 0, sizeof labels);
    memset(&groups, 0, sizeof groups);
    guard_standard_streams();
    int status = read_options(&options, argc, argv);
    if (status != 0) {
        return status;
    }
    if (options.print) {
        return print_about(options.print);
    }
    if (options.scene) {
        status = read_scene(&options, &scene, &labels, &groups);
    }
    if (status == 0) {
        job_prepare(&job, &options, &scene, &labels, &groups);
        status = run(&job);
        write_order_destroy(&job.order);
    }
    scene_free(&scene);
    labels_free(&labels);
    groups_free(&groups);
    return status;
}
