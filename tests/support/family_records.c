/*
 * family_records.c - cases of the families as text, as doubles, and as the
 * library's lines and shapes
 */
#include <stdlib.h>
#include <string.h>

#include "families.h"

static const char *const ends_words[] = {"capped", "open",     "cap0",
                                         "cap1",   "infinite", "nappe"};
static const char *const line_words[] = {"line", "ray", "segment", "span"};
static const char *const shape_words[] = {"cylinder",  "cone",  "acone",
                                          "ecylinder", "econe", "sphere",
                                          "capsule",   "rcone", "halfspace"};

int family_shape_size(family_shape word)
{
    static const int sizes[] = {7, 8, 7, 12, 13, 4, 7, 8, 6};
    return sizes[word];
}

int family_line_size(family_line word)
{
    return word == FAMILY_SPAN ? 8 : 6;
}

int family_lengths(family_shape word)
{
    return family_shape_size(word) -
           (word == FAMILY_ACONE || word == FAMILY_ECONE);
}

int family_is_size(family_shape word, int i)
{
    const int two = word == FAMILY_CONE || word == FAMILY_RCONE;
    return word != FAMILY_ECYLINDER && word != FAMILY_HALFSPACE &&
           (i == family_shape_size(word) - 1 || (two && i == 3));
}

int family_has_points(family_shape word)
{
    return word <= FAMILY_CONE || word == FAMILY_CAPSULE ||
           word == FAMILY_RCONE;
}

int family_axis(family_shape word)
{
    static const int numbers[] = {3, 4, 3, 9, 9, 0, 3, 4, 3};
    return numbers[word];
}

void family_set_shape(struct family_case *c, family_shape word,
                      const double at[3], const double a[3], const double b[3],
                      const double to[3], double r0, double last)
{
    const int elliptic = word == FAMILY_ECYLINDER || word == FAMILY_ECONE;
    const int n = family_shape_size(word);
    double *x = c->shape_data;
    c->shape_word = word;
    for (int i = 0; i < 3; i++) {
        x[family_axis(word) + i] = to[i]; /* of a sphere: overwritten */
        x[i] = at[i];
        if (elliptic) {
            x[3 + i] = a[i];
            x[6 + i] = b[i];
        }
    }
    if (family_is_size(word, 3))
        x[3] = r0;
    if (family_is_size(word, n - 1))
        x[n - 1] = last;
}

static void make_line(struct family_case *c)
{
    const double *x = c->line_data;
    switch (c->line_word) {
    case FAMILY_LINE:
        c->line_status = cylint_whole_line(&c->line, x, x + 3);
        break;
    case FAMILY_RAY:
        c->line_status = cylint_ray(&c->line, x, x + 3);
        break;
    case FAMILY_SEGMENT:
        c->line_status = cylint_segment(&c->line, x, x + 3);
        break;
    case FAMILY_SPAN:
        c->line_status = cylint_span(&c->line, x, x + 3, x[6], x[7]);
        break;
    }
}

struct family_case family_of(family_line line, const double *line_data,
                             family_shape shape, const double *shape_data)
{
    struct family_case c;
    memset(&c, 0, sizeof c);
    c.line_word = line;
    c.shape_word = shape;
    memcpy(c.line_data, line_data,
           (size_t)family_line_size(line) * sizeof(double));
    memcpy(c.shape_data, shape_data,
           (size_t)family_shape_size(shape) * sizeof(double));
    return c;
}

struct family_case family_example(family_shape word)
{
    static const double line[] = {0, 0, -1, 0, 0, 1};
    static const double shapes[FAMILY_SHAPES][13] = {
        {0, 0, 0, 0, 0, 1, 1},
        {0, 0, 0, 1, 0, 0, 1, 0.5},
        {0, 0, 0, 0, 0, 1, 30},
        {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1},
        {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.5},
        {0, 0, 0, 1},
        {0, 0, 0, 0, 0, 1, 1},
        {0, 0, 0, 1, 0, 0, 1, 0.5},
        {0, 0, 0, 0, 0, 1}};
    return family_of(FAMILY_LINE, line, word, shapes[word]);
}

int family_make(struct family_case *c)
{
    const double *x = c->shape_data;
    cylint_shape *s = &c->shape;
    make_line(c);
    switch (c->shape_word) {
    case FAMILY_CYLINDER:
        c->shape_status = cylint_cylinder(s, x, x + 3, x[6], c->ends);
        break;
    case FAMILY_CONE:
        c->shape_status = cylint_cone(s, x, x[3], x + 4, x[7], c->ends);
        break;
    case FAMILY_ACONE:
        c->shape_status = cylint_angle_cone(s, x, x + 3, x[6], c->ends);
        break;
    case FAMILY_ECYLINDER:
        c->shape_status =
            cylint_elliptic_cylinder(s, x, x + 3, x + 6, x + 9, c->ends);
        break;
    case FAMILY_ECONE:
        c->shape_status =
            cylint_elliptic_cone(s, x, x + 3, x + 6, x + 9, x[12], c->ends);
        break;
    case FAMILY_SPHERE:
        c->shape_status = cylint_sphere(s, x, x[3], c->ends);
        break;
    case FAMILY_CAPSULE:
        c->shape_status = cylint_capsule(s, x, x + 3, x[6], c->ends);
        break;
    case FAMILY_RCONE:
        c->shape_status = cylint_round_cone(s, x, x[3], x + 4, x[7], c->ends);
        break;
    case FAMILY_HALFSPACE:
        c->shape_status = cylint_halfspace(s, x, x + 3);
        c->ends = CYLINT_ENDS_INFINITE;
        break;
    }
    return c->line_status == CYLINT_OK && c->shape_status == CYLINT_OK;
}

static const char *parse_word(const char *text, const char *const *words, int n,
                              int *found)
{
    text += strspn(text, " ");
    const size_t length = strcspn(text, " =\n");
    for (*found = n - 1; *found >= 0; --*found)
        if (strlen(words[*found]) == length &&
            strncmp(text, words[*found], length) == 0)
            return text + length;
    return NULL;
}

const char *family_numbers(const char *text, int n, double *to)
{
    for (int i = 0; i < n; i++) {
        char *end;
        to[i] = strtod(text, &end);
        if (end == text)
            return NULL;
        text = end;
    }
    return text;
}

const char *family_parse_any(const char *text, struct family_case *c)
{
    int word;
    memset(c, 0, sizeof *c);
    c->line_data[3] = 1;
    const char *line = parse_word(text, line_words, 4, &word);
    if (line) {
        c->line_word = (family_line)word;
        text =
            family_numbers(line, family_line_size(c->line_word), c->line_data);
    }
    if (!text || !(text = parse_word(text, shape_words, FAMILY_SHAPES, &word)))
        return NULL;
    c->shape_word = (family_shape)word;
    text =
        family_numbers(text, family_shape_size(c->shape_word), c->shape_data);
    if (!text)
        return NULL;
    const char *ends = text + strspn(text, " ");
    if (strncmp(ends, "ends=", 5) == 0) {
        if (!(text = parse_word(ends + 5, ends_words, 6, &word)))
            return NULL;
        c->ends = (cylint_ends)word;
    }
    family_make(c);
    return text;
}

const char *family_parse(const char *text, struct family_case *c)
{
    text = family_parse_any(text, c);
    return text && !c->line_status && !c->shape_status ? text : NULL;
}

struct family_case case_of(const char *text)
{
    struct family_case c;
    if (!family_parse(text, &c)) {
        fprintf(stderr, "no record of a shape: %s\n", text);
        abort();
    }
    return c;
}

cylint_shape shape_of(const char *text)
{
    return case_of(text).shape;
}

void family_print(FILE *to, const struct family_case *c)
{
    fputs(line_words[c->line_word], to);
    for (int i = 0; i < family_line_size(c->line_word); i++)
        fprintf(to, " %a", c->line_data[i]);
    fprintf(to, "  %s", shape_words[c->shape_word]);
    for (int i = 0; i < family_shape_size(c->shape_word); i++)
        fprintf(to, " %a", c->shape_data[i]);
    fprintf(to, "  ends=%s", ends_words[c->ends]);
}

void family_report(const struct family_case *c)
{
    family_print(stderr, c);
    fputc('\n', stderr);
}
