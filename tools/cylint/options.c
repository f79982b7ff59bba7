/*
 * options.c - the options of cylint
 *
 * A new option needs a line in the table, and a rule if it does not go with
 * others.
 */
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "arguments.h"
#include "numbers.h"
#include "options.h"
#include "scene.h"

/* --------------------------------------------------------------- values -- */

/* One character, or \t for a tab. */
static int read_separator(const struct option *o, const char *value,
                          void *place)
{
    const int is_tab = strcmp(value, "\\t") == 0;
    *(char *)place = is_tab ? '\t' : value[0];
    return check_value(
        o, value,
        is_tab || (value[0] != '\0' && value[0] != '\n' && value[1] == '\0'));
}

static int read_missing(const struct option *o, const char *value, void *place)
{
    *(const char **)place = value;
    return check_value(o, value, strchr(value, '\n') == NULL);
}

static int read_domain(const struct option *o, const char *value, void *place)
{
    struct grammar *g = place;
    g->has_domain = 1;
    return check_value(o, value,
                       read_bounds(value, g->domain, 2) &&
                           g->domain[0] <= g->domain[1]);
}

static int read_radius(const struct option *o, const char *value, void *place)
{
    return check_value(o, value, read_bounds(value, place, 1));
}

static int read_method(const struct option *o, const char *value, void *place)
{
    int i;
    const int status =
        read_word_of(o, value, WORDS(cylint_methods()), o->extra, &i);
    if (status == 0)
        *(const cylint_method **)place = &cylint_methods()[i];
    return status;
}

/* The query of pairs, the first one, has no word. */
static int read_query(const struct option *o, const char *value, void *place)
{
    int i;
    const int status = read_word_of(o, value, WORDS(query_kinds + 1), NULL, &i);
    *(enum query *)place = (enum query)(i + 1);
    return status;
}

/* ---------------------------------------------------------------- table -- */

/* What an option needs.  Most, with 0 in the table, need answers, which --save and
 * --text do not write; NEEDS_QUERY: also a scene. */
enum needs {
    NEEDS_ANSWERS,
    NEEDS_NOTHING,
    NEEDS_TEXT,
    NEEDS_SCENE,
    NEEDS_QUERY,
    NEEDS_PIECES,
    NEEDS_SOLIDS
};

static const char *const modes[] = {"owner", "union", "cells", "chords", NULL};
static const char *const sums[] = {"label", "label:t", "total", "total:t",
                                   NULL};
static const char *const names_of_shapes[] = {"number", "label", NULL};
static const char *const accels[] = {"auto", "none", "embree", NULL};
static const char *const bad_policies[] = {"mark", "skip", "stop", NULL};
static const char *const lists[] = {"methods", "shapes", "columns", NULL};

#define AT(member) offsetof(struct options, member)

/* In the order of --help.  A help of NULL is that of the next option. */
static const struct option option_table[] = {
    {"k", "LINE,SHAPE", read_text, AT(kinds), 0, 0, 0,
     "records are bare numbers of these kinds; -s: -k LINE"},
    {"s", "FILE", read_text, AT(scene), 0, 0, NEEDS_NOTHING,
     "a scene, one SHAPE [ends=WORD] [SOLID]... [TAIL] a line,\n"
     "or a neuron: NAME.swc, or a file of --save\n"
     "SOLID: in=NAME[/CLAUSE] or out=NAME[/CLAUSE]"},
    {"save", "FILE", read_text, AT(save), 0, 0, NEEDS_SCENE,
     "save the scene for other calls' -s, instead of answers"},
    {"text", 0, read_flag, AT(writes_text), 0, 1, NEEDS_SCENE,
     "write the scene as text instead of answers"},
    {"swc", "FORM", read_word, AT(swc), swc_forms, 0, NEEDS_SCENE,
     "the scene is a neuron, of cones (default) or round"},
    {"q", "QUERY", read_query, AT(query), 0, 0, NEEDS_QUERY,
     "with -s: nearest (default), first, any, count, all,\n"
     "pieces or inside"},
    {"pieces", "MODE", read_word, AT(piece_mode), modes, 0, NEEDS_PIECES,
     "of -q pieces: owner (default), union, cells or chords"},
    {"union", 0, read_flag, AT(piece_mode), 0, 1, NEEDS_PIECES,
     "the same as --pieces union"},
    {"rank", "FILE", read_text, AT(rank), 0, 0, NEEDS_SOLIDS,
     "lines LABEL INTEGER: of several solids the one with the\n"
     "least rank owns a place"},
    {"first", "K", read_count, AT(most_pieces), "a number of pieces", INT_MAX,
     NEEDS_PIECES, "of -q pieces: the first K pieces of each line"},
    {"sum", "WHAT", read_word, AT(sum), sums, 0, NEEDS_PIECES,
     "of -q pieces: sums of lengths, one for each label or of\n"
     "all: label, total; in multiples of the direction: label:t,\n"
     "total:t"},
    {"not", "WHAT", read_word, AT(not_label), names_of_shapes, 0, NEEDS_QUERY,
     "with -s: a record's not=NAME leaves out the shape with\n"
     "this number (default) or those with this label"},
    {"within", "R", read_radius, AT(radius), "a radius", 0, NEEDS_QUERY,
     "with -s: of points, shapes up to R away"},
    {"signed", 0, read_flag, AT(signed_flag), 0, CYLINT_SIGNED, 0,
     "of points: distances from closed solids"},
    {"f", "LIST", read_text, AT(columns), 0, 0, 0,
     "output columns, see --list=columns"},
    {"ends", "WORD", read_word, AT(grammar.ends), ends_words, 0, NEEDS_NOTHING,
     "the ends of shapes without ends="},
    {"t", "MIN,MAX", read_domain, AT(grammar), "MIN,MAX with MIN <= MAX", 0, 0,
     "the domain of lines and rays"},
    {"method", "NAME", read_method, AT(method), "a method of --list=methods", 0,
     0, "answer by a published method, see --list=methods"},
    {"accel", "HOW", read_word, AT(accel), accels, 0, NEEDS_QUERY,
     "with -s: auto or none; the answers are the same"},
    {"p", "N", read_count, AT(style.digits), "1 to 17 digits",
     NUMBER_MAX_DIGITS, NEEDS_TEXT, NULL},
    {"x", 0, read_flag, AT(style.digits), 0, NUMBER_HEX, NEEDS_TEXT,
     "N significant digits; hexadecimal"},
    {"d", "CHAR", read_separator, AT(style.separator), "one character", 0, 0,
     "output separator, instead of a tab"},
    {"miss", "TOKEN", read_missing, AT(style.missing),
     "a text without a line feed", 0, 0, "what to write for a missing value"},
    {"e", "HOW", read_word, AT(bad_policy), bad_policies, 0, 0,
     "bad records: mark (default), skip or stop"},
    {"tail", 0, read_flag, AT(tail_policy), 0, TAIL_ALLOWED, 0,
     "no message about numbers and words in tails"},
    {"no-tail", 0, read_flag, AT(tail_policy), 0, TAIL_REFUSED, 0,
     "a record with a tail is bad"},
    {"C", 0, read_flag, AT(copies_comments), 0, 1, 0,
     "copy blank lines and comments through"},
    {"b", 0, read_flag, AT(is_binary), 0, 1, 0, NULL},
    {"binary-in", 0, read_flag, AT(is_binary_in), 0, 1, 0, NULL},
    {"binary-out", 0, read_flag, AT(style.is_binary), 0, 1, 0,
     "little-endian doubles in and out, in, out (needs -k)"},
    {"j", "N", read_count, AT(workers), "a number of workers", INT_MAX,
     NEEDS_NOTHING, "workers, at most; one for each processor by default"},
    {"hits-only", 0, read_flag, AT(hits_only), 0, 1, 0,
     "only answers with a hit"},
    {"header", 0, read_flag, AT(writes_header), 0, 1, 0, "column names first"},
    {"o", "FILE", read_text, AT(output), 0, 0, NEEDS_NOTHING, "output file"},
    {"progress", 0, read_flag, AT(shows_progress), 0, 1, 0,
     "write the progress to standard error"},
    {"list", "=WHAT", read_about, AT(about), lists, 0, 0,
     "methods, shapes or columns, one a line"},
    {"help", 0, read_about, AT(about), 0, 0, 0, NULL},
    {"version", 0, read_about, AT(about), 0, 0, 0,
     "print this text or the version"},
    {0}};

static int is_given(const struct options *o, const char *name)
{
    return was_given(option_table, o->given, name);
}

/* ------------------------------------- options that depend on each other -- */

/* -k LINE,SHAPE, or -k LINE with a scene. */
static int settle_kinds(struct options *o)
{
    struct grammar *g = &o->grammar;
    if (!o->kinds)
        return 0;
    const char *comma = strchr(o->kinds, ','),
               *shape = comma ? comma + 1 : NULL;
    g->line = find_word(WORDS(line_kinds),
                        comma ? between(o->kinds, comma) : string_of(o->kinds));
    g->shape =
        shape ? find_word(WORDS(shape_kinds), string_of(shape)) : NOT_GIVEN;
    if (g->line != NOT_GIVEN &&
        (g->has_shape ? g->shape != NOT_GIVEN : shape == NULL))
        return 0;
    char found[SHOWN_CAPACITY];
    return usage("-k: expected %s, found '%s'%s",
                 g->has_shape ? "LINE,SHAPE, as in -k ray,cylinder"
                              : "LINE, as in -k ray",
                 escape(found, string_of(o->kinds), VALUE_MOST),
                 !shape && g->line != NOT_GIVEN
                     ? "; with a scene, -s FILE, it is right"
                     : "");
}

static int settle_needs(struct options *o)
{
    static const char scene[] = "a scene, -s FILE",
                      answers[] = "answers: --save and --text write none";
    const int is_pieces = o->query == QUERY_PIECES;
    const int is_answered = !o->save && !o->writes_text;
    const char *const missing[] = {
        [NEEDS_ANSWERS] = is_answered ? NULL : answers,
        [NEEDS_TEXT] = o->save ? "text: --save writes none" : NULL,
        [NEEDS_SCENE] = o->scene ? NULL : scene,
        [NEEDS_QUERY] = !o->scene     ? scene
                        : is_answered ? NULL
                                      : answers,
        [NEEDS_PIECES] = is_pieces ? NULL : "the query -q pieces",
        [NEEDS_SOLIDS] = is_pieces || o->query == QUERY_INSIDE
                             ? NULL
                             : "the query -q pieces or -q inside"};
    for (int i = 0; option_table[i].name; i++) {
        const struct option *option = &option_table[i];
        if (o->given >> i & 1 && missing[option->needs])
            return usage("%s%s needs %s", option->name[1] ? "--" : "-",
                         option->name, missing[option->needs]);
    }
    return 0;
}

static int is_same_word(const char *a, const char *b)
{
    return a && strcmp(a, b) == 0;
}

static int uses_stdin(const struct options *o)
{
    int is_used = o->file_count == 0;
    for (int i = 0; i < o->file_count; i++)
        is_used |= is_same_word(o->files[i], "-");
    return is_used;
}

/* Sets why records may not have lines, points or not=NAME. */
static int settle_records(struct options *o)
{
    struct grammar *g = &o->grammar;
    const struct query_kind *q = &query_kinds[o->query];
    g->no_lines = is_given(o, "within")   ? "the option --within is for points"
                  : q->no_lines           ? q->no_lines
                  : o->signed_flag        ? "the option --signed is for points"
                  : g->line == LINE_POINT ? ""
                                          : NULL;
    g->no_points = q->no_points ? q->no_points
                   : g->line != NOT_GIVEN && g->line != LINE_POINT ? ""
                   : o->method ? "a method computes no distances"
                               : NULL;
    g->no_left_out = q->no_left_out;
    if (q->no_points && g->no_lines)
        return usage("the query %s is for lines, not for points", q->word);
    if (q->no_points && o->method)
        return usage("--method: no method answers the query %s", q->word);
    if (g->no_lines && g->no_points)
        return o->method ? usage("--method is for lines, not for points")
                         : usage("%s, not for lines", g->no_lines);
    return 0;
}

/* Prints the fault of -f at the name `bad`. */
static int refuse_field_name(const struct fields *fields, const char *bad,
                             int query)
{
    const struct string name = between(bad, bad + strcspn(bad, ","));
    char text[SHOWN_CAPACITY];
    const char *shown = escape(text, name, VALUE_MOST);
    const char *meant = similar_field(name, query);
    if (fields->count == MOST_FIELDS)
        return usage("-f: more than %d columns", MOST_FIELDS);
    return meant ? usage("-f: no column '%s' here; did you mean %s?", shown,
                         meant)
                 : usage("-f: no column '%s' here; see --list=columns", shown);
}

static const char *find_columns(struct fields *fields, const struct options *o,
                                int is_point)
{
    const struct query_kind *q = &query_kinds[o->query];
    const int has_no_labels = o->style.is_binary && o->query == QUERY_NEAREST;
    const char *unless_given = !is_point       ? q->fields
                               : has_no_labels ? "shape,distance,part"
                                               : q->point_fields;
    return find_fields(fields, o->columns ? o->columns : unless_given,
                       (int)o->query + (is_point ? QUERIES : 0));
}

/* Reads the columns of lines, of points, or of both: of those records that the
 * other options allow.  If names fit only one of them, the other is refused. */
static int settle_fields(struct options *o)
{
    struct grammar *g = &o->grammar;
    const char *bad = find_columns(&o->fields, o, 0);
    const char *point_bad = find_columns(&o->point_fields, o, 1);
    if (g->no_lines && point_bad)
        return refuse_field_name(&o->point_fields, point_bad,
                                 (int)o->query + QUERIES);
    if (bad && (point_bad || g->no_points))
        return refuse_field_name(&o->fields, bad, (int)o->query);
    if (bad && !g->no_lines)
        g->no_lines = "the columns of -f are those of points";
    if (point_bad && !g->no_points)
        g->no_points = "the columns of -f are those of lines";
    if (o->point_fields.has_solids)
        g->no_left_out = "depth, shape and label leave out no shapes";
    /* A header and rows of doubles have one set of columns. */
    if ((o->writes_header || o->style.is_binary) && !g->no_lines &&
        !g->no_points)
        g->no_points = o->writes_header
                           ? "the header is that of lines; for points use "
                             "-k point, and no words"
                           : "binary output is of lines; for points use "
                             "-k point, and no words";
    return 0;
}

/* Combinations of options that are wrong. */
static int check_combinations(struct options *o)
{
    const int out = o->style.is_binary, in = o->is_binary_in;
    const int only_writes = o->save || o->writes_text;
    const struct {
        int is_wrong;
        const char *message;
    } rules[] = {
        {is_same_word(o->save, "-"),
         "--save: needs a file, not standard output"},
        {o->save && (o->output || o->writes_text),
         "--save: the file of --save is the only output"},
        {only_writes && o->file_count > 0,
         "--save and --text write the scene only: no answers"},
        {is_same_word(o->scene, "-") && uses_stdin(o) && !only_writes,
         "the scene and the records are both standard input"},
        {is_same_word(o->rank, "-"),
         "--rank: needs a file, not standard input"},
        {o->sum && o->most_pieces > 0, "--first and --sum exclude each other"},
        {o->sum && o->columns,
         "-f and --sum exclude each other: the columns of --sum are labels"},
        {is_given(o, "within") && o->query == QUERY_INSIDE,
         "--within: the query inside has no radius"},
        {o->radius < 0 && !o->signed_flag,
         "--within: a radius below 0 needs --signed"},
        {is_given(o, "x") && is_given(o, "p"), "-x and -p exclude each other"},
        {out && is_given(o, "x"), "-x: binary output has no digits"},
        {out && is_given(o, "p"), "-p: binary output has no digits"},
        {out && is_given(o, "d"), "-d: binary output has no separators"},
        {in && o->grammar.line == NOT_GIVEN,
         "binary input needs the kinds: -k LINE,SHAPE, or with -s: -k LINE"},
        {out && o->writes_header, "--header: binary output has no header"},
        {out && options_fields(o)->label_count > 0,
         "-f label: binary output has numbers only"},
        {out && o->style.missing,
         "--miss: in binary output a missing value is NaN"},
        {(in || out) && o->copies_comments, "-C: only text has comments"}};
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].is_wrong)
            return usage("%s", rules[i].message);
    return 0;
}

/* The remarks to test for. */
static unsigned wanted_remarks(const struct options *o)
{
    const struct grammar *g = &o->grammar;
    const unsigned tail = 1u << REMARK_NUMBERS | 1u << REMARK_LATE_WORD;
    return (o->tail_policy == TAIL_WITH_REMARK ? tail : 0) |
           (unsigned)g->has_domain << REMARK_DOMAIN |
           (unsigned)!g->has_shape << REMARK_LABEL;
}

static int settle(struct options *o)
{
    static char dash[] = "-";
    static char *standard_input[] = {dash};
    static int (*const steps[])(struct options *) = {
        settle_kinds, settle_needs, settle_records, settle_fields,
        check_combinations};
    struct grammar *g = &o->grammar;
    int status = 0;
    g->has_line = 1;
    g->has_shape = o->scene == NULL;
    if (o->scene && !is_given(o, "q"))
        o->query = QUERY_NEAREST;
    g->no_tail = o->tail_policy == TAIL_REFUSED;
    o->is_binary_in |= o->is_binary;
    o->style.is_binary |= o->is_binary;
    o->sum += is_given(o, "sum");
    for (size_t i = 0; i < sizeof steps / sizeof *steps && status == 0; i++)
        status = steps[i](o);
    o->remarks = wanted_remarks(o);
    if (o->file_count == 0) {
        o->files = standard_input;
        o->file_count = 1;
    }
    if (is_same_word(o->output, "-"))
        o->output = NULL;
    return status;
}

int read_options(struct options *o, int argc, char **argv)
{
    memset(o, 0, sizeof *o);
    o->grammar.line = o->grammar.shape = o->grammar.ends = o->swc = NOT_GIVEN;
    o->style.separator = '\t';
    o->radius = HUGE_VAL;
    o->files = argv;
    const int status =
        take_arguments(option_table, argc, argv, o, &o->file_count, &o->given);
    return status != 0 || o->about ? status : settle(o);
}

/* ----------------------------------------------------------------- help -- */

static void print_all_help(void)
{
    fputs("cylint [OPTION]... [FILE]...\n"
          "  a line and a shape in every record\n"
          "cylint -s SCENE [OPTION]... [FILE]...\n"
          "  a line or point in every record, and all shapes of SCENE\n"
          "\n"
          "Intersects lines with cylinders, cones and round shapes, and "
          "computes the\n"
          "distances of points from them.  Reads records from files or "
          "standard input\n"
          "(-), one a line, and writes one answer for each.\n"
          "\n"
          "  record  LINE SHAPE [ends=WORD] [TAIL]\n"
          "          with -s: LINE [not=NAME]... [TAIL]\n"
          "  LINE    line|ray ox oy oz dx dy dz   segment ax ay az bx by bz\n"
          "          span ox oy oz dx dy dz tmin tmax   point x y z\n"
          "  SHAPE   cylinder p0 p1 r   cone p0 r0 p1 r1   ecylinder c a b h\n"
          "          econe c a b h k    acone v u degrees\n"
          "          sphere c r   capsule p0 p1 r   rcone p0 r0 p1 r1\n"
          "          halfspace p n\n"
          "  WORD    capped open cap0 cap1 infinite nappe\n"
          "\n",
          stdout);
    print_options(option_table);
    fputs("\n"
          "Exit status: 0 all answered, 1 some records bad, 2 usage, 3 input "
          "or output\n"
          "failed, 4 out of memory.  See cylint(1).\n",
          stdout);
}

int print_about(const char *what)
{
    if (strcmp(what, "help") == 0)
        print_all_help();
    else if (strcmp(what, "version") == 0)
        puts("cylint " CYLINT_VERSION);
    else if (strcmp(what, "columns") == 0)
        list_columns();
    else if (strcmp(what, "methods") == 0)
        for (const cylint_method *m = cylint_methods(); m->name; m++)
            printf("%s\t%s\t%s\n", m->name, m->source, m->shapes);
    else
        for (const struct kind *k = shape_kinds; k->word; k++)
            printf("%s\t%d\t%s\n", k->word, k->numbers, k->names);
    return end_printing();
}
