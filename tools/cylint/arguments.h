/*
 * arguments.h - a command line, argument by argument
 *
 * Options may stand anywhere; what follows -- is a file.  A short option's
 * value is the rest of its argument or the next one, a long one's follows
 * '=' or is the next argument.
 */
#ifndef CYLINT_ARGUMENTS_H
#define CYLINT_ARGUMENTS_H

/* A short option is its letter. */
struct option {
    const char *name;
    int id;
    int has_value;
};

/* Says what is wrong and where help is; returns EXIT_USAGE. */
int usage(const char *format, ...);
int usage_value(const struct option *o, const char *value,
                const char *expected);
/* The same; `meant` is the word that the value is nearly, or NULL. */
int usage_similar(const struct option *o, const char *value,
                  const char *expected, const char *meant);

/* A whole number from 1 to `most`; returns whether it is one. */
int read_count(const char *value, int most, int *count);

/* Which of `words` (NULL at the end) the value is; returns 0 or EXIT_USAGE. */
int read_word(const struct option *o, const char *value,
              const char *const *words, const char *expected, int *index);

/* What is done with an option; value is NULL if it has none.  Returns 0 or an
 * exit status. */
typedef int option_taker(void *context, const struct option *o,
                         const char *value);

/* Gives the options among argv[1..argc) to `take` one after the other and
 * moves the files to the front of argv, *files of them.  `known` ends with a
 * name that is NULL.  Returns 0, EXIT_USAGE, or what `take` returned. */
int take_arguments(const struct option *known, int argc, char **argv,
                   option_taker *take, void *context, int *files);

#endif
