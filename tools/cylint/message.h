/*
 * message.h - messages about files, records and memory
 */
#ifndef CYLINT_MESSAGE_H
#define CYLINT_MESSAGE_H

/* The numbers of a function's arguments `format` and `...`. */
#if defined(__GNUC__)
#define LIKE_PRINTF(format_, first) \
    __attribute__((format(printf, format_, first)))
#else
#define LIKE_PRINTF(format_, first)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Prints `PROGRAM: `, the text as printf() writes it, and a line feed. */
void message(const char *format, ...) LIKE_PRINTF(1, 2);

#ifdef __cplusplus
}
#endif

#endif
