/*
 * arguments.h - a command line, argument by argument
 *
 * Options and files may be mixed; all arguments after -- are files.  The value
 * of a short option is the rest of its argument or the next argument.  The
 * value of a long option follows '=' or is the next argument.
 */
#ifndef CYLINT_ARGUMENTS_H
#define CYLINT_ARGUMENTS_H

/* A short option is its letter. */
struct option {
    const char *name;
    int id;
    int has_value;
};

/* Prints a message and a hint to --help.  Returns EXIT_USAGE. */
int usage(const char *format, ...);
int usage_value(const struct option *o, const char *value,
                const char *expected);
/* The same for a wrong value.  `meant` is the known word nearest to it, or
 * NULL. */
int usage_similar(const struct option *o, const char *value,
                  const char *expected, const char *meant);

/* Reads a whole number from 1 to `most`.  Returns whether it is one. */
int read_count(const char *value, int most, int *count);

/* Reads a number, inf or -inf at p.  Returns the byte after it, or NULL.  The ends
 * of a domain may be infinite; the numbers of a record may not. */
const char *read_bound(const char *p, double *bound);

/* Reads one character, or \t for a tab.  Returns whether it is that. */
int read_separator(const char *value, char *separator);

/* Finds the value in `words` (NULL at the end).  Returns 0 or EXIT_USAGE. */
int read_word(const struct option *o, const char *value,
              const char *const *words, const char *expected, int *index);

/* Handles an option; value is NULL if it has none.  Returns 0 or an exit
 * status. */
typedef int option_handler(void *context, const struct option *o,
                           const char *value);

/* Calls `handle` for each option in argv[1..argc).  Moves the files to the front
 * of argv and their number to *files.  The last name in `known` is NULL.
 * Returns 0, EXIT_USAGE, or the result of `handle`. */
int take_arguments(const struct option *known, int argc, char **argv,
                   option_handler *handle, void *context, int *files);

#endif
