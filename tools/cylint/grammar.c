/*
 * grammar.c - reads a line or point and a shape from a record of text or
 * doubles
 *
 * Texts are pointers to their start and end, not C strings: a NUL is a bad
 * byte.
 */
#include <string.h>

#include "grammar.h"
#include "numbers.h"

const struct kind line_kinds[] = {
    {"line", 6, "ox oy oz  dx dy dz", {0, 0}},
    {"ray", 6, "ox oy oz  dx dy dz", {0, 0}},
    {"segment", 6, "ax ay az  bx by bz", {0, 0}},
    {"span", 8, "ox oy oz  dx dy dz  tmin tmax", {6, 6}},
    {"point", 3, "x y z", {0, 0}},
    {0}};

const struct kind shape_kinds[] = {
    {"cylinder", 7, "p0x p0y p0z  p1x p1y p1z  r", {6, 6}},
    {"cone", 8, "p0x p0y p0z  r0  p1x p1y p1z  r1", {3, 7}},
    {"acone", 7, "vx vy vz  ux uy uz  degrees", {6, 6}},
    {"ecylinder", 12, "cx cy cz  ax ay az  bx by bz  hx hy hz", {0, 0}},
    {"econe", 13, "cx cy cz  ax ay az  bx by bz  hx hy hz  k", {12, 12}},
    {"sphere", 4, "cx cy cz  r", {3, 3}},
    {"capsule", 7, "p0x p0y p0z  p1x p1y p1z  r", {6, 6}},
    {"rcone", 8, "p0x p0y p0z  r0  p1x p1y p1z  r1", {3, 7}},
    {"halfspace", 6, "px py pz  nx ny nz", {0, 0}},
    {0}};

const char *const ends_words[] = {"capped",   "open",  "cap0", "cap1",
                                  "infinite", "nappe", NULL};

int numbers_of_record(const struct grammar *g)
{
    return line_kinds[g->line].numbers +
           (g->has_shape ? shape_kinds[g->shape].numbers : 0);
}

/* ---------------------------------------------------- doubles to shapes -- */

/* lint: a record has the count of numbers of its kinds */
static cylint_status make_point(const double *v, double point[3])
{
    for (int i = 0; i < 3; i++) {
        if (v[i] - v[i] != 0)
            return CYLINT_ENONFINITE;
        point[i] = v[i];
    }
    return CYLINT_OK;
}

/* lint: a record has the count of numbers of its kinds */
static cylint_status make_line(const struct grammar *g, int kind,
                               const double *v, struct record *record)
{
    cylint_line *line = &record->line;
    record->is_point = kind == LINE_POINT;
    if (kind == LINE_POINT)
        return make_point(v, record->point);
    if (kind == LINE_SEGMENT)
        return cylint_segment(line, v, v + 3);
    if (kind == LINE_SPAN)
        return cylint_span(line, v, v + 3, v[6], v[7]);
    if (g->has_domain)
        return cylint_span(line, v, v + 3, g->domain[0], g->domain[1]);
    return kind == LINE_RAY ? cylint_ray(line, v, v + 3)
                            : cylint_whole_line(line, v, v + 3);
}

/* It has no ends: `capped`, the usual word, and `infinite` change nothing. */
static cylint_status make_halfspace(const double *v, cylint_ends ends,
                                    cylint_shape *shape)
{
    if (ends == CYLINT_ENDS_CAPPED || ends == CYLINT_ENDS_INFINITE)
        return cylint_halfspace(shape, v, v + 3);
    memset(shape, 0, sizeof *shape);
    return CYLINT_EENDS;
}

/* lint: a record has the count of numbers of its kinds */
cylint_status shape_of_numbers(cylint_kind kind, int ends, const double *v,
                               cylint_shape *shape)
{
    const cylint_ends e = ends != NOT_GIVEN           ? (cylint_ends)ends
                          : kind == CYLINT_KIND_ACONE ? CYLINT_ENDS_INFINITE
                                                      : CYLINT_ENDS_CAPPED;
    switch (kind) {
    case CYLINT_KIND_CYLINDER:
        return cylint_cylinder(shape, v, v + 3, v[6], e);
    case CYLINT_KIND_CONE:
        return cylint_cone(shape, v, v[3], v + 4, v[7], e);
    case CYLINT_KIND_ECYLINDER:
        return cylint_elliptic_cylinder(shape, v, v + 3, v + 6, v + 9, e);
    case CYLINT_KIND_ECONE:
        return cylint_elliptic_cone(shape, v, v + 3, v + 6, v + 9, v[12], e);
    case CYLINT_KIND_SPHERE:
        return cylint_sphere(shape, v, v[3], e);
    case CYLINT_KIND_CAPSULE:
        return cylint_capsule(shape, v, v + 3, v[6], e);
    case CYLINT_KIND_RCONE:
        return cylint_round_cone(shape, v, v[3], v + 4, v[7], e);
    case CYLINT_KIND_HALFSPACE:
        return make_halfspace(v, e, shape);
    default:
        return cylint_angle_cone(shape, v, v + 3, v[6], e);
    }
}

/* -------------------------------------------------------------- fields -- */

/* An empty field is a comma too many: the message shows the comma. */
static struct string shown_field(const struct reader *r)
{
    struct string s = field(r);
    s.length += s.length == 0 && r->p < r->end;
    return s;
}

int refuse_field(struct reader *r, const char *what)
{
    return refuse_text(r->notes, what, shown_field(r));
}

int refuse_other_field(struct reader *r, const char *expected)
{
    return refuse_other(r->notes, expected, shown_field(r));
}

static int refuse_word(struct reader *r, struct words expected)
{
    char list[WORDS_CAPACITY];
    refuse_other_field(r, list_words(list, expected));
    suggest(r->notes, expected, field(r));
    return EXIT_BAD;
}

static int is_next(const struct reader *r, const char *word)
{
    return begins_with(between(r->p, r->end), word);
}

const char *end_of_number(const char *p, const char *end, double *value)
{
    const char *after = cylint_read_number(p, end, value);
    return after && (after == end || is_blank(*after) || *after == ',') ? after
                                                                        : NULL;
}

/* Counts the successive numbers at r.p. */
static int count_numbers(struct reader r)
{
    double value;
    int count = 0;
    for (const char *after; (after = end_of_number(r.p, r.end, &value));
         skip_to(&r, after))
        count++;
    return count;
}

/* The text around the first comma of the record, before r->p, if it is a decimal
 * comma: digits before it, digits and perhaps an exponent after it, alone between
 * blanks.  Else an empty text.  lint: a number ends at `to`, which is not NULL. */
static struct string decimal_comma(const struct reader *r)
{
    const char *const begin = r->notes->text, *const end = r->end;
    const char *comma = memchr(begin, ',', (size_t)(r->p - begin));
    const char *from = comma ? comma : begin;
    while (from > begin && is_digit(from[-1]))
        from--;
    from -= from > begin && (from[-1] == '-' || from[-1] == '+');
    if (!comma || from == comma || (from > begin && !is_blank(from[-1])))
        return between(begin, begin);
    const char *const to = field_end(comma + 1, end), *after = comma + 1;
    while (is_digit(*after))
        after++;
    return after > comma + 1 && (after == to || (*after | 0x20) == 'e') &&
                   (*to != ',' || is_blank(to[1]))
               ? between(from, to)
               : between(begin, begin);
}

#define SEPARATORS "write a decimal point, and blanks or commas between fields"

/* Appends advice to the note if the wrong field, at r, suggests a decimal comma or
 * semicolons. */
static void advise_on_separators(struct reader *r)
{
    double value;
    const char *after = cylint_read_number(r->p, r->end, &value);
    const int has_semicolon = after && *after == ';';
    skip_field(r);
    if (has_semicolon || decimal_comma(r).length > 0)
        advise(r->notes, SEPARATORS);
}

void remark_decimal_comma(struct reader *r)
{
    double value;
    if (!end_of_number(r->p, r->end, &value))
        return;
    const struct string found = decimal_comma(r);
    if (found.length > 0 && wants_remark(r->notes, REMARK_NUMBERS)) {
        refuse_text(r->notes, "these are two numbers", found);
        advise(r->notes, SEPARATORS);
        make_remark(r->notes, REMARK_NUMBERS);
    }
}

int read_numbers(struct reader *r, double *v, int count)
{
    const char *const end = r->end;
    for (int i = 0; i < count; i++) {
        const char *after = end_of_number(r->p, end, &v[i]);
        if (!after)
            return refuse_other_field(r, "a number");
        if (v[i] - v[i] != 0)
            return refuse_field(r, "number too large");
        r->p = skip_separator(after, end);
    }
    return 0;
}

/* ------------------------------------------------------ lines and shapes -- */

/* Whether the line may be no text. */
static int has_control(struct reader r)
{
    for (; r.p < r.end; r.p++)
        if (is_control(*r.p))
            return 1;
    return 0;
}

/* Appends advice if the record is the first line of a text and its first two
 * fields, from r on, are no numbers. */
static int advise_on_names(struct reader r)
{
    if (r.notes->line != 1 || count_numbers(r) > 0 || has_control(r))
        return 0;
    skip_field(&r);
    if (r.p == r.end || count_numbers(r) > 0)
        return 0;
    advise(r.notes, "'tail -n +2' leaves out a line of column names");
    return 1;
}

static int refuse_line_kind(struct reader *r, const struct grammar *g)
{
    const int numbers = count_numbers(*r);
    refuse_word(r, WORDS(line_kinds));
    if (advise_on_names(*r))
        return EXIT_BAD;
    if (numbers > 0)
        advise(r->notes, g->has_shape  ? "for bare numbers use -k ray,cylinder"
                         : numbers < 6 ? "for bare numbers use -k point"
                                       : "for bare numbers use -k ray");
    else if (find_word(WORDS(shape_kinds), field(r)) != NOT_GIVEN)
        advise(r->notes, "for a scene use -s");
    return EXIT_BAD;
}

static int refuse_shape_kind(struct reader *r, const struct grammar *g)
{
    refuse_word(r, WORDS(shape_kinds));
    if (!g->has_line && find_word(WORDS(line_kinds), field(r)) != NOT_GIVEN)
        advise(r->notes, "a scene has shapes only, no records");
    else if (g->convert)
        advise(r->notes, g->convert);
    else if (!g->has_line && count_numbers(*r) > 0)
        advise(r->notes, "a neuron needs a name that ends in .swc, or --swc");
    return EXIT_BAD;
}

/* The kind of -k, or the one that is read.  NOT_GIVEN: the word is none. */
static int read_kind(struct reader *r, int given, struct words kinds)
{
    const int kind = given == NOT_GIVEN ? find_word(kinds, field(r)) : given;
    if (given == NOT_GIVEN && kind != NOT_GIVEN)
        skip_field(r);
    return kind;
}

/* The library refused the line or shape that begins at `at`.  The message
 * shows the number that is wrong, or the first word. */
static int refuse_status(struct reader *r, const char *at, int has_word,
                         const struct kind *k, const double *v,
                         cylint_status status)
{
    const char *what = cylint_strerror((int)status);
    if (status != CYLINT_ERADIUS && status != CYLINT_EANGLE &&
        status != CYLINT_EDOMAIN)
        return refuse(r->notes, at, "%s", what);
    const int is_second = v[k->checked[0]] >= 0 && v[k->checked[1]] < 0;
    r->p = at;
    for (int i = k->checked[is_second] + has_word; i > 0; i--)
        skip_field(r);
    return refuse_field(r, what);
}

static int read_line(struct reader *r, const struct grammar *g, int *kind,
                     struct record *record)
{
    double v[8];
    const char *at = r->p;
    *kind = read_kind(r, g->line, WORDS(line_kinds));
    if (*kind == NOT_GIVEN)
        return refuse_line_kind(r, g);
    record->is_point = *kind == LINE_POINT;
    const char *reason = record->is_point ? g->no_points : g->no_lines;
    if (reason) {
        r->p = at;
        return refuse_field(r, reason);
    }
    const struct kind *k = &line_kinds[*kind];
    if (read_numbers(r, v, k->numbers)) {
        if (r->p == at && find_word(WORDS(line_kinds), field(r)) != NOT_GIVEN)
            advise(r->notes, "with -k records have no words");
        else if (r->p == at)
            advise_on_names(*r);
        return EXIT_BAD;
    }
    const cylint_status status = make_line(g, *kind, v, record);
    return status != CYLINT_OK &&
           refuse_status(r, at, g->line == NOT_GIVEN, k, v, status);
}

/* Reads ends=WORD, if it stands there. */
static int read_ends(struct reader *r, int *ends)
{
    if (!is_next(r, ENDS_WORD))
        return 0;
    r->p += strlen(ENDS_WORD);
    *ends = find_word(WORDS(ends_words), field(r));
    if (*ends == NOT_GIVEN)
        return refuse_word(r, WORDS(ends_words));
    r->has_word = 1;
    skip_field(r);
    return 0;
}

static int read_shape(struct reader *r, const struct grammar *g,
                      struct record *record)
{
    double v[13];
    const char *at = r->p;
    int kind = read_kind(r, g->shape, WORDS(shape_kinds)), ends = g->ends;
    if (kind == NOT_GIVEN)
        return refuse_shape_kind(r, g);
    const struct kind *k = &shape_kinds[kind];
    if (read_numbers(r, v, k->numbers))
        return EXIT_BAD;
    const char *const behind = r->p;
    if (read_ends(r, &ends))
        return EXIT_BAD;
    const cylint_status status =
        shape_of_numbers(KIND_OF_NUMBER(kind), ends, v, &record->shape);
    return status != CYLINT_OK &&
           refuse_status(r, status == CYLINT_EENDS && r->has_word ? behind : at,
                         g->shape == NOT_GIVEN, k, v, status);
}

/* -------------------------------------------- words behind, and tail -- */

static int is_solid_next(const struct reader *r)
{
    return is_next(r, IN_WORD) || is_next(r, OUT_WORD);
}

/* Finds the end of the words in=NAME and out=NAME, or not=NAME; solids_read() or
 * left_out_read() reads them. */
static int read_words(struct reader *r, const struct grammar *g,
                      struct record *record)
{
    const char *const begin = r->p;
    if (g->has_line && g->has_shape && is_solid_next(r))
        return refuse_field(
            r, "in= and out= are for the shapes of a scene, -s FILE");
    if (g->no_left_out && is_next(r, NOT_WORD))
        return refuse_field(r, g->no_left_out);
    while (g->has_shape ? !g->has_line && is_solid_next(r)
                        : is_next(r, NOT_WORD))
        skip_field(r);
    record->words = between(begin, r->p);
    r->has_word |= record->words.length > 0;
    return g->has_shape && record->words.length > 0 && is_next(r, ENDS_WORD) &&
           refuse_field(r, "ends= must stand before in= and out=");
}

static const char *article(const char *word)
{
    return strchr("aeiou", word[0]) ? "an" : "a";
}

/* Whether the tail of a record of bare numbers, of -k, begins with a
 * number.  Notes "N numbers where a ray has 6".  After a word a tail may
 * begin with a number. */
static int has_surplus(struct reader *r, const struct grammar *g)
{
    const int surplus =
        g->line != NOT_GIVEN && !r->has_word ? count_numbers(*r) : 0;
    if (surplus == 0)
        return 0;
    const char *line = line_kinds[g->line].word;
    const char *shape = g->has_shape ? shape_kinds[g->shape].word : "";
    const int numbers = numbers_of_record(g);
    refuse(r->notes, r->p, "%d numbers where %s %s%s%s%s%s %s %d",
           numbers + surplus, article(line), line, *shape ? " and " : "",
           *shape ? article(shape) : "", *shape ? " " : "", shape,
           *shape ? "have" : "has", numbers);
    return 1;
}

/* Whether the tail begins with a shape, which a record with a scene does not have.
 * Notes it. */
static int has_late_shape(struct reader r, const struct grammar *g)
{
    const struct string word = field(&r);
    if (g->has_shape || find_word(WORDS(shape_kinds), word) == NOT_GIVEN)
        return 0;
    skip_field(&r);
    return count_numbers(r) > 0 &&
           refuse_text(r.notes, "with -s the shapes are those of the scene",
                       word);
}

/* Whether the tail has a word that is read only before the tail.  Notes the first
 * one.  After another word of a shape ends= belongs to the tail. */
static int has_late_word(struct reader r, const struct grammar *g)
{
    if (!memchr(r.p, '=', (size_t)(r.end - r.p)))
        return 0;
    for (; r.p < r.end; skip_field(&r))
        if (is_next(&r, NOT_WORD) ||
            (!(g->has_shape && r.has_word) && is_next(&r, ENDS_WORD)) ||
            (!g->has_line && is_solid_next(&r)))
            return refuse_field(&r, "this word has no effect within the tail");
    return 0;
}

/* A word for the ends without `ends=`, or a blank before `=`. */
static int has_bare_word(struct reader r, const struct grammar *g)
{
    const int is_solid =
        !g->has_line && (is_next(&r, "in =") || is_next(&r, "out ="));
    const int is_ends = g->has_shape && !r.has_word &&
                        (find_word(WORDS(ends_words), field(&r)) != NOT_GIVEN ||
                         is_next(&r, "ends ="));
    if (!is_solid && !is_ends)
        return 0;
    refuse_field(&r, "this word has no effect in a tail");
    advise(r.notes, is_solid ? "in=NAME and out=NAME have no blanks"
                             : "ends=WORD sets the ends");
    return 1;
}

/* The tail is copied unchanged.  A NUL is refused, because text tools that read
 * the answers do not accept it. */
static int read_tail(struct reader *r, const struct grammar *g,
                     struct record *record)
{
    const char *end = r->end;
    while (end > r->p && is_blank(end[-1]))
        end--;
    record->tail = between(r->p, end);
    const char *nul = memchr(r->p, '\0', record->tail.length);
    if (nul)
        return refuse_text(r->notes, "unexpected byte", between(nul, nul + 1));
    if (record->tail.length == 0)
        return 0;
    if (g->no_tail)
        return has_surplus(r, g) ||
               refuse_other_field(r, "the end of the line");
    if (wants_remark(r->notes, REMARK_NUMBERS) && has_surplus(r, g)) {
        advise(r->notes, "what follows is copied as the tail");
        make_remark(r->notes, REMARK_NUMBERS);
    }
    remark_decimal_comma(r);
    if (wants_remark(r->notes, REMARK_LATE_WORD) &&
        (has_late_shape(*r, g) || has_late_word(*r, g) || has_bare_word(*r, g)))
        make_remark(r->notes, REMARK_LATE_WORD);
    return 0;
}

static void remark_domain(int kind, const char *at, struct notes *notes)
{
    if (kind >= LINE_SEGMENT && wants_remark(notes, REMARK_DOMAIN)) {
        refuse(notes, at, "-t has no effect on a %s", line_kinds[kind].word);
        make_remark(notes, REMARK_DOMAIN);
    }
}

/* -------------------------------------------------------------- records -- */

const char *end_of_line(const char *p, const char *end)
{
    const char *feed = memchr(p, '\n', (size_t)(end - p));
    return feed ? feed : end;
}

int is_record(const char *line, const char *end)
{
    end = before_return(line, end);
    if (end - line > LINE_MOST)
        return 1;
    while (line < end && (is_blank(*line) || *line == '\r'))
        line++;
    return line < end && *line != '#';
}

int begin_line(struct reader *r, const char *text, const char *end,
               struct notes *notes)
{
    end = before_return(text, end);
    *r = (struct reader){skip_blanks(text, end), end, notes, 0};
    return end - text > LINE_MOST
               ? refuse(notes, text, "line longer than 1 MiB")
               : 0;
}

int read_record(const struct grammar *g, const char *text, const char *end,
                struct record *record, struct notes *notes)
{
    struct reader r;
    int kind = NOT_GIVEN;
    record->is_point = g->no_lines != NULL;
    if (begin_line(&r, text, end, notes))
        return EXIT_BAD;
    const char *const at = r.p;
    if ((g->has_line && read_line(&r, g, &kind, record)) ||
        (g->has_shape && read_shape(&r, g, record)) ||
        read_words(&r, g, record) || read_tail(&r, g, record)) {
        advise_on_separators(&r);
        return EXIT_BAD;
    }
    remark_domain(kind, at, notes);
    return 0;
}

int record_of_numbers(const struct grammar *g, const double *numbers,
                      struct record *record, struct notes *notes)
{
    cylint_status status = make_line(g, g->line, numbers, record);
    numbers += line_kinds[g->line].numbers;
    record->tail.length = record->words.length = 0;
    if (g->has_shape && status == CYLINT_OK)
        status = shape_of_numbers(KIND_OF_NUMBER(g->shape), g->ends, numbers,
                                  &record->shape);
    if (status != CYLINT_OK)
        return refuse(notes, NULL, "%s", cylint_strerror((int)status));
    remark_domain(g->line, NULL, notes);
    return 0;
}
