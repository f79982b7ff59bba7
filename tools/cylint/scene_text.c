/*
 * scene_text.c - shapes as text of the grammar, which is read as the same shapes
 */
#include <math.h>
#include <stdlib.h>

#include "numbers.h"
#include "scene.h"

/*
 * Text has the angle of a cone in degrees, a shape its tangent.  The tangent
 * grows with the angle, so this steps from an approximation, of 15 digits, to the
 * first double whose tangent is not on the same side.  Returns 0 if no angle has
 * the tangent.  number: apex, axis, tangent.
 */
static double angle_of(const double number[7])
{
    const double degree = 57.29577951308232; /* 180 / pi */
    const double tangent = number[6];
    char digits[NUMBER_CAPACITY + 1] = {0};
    double angle;
    const size_t length =
        cylint_write_number(digits, atan(tangent) * degree, 15);
    cylint_read_number(digits, digits + length, &angle);
    angle = fmin(angle, nextafter(90, 0));
    for (int before = 0;;) {
        cylint_shape made;
        double again[CYLINT_ARGUMENTS_MOST];
        if (cylint_angle_cone(&made, number, number + 3, angle,
                              CYLINT_ENDS_INFINITE) != CYLINT_OK)
            return 0;
        cylint_arguments(&made, again);
        const double reached = again[6];
        const int side = (reached < tangent) - (reached > tangent);
        if (side == 0)
            return angle;
        if (side == -before)
            return 0;
        before = side;
        angle = nextafter(angle, side * HUGE_VAL);
    }
}

/* -------------------------------------------------------------- record -- */

/* lint: member[] has r->members elements */
/* Returns why text cannot hold the record, or NULL.  A label is the tail of a line,
 * without the blanks around it. */
static const char *fault_of(const struct shape_record *r)
{
    for (size_t i = 0; i < r->members; i++)
        if (abs(r->member[i].clause) > CLAUSE_MOST)
            return "text cannot hold a clause above 999999999";
    const struct string label = r->label;
    const char *const text = label.text;
    if (label.length == 0)
        return NULL;
    const char last = text[label.length - 1];
    return memchr(text, '\n', label.length) || memchr(text, '\0', label.length)
               ? "text cannot hold a label with a line feed or NUL"
           : is_blank(text[0]) || is_blank(last) || last == '\r'
               ? "text cannot hold a label with blanks around it"
           : begins_with(label, IN_WORD) || begins_with(label, OUT_WORD)
               ? "text cannot hold a label that begins with in= or out="
           : r->members > 0 && begins_with(label, ENDS_WORD)
               ? "text cannot hold a label that begins with ends= in a solid"
               : NULL;
}

/* lint: a record has the count of numbers of its kinds */
static void put_shape(struct text *t, const struct shape_record *r,
                      cylint_kind kind, const double *number, int digits)
{
    const int usual = kind == CYLINT_KIND_ACONE || kind == CYLINT_KIND_HALFSPACE
                          ? CYLINT_ENDS_INFINITE
                          : CYLINT_ENDS_CAPPED;
    const struct kind *k = &shape_kinds[NUMBER_OF_KIND(kind)];
    put_word(t, k->word);
    for (int i = 0; i < k->numbers; i++) {
        put_char(t, ' ');
        t->length +=
            cylint_write_number(t->data + t->length, number[i], digits);
    }
    /* A label of this form would be read as the ends. */
    if (r->shape->ends != usual || begins_with(r->label, ENDS_WORD)) {
        put_word(t, " " ENDS_WORD);
        put_word(t, ends_words[r->shape->ends]);
    }
}

/* lint: member[] has r->members elements */
/* A solid of a saved scene has no name: its number serves. */
static void put_member(struct text *t, const struct solids *s,
                       const cylint_member *m)
{
    put_word(t, m->clause < 0 ? " " OUT_WORD : " " IN_WORD);
    if (m->solid < s->names.texts.count)
        put_string(t, names_get(&s->names, m->solid));
    else
        put_whole(t, m->solid + 1);
    put_char(t, '/');
    put_whole(t, (unsigned long long)abs(m->clause));
}

const char *put_record(struct text *t, const struct shape_record *r, int digits)
{
    double number[CYLINT_ARGUMENTS_MOST];
    const size_t begin = t->length;
    const cylint_kind kind = cylint_arguments(r->shape, number);
    const char *fault = kind == CYLINT_KIND_NONE
                            ? "text cannot hold a refused shape"
                            : fault_of(r);
    if (fault)
        return fault;
    if (kind == CYLINT_KIND_ACONE && (number[6] = angle_of(number)) == 0)
        return "text cannot hold a cone whose tangent no angle in degrees has";
    put_shape(t, r, kind, number, digits);
    for (size_t i = 0; i < r->members && t->length - begin <= LINE_MOST; i++)
        put_member(t, r->solids, &r->member[i]);
    if (r->label.length > 0 && r->label.length <= LINE_MOST) {
        /* The first comma after a field separates. */
        put_word(t, r->label.text[0] == ',' ? " ," : " ");
        put_string(t, r->label);
    }
    if (r->label.length > LINE_MOST || t->length - begin > LINE_MOST) {
        t->length = begin;
        return "the line would be longer than 1 MiB";
    }
    put_char(t, '\n');
    return NULL;
}

/* --------------------------------------------------------------- scene -- */

static int compare_by_shape(const void *a, const void *b)
{
    const cylint_member *m = a, *n = b;
    return m->shape != n->shape   ? (m->shape > n->shape ? 1 : -1)
           : m->solid != n->solid ? (m->solid > n->solid ? 1 : -1)
                                  : abs(m->clause) - abs(n->clause);
}

static int put_records(const struct scene *scene, int digits,
                       struct output *out, struct text *t)
{
    const struct solids *s = &scene->solids;
    size_t at = 0;
    int status = 0;
    for (size_t i = 0; i < scene->count && status == 0; i++) {
        cylint_shape shape;
        struct shape_record r = {&shape, s,
                                 s->count > 0 ? s->member + at : NULL, 0,
                                 labels_get(&scene->labels, i)};
        cylint_scene_shape(scene->shapes, i, &shape);
        for (; at < s->count && s->member[at].shape == i; at++)
            r.members++;
        const char *fault = put_record(t, &r, digits);
        if (fault)
            return complain(EXIT_BAD, scene->file, "shape %llu: %s",
                            (unsigned long long)i + 1, fault);
        if (t->length >= TEXT_FULL || i + 1 == scene->count) {
            status = output_write(out, t->data, t->length);
            t->length = 0;
        }
    }
    return status;
}

int scene_write_text(struct scene *scene, int digits, struct output *out)
{
    struct solids *s = &scene->solids;
    struct text t = {malloc(TEXT_FULL + RECORD_MOST), 0};
    if (!t.data)
        return out_of_memory();
    if (s->count > 0)
        qsort(s->member, s->count, sizeof *s->member, compare_by_shape);
    const int status = put_records(scene, digits, out, &t);
    free(t.data);
    return status;
}
