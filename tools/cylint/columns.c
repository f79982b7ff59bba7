/*
 * columns.c - the columns of an answer, and how they are written
 *
 * A new column needs a line in the table and, for a new kind of value, a case
 * in value_of().
 */
#include <math.h>

#include "columns.h"
#include "numbers.h"
#include "similar.h"

enum value {
    VALUE_RELATION,
    VALUE_N,
    VALUE_T,
    VALUE_PART,
    VALUE_SIDE,
    VALUE_X,
    VALUE_Y,
    VALUE_Z,
    VALUE_NX,
    VALUE_NY,
    VALUE_NZ,
    VALUE_H,
    VALUE_PHI,
    VALUE_CHORD,
    VALUE_DISTANCE,
    VALUE_FEATURE,
    VALUE_RECORD,
    VALUE_SHAPE,
    VALUE_LABEL,
    VALUE_COUNT,
    VALUE_DEPTH,
    VALUE_LENGTH
};

struct column {
    const char *name;
    enum value value;
    int hit;          /* 0 or 1, for values of a hit */
    unsigned queries; /* a bit for each enum query */
    const char *about;
};

const char *const query_words[] = {
    [QUERY_PAIRS] = "pairs",   [QUERY_NEAREST] = "nearest",
    [QUERY_ANY] = "any",       [QUERY_COUNT] = "count",
    [QUERY_ALL] = "all",       [QUERY_FIRST] = "first",
    [QUERY_PIECES] = "pieces", [QUERY_INSIDE] = "inside",
    [QUERIES] = NULL};

/* For --list=columns; by query without QUERY_POINT. */
static const char *const point_query_words[] = {
    [QUERY_PAIRS] = "point-pairs", [QUERY_NEAREST] = "point-nearest",
    [QUERY_ANY] = "point-any",     [QUERY_COUNT] = "point-count",
    [QUERY_ALL] = "point-all",     [QUERY_INSIDE] = "point-inside"};

enum {
    PAIRS = 1 << QUERY_PAIRS,
    NEAREST = 1 << QUERY_NEAREST,
    ANY = 1 << QUERY_ANY,
    COUNT = 1 << QUERY_COUNT,
    ALL = 1 << QUERY_ALL,
    FIRST = 1 << QUERY_FIRST,
    PIECES = 1 << QUERY_PIECES,
    POINT = 1 << QUERY_POINT,
    POINT_NEAREST = 1 << QUERY_POINT_NEAREST,
    POINT_ANY = 1 << QUERY_POINT_ANY,
    POINT_COUNT = 1 << QUERY_POINT_COUNT,
    POINT_ALL = 1 << QUERY_POINT_ALL,
    POINT_INSIDE = 1 << QUERY_POINT_INSIDE,
    POINTS = POINT | POINT_NEAREST | POINT_ALL,
    OF_SHAPES = NEAREST | ALL | FIRST | PIECES | POINT_NEAREST | POINT_ALL |
                POINT_INSIDE,
    EVERY = PAIRS | ANY | COUNT | POINT | POINT_ANY | POINT_COUNT | OF_SHAPES
};

/* Of both hits; of the one hit and, with POINTS, of the nearest point. */
#define HIT(name, value, points, about)                          \
    {name "0", value, 0, PAIRS | ALL, about ", first hit"},      \
        {name "1", value, 1, PAIRS | ALL, about ", second hit"}, \
    {                                                            \
        name, value, 0, NEAREST | FIRST | (points), about        \
    }

static const struct column columns[] = {
    {"relation", VALUE_RELATION, 0, PAIRS | NEAREST | ALL,
     "miss, touch, along or cross: the whole line and the closed solid"},
    {"n", VALUE_N, 0, PAIRS | ALL, "number of hits"},
    {"t0", VALUE_T, 0, PAIRS | ALL | PIECES,
     "where on the line, first hit or begin of the piece"},
    {"t1", VALUE_T, 1, PAIRS | ALL | PIECES,
     "where on the line, second hit or end of the piece"},
    {"t", VALUE_T, 0, NEAREST | FIRST, "where on the line"},
    {"distance", VALUE_DISTANCE, 0, POINTS,
     "of a point from the surface, negative inside the solid"},
    HIT("part", VALUE_PART, POINTS, "lateral, cap0 or cap1"),
    {"feature", VALUE_FEATURE, 0, POINTS,
     "lateral, cap0, cap1, rim0, rim1 or apex: what is nearest"},
    HIT("side", VALUE_SIDE, 0, "entering, leaving or both"),
    HIT("x", VALUE_X, POINTS, "x of the point"),
    HIT("y", VALUE_Y, POINTS, "y of the point"),
    HIT("z", VALUE_Z, POINTS, "z of the point"),
    HIT("nx", VALUE_NX, POINTS, "x of the outward unit normal"),
    HIT("ny", VALUE_NY, POINTS, "y of the outward unit normal"),
    HIT("nz", VALUE_NZ, POINTS, "z of the outward unit normal"),
    HIT("h", VALUE_H, 0, "axial coordinate, 0 at the base, 1 at the top"),
    HIT("phi", VALUE_PHI, 0, "angle about the axis over 2 pi, in [0,1)"),
    {"chord", VALUE_CHORD, 0, PAIRS | ALL, "t1 - t0"},
    {"shape", VALUE_SHAPE, 0, OF_SHAPES,
     "number of the shape in the scene, from 1; 0 for none"},
    {"label", VALUE_LABEL, 0, OF_SHAPES,
     "the tail of the shape's line in the scene"},
    {"depth", VALUE_DEPTH, 0, PIECES | POINT_INSIDE,
     "number of solids that contain the piece or the point"},
    {"length", VALUE_LENGTH, 0, PIECES,
     "t1 - t0, times the length of the direction"},
    {"any", VALUE_COUNT, 0, ANY | POINT_ANY,
     "1 if a shape is hit or within the radius, else 0"},
    {"count", VALUE_COUNT, 0, COUNT | POINT_COUNT | POINT_INSIDE,
     "number of shapes that are hit, are within the radius or hold the point"},
    {"id", VALUE_RECORD, 0, EVERY, "number of the record, from 1"},
    {"record", VALUE_RECORD, 0, ALL | PIECES | POINT_ALL, "the same as id"},
};

enum { COLUMNS = sizeof columns / sizeof *columns };

const char *default_fields(enum query query, int binary)
{
    static const char *const defaults[ALL_QUERIES] = {
        [QUERY_PAIRS] = "relation,n,t0,t1",
        [QUERY_NEAREST] = "shape,t,part",
        [QUERY_ANY] = "any",
        [QUERY_COUNT] = "count",
        [QUERY_ALL] = "record,shape,t0,t1",
        [QUERY_FIRST] = "shape,t,part",
        [QUERY_PIECES] = "record,t0,t1,shape,depth",
        [QUERY_INSIDE] = "count",
        [QUERY_POINT] = "distance,part",
        [QUERY_POINT_NEAREST] = "shape,distance,part,label",
        [QUERY_POINT_ANY] = "any",
        [QUERY_POINT_COUNT] = "count",
        [QUERY_POINT_ALL] = "record,shape,distance",
        [QUERY_POINT_FIRST] = "",
        [QUERY_POINT_PIECES] = "",
        [QUERY_POINT_INSIDE] = "count",
    };
    return binary && query == QUERY_POINT_NEAREST ? "shape,distance,part"
                                                  : defaults[query];
}

static unsigned want_of(enum value value)
{
    switch (value) {
    case VALUE_T:
    case VALUE_CHORD:
        return CYLINT_WANT_T;
    case VALUE_PART:
    case VALUE_FEATURE:
    case VALUE_SIDE:
        return CYLINT_WANT_PART;
    case VALUE_X:
    case VALUE_Y:
    case VALUE_Z:
        return CYLINT_WANT_POINT;
    case VALUE_NX:
    case VALUE_NY:
    case VALUE_NZ:
        return CYLINT_WANT_NORMAL;
    case VALUE_H:
        return CYLINT_WANT_Z;
    case VALUE_PHI:
        return CYLINT_WANT_PHI;
    default:
        return CYLINT_WANT_COUNT;
    }
}

static const struct column *find_column(const char *name, size_t length,
                                        enum query query)
{
    for (int i = 0; i < COLUMNS; i++)
        if ((columns[i].queries >> query & 1) &&
            strlen(columns[i].name) == length &&
            memcmp(columns[i].name, name, length) == 0)
            return &columns[i];
    return NULL;
}

const char *similar_field(const char *name, size_t length, enum query query)
{
    struct similar similar = similar_to(name, length);
    for (int i = 0; i < COLUMNS; i++)
        if (columns[i].queries >> query & 1)
            similar_try(&similar, columns[i].name);
    return similar.word;
}

/* Whether a column needs both hits or their number. */
static int needs_both_hits(const struct fields *fields)
{
    for (int i = 0; i < fields->count; i++) {
        const struct column *c = fields->column[i];
        if (c->hit || c->value == VALUE_N || c->value == VALUE_CHORD)
            return 1;
    }
    return 0;
}

int fields_need_sides(const struct fields *fields)
{
    for (int i = 0; i < fields->count; i++)
        if (fields->column[i]->value == VALUE_SIDE)
            return 1;
    return 0;
}

static int is_of_solids(enum value value, enum query query)
{
    return value == VALUE_DEPTH ||
           (query == QUERY_POINT_INSIDE &&
            (value == VALUE_SHAPE || value == VALUE_LABEL));
}

const char *find_fields(struct fields *fields, const char *names,
                        enum query query, size_t *length)
{
    fields->count = fields->labels = fields->relation = 0;
    fields->counts = fields->solids = 0;
    fields->want = 0;
    for (;;) {
        *length = strcspn(names, ",");
        const struct column *c = find_column(names, *length, query);
        if (!c || fields->count == MOST_FIELDS)
            return names;
        fields->column[fields->count++] = c;
        fields->want |= want_of(c->value);
        fields->labels += c->value == VALUE_LABEL;
        fields->relation |= c->value == VALUE_RELATION;
        fields->counts |= c->value == VALUE_COUNT;
        fields->solids |= is_of_solids(c->value, query);
        if (names[*length] == '\0')
            break;
        names += *length + 1;
    }
    if (query < QUERIES && !needs_both_hits(fields))
        fields->want |= CYLINT_WANT_NEAREST;
    return NULL;
}

/* ------------------------------------------------------------- values -- */

static inline double value_of_hit(enum value value, const cylint_hit *hit)
{
    switch (value) {
    case VALUE_T:
        return hit->t;
    case VALUE_PART:
        return hit->part;
    case VALUE_SIDE:
        return hit->side;
    case VALUE_X:
    case VALUE_Y:
    case VALUE_Z:
        return hit->point[value - VALUE_X];
    case VALUE_NX:
    case VALUE_NY:
    case VALUE_NZ:
        return hit->normal[value - VALUE_NX];
    case VALUE_H:
        return hit->z;
    default:
        return hit->phi;
    }
}

static inline double value_of_closest(enum value value,
                                      const cylint_closest *closest)
{
    switch (value) {
    case VALUE_DISTANCE:
        return closest->distance;
    case VALUE_PART:
        return closest->part;
    case VALUE_FEATURE:
        return closest->feature;
    case VALUE_X:
    case VALUE_Y:
    case VALUE_Z:
        return closest->point[value - VALUE_X];
    default:
        return closest->normal[value - VALUE_NX];
    }
}

static inline int is_missing(const struct column *c, const struct row *row)
{
    switch (c->value) {
    case VALUE_RECORD:
    case VALUE_COUNT:
    case VALUE_SHAPE:
    case VALUE_DEPTH:
    case VALUE_LENGTH:
        return 0;
    case VALUE_LABEL:
        return row->label_length == 0;
    case VALUE_RELATION:
    case VALUE_N:
        return row->answer == NULL;
    case VALUE_CHORD:
        return row->answer == NULL || row->answer->n < 2;
    default:
        return row->piece     ? 0
               : row->closest ? row->closest->part < 0
                              : row->answer == NULL || row->answer->n <= c->hit;
    }
}

static inline double value_of_piece(const struct column *c,
                                    const struct row *row)
{
    const cylint_piece *p = row->piece;
    return c->value == VALUE_LENGTH ? (p->t1 - p->t0) * row->unit
           : c->hit                 ? p->t1
                                    : p->t0;
}

/* The value of a column that is not missing and not a label. */
static inline double value_of(const struct column *c, const struct row *row)
{
    const cylint_answer *a = row->answer;
    switch (c->value) {
    case VALUE_RECORD:
        return (double)row->record;
    case VALUE_SHAPE:
        return (double)row->shape;
    case VALUE_COUNT:
        return (double)row->count;
    case VALUE_DEPTH:
        return (double)row->depth;
    case VALUE_RELATION:
        return a->relation;
    case VALUE_N:
        return a->n;
    case VALUE_CHORD:
        return a->hit[1].t - a->hit[0].t;
    default:
        return row->piece     ? value_of_piece(c, row)
               : row->closest ? value_of_closest(c->value, row->closest)
                              : value_of_hit(c->value, &a->hit[c->hit]);
    }
}

/* The words for a value, or NULL if it is a number. */
static const char *const *words_of(enum value value)
{
    static const char *const relations[] = {[CYLINT_RELATION_MISS] = "miss",
                                            [CYLINT_RELATION_TOUCH] = "touch",
                                            [CYLINT_RELATION_ALONG] = "along",
                                            [CYLINT_RELATION_CROSS] = "cross"};
    static const char *const parts[] = {[CYLINT_PART_LATERAL] = "lateral",
                                        [CYLINT_PART_CAP0] = "cap0",
                                        [CYLINT_PART_CAP1] = "cap1"};
    static const char *const features[] = {
        [CYLINT_FEATURE_LATERAL] = "lateral", [CYLINT_FEATURE_CAP0] = "cap0",
        [CYLINT_FEATURE_CAP1] = "cap1",       [CYLINT_FEATURE_RIM0] = "rim0",
        [CYLINT_FEATURE_RIM1] = "rim1",       [CYLINT_FEATURE_APEX] = "apex"};
    static const char *const sides[] = {[CYLINT_SIDE_ENTERING] = "entering",
                                        [CYLINT_SIDE_LEAVING] = "leaving",
                                        [CYLINT_SIDE_BOTH] = "both"};
    return value == VALUE_RELATION  ? relations
           : value == VALUE_PART    ? parts
           : value == VALUE_FEATURE ? features
           : value == VALUE_SIDE    ? sides
                                    : NULL;
}

static int is_whole(enum value value)
{
    return value == VALUE_N || value == VALUE_RECORD || value == VALUE_SHAPE ||
           value == VALUE_COUNT || value == VALUE_DEPTH;
}

/* --------------------------------------------------------------- rows -- */

static void put_missing(struct text *out, const struct style *style,
                        const struct column *c)
{
    const int is_word = words_of(c->value) || c->value == VALUE_LABEL;
    put_string(out, style->missing ? style->missing : is_word ? "-" : "nan");
}

static void put_value(struct text *out, const struct style *style,
                      const struct column *c, const struct row *row)
{
    const double value = value_of(c, row);
    const char *const *words = words_of(c->value);
    if (words) {
        put_string(out, words[(int)value]);
    } else if (is_whole(c->value)) {
        put_whole(out, (unsigned long long)value);
    } else {
        out->length +=
            cylint_write_number(out->data + out->length, value, style->digits);
    }
}

static void put_field(struct text *out, const struct style *style,
                      const struct column *c, const struct row *row)
{
    if (is_missing(c, row))
        put_missing(out, style, c);
    else if (c->value == VALUE_LABEL)
        put_bytes(out, row->label, row->label_length);
    else
        put_value(out, style, c, row);
}

static void put_doubles(struct text *out, const struct fields *fields,
                        const struct row *row)
{
    struct text t = *out;
    for (int i = 0; i < fields->count; i++) {
        const struct column *c = fields->column[i];
        put_little_endian(&t, is_missing(c, row) ? NAN : value_of(c, row));
    }
    out->length = t.length;
}

void put_row(struct text *out, const struct fields *fields,
             const struct style *style, const struct row *row)
{
    if (style->binary) {
        put_doubles(out, fields, row);
        return;
    }
    for (int i = 0; i < fields->count; i++) {
        if (i > 0)
            put_char(out, style->separator);
        put_field(out, style, fields->column[i], row);
    }
    if (row->tail_length > 0) {
        put_char(out, style->separator);
        put_bytes(out, row->tail, row->tail_length);
    }
    put_char(out, '\n');
}

void put_error(struct text *out, const struct fields *fields,
               const struct style *style)
{
    if (!style->binary)
        put_string(out, "error");
    for (int i = 0; i < fields->count; i++) {
        if (style->binary) {
            put_little_endian(out, NAN);
        } else if (i > 0) {
            put_char(out, style->separator);
            put_missing(out, style, fields->column[i]);
        }
    }
    if (!style->binary)
        put_char(out, '\n');
}

void put_header(struct text *out, const struct fields *fields,
                const struct style *style)
{
    for (int i = 0; i < fields->count; i++) {
        if (i > 0)
            put_char(out, style->separator);
        put_string(out, fields->column[i]->name);
    }
    put_char(out, '\n');
}

/* Names and words are shorter than numbers; "error" fits into one field. */
size_t row_capacity(const struct fields *fields, const struct style *style,
                    size_t longest_label)
{
    const size_t missing = style->missing ? strlen(style->missing) : 0;
    const size_t widest = missing > NUMBER_CAPACITY ? missing : NUMBER_CAPACITY;
    return (size_t)(fields->count + 1) * (widest + 1) +
           (size_t)fields->labels * longest_label;
}

void list_columns(void (*print)(const char *name, const char *queries,
                                const char *about))
{
    for (int i = 0; i < COLUMNS; i++) {
        struct text where;
        char buffer[160];
        where.data = buffer;
        where.length = 0;
        for (int q = 0; q < ALL_QUERIES; q++) {
            if (columns[i].queries >> q & 1) {
                put_string(&where, where.length > 0 ? "," : "");
                put_string(&where, q < QUERIES
                                       ? query_words[q]
                                       : point_query_words[q - QUERIES]);
            }
        }
        put_char(&where, '\0');
        print(columns[i].name, buffer, columns[i].about);
    }
}
