/*
 * options.c - reads the options of cylint
 */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "arguments.h"
#include "numbers.h"
#include "options.h"
#include "similar.h"

enum option_id {
    OPT_ACCEL = 256,
    OPT_BINARY_IN,
    OPT_BINARY_OUT,
    OPT_ENDS,
    OPT_FIRST,
    OPT_HEADER,
    OPT_HELP,
    OPT_HITS_ONLY,
    OPT_LIST,
    OPT_METHOD,
    OPT_MISS,
    OPT_NO_TAIL,
    OPT_NOT,
    OPT_NPY,
    OPT_PIECES,
    OPT_PROGRESS,
    OPT_RANK,
    OPT_SAVE,
    OPT_SIGNED,
    OPT_SUM,
    OPT_SWC,
    OPT_TAIL,
    OPT_TEXT,
    OPT_UNION,
    OPT_VERSION,
    OPT_WITHIN
};

static const struct option options_known[] = {{"b", 'b', 0},
                                              {"C", 'C', 0},
                                              {"d", 'd', 1},
                                              {"e", 'e', 1},
                                              {"f", 'f', 1},
                                              {"j", 'j', 1},
                                              {"k", 'k', 1},
                                              {"o", 'o', 1},
                                              {"p", 'p', 1},
                                              {"q", 'q', 1},
                                              {"s", 's', 1},
                                              {"t", 't', 1},
                                              {"x", 'x', 0},
                                              {"accel", OPT_ACCEL, 1},
                                              {"binary-in", OPT_BINARY_IN, 0},
                                              {"binary-out", OPT_BINARY_OUT, 0},
                                              {"ends", OPT_ENDS, 1},
                                              {"first", OPT_FIRST, 1},
                                              {"header", OPT_HEADER, 0},
                                              {"help", OPT_HELP, 0},
                                              {"hits-only", OPT_HITS_ONLY, 0},
                                              {"list", OPT_LIST, 1},
                                              {"method", OPT_METHOD, 1},
                                              {"miss", OPT_MISS, 1},
                                              {"no-tail", OPT_NO_TAIL, 0},
                                              {"not", OPT_NOT, 1},
                                              {"npy", OPT_NPY, 0},
                                              {"pieces", OPT_PIECES, 1},
                                              {"progress", OPT_PROGRESS, 0},
                                              {"rank", OPT_RANK, 1},
                                              {"save", OPT_SAVE, 1},
                                              {"signed", OPT_SIGNED, 0},
                                              {"sum", OPT_SUM, 1},
                                              {"swc", OPT_SWC, 1},
                                              {"tail", OPT_TAIL, 0},
                                              {"text", OPT_TEXT, 0},
                                              {"union", OPT_UNION, 0},
                                              {"version", OPT_VERSION, 0},
                                              {"within", OPT_WITHIN, 1},
                                              {NULL, 0, 0}};

/* Values that are checked after all options were read. */
struct pending {
    const char *kinds, *query, *fields;
    int tail;              /* --tail: no remark on it */
    int not_what;          /* --not was given */
    int has_swc;           /* --swc was given */
    int hex;               /* -x */
    int within;            /* --within */
    const char *of_pieces; /* an option that needs -q pieces */
};

/* ------------------------------------------------------------- values -- */

static int read_domain(const char *value, struct grammar *g)
{
    const char *p = read_bound(value, &g->tmin);
    if (!p || *p != ',') {
        return 0;
    }
    p = read_bound(p + 1, &g->tmax);
    g->has_domain = 1;
    return p && *p == '\0' && g->tmin <= g->tmax;
}

static int read_radius(const char *value, double *radius)
{
    const char *p = read_bound(value, radius);
    return p && *p == '\0';
}

static const cylint_method *find_method(const char *name)
{
    const cylint_method *m = cylint_methods();
    while (m->name && strcmp(m->name, name) != 0) {
        m++;
    }
    return m->name ? m : NULL;
}

static int read_accel(struct options *options, const struct option *o,
                      const char *value)
{
    int index;
    const int status =
        read_word(o, value, accel_words, "auto, none or tree", &index);
    options->accel = index == ACCEL_EMBREE ? ACCEL_TREE : (enum accel)index;
    return status;
}

static int read_method(struct options *options, const struct option *o,
                       const char *value)
{
    struct similar similar = similar_to(value, strlen(value));
    options->method = find_method(value);
    if (options->method) {
        return 0;
    }
    for (const cylint_method *m = cylint_methods(); m->name; m++) {
        similar_try(&similar, m->name);
    }
    return usage_similar(o, value, "a method of --list=methods", similar.word);
}

static int read_bad_policy(struct options *options, const struct option *o,
                           const char *value)
{
    static const char *const words[] = {"mark", "skip", "stop", NULL};
    int index;
    const int status = read_word(o, value, words, "mark, skip or stop", &index);
    options->bad = (enum bad_policy)index;
    return status;
}

static int read_not(struct options *options, const struct option *o,
                    const char *value)
{
    static const char *const words[] = {"number", "label", NULL};
    return read_word(o, value, words, "number or label", &options->not_label);
}

static int read_mode(struct options *options, const struct option *o,
                     const char *value)
{
    static const char *const words[] = {[CYLINT_PIECES_UNION] = "union",
                                        [CYLINT_PIECES_OWNER] = "owner",
                                        [CYLINT_PIECES_CELLS] = "cells",
                                        [CYLINT_PIECES_CHORDS] = "chords",
                                        NULL};
    int index;
    const int status =
        read_word(o, value, words, "owner, union, cells or chords", &index);
    options->mode = (cylint_piece_mode)index;
    return status;
}

static int read_sum(struct options *options, const struct option *o,
                    const char *value)
{
    static const char *const words[] = {"label", "label:t", NULL};
    int index;
    const int status = read_word(o, value, words, "label or label:t", &index);
    options->sum = index == 0 ? SUM_LENGTH : SUM_T;
    return status;
}

/* Reads the value of an option that needs -q pieces. */
static int take_value_of_pieces(struct options *options,
                                struct pending *pending, const struct option *o,
                                const char *value)
{
    pending->of_pieces = o->name;
    if (o->id == OPT_FIRST) {
        return read_count(value, INT_MAX / 10 - 1, &options->most_pieces)
                   ? 0
                   : usage_value(o, value, "a number of pieces");
    }
    return o->id == OPT_SUM ? read_sum(options, o, value)
                            : read_mode(options, o, value);
}

static int read_list(struct options *options, const struct option *o,
                     const char *value)
{
    static const char *const words[] = {"methods", "shapes", "columns", NULL};
    int index;
    options->print = value;
    return read_word(o, value, words, "methods, shapes or columns", &index);
}

/* Keeps a value that is tested later or not at all.  Returns 0 if this option's
 * value is tested now. */
static int keep_value(struct options *options, struct pending *pending, int id,
                      const char *value)
{
    switch (id) {
    case 'f':
        pending->fields = value;
        return 1;
    case 'k':
        pending->kinds = value;
        return 1;
    case 'o':
        options->output = value;
        return 1;
    case 'q':
        pending->query = value;
        return 1;
    case 's':
        options->scene = value;
        return 1;
    case OPT_MISS:
        options->style.missing = value;
        return 1;
    case OPT_RANK:
        options->rank = value;
        return 1;
    case OPT_SAVE:
        options->save = value;
        return 1;
    default:
        return 0;
    }
}

static int take_value(struct options *options, struct pending *pending,
                      const struct option *o, const char *value)
{
    switch (o->id) {
    case 'd':
        return read_separator(value, &options->style.separator)
                   ? 0
                   : usage_value(o, value, "one character");
    case 'e':
        return read_bad_policy(options, o, value);
    case 'j':
        return read_count(value, INT_MAX / 10 - 1, &options->workers)
                   ? 0
                   : usage_value(o, value, "a number of workers");
    case 'p':
        return read_count(value, NUMBER_MAX_DIGITS, &options->style.digits)
                   ? 0
                   : usage_value(o, value, "1 to 17 digits");
    case 't':
        return read_domain(value, &options->grammar)
                   ? 0
                   : usage_value(o, value, "MIN,MAX with MIN <= MAX");
    case OPT_ACCEL:
        return read_accel(options, o, value);
    case OPT_ENDS:
        return read_word(o, value, ends_words,
                         "capped, open, cap0, cap1, infinite or nappe",
                         &options->grammar.ends);
    case OPT_LIST:
        return read_list(options, o, value);
    case OPT_METHOD:
        return read_method(options, o, value);
    case OPT_NOT:
        pending->not_what = 1;
        return read_not(options, o, value);
    case OPT_WITHIN:
        pending->within = 1;
        return read_radius(value, &options->radius)
                   ? 0
                   : usage_value(o, value, "a radius");
    case OPT_FIRST:
    case OPT_PIECES:
    case OPT_SUM:
        return take_value_of_pieces(options, pending, o, value);
    default: /* OPT_SWC */
        pending->has_swc = 1;
        return read_word(o, value, swc_forms, SWC_FORMS, &options->swc);
    }
}

static void take_flag(struct options *options, struct pending *pending,
                      const struct option *o)
{
    switch (o->id) {
    case 'b':
        options->binary_in = options->style.binary = 1;
        break;
    case OPT_BINARY_IN:
        options->binary_in = 1;
        break;
    case OPT_BINARY_OUT:
        options->style.binary = 1;
        break;
    case OPT_NPY:
        options->style.binary = options->array = 1;
        break;
    case 'C':
        options->comments = 1;
        break;
    case 'x':
        pending->hex = 1;
        break;
    case OPT_HEADER:
        options->header = 1;
        break;
    case OPT_HITS_ONLY:
        options->hits_only = 1;
        break;
    case OPT_PROGRESS:
        options->progress = 1;
        break;
    case OPT_UNION:
        pending->of_pieces = o->name;
        options->mode = CYLINT_PIECES_UNION;
        break;
    case OPT_TEXT:
        options->text = 1;
        break;
    case OPT_SIGNED:
        options->point_want = CYLINT_SIGNED;
        break;
    case OPT_TAIL:
    case OPT_NO_TAIL:
        pending->tail = o->id == OPT_TAIL;
        options->grammar.no_tail = o->id == OPT_NO_TAIL;
        break;
    default: /* OPT_HELP, OPT_VERSION */
        options->print = o->name;
    }
}

/* The context of take_arguments(). */
struct parsed_options {
    struct options *options;
    struct pending pending;
};

static int take_option(void *context, const struct option *o, const char *value)
{
    struct parsed_options *parsed = context;
    if (o->has_value) {
        return keep_value(parsed->options, &parsed->pending, o->id, value)
                   ? 0
                   : take_value(parsed->options, &parsed->pending, o, value);
    }
    take_flag(parsed->options, &parsed->pending, o);
    return 0;
}

/* ---------------------------------------------- options upon each other -- */

/* -k LINE,SHAPE, or -k LINE with a scene. */
static int settle_kinds(struct grammar *g, const char *kinds)
{
    const size_t length = strcspn(kinds, ",");
    const char *shape = kinds[length] ? kinds + length + 1 : NULL;
    g->line = find_kind(line_kinds, LINE_KINDS, kinds, length);
    g->shape = shape ? find_kind(shape_kinds, SHAPE_KINDS, shape, strlen(shape))
                     : NOT_GIVEN;
    if (g->line != NOT_GIVEN &&
        (g->has_shape ? g->shape != NOT_GIVEN : shape == NULL)) {
        describe_bare(g);
        return 0;
    }
    return usage(g->has_shape ? "-k: expected LINE,SHAPE, as in -k ray,cylinder"
                              : "-k: expected LINE, as in -k ray");
}

static int settle_query(struct options *options, const char *query)
{
    options->query = options->scene ? QUERY_NEAREST : QUERY_PAIRS;
    if (!query) {
        return 0;
    }
    const int index = find_word(query_words, query, strlen(query));
    if (index == NOT_GIVEN || index == QUERY_PAIRS) {
        return usage("-q: expected nearest, first, any, count, all, pieces or "
                     "inside");
    }
    options->query = (enum query)index;
    return options->scene ? 0 : usage("-q needs a scene, -s FILE");
}

/* The options of pieces, after the query. */
static int settle_pieces(const struct options *o, const struct pending *pending)
{
    const int is_pieces = o->query == QUERY_PIECES;
    if (pending->of_pieces && !is_pieces) {
        return usage("--%s needs the query -q pieces", pending->of_pieces);
    }
    if (o->rank && !is_pieces && o->query != QUERY_INSIDE) {
        return usage("--rank needs the query -q pieces or -q inside");
    }
    if (o->rank && strcmp(o->rank, "-") == 0) {
        return usage("--rank: needs a file, not standard input");
    }
    if (o->sum && o->most_pieces > 0) {
        return usage("--first and --sum exclude each other");
    }
    return o->sum && pending->fields
               ? usage("-f and --sum exclude each other: the columns of --sum "
                       "are labels")
               : 0;
}

/* Prints the fault of -f at the name `bad`. */
static int refuse_field(const struct fields *fields, const char *bad,
                        size_t length, enum query query)
{
    if (fields->count == MOST_FIELDS) {
        return usage("-f: more than %d columns", MOST_FIELDS);
    }
    char shown[4 * 64 + 4];
    escape_bytes(shown, bad, bad + length, 64);
    const char *meant = similar_field(bad, length, query);
    return meant ? usage("-f: no column '%s' here; did you mean %s?", shown,
                         meant)
                 : usage("-f: no column '%s' here; see --list=columns", shown);
}

/* Reads the columns of lines, of points, or of both: of those records that the
 * other options allow.  If names fit only one of them, the other is refused. */
static int settle_fields(struct options *o, const char *names)
{
    struct grammar *g = &o->grammar;
    const enum query points = query_of_points(o->query);
    const int binary = o->style.binary;
    size_t length, point_length;
    const char *bad = find_fields(
        &o->fields, names ? names : default_fields(o->query, binary), o->query,
        &length);
    const char *point_bad = find_fields(
        &o->point_fields, names ? names : default_fields(points, binary),
        points, &point_length);
    if (bad && (point_bad || g->no_points)) {
        const int of_points = g->no_lines && !g->no_points;
        return of_points ? refuse_field(&o->point_fields, point_bad,
                                        point_length, points)
                         : refuse_field(&o->fields, bad, length, o->query);
    }
    if (point_bad && g->no_lines) {
        return refuse_field(&o->point_fields, point_bad, point_length, points);
    }
    if (bad && !g->no_lines) {
        g->no_lines = "the columns of -f are those of points";
    }
    if (point_bad && !g->no_points) {
        g->no_points = "the columns of -f are those of lines";
    }
    if (o->point_fields.solids) {
        g->no_left_out = "depth, shape and label leave out no shapes";
    }
    return 0;
}

/* The radius of --within: a radius below 0 is a depth in a solid. */
static int settle_radius(const struct options *o, const struct pending *pending)
{
    if (pending->within && !o->scene) {
        return usage("--within needs a scene, -s FILE");
    }
    if (pending->within && o->query == QUERY_INSIDE) {
        return usage("--within: the query inside has no radius");
    }
    return o->radius < 0 && !o->point_want
               ? usage("--within: a radius below 0 needs --signed")
               : 0;
}

/* Why a line is a fault, or NULL. */
static const char *refusal_of_lines(const struct options *o,
                                    const struct pending *pending)
{
    return pending->within                 ? "the option --within is for points"
           : o->query == QUERY_INSIDE      ? "the query inside is for points"
           : o->point_want                 ? "the option --signed is for points"
           : o->grammar.line == LINE_POINT ? ""
                                           : NULL;
}

/* Of the queries first and pieces. */
static int settle_lines_only(struct options *o)
{
    struct grammar *g = &o->grammar;
    const int is_first = o->query == QUERY_FIRST;
    const char *word = query_words[o->query];
    g->no_points = is_first ? "the query first is for lines"
                            : "the query pieces is for lines";
    g->no_left_out = is_first ? "the query first leaves out no shapes"
                              : "the query pieces leaves out no shapes";
    if (g->no_lines) {
        return usage("the query %s is for lines, not for points", word);
    }
    return o->method ? usage("--method: no method answers the query %s", word)
                     : 0;
}

/* Whether the options allow only lines or only points. */
static int settle_records(struct options *o, const struct pending *pending)
{
    struct grammar *g = &o->grammar;
    const int status = settle_radius(o, pending);
    if (status != 0) {
        return status;
    }
    g->no_lines = refusal_of_lines(o, pending);
    if (o->query == QUERY_FIRST || o->query == QUERY_PIECES) {
        return settle_lines_only(o);
    }
    if (g->line != NOT_GIVEN && g->line != LINE_POINT) {
        g->no_points = "";
    } else if (o->method) {
        g->no_points = "a method computes no distances";
    }
    if (g->no_lines && g->no_points) {
        return o->method ? usage("--method is for lines, not for points")
                         : usage("%s, not for lines", g->no_lines);
    }
    return 0;
}

/* A header and rows of doubles have one set of columns. */
static void settle_one_set(struct options *o)
{
    struct grammar *g = &o->grammar;
    if ((o->header || o->style.binary) && !g->no_lines && !g->no_points) {
        g->no_points =
            o->header ? "the header is that of lines; for points use -k point"
                      : "binary output is of lines; for points use -k point";
    }
}

/* -x or -p, of numbers in text. */
static int settle_digits(struct options *options, int hex)
{
    if (hex && options->style.digits > 0) {
        return usage("-x and -p exclude each other");
    }
    if (options->style.binary && (hex || options->style.digits > 0)) {
        return usage("-%c: binary output has no digits", hex ? 'x' : 'p');
    }
    if (hex) {
        options->style.digits = NUMBER_HEX;
    }
    return 0;
}

static int settle_binary(const struct options *options)
{
    const struct grammar *g = &options->grammar;
    if (options->binary_in && g->line == NOT_GIVEN) {
        return usage("binary input needs the kinds, -k %s",
                     g->has_shape ? "LINE,SHAPE" : "LINE");
    }
    if (options->style.binary && options->header) {
        return usage("--header: binary output has none");
    }
    if (options->style.binary && options_fields(options)->labels > 0) {
        return usage("-f label: binary output has numbers only");
    }
    if (options->style.binary && options->style.missing) {
        return usage("--miss: in binary output what is missing is NaN");
    }
    if (options->comments && (options->binary_in || options->style.binary)) {
        return usage("-C: only text has comments");
    }
    return 0;
}

/* The remarks to test for. */
static unsigned wanted_remarks(const struct grammar *g, int tail)
{
    unsigned wanted = 0;
    if (g->bare[0] && !tail && !g->no_tail) {
        wanted |= 1u << REMARK_SURPLUS;
    }
    if (g->has_domain) {
        wanted |= 1u << REMARK_DOMAIN;
    }
    if (!g->has_shape) {
        wanted |= 1u << REMARK_LABEL;
    }
    return wanted;
}

static int uses_stdin(const struct options *options)
{
    for (int i = 0; i < options->file_count; i++) {
        if (strcmp(options->files[i], "-") == 0) {
            return 1;
        }
    }
    return 0;
}

/* Before the files are completed: --save without one answers no records. */
static int settle_save(struct options *options, const struct pending *pending)
{
    const char *const o = options->output;
    if (!options->save) {
        return 0;
    }
    if (!options->scene) {
        return usage("--save needs a scene, -s FILE");
    }
    if (o && strcmp(options->save, o) == 0) {
        return usage("--save and -o name the same file");
    }
    options->only_saves = options->file_count == 0;
    return options->only_saves &&
                   (o || pending->query || pending->fields || pending->kinds)
               ? usage("--save: answers need an input file; - is standard "
                       "input")
               : 0;
}

/* --text writes the scene, and answers no records. */
static int settle_text(const struct options *o, const struct pending *pending)
{
    if (!o->text) {
        return 0;
    }
    if (!o->scene) {
        return usage("--text needs a scene, -s FILE");
    }
    return o->save || o->file_count > 0 || pending->query || pending->fields ||
                   pending->kinds || o->style.binary
               ? usage("--text writes the scene only: no answers, no --save")
               : 0;
}

static int settle(struct options *options, const struct pending *pending)
{
    static char dash[] = "-";
    static char *standard_input[] = {dash};
    struct grammar *g = &options->grammar;
    g->has_line = 1;
    g->has_shape = options->scene == NULL;
    int status = settle_save(options, pending);
    if (status == 0) {
        status = settle_text(options, pending);
    }
    if (status != 0) {
        return status;
    }
    if (options->file_count == 0) {
        options->files = standard_input;
        options->file_count = 1;
    }
    if (options->scene && strcmp(options->scene, "-") == 0 &&
        uses_stdin(options) && !options->only_saves && !options->text) {
        return usage("the scene and the records are both standard input");
    }
    if (pending->not_what && !options->scene) {
        return usage("--not needs a scene, -s FILE");
    }
    if (pending->has_swc && !(options->scene && swc_is_name(options->scene))) {
        return usage("--swc needs a neuron, -s NAME.swc");
    }
    status = pending->kinds ? settle_kinds(g, pending->kinds) : 0;
    options->remarks = wanted_remarks(g, pending->tail);
    if (status == 0) {
        status = settle_query(options, pending->query);
    }
    if (status == 0) {
        status = settle_pieces(options, pending);
    }
    if (status == 0) {
        status = settle_records(options, pending);
    }
    if (status == 0) {
        status = settle_fields(options, pending->fields);
        settle_one_set(options);
    }
    if (status == 0) {
        status = settle_digits(options, pending->hex);
    }
    return status == 0 ? settle_binary(options) : status;
}

int read_options(struct options *options, int argc, char **argv)
{
    struct parsed_options parsed = {.options = options};
    memset(options, 0, sizeof *options);
    options->grammar.line = NOT_GIVEN;
    options->grammar.shape = NOT_GIVEN;
    options->grammar.ends = NOT_GIVEN;
    options->mode = CYLINT_PIECES_OWNER;
    options->style.separator = '\t';
    options->radius = HUGE_VAL;
    options->files = argv;
    const int status = take_arguments(options_known, argc, argv, take_option,
                                      &parsed, &options->file_count);
    return status != 0 || options->print ? status
                                         : settle(options, &parsed.pending);
}
