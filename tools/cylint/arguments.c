/*
 * arguments.c - a command line, argument by argument
 */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "grammar.h"
#include "main.h"
#include "numbers.h"
#include "similar.h"
#include "text.h"

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

int usage_similar(const struct option *o, const char *value,
                  const char *expected, const char *meant)
{
    char shown[4 * 64 + 4];
    escape_bytes(shown, value, value + strlen(value), 64);
    return usage("%s%s: expected %s, found '%s'%s%s%s", o->name[1] ? "--" : "-",
                 o->name, expected, shown, meant ? "; did you mean " : "",
                 meant ? meant : "", meant ? "?" : "");
}

int usage_value(const struct option *o, const char *value, const char *expected)
{
    return usage_similar(o, value, expected, NULL);
}

int read_count(const char *value, int most, int *count)
{
    int n = 0;
    for (const char *p = value; *p >= '0' && *p <= '9' && n <= most; p++) {
        n = 10 * n + (*p - '0');
        if (p[1] == '\0' && n >= 1 && n <= most) {
            *count = n;
            return 1;
        }
    }
    return 0;
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

int read_separator(const char *value, char *separator)
{
    if (strcmp(value, "\\t") == 0) {
        *separator = '\t';
        return 1;
    }
    *separator = value[0];
    return value[0] != '\0' && value[0] != '\n' && value[1] == '\0';
}

int read_word(const struct option *o, const char *value,
              const char *const *words, const char *expected, int *index)
{
    const size_t length = strlen(value);
    *index = find_word(words, value, length);
    return *index != NOT_GIVEN
               ? 0
               : usage_similar(o, value, expected,
                               similar_word(words, value, length));
}

/* The arguments, the position in them, and the function that takes them. */
struct arguments {
    char **argv;
    int count, next;
    const struct option *known;
    option_handler *handle;
    void *context;
};

static const struct option *find_option(const struct option *known,
                                        const char *name, size_t length)
{
    for (const struct option *o = known; o->name; o++)
        if (strlen(o->name) == length && memcmp(o->name, name, length) == 0)
            return o;
    return NULL;
}

/* One letter is too short for a suggestion. */
static int refuse_option(const struct option *known, const char *dashes,
                         const char *name, size_t length)
{
    struct similar similar = similar_to(name, length);
    char shown[4 * 64 + 4];
    escape_bytes(shown, name, name + length, 64);
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
    const struct option *o =
        length > 1 ? find_option(args->known, name, length) : NULL;
    char shown[4 * 64 + 4];
    escape_bytes(shown, name, name + length, 64);
    if (!o)
        return refuse_option(args->known, "--", name, length);
    if (!o->has_value) {
        return name[length] == '=' ? usage("--%s takes no value", shown)
                                   : args->handle(args->context, o, NULL);
    }
    if (name[length] == '=')
        return args->handle(args->context, o, name + length + 1);
    return args->next < args->count
               ? args->handle(args->context, o, args->argv[args->next++])
               : usage("--%s needs a value", shown);
}

static int take_short(struct arguments *args, const char *letters)
{
    int status = 0;
    for (const char *p = letters; *p && status == 0; p++) {
        const struct option *o = find_option(args->known, p, 1);
        char shown[8];
        escape_bytes(shown, p, p + 1, 1);
        if (!o) {
            return p == letters && p[1]
                       ? refuse_option(args->known, "-", p, strlen(p))
                       : usage("unknown option '-%s'", shown);
        }
        if (!o->has_value)
            status = args->handle(args->context, o, NULL);
        else if (p[1])
            return args->handle(args->context, o, p + 1);
        else if (args->next < args->count)
            return args->handle(args->context, o, args->argv[args->next++]);
        else
            return usage("-%s needs a value", shown);
    }
    return status;
}

int take_arguments(const struct option *known, int argc, char **argv,
                   option_handler *handle, void *context, int *files)
{
    struct arguments args = {argv, argc, argc > 0, known, handle, context};
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
