/*
 * grammar.c - a record of text or of doubles becomes a line and a shape
 *
 * Text is pointers and lengths, never strings: a NUL is a bad byte.  Fields
 * are separated by blanks, tabs, and at most one comma.
 */
#include <string.h>

#include "grammar.h"
#include "numbers.h"

const struct kind line_kinds[LINE_KINDS] = {
    [LINE_WHOLE] = {"line", 6, "ox oy oz  dx dy dz"},
    [LINE_RAY] = {"ray", 6, "ox oy oz  dx dy dz"},
    [LINE_SEGMENT] = {"segment", 6, "ax ay az  bx by bz"},
    [LINE_SPAN] = {"span", 8, "ox oy oz  dx dy dz  tmin tmax"},
};

const struct kind shape_kinds[SHAPE_KINDS] = {
    [SHAPE_CYLINDER] = {"cylinder", 7, "p0x p0y p0z  p1x p1y p1z  r"},
    [SHAPE_CONE] = {"cone", 8, "p0x p0y p0z  r0  p1x p1y p1z  r1"},
    [SHAPE_ECYLINDER] = {"ecylinder", 12,
                         "cx cy cz  ax ay az  bx by bz  hx hy hz"},
    [SHAPE_ECONE] = {"econe", 13, "cx cy cz  ax ay az  bx by bz  hx hy hz  k"},
    [SHAPE_ACONE] = {"acone", 7, "vx vy vz  ux uy uz  degrees"},
};

const char *const ends_words[] = {[CYLINT_ENDS_CAPPED] = "capped",
                                  [CYLINT_ENDS_OPEN] = "open",
                                  [CYLINT_ENDS_CAP0] = "cap0",
                                  [CYLINT_ENDS_CAP1] = "cap1",
                                  [CYLINT_ENDS_INFINITE] = "infinite",
                                  [CYLINT_ENDS_NAPPE] = "nappe",
                                  NULL};

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

int numbers_of_record(const struct grammar *g)
{
    return (g->has_line ? line_kinds[g->line].numbers : 0) +
           (g->has_shape ? shape_kinds[g->shape].numbers : 0);
}

/* ---------------------------------------------------- doubles to shapes -- */

static cylint_status make_line(const struct grammar *g, int kind,
                               const double *v, cylint_line *line)
{
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

static cylint_status make_shape(int kind, int ends, const double *v,
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
    default:
        return cylint_angle_cone(shape, v, v + 3, v[6], e);
    }
}

/* ------------------------------------------------------------ text fields */

/* Where reading has come to, and what went wrong. */
struct reader {
    const char *p, *end;
    struct fault *fault;
};

static inline const char *skip_separator(const char *p, const char *end)
{
    p = skip_blanks(p, end);
    return p < end && *p == ',' ? skip_blanks(p + 1, end) : p;
}

static void skip_to(struct reader *r, const char *p)
{
    r->p = skip_separator(p, r->end);
}

static const char *end_of_field(const struct reader *r)
{
    const char *p = r->p;
    while (p < r->end && !is_blank(*p) && *p != ',') {
        p++;
    }
    return p;
}

/* A field of no length can only be a comma too many: show that. */
static int refuse(struct reader *r, const char *what, int expected)
{
    const char *after = end_of_field(r);
    if (after == r->p && after < r->end) {
        after++;
    }
    *r->fault = (struct fault){what, expected, r->p, after, 0};
    return 0;
}

static int read_numbers(struct reader *r, double *v, int count)
{
    const char *const end = r->end;
    for (int i = 0; i < count; i++) {
        const char *after = cylint_read_number(r->p, end, &v[i]);
        if (!after || !(after == end || is_blank(*after) || *after == ',')) {
            return refuse(r, "a number", 1);
        }
        if (v[i] - v[i] != 0) {
            return refuse(r, "number too large", 0);
        }
        r->p = skip_separator(after, end);
    }
    return 1;
}

static int read_kind(struct reader *r, const struct kind *kinds, int count,
                     const char *expected)
{
    const char *after = end_of_field(r);
    const int kind = find_kind(kinds, count, r->p, (size_t)(after - r->p));
    if (kind == NOT_GIVEN) {
        refuse(r, expected, 1);
        return kind;
    }
    skip_to(r, after);
    return kind;
}

/* What the library refuses is shown at the line's or shape's beginning. */
static int refuse_status(struct reader *r, const char *at, int status)
{
    *r->fault = (struct fault){cylint_strerror(status), 0, at, at, 0};
    return 0;
}

static int read_line(struct reader *r, const struct grammar *g,
                     cylint_line *line)
{
    double v[8];
    const char *at = r->p;
    int kind = g->line;
    if (kind == NOT_GIVEN) {
        kind =
            read_kind(r, line_kinds, LINE_KINDS, "line, ray, segment or span");
    }
    if (kind == NOT_GIVEN || !read_numbers(r, v, line_kinds[kind].numbers)) {
        return 0;
    }
    const cylint_status status = make_line(g, kind, v, line);
    return status == CYLINT_OK || refuse_status(r, at, (int)status);
}

static int read_ends(struct reader *r, int *ends)
{
    static const char key[] = "ends=";
    const size_t length = sizeof key - 1;
    if ((size_t)(r->end - r->p) < length || memcmp(r->p, key, length) != 0) {
        return 1;
    }
    r->p += length;
    const char *after = end_of_field(r);
    *ends = find_word(ends_words, r->p, (size_t)(after - r->p));
    if (*ends == NOT_GIVEN) {
        return refuse(r, ENDS_WORDS, 1);
    }
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
        kind = read_kind(r, shape_kinds, SHAPE_KINDS,
                         "cylinder, cone, ecylinder, econe or acone");
    }
    int ends = g->ends;
    if (kind == NOT_GIVEN || !read_numbers(r, v, shape_kinds[kind].numbers) ||
        !read_ends(r, &ends)) {
        return 0;
    }
    const cylint_status status = make_shape(kind, ends, v, shape);
    return status == CYLINT_OK || refuse_status(r, at, (int)status);
}

/* The rest of the line is copied as it is, but for a NUL, which no text
 * tool behind us would survive. */
static int read_tail(struct reader *r, const struct parts *parts)
{
    const char *end = r->end;
    while (end > r->p && is_blank(end[-1])) {
        end--;
    }
    *parts->tail = r->p;
    *parts->tail_length = (size_t)(end - r->p);
    const char *nul = memchr(r->p, '\0', *parts->tail_length);
    if (nul) {
        *r->fault = (struct fault){"unexpected byte", 0, nul, nul + 1, 0};
    }
    return !nul;
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
        *fault = (struct fault){"line longer than 1 MiB", 0, text, text, 0};
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
    struct reader r = {skip_blanks(text, end), end, fault};
    return (!g->has_line || read_line(&r, g, parts->line)) &&
           (!g->has_shape || read_shape(&r, g, parts->shape)) &&
           read_tail(&r, parts);
}

int take_parts(const struct grammar *g, const double *numbers,
               const struct parts *parts, struct fault *fault)
{
    cylint_status status = CYLINT_OK;
    *parts->tail_length = 0;
    if (g->has_line) {
        status = make_line(g, g->line, numbers, parts->line);
        numbers += line_kinds[g->line].numbers;
    }
    if (g->has_shape && status == CYLINT_OK) {
        status = make_shape(g->shape, g->ends, numbers, parts->shape);
    }
    if (status != CYLINT_OK) {
        *fault = (struct fault){cylint_strerror((int)status), 0, NULL, NULL, 0};
    }
    return status == CYLINT_OK;
}

static struct parts parts_of(struct record *r)
{
    return (struct parts){&r->line, &r->shape, &r->tail, &r->tail_length};
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
