/*
 * arguments.h - a table of options, and a command line that is read by it
 *
 * Options and files may be mixed; all arguments after -- are files.  The value
 * of a short option is the rest of its argument or the next argument.  The
 * value of a long option follows '=' or is the next argument.
 */
#ifndef CYLINT_ARGUMENTS_H
#define CYLINT_ARGUMENTS_H

#include <stddef.h>

#include "report.h"

enum { VALUE_MOST = 64 /* bytes of a value in a message */ };

struct option;

/* Reads a value into the option's place.  Returns 0, or EXIT_USAGE after a
 * message.  value: NULL if the option has none. */
typedef int option_reader(const struct option *o, const char *value,
                          void *place);

struct option {
    const char *name; /* one letter: a short option */
    /* the name of its value, after a blank or =; NULL: it has none */
    const char *value;
    option_reader *read; /* a letter without a value cannot be wrong */
    size_t place; /* of the member that it sets, in the struct of all options */
    /* for read_word: a const char *const[], ended by NULL; else what messages
     * expect, a const char * */
    const void *extra;
    int number;       /* what read_flag sets; the most of read_count */
    int needs;        /* what must be there, by the caller's enumeration */
    const char *help; /* of it and of those before it that have none */
};

/* Reads a word of a table and writes its index.  expected: for the message; NULL: a
 * list of the words. */
int read_word_of(const struct option *o, const char *value, struct words words,
                 const char *expected, int *index);

option_reader read_flag;  /* sets an int to `number` */
option_reader read_text;  /* a const char *, the value */
option_reader read_word;  /* an int, the index of a word */
option_reader read_count; /* an int from 1 to `number` */
option_reader read_about; /* a const char *, the word or the option's name */

/* Prints a message and a hint to --help.  Returns EXIT_USAGE. */
int usage(const char *format, ...) LIKE_PRINTF(1, 2);

/* Returns 0 if the value is right; else prints what was expected, o->extra, and
 * returns EXIT_USAGE. */
int check_value(const struct option *o, const char *value, int is_right);

/* Reads a text of `count` numbers, inf or -inf with commas between them.  Returns 0
 * if it is anything else. */
int read_bounds(const char *text, double *bounds, int count);

/* Reads argv[1..argc) into *options, moves the files to the front of argv
 * and their number to *files, and adds a bit to *given for each option by
 * its index.  The last name in `table` is NULL.  Returns 0 or EXIT_USAGE. */
int take_arguments(const struct option *table, int argc, char **argv,
                   void *options, int *files, unsigned long long *given);

/* Whether the option with this name is one of those. */
int was_given(const struct option *table, unsigned long long given,
              const char *name);

/* Prints the lines of the options in --help. */
void print_options(const struct option *table);

/* Returns 0, or EXIT_IO after a message if standard output did not take all. */
int end_printing(void);

#endif
