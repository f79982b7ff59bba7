/*
 * message.c - prints messages on standard error
 *
 * A program that reads scenes but must not print defines message() itself and
 * leaves this file out; the Python package does.
 */
#include <stdarg.h>
#include <stdio.h>

#include "report.h"

/* lint: va_start() was called */
void message(const char *format, ...)
{
    va_list list;
    fprintf(stderr, "%s: ", program);
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
}
