/*
 * swc.c - neurons in SWC: a frustum or a rounded cone from each node to its
 * parent
 *
 *   node = number type x y z radius parent
 *
 * Fields are separated by blanks, tabs and at most one comma; the type, and
 * what follows the parent, is ignored.  Parent -1, or a parent that is not in
 * the file, marks a root.  Parents may stand after their children, so the
 * shapes are made after all nodes were read.  Rounded cones join without gaps;
 * with them a root gives a sphere.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "block.h"
#include "main.h"
#include "numbers.h"
#include "scene.h"
#include "swc.h"

enum { DIGITS_MOST = 18 }; /* of a node's number: it fits 64 bits */

#define NO_PARENT UINT64_MAX
/* All whole numbers below this one are doubles. */
#define DECIMAL_MOST 9007199254740992.0 /* 2^53 */

struct swc_node {
    uint64_t number, parent;
    double centre[3], radius;
    unsigned long long line, column; /* of the parent's number */
    size_t up;                       /* the parent's index, from 1; 0: a root */
    size_t path; /* the first node, from 1, whose ancestor this is; 0: none */
};

const char *const swc_forms[] = {
    [SWC_CONES] = "cones", [SWC_ROUND] = "round", NULL};

int swc_is_name(const char *file)
{
    const size_t length = strlen(file);
    const char *last = file + length - (length < 4 ? length : 4);
    return strcmp(last, ".swc") == 0 || strcmp(last, ".SWC") == 0;
}

/* -------------------------------------------------- numbers to nodes -- */

/* The hash.  Most nodes have consecutive numbers: eight of them stay together
 * in the table; the multiplier, 2^64 over the golden ratio, spreads the
 * groups of eight. */
static size_t first_place(const struct swc *swc, uint64_t number)
{
    const uint64_t scattered = (number >> 3) * 0x9e3779b97f4a7c15u;
    return (size_t)(scattered >> (64 - swc->bits) & ~(uint64_t)7) |
           (size_t)(number & 7);
}

/* The entry of this number, or the free entry where it belongs. */
static size_t *find_place(const struct swc *swc, uint64_t number)
{
    const size_t mask = ((size_t)1 << swc->bits) - 1;
    size_t i = first_place(swc, number);
    while (swc->places[i] > 0 &&
           swc->nodes[swc->places[i] - 1].number != number) {
        i = (i + 1) & mask;
    }
    return &swc->places[i];
}

/* Doubles the capacity.  At least half of the entries stay free. */
static int grow(struct swc *swc)
{
    const int bits = swc->bits > 0 ? swc->bits + 1 : 12;
    const size_t capacity = (size_t)1 << (bits - 1);
    if (capacity > SIZE_MAX / sizeof *swc->nodes) {
        return out_of_memory();
    }
    struct swc_node *nodes = realloc(swc->nodes, capacity * sizeof *nodes);
    if (!nodes) {
        return out_of_memory();
    }
    swc->nodes = nodes;
    size_t *places = calloc(2 * capacity, sizeof *places);
    if (!places) {
        return out_of_memory();
    }
    free(swc->places);
    swc->places = places;
    swc->bits = bits;
    swc->capacity = capacity;
    for (size_t i = 0; i < swc->count; i++) {
        *find_place(swc, nodes[i].number) = i + 1;
    }
    return 0;
}

void swc_free(struct swc *swc)
{
    free(swc->nodes);
    free(swc->places);
}

/* ------------------------------------------------------------- one node -- */

/* The rest of the text, and the place for a fault. */
struct reader {
    const char *p, *end;
    struct fault *fault;
};

static const char *end_of_field(const struct reader *r)
{
    const char *p = r->p;
    while (p < r->end && !is_blank(*p) && *p != ',') {
        p++;
    }
    return p;
}

/* Continues behind a field and its separator: blanks, one comma, blanks. */
static void skip_to(struct reader *r, const char *field_end)
{
    const char *p = skip_blanks(field_end, r->end);
    r->p = p < r->end && *p == ',' ? skip_blanks(p + 1, r->end) : p;
}

/* An empty field is a comma too many: the message shows the comma. */
static int refuse(struct reader *r, const char *what, int expected)
{
    const char *end = end_of_field(r);
    if (end == r->p && end < r->end) {
        end++;
    }
    *r->fault = (struct fault){
        .what = what, .expected = expected, .at = r->p, .end = end};
    return 0;
}

/* Reads the field as a decimal number; other programs do not read SWC's
 * numbers as hexadecimal.  Returns whether it is one; it may be infinite. */
static int is_decimal(const struct reader *r, double *value)
{
    const char *end = end_of_field(r);
    const size_t length = (size_t)(end - r->p);
    return cylint_read_number(r->p, r->end, value) == end &&
           !memchr(r->p, 'x', length) && !memchr(r->p, 'X', length);
}

/* Reads digits, at most DIGITS_MOST behind leading zeros. */
static int is_digits(const struct reader *r, uint64_t *number)
{
    const char *end = end_of_field(r);
    const char *p = r->p;
    *number = 0;
    while (p < end && end - p > DIGITS_MOST && *p == '0') {
        p++;
    }
    const int fits = p < end && end - p <= DIGITS_MOST;
    while (fits && p < end && *p >= '0' && *p <= '9') {
        *number = 10 * *number + (uint64_t)(*p++ - '0');
    }
    return fits && p == end;
}

/* Reads a node's number: digits, or a decimal number that is whole. */
static int read_whole(struct reader *r, uint64_t *number, const char *expected)
{
    double value;
    if (!is_digits(r, number)) {
        if (!is_decimal(r, &value) || *r->p == '-' || !(value < DECIMAL_MOST) ||
            (double)(uint64_t)value != value) {
            return refuse(r, expected, 1);
        }
        *number = (uint64_t)value;
    }
    skip_to(r, end_of_field(r));
    return 1;
}

static int read_parent(struct reader *r, uint64_t *parent)
{
    double value;
    if (is_decimal(r, &value) && value == -1) {
        *parent = NO_PARENT;
        return 1;
    }
    return read_whole(r, parent, "a node's number or -1");
}

static int read_decimal(struct reader *r, double *value)
{
    if (!is_decimal(r, value)) {
        return refuse(r, "a number", 1);
    }
    if (*value - *value != 0) {
        return refuse(r, "number too large", 0);
    }
    skip_to(r, end_of_field(r));
    return 1;
}

static int read_radius(struct reader *r, double *radius)
{
    struct reader at = *r;
    return read_decimal(r, radius) &&
           (*radius >= 0 || refuse(&at, "negative radius", 0));
}

/* [text, end) is one line. */
static int read_node(const char *text, const char *end, struct swc_node *node,
                     struct fault *fault)
{
    struct reader r = {skip_blanks(text, end), end, fault};
    if (!read_whole(&r, &node->number, "a node's number")) {
        return 0;
    }
    skip_to(&r, end_of_field(&r)); /* the type */
    for (int i = 0; i < 3; i++) {
        if (!read_decimal(&r, &node->centre[i])) {
            return 0;
        }
    }
    if (!read_radius(&r, &node->radius)) {
        return 0;
    }
    node->column = (unsigned long long)(r.p - text) + 1;
    return read_parent(&r, &node->parent);
}

/* ------------------------------------------------------------ all nodes -- */

static int print_fault(struct block *b, unsigned long long line,
                       const char *text, const struct fault *fault)
{
    take_note(&b->notes, line, 0, text, b->text + b->length, fault);
    print_note(&b->notes.note[0], b->name);
    return EXIT_BAD;
}

static int read_line(struct swc *swc, struct block *b, const char *text,
                     const char *end, unsigned long long line)
{
    struct swc_node node = {0};
    struct fault fault;
    node.line = line;
    if (!trim_line(text, &end, &fault) ||
        !read_node(text, end, &node, &fault)) {
        return print_fault(b, line, text, &fault);
    }
    if (swc->count == swc->capacity) {
        const int status = grow(swc);
        if (status != 0) {
            return status;
        }
    }
    size_t *place = find_place(swc, node.number);
    if (*place > 0) {
        struct reader r = {skip_blanks(text, end), end, &fault};
        refuse(&r, "this node was given before", 0);
        return print_fault(b, line, text, &fault);
    }
    swc->nodes[swc->count++] = node;
    *place = swc->count;
    return 0;
}

int swc_read_nodes(struct swc *swc, struct block *b)
{
    const char *end = b->text + b->length;
    unsigned long long line = b->line;
    int status = 0;
    for (const char *p = b->text; p < end && status == 0; line++) {
        const char *feed = end_of_line(p, end);
        if (is_record(p, feed)) {
            status = read_line(swc, b, p, feed, line);
        }
        p = feed + 1;
    }
    return status;
}

/* --------------------------------------------------------------- shapes -- */

static int refuse_cycle(const struct swc *swc, size_t index, const char *name)
{
    const struct swc_node *node = &swc->nodes[index - 1];
    struct note note = {.line = node->line, .column = node->column};
    snprintf(note.text, sizeof note.text,
             node->up == index ? "node %llu is its own parent"
                               : "the parents of node %llu lead back to it",
             (unsigned long long)node->number);
    print_note(&note, name);
    return EXIT_BAD;
}

/* The node of the cycle through `start` that stands first in the file. */
static size_t first_of_cycle(const struct swc *swc, size_t start)
{
    size_t first = start;
    for (size_t i = swc->nodes[start - 1].up; i != start;
         i = swc->nodes[i - 1].up) {
        first = i < first ? i : first;
    }
    return first;
}

/* Follows the parents of each node to a root or to a node followed before:
 * to one of the same path, if they form a cycle. */
static int refuse_cycles(const struct swc *swc, const char *name)
{
    for (size_t start = 1; start <= swc->count; start++) {
        size_t i = start;
        while (i > 0 && swc->nodes[i - 1].path == 0) {
            swc->nodes[i - 1].path = start;
            i = swc->nodes[i - 1].up;
        }
        if (i > 0 && swc->nodes[i - 1].path == start) {
            return refuse_cycle(swc, first_of_cycle(swc, i), name);
        }
    }
    return 0;
}

/* Finds the parents' indices.  Returns how many parents are missing. */
static size_t find_parents(const struct swc *swc)
{
    size_t missing = 0;
    for (size_t i = 0; i < swc->count; i++) {
        struct swc_node *node = &swc->nodes[i];
        if (node->parent != NO_PARENT) {
            node->up = *find_place(swc, node->parent);
            missing += node->up == 0;
        }
    }
    return missing;
}

static void print_missing(size_t count, const char *name)
{
    char what[120];
    if (count > 0) {
        snprintf(what, sizeof what,
                 "%llu node%s with a parent that is not in the file taken as"
                 " %s",
                 (unsigned long long)count, count == 1 ? "" : "s",
                 count == 1 ? "a root" : "roots");
        complain(name, what);
    }
}

static void print_skipped(size_t count, const char *what, const char *lack,
                          const char *name)
{
    char text[80];
    if (count > 0) {
        snprintf(text, sizeof text, "%llu %s%s of no %s skipped",
                 (unsigned long long)count, what, count == 1 ? "" : "s", lack);
        complain(name, text);
    }
}

/* The nodes become shapes of a scene.  Counts what bounds nothing. */
struct conversion {
    struct scene *scene;
    enum swc_form form;
    int ends;         /* NOT_GIVEN: capped */
    const char *name; /* of the file */
    size_t without_length, without_radius, roots_without_radius;
};

static int same_place(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Whether a root bounds a ball; counts it if not. */
static int is_ball(struct conversion *c, const struct swc_node *root)
{
    c->roots_without_radius += root->radius == 0;
    return root->radius > 0;
}

/* Whether an edge bounds a shape; counts it if not.  A rounded cone without
 * length is a ball. */
static int is_solid(struct conversion *c, const struct swc_node *node,
                    const struct swc_node *parent)
{
    if (c->form == SWC_CONES && same_place(node->centre, parent->centre)) {
        c->without_length++;
        return 0;
    }
    if (node->radius == 0 && parent->radius == 0) {
        c->without_radius++;
        return 0;
    }
    return 1;
}

/* parent: NULL for a root. */
static cylint_status make_shape(const struct conversion *c,
                                const struct swc_node *node,
                                const struct swc_node *parent,
                                cylint_shape *shape)
{
    const cylint_ends ends =
        c->ends == NOT_GIVEN ? CYLINT_ENDS_CAPPED : (cylint_ends)c->ends;
    if (!parent) {
        return cylint_sphere(shape, node->centre, node->radius, ends);
    }
    if (c->form == SWC_ROUND) {
        return cylint_round_cone(shape, node->centre, node->radius,
                                 parent->centre, parent->radius, ends);
    }
    return cylint_cone(shape, node->centre, node->radius, parent->centre,
                       parent->radius, ends);
}

static int add_shape(struct conversion *c, const struct swc_node *node,
                     const struct swc_node *parent)
{
    char number[DIGITS_MOST + 1];
    struct text label = {number, 0};
    struct record record;
    const cylint_status status = make_shape(c, node, parent, &record.shape);
    if (status != CYLINT_OK) {
        struct note note = {.line = node->line, .column = 1};
        snprintf(note.text, sizeof note.text, "%s",
                 cylint_strerror((int)status));
        print_note(&note, c->name);
        return EXIT_BAD;
    }
    put_whole(&label, node->number);
    record.tail = number;
    record.tail_length = label.length;
    return scene_add(c->scene, &record);
}

static int convert_node(struct conversion *c, const struct swc *swc,
                        const struct swc_node *node)
{
    const struct swc_node *parent =
        node->up > 0 ? &swc->nodes[node->up - 1] : NULL;
    const int is_shape = parent ? is_solid(c, node, parent)
                                : c->form == SWC_ROUND && is_ball(c, node);
    return is_shape ? add_shape(c, node, parent) : 0;
}

int swc_add_shapes(struct swc *swc, struct scene *scene, int ends,
                   enum swc_form form, const char *name)
{
    struct conversion c = {
        .scene = scene, .form = form, .ends = ends, .name = name};
    if (swc->count == 0) {
        complain(name, "no node was found");
        return EXIT_BAD;
    }
    const size_t missing = find_parents(swc);
    int status = refuse_cycles(swc, name);
    for (size_t i = 0; i < swc->count && status == 0; i++) {
        status = convert_node(&c, swc, &swc->nodes[i]);
    }
    if (status != 0) {
        return status;
    }
    print_missing(missing, name);
    print_skipped(c.without_length, "edge", "length", name);
    print_skipped(c.without_radius, "edge", "radius", name);
    print_skipped(c.roots_without_radius, "root", "radius", name);
    return 0;
}
