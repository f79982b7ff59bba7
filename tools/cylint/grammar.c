/*
 * grammar.c - reads a line or point and a shape from a record of text or doubles
 *
 * Texts are pointers to their begin and end, not C strings: a NUL is a bad byte.
 * Fields are separated by blanks, tabs, and at most one comma.
 */
#include <stdio.h>
#include <string.h>

#include "grammar.h"
#include "numbers.h"
#include "similar.h"

const struct kind line_kinds[LINE_KINDS] = {
    [LINE_WHOLE] = {"line", 6, "ox oy oz  dx dy dz"},
    [LINE_RAY] = {"ray", 6, "ox oy oz  dx dy dz"},
    [LINE_SEGMENT] = {"segment", 6, "ax ay az  bx by bz"},
    [LINE_SPAN] = {"span", 8, "ox oy oz  dx dy dz  tmin tmax"},
    [LINE_POINT] = {"point", 3, "x y z"},
};

const struct kind shape_kinds[SHAPE_KINDS] = {
    [SHAPE_CYLINDER] = {"cylinder", 7, "p0x p0y p0z  p1x p1y p1z  r"},
    [SHAPE_CONE] = {"cone", 8, "p0x p0y p0z  r0  p1x p1y p1z  r1"},
    [SHAPE_ECYLINDER] = {"ecylinder", 12,
                         "cx cy cz  ax ay az  bx by bz  hx hy hz"},
    [SHAPE_ECONE] = {"econe", 13, "cx cy cz  ax ay az  bx by bz  hx hy hz  k"},
    [SHAPE_ACONE] = {"acone", 7, "vx vy vz  ux uy uz  degrees"},
    [SHAPE_SPHERE] = {"sphere", 4, "cx cy cz  r"},
    [SHAPE_CAPSULE] = {"capsule", 7, "p0x p0y p0z  p1x p1y p1z  r"},
    [SHAPE_RCONE] = {"rcone", 8, "p0x p0y p0z  r0  p1x p1y p1z  r1"},
    [SHAPE_HALFSPACE] = {"halfspace", 6, "px py pz  nx ny nz"},
};

const char *const ends_words[] = {[CYLINT_ENDS_CAPPED] = "capped",
                                  [CYLINT_ENDS_OPEN] = "open",
                                  [CYLINT_ENDS_CAP0] = "cap0",
                                  [CYLINT_ENDS_CAP1] = "cap1",
                                  [CYLINT_ENDS_INFINITE] = "infinite",
                                  [CYLINT_ENDS_NAPPE] = "nappe",
                                  NULL};

#define SHAPE_WORDS                                                       \
    "cylinder, cone, ecylinder, econe, acone, sphere, capsule, rcone or " \
    "halfspace"
#define LINE_WORDS "line, ray, segment, span or point"
#define ENDS_WORD "ends="
#define ENDS_WORDS "capped, open, cap0, cap1, infinite or nappe"

static int is_word(const char *word, const char *text, size_t length)
{
    return strlen(word) == length && memcmp(word, text, length) == 0;
}

int find_word(const char *const *words, const char *text, size_t length)
{
    for (int i = 0; words[i]; i++) {
        if (is_word(words[i], text, length)) {
            return i;
        }
    }
    return NOT_GIVEN;
}

int find_kind(const struct kind *kinds, int count, const char *text,
              size_t length)
{
    for (int i = 0; i < count; i++) {
        if (is_word(kinds[i].word, text, length)) {
            return i;
        }
    }
    return NOT_GIVEN;
}

static const char *article(const char *word)
{
    return strchr("aeiou", word[0]) ? "an" : "a";
}

void describe_bare(struct grammar *g)
{
    const char *line = line_kinds[g->line].word;
    if (g->has_shape) {
        const char *shape = shape_kinds[g->shape].word;
        snprintf(g->bare, sizeof g->bare, "%s %s and %s %s have %d",
                 article(line), line, article(shape), shape,
                 numbers_of_record(g));
    } else {
        snprintf(g->bare, sizeof g->bare, "%s %s has %d", article(line), line,
                 numbers_of_record(g));
    }
}

int numbers_of_record(const struct grammar *g)
{
    return (g->has_line ? line_kinds[g->line].numbers : 0) +
           (g->has_shape ? shape_kinds[g->shape].numbers : 0);
}

/* ---------------------------------------------------- doubles to shapes -- */

static cylint_status make_point(const double *v, double point[3])
{
    for (int i = 0; i < 3; i++) {
        if (v[i] - v[i] != 0) {
            return CYLINT_ENONFINITE;
        }
        point[i] = v[i];
    }
    return CYLINT_OK;
}

static cylint_status make_line(const struct grammar *g, int kind,
                               const double *v, const struct parts *parts)
{
    cylint_line *line = parts->line;
    *parts->is_point = kind == LINE_POINT;
    if (kind == LINE_POINT) {
        return make_point(v, parts->point);
    }
    if (kind == LINE_SEGMENT) {
        return cylint_segment(line, v, v + 3);
    }
    if (kind == LINE_SPAN) {
        return cylint_span(line, v, v + 3, v[6], v[7]);
    }
    if (g->has_domain) {
        return cylint_span(line, v, v + 3, g->tmin, g->tmax);
    }
    return kind == LINE_RAY ? cylint_ray(line, v, v + 3)
                            : cylint_whole_line(line, v, v + 3);
}

/* It has no ends: `capped`, the usual word, and `infinite` change nothing. */
static cylint_status make_halfspace(const double *v, cylint_ends ends,
                                    cylint_shape *shape)
{
    if (ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_INFINITE) {
        return cylint_halfspace(shape, v, v + 3);
    }
    memset(shape, 0, sizeof *shape);
    return CYLINT_EENDS;
}

cylint_status shape_of_numbers(int kind, int ends, const double *v,
                               cylint_shape *shape)
{
    const cylint_ends e = ends != NOT_GIVEN     ? (cylint_ends)ends
                          : kind == SHAPE_ACONE ? CYLINT_ENDS_INFINITE
                                                : CYLINT_ENDS_CAPPED;
    switch (kind) {
    case SHAPE_CYLINDER:
        return cylint_cylinder(shape, v, v + 3, v[6], e);
    case SHAPE_CONE:
        return cylint_cone(shape, v, v[3], v + 4, v[7], e);
    case SHAPE_ECYLINDER:
        return cylint_elliptic_cylinder(shape, v, v + 3, v + 6, v + 9, e);
    case SHAPE_ECONE:
        return cylint_elliptic_cone(shape, v, v + 3, v + 6, v + 9, v[12], e);
    case SHAPE_SPHERE:
        return cylint_sphere(shape, v, v[3], e);
    case SHAPE_CAPSULE:
        return cylint_capsule(shape, v, v + 3, v[6], e);
    case SHAPE_RCONE:
        return cylint_round_cone(shape, v, v[3], v + 4, v[7], e);
    case SHAPE_HALFSPACE:
        return make_halfspace(v, e, shape);
    default:
        return cylint_angle_cone(shape, v, v + 3, v[6], e);
    }
}

/* ------------------------------------------------------------ text fields */

/* The position in the text, and the fault. */
struct reader {
    const char *p, *end;
    struct fault *fault;
    int has_word; /* ends=WORD, not=NAME, in=NAME or out=NAME was read */
};

static void skip_to(struct reader *r, const char *p)
{
    r->p = skip_separator(p, r->end);
}

static const char *end_of_field(const struct reader *r)
{
    return field_end(r->p, r->end);
}

/* An empty field is a comma too many: the message shows the comma. */
static int refuse(struct reader *r, const char *what, int expected)
{
    const char *after = end_of_field(r);
    if (after == r->p && after < r->end) {
        after++;
    }
    *r->fault = (struct fault){
        .what = what, .expected = expected, .at = r->p, .end = after};
    return 0;
}

/* Returns the end of the number at p if it is a whole field, else NULL. */
static const char *end_of_number(const char *p, const char *end, double *value)
{
    const char *after = cylint_read_number(p, end, value);
    return after && (after == end || is_blank(*after) || *after == ',') ? after
                                                                        : NULL;
}

/* Counts the successive numbers at p. */
static int count_numbers(const char *p, const char *end)
{
    double value;
    int count = 0;
    for (const char *after; p < end && (after = end_of_number(p, end, &value));
         p = skip_separator(after, end)) {
        count++;
    }
    return count;
}

static int read_numbers(struct reader *r, double *v, int count)
{
    const char *const end = r->end;
    for (int i = 0; i < count; i++) {
        const char *after = end_of_number(r->p, end, &v[i]);
        if (!after) {
            return refuse(r, "a number", 1);
        }
        if (v[i] - v[i] != 0) {
            return refuse(r, "number too large", 0);
        }
        r->p = skip_separator(after, end);
    }
    return 1;
}

static int read_kind(struct reader *r, const struct kind *kinds, int count)
{
    const char *after = end_of_field(r);
    const int kind = find_kind(kinds, count, r->p, (size_t)(after - r->p));
    if (kind != NOT_GIVEN) {
        skip_to(r, after);
    }
    return kind;
}

/* The word of a kind that is nearest to the text, or NULL. */
static const char *similar_kind(const struct reader *r,
                                const struct kind *kinds, int count)
{
    const char *after = end_of_field(r);
    struct similar similar = similar_to(r->p, (size_t)(after - r->p));
    for (int i = 0; i < count; i++) {
        similar_try(&similar, kinds[i].word);
    }
    return similar.word;
}

static int is_kind(const struct reader *r, const struct kind *kinds, int count)
{
    struct reader copy = *r;
    return read_kind(&copy, kinds, count) != NOT_GIVEN;
}

static int refuse_line_kind(struct reader *r, const struct grammar *g)
{
    refuse(r, LINE_WORDS, 1);
    if (count_numbers(r->p, r->end) > 0) {
        r->fault->remedy = g->has_shape ? "for bare numbers use -k ray,cylinder"
                                        : "for bare numbers use -k ray";
    } else if (is_kind(r, shape_kinds, SHAPE_KINDS)) {
        r->fault->remedy = "for a scene use -s";
    } else {
        r->fault->meant = similar_kind(r, line_kinds, LINE_KINDS);
    }
    return 0;
}

static int refuse_shape_kind(struct reader *r, const struct grammar *g)
{
    refuse(r, SHAPE_WORDS, 1);
    if (!g->has_line && is_kind(r, line_kinds, LINE_KINDS)) {
        r->fault->remedy = "a scene has shapes only; for records leave out -s";
    } else if (g->convert) {
        r->fault->remedy = g->convert;
    } else {
        r->fault->meant = similar_kind(r, shape_kinds, SHAPE_KINDS);
    }
    return 0;
}

/* The number of the first negative radius of a shape, or of its first radius. */
static int wrong_radius(int kind, const double *v)
{
    switch (kind) {
    case SHAPE_SPHERE:
        return 3;
    case SHAPE_CONE:
    case SHAPE_RCONE:
        return v[3] >= 0 && v[7] < 0 ? 7 : 3;
    case SHAPE_ECONE:
        return 12;
    default:
        return 6;
    }
}

/* The library refused the line or shape that begins at `at`.  The message
 * shows its number `wrong`, counted from 0; NOT_GIVEN: its first word. */
static int refuse_status(struct reader *r, const char *at, int has_word,
                         int status, int wrong)
{
    r->p = at;
    for (int i = wrong == NOT_GIVEN ? 0 : wrong + has_word; i > 0; i--) {
        skip_to(r, end_of_field(r));
    }
    refuse(r, cylint_strerror(status), 0);
    if (wrong == NOT_GIVEN) {
        r->fault->end = at;
    }
    return 0;
}

static void remark_domain(const struct grammar *g, int kind, const char *at,
                          struct remarks *remarks)
{
    if (g->has_domain && kind >= LINE_SEGMENT && remarks &&
        remarks->wanted & 1u << REMARK_DOMAIN) {
        remarks->found |= 1u << REMARK_DOMAIN;
        remarks->fault[REMARK_DOMAIN] = (struct fault){
            .what = kind == LINE_SEGMENT ? "-t has no effect on a segment"
                    : kind == LINE_SPAN  ? "-t has no effect on a span"
                                         : "-t has no effect on a point",
            .at = at,
            .end = at};
    }
}

static int read_line(struct reader *r, const struct grammar *g,
                     const struct parts *parts)
{
    double v[8];
    const char *at = r->p;
    int kind = g->line;
    if (kind == NOT_GIVEN) {
        kind = read_kind(r, line_kinds, LINE_KINDS);
        if (kind == NOT_GIVEN) {
            return refuse_line_kind(r, g);
        }
    }
    *parts->is_point = kind == LINE_POINT;
    const char *reason = kind == LINE_POINT ? g->no_points : g->no_lines;
    if (reason) {
        r->p = at;
        return refuse(r, reason, 0);
    }
    if (!read_numbers(r, v, line_kinds[kind].numbers)) {
        return 0;
    }
    remark_domain(g, kind, at, parts->remarks);
    const cylint_status status = make_line(g, kind, v, parts);
    return status == CYLINT_OK ||
           refuse_status(r, at, g->line == NOT_GIVEN, (int)status,
                         status == CYLINT_EDOMAIN ? 6 : NOT_GIVEN);
}

static int begins_with(const struct reader *r, const char *word)
{
    const size_t length = strlen(word);
    return (size_t)(r->end - r->p) >= length && memcmp(r->p, word, length) == 0;
}

static int read_ends(struct reader *r, int *ends)
{
    if (!begins_with(r, ENDS_WORD)) {
        return 1;
    }
    r->p += strlen(ENDS_WORD);
    const char *after = end_of_field(r);
    *ends = find_word(ends_words, r->p, (size_t)(after - r->p));
    if (*ends == NOT_GIVEN) {
        refuse(r, ENDS_WORDS, 1);
        r->fault->meant =
            similar_word(ends_words, r->p, (size_t)(after - r->p));
        return 0;
    }
    r->has_word = 1;
    skip_to(r, after);
    return 1;
}

static int read_shape(struct reader *r, const struct grammar *g,
                      cylint_shape *shape)
{
    double v[13];
    const char *at = r->p;
    int kind = g->shape;
    if (kind == NOT_GIVEN) {
        kind = read_kind(r, shape_kinds, SHAPE_KINDS);
        if (kind == NOT_GIVEN) {
            return refuse_shape_kind(r, g);
        }
    }
    int ends = g->ends;
    if (!read_numbers(r, v, shape_kinds[kind].numbers) ||
        !read_ends(r, &ends)) {
        return 0;
    }
    const cylint_status status = shape_of_numbers(kind, ends, v, shape);
    return status == CYLINT_OK ||
           refuse_status(r, at, g->shape == NOT_GIVEN, (int)status,
                         status == CYLINT_ERADIUS  ? wrong_radius(kind, v)
                         : status == CYLINT_EANGLE ? 6
                                                   : NOT_GIVEN);
}

static int begins_with_solid(const struct reader *r)
{
    return begins_with(r, IN_WORD) || begins_with(r, OUT_WORD);
}

/* Finds the end of the words.  solids_read() reads them. */
static int read_solids(struct reader *r, const struct grammar *g,
                       const struct parts *parts)
{
    if (g->has_line) {
        return !begins_with_solid(r) ||
               refuse(r, "in= and out= are for the shapes of a scene, -s FILE",
                      0);
    }
    *parts->solids = r->p;
    while (begins_with_solid(r)) {
        r->has_word = 1;
        skip_to(r, end_of_field(r));
    }
    *parts->solids_length = (size_t)(r->p - *parts->solids);
    return *parts->solids_length == 0 || !begins_with(r, ENDS_WORD) ||
           refuse(r, "ends= must stand before in= and out=", 0);
}

/* Finds the end of the names.  left_out_read() reads them with the scene. */
static int read_left_out(struct reader *r, const struct grammar *g,
                         const struct parts *parts)
{
    if (g->no_left_out && begins_with(r, NOT_WORD)) {
        return refuse(r, g->no_left_out, 0);
    }
    *parts->left_out = r->p;
    while (begins_with(r, NOT_WORD)) {
        r->has_word = 1;
        skip_to(r, end_of_field(r));
    }
    *parts->left_out_length = (size_t)(r->p - *parts->left_out);
    return 1;
}

/* Whether the tail of a record of bare numbers begins with a number.  Writes
 * the fault "N numbers where a ray has 6".  After ends=WORD or not=NAME a tail
 * may begin with a number. */
static int surplus(const struct reader *r, const struct grammar *g,
                   struct fault *fault)
{
    const int more =
        g->bare[0] && !r->has_word ? count_numbers(r->p, r->end) : 0;
    if (more > 0) {
        *fault = (struct fault){.what = g->bare,
                                .at = r->p,
                                .end = r->p,
                                .numbers = numbers_of_record(g) + more};
    }
    return more > 0;
}

/* The tail is copied unchanged.  A NUL is refused, because text tools that read
 * the answers do not accept it. */
static int read_tail(struct reader *r, const struct grammar *g,
                     const struct parts *parts)
{
    const char *end = r->end;
    while (end > r->p && is_blank(end[-1])) {
        end--;
    }
    *parts->tail = r->p;
    *parts->tail_length = (size_t)(end - r->p);
    const char *nul = memchr(r->p, '\0', *parts->tail_length);
    if (nul) {
        *r->fault = (struct fault){
            .what = "unexpected byte", .at = nul, .end = nul + 1};
        return 0;
    }
    if (g->no_tail && end > r->p) {
        return surplus(r, g, r->fault) ? 0
                                       : refuse(r, "the end of the line", 1);
    }
    struct remarks *remarks = parts->remarks;
    if (remarks && remarks->wanted & 1u << REMARK_SURPLUS && end > r->p &&
        surplus(r, g, &remarks->fault[REMARK_SURPLUS])) {
        remarks->found |= 1u << REMARK_SURPLUS;
        remarks->fault[REMARK_SURPLUS].remedy =
            "what follows is copied as the tail";
    }
    return 1;
}

const char *end_of_line(const char *p, const char *end)
{
    const char *feed = memchr(p, '\n', (size_t)(end - p));
    return feed ? feed : end;
}

int is_record(const char *line, const char *end)
{
    if (end - line > LINE_MOST) {
        return 1;
    }
    while (line < end && (is_blank(*line) || *line == '\r')) {
        line++;
    }
    return line < end && *line != '#';
}

int trim_line(const char *text, const char **end, struct fault *fault)
{
    if (*end - text > LINE_MOST) {
        *fault = (struct fault){
            .what = "line longer than 1 MiB", .at = text, .end = text};
        return 0;
    }
    if (*end > text && (*end)[-1] == '\r') {
        --*end;
    }
    return 1;
}

int read_parts(const struct grammar *g, const char *text, const char *end,
               const struct parts *parts, struct fault *fault)
{
    if (!trim_line(text, &end, fault)) {
        return 0;
    }
    struct reader r = {skip_blanks(text, end), end, fault, 0};
    *parts->is_point = g->no_lines != NULL;
    if (parts->remarks) {
        parts->remarks->found = 0;
    }
    return (!g->has_line || read_line(&r, g, parts)) &&
           (g->has_shape
                ? read_shape(&r, g, parts->shape) && read_solids(&r, g, parts)
                : read_left_out(&r, g, parts)) &&
           read_tail(&r, g, parts);
}

int take_parts(const struct grammar *g, const double *numbers,
               const struct parts *parts, struct fault *fault)
{
    cylint_status status = CYLINT_OK;
    *parts->tail_length = 0;
    if (parts->remarks) {
        parts->remarks->found = 0;
    }
    if (g->has_line) {
        remark_domain(g, g->line, NULL, parts->remarks);
        status = make_line(g, g->line, numbers, parts);
        numbers += line_kinds[g->line].numbers;
    }
    if (g->has_shape && status == CYLINT_OK) {
        status = shape_of_numbers(g->shape, g->ends, numbers, parts->shape);
    }
    if (!g->has_shape) {
        *parts->left_out_length = 0;
    } else if (!g->has_line) {
        *parts->solids_length = 0;
    }
    if (status != CYLINT_OK) {
        *fault = (struct fault){.what = cylint_strerror((int)status)};
    }
    return status == CYLINT_OK;
}

struct parts parts_of(struct record *r)
{
    return (struct parts){.is_point = &r->is_point,
                          .line = &r->line,
                          .point = r->point,
                          .shape = &r->shape,
                          .tail = &r->tail,
                          .tail_length = &r->tail_length,
                          .left_out = &r->left_out,
                          .left_out_length = &r->left_out_length,
                          .solids = &r->solids,
                          .solids_length = &r->solids_length};
}

int read_record(const struct grammar *g, const char *text, const char *end,
                struct record *record, struct fault *fault)
{
    const struct parts parts = parts_of(record);
    return read_parts(g, text, end, &parts, fault);
}

int take_record(const struct grammar *g, const double *numbers,
                struct record *record, struct fault *fault)
{
    const struct parts parts = parts_of(record);
    return take_parts(g, numbers, &parts, fault);
}
