/*
 * message.c - messages and the progress of the work on standard error, and signals
 * that the system handles
 *
 * A program that reads scenes but must not print, or handles signals itself,
 * defines these functions and leaves this file out; the Python package does.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "report.h"

enum { MESSAGE_CAPACITY = 2048 };

/* The terminal's last line is one of progress, which a message replaces. */
static int has_progress_line;

/* In one call of write(), so that messages of several processes do not mix. */
/* lint: va_start() was called */
void message(const char *format, ...)
{
    char text[MESSAGE_CAPACITY];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fprintf(stderr, "%s%s: %s\n", has_progress_line ? "\r\033[K" : "", program,
            text);
    has_progress_line = 0;
}

int is_interrupted(void)
{
    return 0;
}

/* ------------------------------------------------------------ progress -- */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A dumb terminal cannot replace a line. */
void progress_start(struct progress *p, int is_wanted, int answers,
                    const char *unit, int in_bytes)
{
    const char *terminal = getenv("TERM");
    const int is_dumb = terminal && strcmp(terminal, "dumb") == 0;
    p->unit = unit;
    p->in_bytes = in_bytes;
    p->is_terminal = isatty(2) && !isatty(answers) && !is_dumb;
    p->is_shown = is_wanted || p->is_terminal;
    p->start = p->last = p->is_shown ? seconds() : 0;
    p->count = 0;
}

static void show(struct progress *p, double now, double done, double total)
{
    const double spent = now - p->start;
    fprintf(stderr, "%s%s: %llu %s, %.0f/s", p->is_terminal ? "\r" : "",
            program, p->count, p->unit,
            spent > 0 ? (double)p->count / spent : 0);
    if (p->in_bytes && done > 0 && spent > 0)
        fprintf(stderr, ", %.1f MB/s", 1e-6 * done / spent);
    if (done > 0 && done <= total) {
        fprintf(stderr, ", %.0f %%, %.0f s left", 100 * done / total,
                spent * (total - done) / done);
    }
    fputs(p->is_terminal ? "\033[K" : "\n", stderr);
    has_progress_line = p->is_terminal;
    p->last = now;
}

void progress_add(struct progress *p, unsigned long long count, double done,
                  double total)
{
    p->count += count;
    if (!p->is_shown)
        return;
    const double now = seconds();
    const double interval = has_progress_line ? 0.2 : 1;
    if (now - p->last >= interval)
        show(p, now, done, total);
}

void progress_end(struct progress *p)
{
    if (has_progress_line)
        fputs("\r\033[K", stderr);
    else if (p->is_shown && !p->is_terminal)
        show(p, seconds(), 0, 0);
    has_progress_line = 0;
}
