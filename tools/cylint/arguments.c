/*
 * arguments.c - a table of options, and a command line that is read by it
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "numbers.h"

enum { HELP_COLUMN = 21 };

/* ------------------------------------------------------------- messages -- */

/* lint: va_start() was called */
int usage(const char *format, ...)
{
    va_list list;
    fprintf(stderr, "%s: ", program);
    va_start(list, format);
    vfprintf(stderr, format, list);
    va_end(list);
    fprintf(stderr, "\nTry '%s --help'.\n", program);
    return EXIT_USAGE;
}

static const char *dashes_of(const struct option *o)
{
    return o->name[1] ? "--" : "-";
}

/* usage() for a wrong value.  `meant` is the word nearest to it that is right, or
 * NULL. */
static int usage_value(const struct option *o, const char *value,
                       const char *expected, const char *meant)
{
    char shown[SHOWN_CAPACITY];
    return usage("%s%s: expected %s, found '%s'%s%s%s", dashes_of(o), o->name,
                 expected, escape(shown, string_of(value), VALUE_MOST),
                 meant ? "; did you mean " : "", meant ? meant : "",
                 meant ? "?" : "");
}

/* --------------------------------------------------------------- values -- */

int read_flag(const struct option *o, const char *value, void *place)
{
    (void)value;
    *(int *)place = o->number;
    return 0;
}

int read_text(const struct option *o, const char *value, void *place)
{
    (void)o;
    *(const char **)place = value;
    return 0;
}

int read_word_of(const struct option *o, const char *value, struct words words,
                 const char *expected, int *index)
{
    char list[WORDS_CAPACITY];
    *index = find_word(words, string_of(value));
    return *index != NOT_GIVEN
               ? 0
               : usage_value(o, value,
                             expected ? expected : list_words(list, words),
                             similar_word(words, string_of(value)));
}

int read_word(const struct option *o, const char *value, void *place)
{
    return read_word_of(o, value, WORDS((const char *const *)o->extra), NULL,
                        place);
}

int read_count(const struct option *o, const char *value, void *place)
{
    unsigned long long count;
    if (!read_whole(string_of(value), (unsigned long long)o->number, &count) ||
        count == 0)
        return usage_value(o, value, o->extra, NULL);
    *(int *)place = (int)count;
    return 0;
}

int check_value(const struct option *o, const char *value, int is_right)
{
    return is_right ? 0 : usage_value(o, value, o->extra, NULL);
}

int read_about(const struct option *o, const char *value, void *place)
{
    int index;
    *(const char **)place = value ? value : o->name;
    return value ? read_word(o, value, &index) : 0;
}

/* Returns the byte after it, or NULL. */
static const char *read_bound(const char *p, double *bound)
{
    const char *word = p + (*p == '-' || *p == '+');
    if (strncmp(word, "inf", 3) == 0) {
        *bound = *p == '-' ? -HUGE_VAL : HUGE_VAL;
        return word + 3;
    }
    p = cylint_read_number(p, p + strlen(p), bound);
    return p && *bound - *bound == 0 ? p : NULL;
}

int read_bounds(const char *p, double *bounds, int count)
{
    for (int i = 0; i < count; i++) {
        p = read_bound(p, &bounds[i]);
        if (!p || *p++ != (i + 1 < count ? ',' : '\0'))
            return 0;
    }
    return 1;
}

/* ------------------------------------------------------------ arguments -- */

/* The arguments, the position in them, and where their values go. */
struct arguments {
    const struct option *table;
    char **argv;
    int count, next;
    void *options;
    unsigned long long *given;
};

static int set(struct arguments *args, const struct option *o,
               const char *value)
{
    *args->given |= 1ULL << (o - args->table);
    return o->read(o, value, (char *)args->options + o->place);
}

/* Sets an option to the next argument. */
static int set_next(struct arguments *args, const struct option *o)
{
    return args->next < args->count
               ? set(args, o, args->argv[args->next++])
               : usage("%s%s needs a value", dashes_of(o), o->name);
}

/* Suggests long options: one letter is too short. */
static int refuse_option(const struct option *table, const char *dashes,
                         struct string name)
{
    const char *meant = NULL;
    char text[SHOWN_CAPACITY];
    const char *shown = escape(text, name, VALUE_MOST);
    for (const struct option *o = table; o->name; o++)
        if (o->name[1])
            meant = nearer_word(name, meant, o->name);
    return meant ? usage("unknown option '%s%s'; did you mean --%s?", dashes,
                         shown, meant)
                 : usage("unknown option '%s%s'", dashes, shown);
}

static int take_long(struct arguments *args, const char *text)
{
    const struct string name = between(text, text + strcspn(text, "="));
    const char *value = *end_of(name) == '=' ? end_of(name) + 1 : NULL;
    const int i =
        name.length > 1 ? find_word(WORDS(args->table), name) : NOT_GIVEN;
    if (i == NOT_GIVEN)
        return refuse_option(args->table, "--", name);
    const struct option *o = &args->table[i];
    if (!o->value && value)
        return usage("--%s takes no value", o->name);
    return o->value && !value ? set_next(args, o) : set(args, o, value);
}

static int take_short(struct arguments *args, const char *letters)
{
    for (const char *p = letters; *p; p++) {
        const struct string letter = between(p, p + 1);
        const int i = find_word(WORDS(args->table), letter);
        if (i == NOT_GIVEN)
            return refuse_option(args->table, "-",
                                 p == letters ? string_of(p) : letter);
        const struct option *o = &args->table[i];
        if (o->value)
            return p[1] ? set(args, o, p + 1) : set_next(args, o);
        set(args, o, NULL);
    }
    return 0;
}

int take_arguments(const struct option *table, int argc, char **argv,
                   void *options, int *files, unsigned long long *given)
{
    struct arguments args = {table, argv, argc, argc > 0, options, given};
    int only_files = 0, status = 0;
    *files = 0;
    while (status == 0 && args.next < args.count) {
        char *arg = args.argv[args.next++];
        if (only_files || arg[0] != '-' || arg[1] == '\0')
            argv[(*files)++] = arg;
        else if (strcmp(arg, "--") == 0)
            only_files = 1;
        else if (arg[1] == '-')
            status = take_long(&args, arg + 2);
        else
            status = take_short(&args, arg + 1);
    }
    return status;
}

int was_given(const struct option *table, unsigned long long given,
              const char *name)
{
    return given >> find_word(WORDS(table), string_of(name)) & 1;
}

/* ----------------------------------------------------------------- help -- */

/* Prints the lines of a help from one column on. */
static void print_help(int column, const char *help)
{
    if (column > HELP_COLUMN - 2) {
        printf("\n");
        column = 0;
    }
    while (*help) {
        const int length = (int)strcspn(help, "\n");
        printf("%*s%.*s\n", HELP_COLUMN - column, "", length, help);
        help += length + (help[length] == '\n');
        column = 0;
    }
}

void print_options(const struct option *table)
{
    int column = 0;
    for (const struct option *o = table; o->name; o++) {
        column +=
            printf("%s%s%s", column > 0 ? ", " : "  ", dashes_of(o), o->name);
        if (o->value)
            column += printf("%s%s", *o->value == '=' ? "" : " ", o->value);
        if (o->help) {
            print_help(column, o->help);
            column = 0;
        }
    }
}

int end_printing(void)
{
    return fflush(stdout) == 0 && !ferror(stdout)
               ? 0
               : complain_errno("standard output");
}
