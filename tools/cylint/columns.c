/*
 * columns.c - the columns of an answer, and how they are written
 *
 * A new column needs a line in the table.
 */
#include <math.h>
#include <stdio.h>

#include "columns.h"
#include "numbers.h"

enum type {
    TYPE_REAL,   /* a double */
    TYPE_WHOLE,  /* a double that is a whole number */
    TYPE_WORD,   /* an int: a word, or a whole number */
    TYPE_LENGTH, /* t1 - t0, times the row's unit */
    TYPE_LABEL,
    TYPE_SUM /* of the group with the number of the column */
};

/* The column has a value if the row's answer has at least so many hits;
 * HITS_ANSWER: if there is an answer; HITS_ANY: always. */
enum hits { HITS_ANY = -1, HITS_ANSWER, HITS_ONE, HITS_TWO };

struct column {
    const char *name;
    unsigned queries; /* a bit for each query; of points, from QUERIES on */
    enum type type;
    size_t place; /* of the member in a row */
    const char *const *words;
    enum hits hits;
    unsigned want;
    const char *about;
};

const struct query_kind query_kinds[] = {
    {"pairs", "relation,n,t0,t1", "distance,part", 0, 0, 0},
    {"nearest", "shape,t,part", "shape,distance,part,label", 0, 0, 0},
    {"any", "any", "any", 0, 0, 0},
    {"count", "count", "count", 0, 0, 0},
    {"all", "record,shape,t0,t1", "record,shape,distance", 0, 0, 0},
    {"first", "shape,t,part", "", 0, "the query first is for lines",
     "the query first leaves out no shapes"},
    {"pieces", "record,t0,t1,shape,depth", "", 0,
     "the query pieces is for lines", "the query pieces leaves out no shapes"},
    {"inside", "count", "count", "the query inside is for points", 0, 0},
    {0}};

static const char *const relations[] = {[CYLINT_RELATION_MISS] = "miss",
                                        [CYLINT_RELATION_TOUCH] = "touch",
                                        [CYLINT_RELATION_ALONG] = "along",
                                        [CYLINT_RELATION_CROSS] = "cross"};
/* A part has the number of the feature with its name. */
static const char *const features[] = {
    [CYLINT_FEATURE_LATERAL] = "lateral", [CYLINT_FEATURE_CAP0] = "cap0",
    [CYLINT_FEATURE_CAP1] = "cap1",       [CYLINT_FEATURE_RIM0] = "rim0",
    [CYLINT_FEATURE_RIM1] = "rim1",       [CYLINT_FEATURE_APEX] = "apex"};
static const char *const sides[] = {[CYLINT_SIDE_ENTERING] = "entering",
                                    [CYLINT_SIDE_LEAVING] = "leaving",
                                    [CYLINT_SIDE_BOTH] = "both"};

#define OF_POINTS(queries) ((queries) << QUERIES)

enum {
    PAIRS = 1 << QUERY_PAIRS,
    NEAREST = 1 << QUERY_NEAREST,
    ANY = 1 << QUERY_ANY,
    COUNT = 1 << QUERY_COUNT,
    ALL = 1 << QUERY_ALL,
    FIRST = 1 << QUERY_FIRST,
    PIECES = 1 << QUERY_PIECES,
    INSIDE = 1 << QUERY_INSIDE,
    POINTS = OF_POINTS(PAIRS | NEAREST | ALL),
    OF_SHAPES =
        NEAREST | ALL | FIRST | PIECES | OF_POINTS(NEAREST | ALL | INSIDE),
    EVERY = PAIRS | NEAREST | ANY | COUNT | ALL | FIRST | PIECES |
            OF_POINTS(PAIRS | NEAREST | ANY | COUNT | ALL | INSIDE)
};

#define AT(member) offsetof(struct row, member)

/* Columns of the first hit, of the second, and of the only one. */
#define HITS(name, points, type, member, words, want, about)              \
    {name "0", PAIRS | ALL, type, AT(answer.hit[0].member),               \
     words,    HITS_ONE,    want, about ", first hit"},                   \
        {name "1", PAIRS | ALL, type, AT(answer.hit[1].member),           \
         words,    HITS_TWO,    want, about ", second hit"},              \
    {                                                                     \
        name, NEAREST | FIRST | (points), type, AT(answer.hit[0].member), \
            words, HITS_ONE, want, about                                  \
    }

static const struct column columns[] = {
    {"relation", PAIRS | NEAREST | ALL, TYPE_WORD, AT(answer.relation),
     relations, HITS_ANSWER, 0,
     "miss, touch, along or cross: the whole line and the closed solid"},
    {"n", PAIRS | ALL, TYPE_WORD, AT(answer.n), NULL, HITS_ANSWER, 0,
     "number of hits"},
    {"t0", PAIRS | ALL | PIECES, TYPE_REAL, AT(answer.hit[0].t), NULL, HITS_ONE,
     CYLINT_WANT_T, "where on the line, first hit or start of the piece"},
    {"t1", PAIRS | ALL | PIECES, TYPE_REAL, AT(answer.hit[1].t), NULL, HITS_TWO,
     CYLINT_WANT_T, "where on the line, second hit or end of the piece"},
    {"t", NEAREST | FIRST, TYPE_REAL, AT(answer.hit[0].t), NULL, HITS_ONE,
     CYLINT_WANT_T, "where on the line"},
    {"distance", POINTS, TYPE_REAL, AT(distance), NULL, HITS_ONE, 0,
     "of a point from the surface, negative inside the solid"},
    HITS("part", POINTS, TYPE_WORD, part, features, CYLINT_WANT_PART,
         "lateral, cap0 or cap1"),
    {"feature", POINTS, TYPE_WORD, AT(feature), features, HITS_ONE,
     CYLINT_WANT_PART,
     "lateral, cap0, cap1, rim0, rim1 or apex: what is nearest"},
    HITS("side", 0, TYPE_WORD, side, sides, CYLINT_WANT_PART,
         "entering, leaving or both"),
    HITS("x", POINTS, TYPE_REAL, point[0], NULL, CYLINT_WANT_POINT,
         "x of the point"),
    HITS("y", POINTS, TYPE_REAL, point[1], NULL, CYLINT_WANT_POINT,
         "y of the point"),
    HITS("z", POINTS, TYPE_REAL, point[2], NULL, CYLINT_WANT_POINT,
         "z of the point"),
    HITS("nx", POINTS, TYPE_REAL, normal[0], NULL, CYLINT_WANT_NORMAL,
         "x of the outward unit normal"),
    HITS("ny", POINTS, TYPE_REAL, normal[1], NULL, CYLINT_WANT_NORMAL,
         "y of the outward unit normal"),
    HITS("nz", POINTS, TYPE_REAL, normal[2], NULL, CYLINT_WANT_NORMAL,
         "z of the outward unit normal"),
    HITS("h", 0, TYPE_REAL, z, NULL, CYLINT_WANT_Z,
         "axial coordinate, 0 at the base, 1 at the top"),
    HITS("phi", 0, TYPE_REAL, phi, NULL, CYLINT_WANT_PHI,
         "angle about the axis over 2 pi, in [0,1)"),
    {"chord", PAIRS | ALL, TYPE_LENGTH, 0, NULL, HITS_TWO, CYLINT_WANT_T,
     "t1 - t0"},
    {"shape", OF_SHAPES, TYPE_WHOLE, AT(shape), NULL, HITS_ANY, 0,
     "number of the shape in the scene, from 1; 0 for none"},
    {"label", OF_SHAPES, TYPE_LABEL, AT(label), NULL, HITS_ANY, 0,
     "the tail of the shape's line in the scene"},
    {"depth", PIECES | OF_POINTS(INSIDE), TYPE_WHOLE, AT(depth), NULL, HITS_ANY,
     0, "number of solids that contain the piece or the point"},
    {"length", PIECES, TYPE_LENGTH, 0, NULL, HITS_ANY, 0,
     "t1 - t0, times the length of the direction"},
    {"any", ANY | OF_POINTS(ANY), TYPE_WHOLE, AT(count), NULL, HITS_ANY, 0,
     "1 if a shape is hit or within the radius, else 0"},
    {"count", COUNT | OF_POINTS(COUNT | INSIDE), TYPE_WHOLE, AT(count), NULL,
     HITS_ANY, 0,
     "number of shapes that are hit, are within the radius or hold the point"},
    {"id", EVERY, TYPE_WHOLE, AT(record), NULL, HITS_ANY, 0,
     "number of the record, from 1"},
    {"record", ALL | PIECES | OF_POINTS(ALL), TYPE_WHOLE, AT(record), NULL,
     HITS_ANY, 0, "the same as id"},
    {0}};

/* -------------------------------------------------------------- choosing -- */

static int has_query(const struct column *c, int query)
{
    return c->queries >> query & 1;
}

const char *similar_field(struct string name, int query)
{
    const char *best = NULL;
    for (const struct column *c = columns; c->name; c++)
        if (has_query(c, query))
            best = nearer_word(name, best, c->name);
    return best;
}

static void add_field(struct fields *fields, const struct column *c, int query)
{
    fields->column[fields->count++] = c;
    fields->want |= c->want;
    fields->label_count += c->type == TYPE_LABEL;
    fields->has_count |= c->place == AT(count);
    fields->has_solids |= query == QUERY_INSIDE + QUERIES &&
                          c->place != AT(count) && c->place != AT(record);
    if (c->hits == HITS_TWO || (c->words == NULL && c->type == TYPE_WORD))
        fields->want &= ~(unsigned)CYLINT_WANT_NEAREST;
}

/* Lines need only the nearest hit, unless a column is about both. */
const char *find_fields(struct fields *fields, const char *names, int query)
{
    memset(fields, 0, sizeof *fields);
    fields->want = query < QUERIES ? CYLINT_WANT_NEAREST : 0;
    for (;; names++) {
        const char *const end = names + strcspn(names, ",");
        const int i = find_word(WORDS(columns), between(names, end));
        if (i == NOT_GIVEN || !has_query(&columns[i], query) ||
            fields->count == MOST_FIELDS)
            return names;
        add_field(fields, &columns[i], query);
        names = end;
        if (*names == '\0')
            return NULL;
    }
}

void sum_fields(struct fields *fields, const struct groups *groups)
{
    fields->sums = groups;
    fields->count = groups->columns;
}

void list_columns(void)
{
    for (const struct column *c = columns; c->name; c++) {
        const char *before = "\t";
        printf("%s", c->name);
        for (int q = 0; q < 2 * QUERIES; q++)
            if (has_query(c, q)) {
                printf("%s%s%s", before, q < QUERIES ? "" : "point-",
                       query_kinds[q % QUERIES].word);
                before = ",";
            }
        printf("\t%s\n", c->about);
    }
}

/* ------------------------------------------------------------------ rows -- */

static double member_of(const struct column *c, const struct row *row)
{
    const char *at = (const char *)row + c->place;
    double value;
    int word;
    if (c->type == TYPE_WORD) {
        memcpy(&word, at, sizeof word);
        return word;
    }
    memcpy(&value, at, sizeof value);
    return value;
}

/* The value of column number i that is not missing and not a label. */
static double value_of(const struct column *c, size_t i, const struct row *row)
{
    const cylint_hit *hit = row->answer.hit;
    return c->type == TYPE_LENGTH ? (hit[1].t - hit[0].t) * row->unit
           : c->type == TYPE_SUM  ? row->sums[i]
                                  : member_of(c, row);
}

static const struct column *column_at(const struct fields *fields, size_t i)
{
    static const struct column sum = {
        .name = "total", .type = TYPE_SUM, .hits = HITS_ANY};
    return fields->sums ? &sum : fields->column[i];
}

static int is_missing(const struct column *c, const struct row *row)
{
    return !row || row->answer.n < (int)c->hits ||
           (c->type == TYPE_LABEL && row->label.length == 0);
}

static void put_missing(struct text *out, const struct style *style,
                        int is_word)
{
    put_word(out, style->missing ? style->missing : is_word ? "-" : "nan");
}

static void put_field(struct text *out, const struct style *style,
                      const struct column *c, size_t i, const struct row *row)
{
    if (is_missing(c, row))
        put_missing(out, style, c->words || c->type == TYPE_LABEL);
    else if (c->type == TYPE_LABEL)
        put_string(out, row->label);
    else if (c->words)
        put_word(out, c->words[(int)value_of(c, i, row)]);
    else if (c->type == TYPE_WHOLE || c->type == TYPE_WORD)
        put_whole(out, (unsigned long long)value_of(c, i, row));
    else
        out->length += cylint_write_number(out->data + out->length,
                                           value_of(c, i, row), style->digits);
}

static void put_separator(struct text *out, const struct style *style, size_t i)
{
    if (i > 0 && !style->is_binary)
        put_char(out, style->separator);
}

/* row: NULL: without a tail. */
static void end_row(struct text *out, const struct style *style,
                    const struct row *row)
{
    if (style->is_binary)
        return;
    if (row && row->tail.length > 0) {
        put_char(out, style->separator);
        put_string(out, row->tail);
    }
    put_char(out, '\n');
}

void put_row(struct text *out, const struct fields *fields,
             const struct style *style, const struct row *row)
{
    for (size_t i = 0; i < fields->count; i++) {
        const struct column *c = column_at(fields, i);
        put_separator(out, style, i);
        if (style->is_binary)
            put_little_endian(out,
                              is_missing(c, row) ? NAN : value_of(c, i, row));
        else if (!row && i == 0)
            put_word(out, "error");
        else
            put_field(out, style, c, i, row);
    }
    end_row(out, style, row);
}

/* That of a sum is the label of its group; it can be empty. */
static struct string name_of(const struct fields *fields, size_t i)
{
    const struct groups *g = fields->sums;
    if (!g || g->is_total)
        return string_of(column_at(fields, i)->name);
    return i < g->names.texts.count ? names_get(&g->names, i) : string_of("");
}

void put_header(struct text *out, const struct fields *fields,
                const struct style *style)
{
    for (size_t i = 0; i < fields->count; i++) {
        const struct string name = name_of(fields, i);
        put_separator(out, style, i);
        if (name.length > 0)
            put_string(out, name);
        else
            put_missing(out, style, 1);
    }
    end_row(out, style, NULL);
}

/* Names and words are shorter than numbers; "error" fits into one field. */
size_t row_capacity(const struct fields *fields, const struct style *style,
                    size_t longest_label)
{
    const size_t missing = style->missing ? strlen(style->missing) : 0;
    const size_t widest = missing > NUMBER_CAPACITY ? missing : NUMBER_CAPACITY;
    return (fields->count + 1) * (widest + 1) +
           (size_t)fields->label_count * longest_label +
           (fields->sums ? fields->sums->names.texts.length : 0);
}
