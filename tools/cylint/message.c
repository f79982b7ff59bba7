/*
 * message.c - messages on standard error, and signals that the system handles
 *
 * A program that reads scenes but must not print, or handles signals itself,
 * defines these functions and leaves this file out; the Python package does.
 */
#include <stdarg.h>
#include <stdio.h>

#include "report.h"

enum { MESSAGE_CAPACITY = 2048 };

int has_progress_line;

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
