/*
 * arguments.c - a table of options, and a command line that is read by it
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "main.h"
#include "numbers.h"
#include "text.h"

enum { SHOWN_MOST = 64, SHOWN_CAPACITY = 4 * SHOWN_MOST + 4, HELP_COLUMN = 21 };

const char no_help[] = "";

/* ------------------------------------------------------------- messages -- */

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

int usage_value(const struct option *o, const char *value, const char *expected,
                const char *meant)
{
    char shown[SHOWN_CAPACITY];
    escape_bytes(shown, value, value + strlen(value), SHOWN_MOST);
    return usage("%s%s: expected %s, found '%s'%s%s%s", dashes_of(o), o->name,
                 expected, shown, meant ? "; did you mean " : "",
                 meant ? meant : "", meant ? "?" : "");
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

int read_word(const struct option *o, const char *value, void *place)
{
    char expected[WORDS_CAPACITY];
    const struct words words = WORDS((const char *const *)o->extra);
    const size_t length = strlen(value);
    const int index = find_word(words, value, length);
    if (index == NOT_GIVEN)
        return usage_value(o, value, list_words(expected, words),
                           similar_word(words, value, length));
    *(int *)place = index;
    return 0;
}

int read_count(const struct option *o, const char *value, void *place)
{
    unsigned long long count;
    if (!read_whole(value, value + strlen(value), (unsigned long long)o->number,
                    &count) ||
        count == 0)
        return usage_value(o, value, o->extra, NULL);
    *(int *)place = (int)count;
    return 0;
}

int check_value(const struct option *o, const char *value, int is_right)
{
    return is_right ? 0 : usage_value(o, value, o->extra, NULL);
}

const char *read_bound(const char *p, double *bound)
{
    const char *word = p + (*p == '-' || *p == '+');
    if (strncmp(word, "inf", 3) == 0) {
        *bound = *p == '-' ? -HUGE_VAL : HUGE_VAL;
        return word + 3;
    }
    const char *after = cylint_read_number(p, p + strlen(p), bound);
    return after && *bound - *bound == 0 ? after : NULL;
}

/* ------------------------------------------------------------ arguments -- */

/* The arguments, the position in them, and where their values go. */
struct arguments {
    const struct option *known;
    char **argv;
    int count, next;
    void *options;
    unsigned long long *given;
};

static int set(struct arguments *args, const struct option *o,
               const char *value)
{
    *args->given |= 1ULL << (o - args->known);
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
static int refuse_option(const struct option *known, const char *dashes,
                         const char *name, size_t length)
{
    struct similar similar = similar_to(name, length);
    char shown[SHOWN_CAPACITY];
    escape_bytes(shown, name, name + length, SHOWN_MOST);
    for (const struct option *o = known; o->name; o++)
        if (o->name[1])
            similar_try(&similar, o->name);
    return similar.word ? usage("unknown option '%s%s'; did you mean --%s?",
                                dashes, shown, similar.word)
                        : usage("unknown option '%s%s'", dashes, shown);
}

static int take_long(struct arguments *args, const char *name)
{
    const size_t length = strcspn(name, "=");
    const int i =
        length > 1 ? find_word(WORDS(args->known), name, length) : NOT_GIVEN;
    if (i == NOT_GIVEN)
        return refuse_option(args->known, "--", name, length);
    const struct option *o = &args->known[i];
    if (name[length] != '=')
        return o->value ? set_next(args, o) : set(args, o, NULL);
    return o->value ? set(args, o, name + length + 1)
                    : usage("--%s takes no value", o->name);
}

static int take_short(struct arguments *args, const char *letters)
{
    int status = 0;
    for (const char *p = letters; *p && status == 0; p++) {
        const int i = find_word(WORDS(args->known), p, 1);
        const struct option *o = &args->known[i == NOT_GIVEN ? 0 : i];
        if (i == NOT_GIVEN)
            return refuse_option(args->known, "-", p,
                                 p == letters ? strlen(p) : 1);
        if (o->value)
            return p[1] ? set(args, o, p + 1) : set_next(args, o);
        status = set(args, o, NULL);
    }
    return status;
}

int take_arguments(const struct option *known, int argc, char **argv,
                   void *options, int *files, unsigned long long *given)
{
    struct arguments args = {known, argv, argc, argc > 0, options, given};
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

/* ----------------------------------------------------------------- help -- */

/* Prints the lines of a help from one column on. */
static void print_help(int column, const char *help)
{
    if (*help == '\0' || column > HELP_COLUMN - 2) {
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

void print_options(const struct option *known)
{
    int column = 0;
    for (const struct option *o = known; o->name; o++) {
        if (o->help == no_help)
            continue;
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
