/*
 * main.c - cylint, the command: records in, answers out
 *
 * The locale is never set, so the decimal separator is always a point.
 */
#include <unistd.h>

#include "answer.h"

const char *const program = "cylint";

/* -------------------------------------------------------------- shapes -- */

static int needs_labels(const struct options *o)
{
    return o->fields.label_count > 0 ||
           (!o->grammar.no_points && o->point_fields.label_count > 0) ||
           o->not_label || o->rank || o->sum;
}

/* Reads the shapes of a saved scene or of a text. */
static int load_shapes(struct scene *scene, int keeps_labels)
{
    scene->keeps_labels = keeps_labels;
    const int status = scene_open(scene);
    return status == NOT_SAVED ? scene_read_text(scene) : status;
}

/* Reads the shapes, and what belongs to their labels.  Builds the hierarchy, which
 * a method does not need. */
static int read_scene(struct job *job)
{
    const struct options *o = job->options;
    struct scene *scene = &job->scene;
    int status = load_shapes(scene, needs_labels(o));
    job->groups.shapes = scene->count;
    if (status == 0 && (o->not_label || o->rank || o->sum))
        status = groups_make(&job->groups, &scene->labels, o->sum >= SUM_TOTAL);
    if (o->sum)
        sum_fields(&job->options->fields, &job->groups);
    if (status == 0 && o->rank)
        status = groups_read_ranks(&job->groups, o->rank);
    if (status == 0 && !o->method)
        status = scene_build(scene, o->workers);
    return status;
}

/* ------------------------------------------------------------ the work -- */

static int reads_terminal(const struct options *o)
{
    return strcmp(o->files[0], "-") == 0 && isatty(0);
}

static int answer_input(struct job *job)
{
    const struct options *o = job->options;
    int status = o->scene ? read_scene(job) : 0;
    if (status != 0)
        return status;
    if (o->style.is_binary)
        job->out.row_size = sizeof(double) * options_fields(o)->count;
    if (reads_terminal(o))
        message("waiting for records from the terminal, %s, one a line (see "
                "--help); Ctrl-D ends them",
                o->scene ? "LINE" : "LINE SHAPE");
    progress_start(&job->progress, o->shows_progress, job->out.fd, "records",
                   1);
    status = workers_run(job, o->workers);
    progress_end(&job->progress);
    report_end(&job->report);
    return status;
}

/* Whether a file to write is one of those that are read.  Prints a message if
 * so. */
static int is_read_too(const struct options *o, const char *file)
{
    int is_input = (o->scene && output_is_input(file, o->scene)) ||
                   (o->rank && output_is_input(file, o->rank));
    for (int i = 0; i < o->file_count && !is_input; i++)
        is_input = output_is_input(file, o->files[i]);
    return is_input;
}

static int save(struct job *job)
{
    const struct options *o = job->options;
    struct scene *scene = &job->scene;
    if (is_read_too(o, o->save))
        return EXIT_IO;
    int status = load_shapes(scene, 1);
    if (status == 0)
        status = scene_build(scene, o->workers);
    return status == 0 ? scene_save(scene, o->save) : status;
}

static int write_text(struct job *job)
{
    const struct options *o = job->options;
    job->scene.keeps_labels = 1;
    const int status = scene_read(&job->scene);
    return status == 0
               ? scene_write_text(&job->scene, o->style.digits, &job->out)
               : status;
}

static int answer(struct job *job)
{
    const struct options *o = job->options;
    const size_t record =
        o->is_binary_in ? 8 * (size_t)numbers_of_record(&o->grammar) : 0;
    if (is_read_too(o, o->output))
        return EXIT_IO;
    int status = output_open(&job->out, o->output, 0);
    if (status != 0)
        return status;
    status = input_open(&job->in, o->files, o->file_count, record);
    if (status == 0)
        status = o->writes_text ? write_text(job) : answer_input(job);
    input_close(&job->in);
    const int is_stopped = o->bad_policy == BAD_STOP && job->report.bad > 0;
    const int closed = output_close(&job->out, status == 0 && !is_stopped);
    if (status != 0 || closed != 0)
        return status != 0 ? status : closed;
    return job->report.bad > 0 ? EXIT_BAD : EXIT_ANSWERED;
}

int main(int argc, char **argv)
{
    static struct options options;
    struct job job = {.options = &options,
                      .reading = PTHREAD_MUTEX_INITIALIZER,
                      .order = PTHREAD_MUTEX_INITIALIZER,
                      .changed = PTHREAD_COND_INITIALIZER};
    guard_standard_streams();
    int status = read_options(&options, argc, argv);
    if (status != 0)
        return status;
    if (options.about)
        return print_about(options.about);
    job.scene.file = options.scene;
    job.scene.ends = options.grammar.ends;
    job.scene.swc_form = options.swc;
    status = options.save ? save(&job) : answer(&job);
    scene_free(&job.scene);
    groups_free(&job.groups);
    return status;
}
