/*
 * swc.c - neurons in SWC: a frustum from each node to its parent
 *
 *   node = number type x y z radius parent
 *
 * Fields are separated by blanks and tabs; the type, and what stands behind
 * the parent, is not looked at.  Parent -1 marks a root.  Parents may stand
 * after their children, so that the shapes come when all is read.
 *
 * tools/convert/swc2scene accepts the same files, gives the same shapes in
 * the same order and refuses with the same messages.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "main.h"
#include "numbers.h"
#include "swc.h"

enum { DIGITS_MOST = 18 }; /* of a node's number: it fits 64 bits */

#define NO_PARENT UINT64_MAX

struct swc_node {
    uint64_t number, parent;
    double centre[3], radius;
    unsigned long long line, column; /* of the parent's number */
};

int swc_is_name(const char *file)
{
    const size_t length = strlen(file);
    const char *last = file + length - (length < 4 ? length : 4);
    return strcmp(last, ".swc") == 0 || strcmp(last, ".SWC") == 0;
}

/* -------------------------------------------------- numbers to nodes -- */

/* Nodes mostly have consecutive numbers: eight of these are neighbours here
 * too, and the multiplier, 2^64 over the golden ratio, scatters the eights. */
static size_t first_place(const struct swc *swc, uint64_t number)
{
    const uint64_t scattered = (number >> 3) * 0x9e3779b97f4a7c15u;
    return (size_t)(scattered >> (64 - swc->bits) & ~(uint64_t)7) |
           (size_t)(number & 7);
}

/* The place of this number, or the free one where it belongs. */
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

/* Twice the room: at least half of the places stay free. */
static int grow(struct swc *swc)
{
    const int bits = swc->bits > 0 ? swc->bits + 1 : 12;
    const size_t room = (size_t)1 << (bits - 1);
    if (room > SIZE_MAX / sizeof *swc->nodes) {
        return out_of_memory();
    }
    struct swc_node *nodes = realloc(swc->nodes, room * sizeof *nodes);
    if (!nodes) {
        return out_of_memory();
    }
    swc->nodes = nodes;
    size_t *places = calloc(2 * room, sizeof *places);
    if (!places) {
        return out_of_memory();
    }
    free(swc->places);
    swc->places = places;
    swc->bits = bits;
    swc->room = room;
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

/* Where reading has come to, and what went wrong. */
struct reader {
    const char *p, *end;
    struct fault *fault;
};

static const char *end_of_field(const struct reader *r)
{
    const char *p = r->p;
    while (p < r->end && !is_blank(*p)) {
        p++;
    }
    return p;
}

static void skip_field(struct reader *r)
{
    r->p = skip_blanks(end_of_field(r), r->end);
}

static int refuse(struct reader *r, const char *what, int expected)
{
    *r->fault = (struct fault){
        .what = what, .expected = expected, .at = r->p, .end = end_of_field(r)};
    return 0;
}

static int read_whole(struct reader *r, uint64_t *number, const char *expected)
{
    const char *end = end_of_field(r);
    const char *p = r->p;
    *number = 0;
    while (p < end && end - p > DIGITS_MOST && *p == '0') {
        p++;
    }
    const int fits = p < end && end - p <= DIGITS_MOST;
    while (p < end && *p >= '0' && *p <= '9') {
        *number = 10 * *number + (uint64_t)(*p++ - '0');
    }
    if (!fits || p < end) {
        return refuse(r, expected, 1);
    }
    r->p = skip_blanks(end, r->end);
    return 1;
}

static int read_parent(struct reader *r, uint64_t *parent)
{
    const char *end = end_of_field(r);
    if (end - r->p == 2 && memcmp(r->p, "-1", 2) == 0) {
        *parent = NO_PARENT;
        return 1;
    }
    return read_whole(r, parent, "a node's number or -1");
}

/* Decimal, as all that reads SWC understands it. */
static int read_decimal(struct reader *r, double *value)
{
    const char *end = end_of_field(r);
    const char *after = cylint_read_number(r->p, r->end, value);
    if (after != end || memchr(r->p, 'x', (size_t)(end - r->p)) ||
        memchr(r->p, 'X', (size_t)(end - r->p))) {
        return refuse(r, "a number", 1);
    }
    if (*value - *value != 0) {
        return refuse(r, "number too large", 0);
    }
    r->p = skip_blanks(end, r->end);
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
    skip_field(&r); /* the type */
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

static int say_fault(struct block *b, unsigned long long line, const char *text,
                     const struct fault *fault)
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
        return say_fault(b, line, text, &fault);
    }
    if (swc->count == swc->room) {
        const int status = grow(swc);
        if (status != 0) {
            return status;
        }
    }
    size_t *place = find_place(swc, node.number);
    if (*place > 0) {
        struct reader r = {skip_blanks(text, end), end, &fault};
        refuse(&r, "this node was given before", 0);
        return say_fault(b, line, text, &fault);
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

/* --------------------------------------------------------------- frusta -- */

static int lost_parent(const struct swc_node *node, const char *name)
{
    struct note note = {.line = node->line, .column = node->column};
    snprintf(note.text, sizeof note.text, "no node %llu to be the parent",
             (unsigned long long)node->parent);
    print_note(&note, name);
    return EXIT_BAD;
}

static void say_skipped(size_t count, const char *lack, const char *name)
{
    char what[80];
    if (count > 0) {
        snprintf(what, sizeof what, "%llu edge%s of no %s skipped",
                 (unsigned long long)count, count == 1 ? "" : "s", lack);
        complain(name, what);
    }
}

static int add_frustum(struct scene *scene, const struct swc_node *node,
                       const struct swc_node *parent, int ends)
{
    char number[DIGITS_MOST + 1];
    struct text label = {number, 0};
    struct record record;
    cylint_cone(&record.shape, node->centre, node->radius, parent->centre,
                parent->radius,
                ends == NOT_GIVEN ? CYLINT_ENDS_CAPPED : (cylint_ends)ends);
    put_whole(&label, node->number);
    record.tail = number;
    record.tail_length = label.length;
    return scene_add(scene, &record);
}

static int same_place(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

int swc_add_frusta(struct swc *swc, struct scene *scene, int ends,
                   const char *name)
{
    size_t without_length = 0, without_radius = 0;
    int status = 0;
    for (size_t i = 0; i < swc->count && status == 0; i++) {
        const struct swc_node *node = &swc->nodes[i];
        if (node->parent == NO_PARENT) {
            continue;
        }
        const size_t place = *find_place(swc, node->parent);
        if (place == 0) {
            return lost_parent(node, name);
        }
        const struct swc_node *parent = &swc->nodes[place - 1];
        if (same_place(node->centre, parent->centre)) {
            without_length++;
        } else if (node->radius == 0 && parent->radius == 0) {
            without_radius++;
        } else {
            status = add_frustum(scene, node, parent, ends);
        }
    }
    say_skipped(without_length, "length", name);
    say_skipped(without_radius, "radius", name);
    return status;
}
