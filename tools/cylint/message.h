/*
 * message.h - messages about files, records and memory
 */
#ifndef CYLINT_MESSAGE_H
#define CYLINT_MESSAGE_H

#ifdef __cplusplus
extern "C" {
#endif

/* Prints `PROGRAM: `, the text as printf() writes it, and a line feed. */
void message(const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 1, 2)))
#endif
    ;

#ifdef __cplusplus
}
#endif

#endif
