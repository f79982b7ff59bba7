/*
 * swc.c - neurons in SWC: a frustum or a round cone from each node to its
 * parent
 *
 *   node = number type x y z radius parent
 *
 * Fields are separated by blanks, tabs and at most one comma; the type, and
 * what follows the parent, is ignored.  Parent -1, or a parent that is not in
 * the file, marks a root.  Parents may stand after their children, so the
 * shapes are made after all nodes were read.  Round cones join without gaps;
 * with them a root gives a sphere.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "input.h"
#include "numbers.h"
#include "scene.h"

#define NUMBER_MOST 999999999999999999u /* of a node: 18 digits */

#define NO_PARENT UINT64_MAX

struct swc_node {
    uint64_t number, parent;
    double ball[4];                  /* centre and radius */
    unsigned long long line, column; /* of the parent's number */
    size_t parent_index;             /* from 1; 0: a root */
    size_t path_start; /* the node whose path first came here, from 1; or 0 */
};

/* The nodes of a file, which become shapes of a scene. */
struct swc {
    struct scene *scene;
    struct swc_node *nodes; /* in the order of the file */
    size_t capacity;
    struct names numbers; /* of the nodes, in the same order; their bits */
    size_t skipped;       /* those that give no shape */
};

const char *const swc_forms[] = {
    [SWC_CONES] = "cones", [SWC_ROUND] = "round", NULL};

int swc_is_neuron(const char *file, int form)
{
    const size_t length = strlen(file);
    const char *last = file + length - (length < 4 ? length : 4);
    return strcmp(last, ".swc") == 0 || strcmp(last, ".SWC") == 0 ||
           form != NOT_GIVEN;
}

static size_t node_count(const struct swc *swc)
{
    return swc->numbers.texts.count;
}

static struct string bits_of(const uint64_t *number)
{
    return (struct string){(const char *)number, sizeof *number};
}

/* ------------------------------------------------------------- one node -- */

/* Multiplies by a power of ten.  Returns 0 if the product has above 18 digits. */
static int shift_digits(uint64_t *number, double places)
{
    for (; places > 0 && *number > 0; places--) {
        if (*number > NUMBER_MOST / 10)
            return 0;
        *number *= 10;
    }
    return 1;
}

/* Reads the size of a field, exactly, if it is a decimal number that is whole and
 * has at most 18 digits behind leading zeros.  Returns its end, or NULL. */
static const char *read_size(const struct reader *r, uint64_t *size)
{
    double exponent;
    int zeros = 0, places = 0, is_behind_point = 0;
    const char *const after = end_of_number(r->p, r->end, &exponent), *p = r->p;
    if (!after)
        return NULL;
    *size = 0;
    for (; p < after && (*p | 0x20) != 'e'; p++) {
        is_behind_point |= *p == '.';
        if ((*p | 0x20) == 'x')
            return NULL;
        if (!is_digit(*p))
            continue;
        places += is_behind_point;
        zeros++;
        if (*p != '0') {
            if (!shift_digits(size, zeros))
                return NULL;
            *size += (uint64_t)(*p - '0');
            zeros = 0;
        }
    }
    exponent = 0;
    if (p < after)
        cylint_read_number(p + 1, after, &exponent);
    exponent += zeros - places;
    return (exponent >= 0 || *size == 0) && shift_digits(size, exponent) ? after
                                                                         : NULL;
}

/* The number of a node, or of its parent, which may be -1. */
static int read_node_number(struct reader *r, int is_parent, uint64_t *number)
{
    const char *const after = read_size(r, number);
    const int is_negative = *r->p == '-';
    if (!after || (is_negative && !(is_parent && *number == 1)))
        return refuse_other_field(r, is_parent ? "a node's number or -1"
                                               : "a node's number");
    if (is_negative)
        *number = NO_PARENT;
    skip_to(r, after);
    return 0;
}

static int read_radius(struct reader *r, double *radius)
{
    struct reader at = *r;
    return read_numbers(r, radius, 1) ||
           (*radius < 0 && refuse_field(&at, "negative radius"));
}

/* Reads the node of a line, from its first field on. */
static int read_node(struct reader *r, struct swc_node *node)
{
    if (read_node_number(r, 0, &node->number))
        return EXIT_BAD;
    skip_field(r); /* the type */
    if (read_numbers(r, node->ball, 3) || read_radius(r, &node->ball[3]))
        return EXIT_BAD;
    node->line = r->notes->line;
    node->column = (unsigned long long)(r->p - r->notes->text) + 1;
    return read_node_number(r, 1, &node->parent);
}

/* Adds the node of a line. */
static int add_node(void *context, const char *text, const char *end,
                    struct notes *notes)
{
    struct swc *swc = context;
    struct swc_node node = {0};
    struct reader r, first;
    const size_t count = node_count(swc);
    size_t index;
    if (begin_line(&r, text, end, notes))
        return EXIT_BAD;
    first = r;
    if (read_node(&r, &node))
        return EXIT_BAD;
    struct swc_node *nodes =
        grown(swc->nodes, count, &swc->capacity, sizeof *nodes);
    if (!nodes)
        return out_of_memory();
    swc->nodes = nodes;
    remark_decimal_comma(&r);
    if (!names_add(&swc->numbers, bits_of(&node.number), &index))
        return out_of_memory();
    if (index < count)
        return refuse_field(&first, "this node was given before");
    nodes[count] = node;
    return 0;
}

/* --------------------------------------------------------------- shapes -- */

static int refuse_cycle(const struct swc *swc, size_t index)
{
    const struct swc_node *node = &swc->nodes[index - 1];
    char text[80];
    snprintf(text, sizeof text,
             node->parent_index == index
                 ? "node %llu is its own parent"
                 : "the parents of node %llu form a cycle",
             (unsigned long long)node->number);
    return complain_at(swc->scene->file, node->line, node->column, text);
}

/* Follows the parents of each node to a root or to a node of an earlier path.  A
 * path that comes to a node of its own has a cycle. */
static int refuse_cycles(const struct swc *swc)
{
    for (size_t start = 1; start <= node_count(swc); start++) {
        size_t i = start;
        while (i > 0 && swc->nodes[i - 1].path_start == 0) {
            swc->nodes[i - 1].path_start = start;
            i = swc->nodes[i - 1].parent_index;
        }
        if (i > 0 && swc->nodes[i - 1].path_start == start)
            return refuse_cycle(swc, i);
    }
    return 0;
}

/* Sets the parents' indices.  Returns how many parents are missing. */
static size_t find_parents(const struct swc *swc)
{
    const size_t count = node_count(swc);
    size_t missing = 0;
    for (size_t i = 0; i < count; i++) {
        struct swc_node *node = &swc->nodes[i];
        if (node->parent != NO_PARENT) {
            const size_t found =
                names_find(&swc->numbers, bits_of(&node->parent));
            node->parent_index = found < count ? found + 1 : 0;
            missing += node->parent_index == 0;
        }
    }
    return missing;
}

static int is_same_place(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Whether the node gives a shape: it has a length, or is a ball, and a radius.  A
 * round cone without length is a ball.  parent: NULL for a root with SWC_ROUND. */
static int has_shape(const struct swc *swc, const struct swc_node *node,
                     const struct swc_node *parent)
{
    const int has_length = swc->scene->swc_form == SWC_ROUND ||
                           !is_same_place(node->ball, parent->ball);
    return has_length && (node->ball[3] > 0 || (parent && parent->ball[3] > 0));
}

/* parent: NULL for a root. */
static int add_shape(const struct swc *swc, const struct swc_node *node,
                     const struct swc_node *parent)
{
    char digits[24];
    struct text label = {digits, 0};
    struct record record;
    double number[8];
    const cylint_kind kind = !parent ? CYLINT_KIND_SPHERE
                             : swc->scene->swc_form == SWC_ROUND
                                 ? CYLINT_KIND_RCONE
                                 : CYLINT_KIND_CONE;
    memcpy(number, node->ball, sizeof node->ball);
    if (parent)
        memcpy(number + 4, parent->ball, sizeof parent->ball);
    const cylint_status status =
        shape_of_numbers(kind, swc->scene->ends, number, &record.shape);
    if (status != CYLINT_OK)
        return complain_at(swc->scene->file, node->line, 1,
                           cylint_strerror((int)status));
    put_whole(&label, node->number);
    record.tail = between(digits, digits + label.length);
    return scene_add(swc->scene, &record);
}

static int convert_node(struct swc *swc, const struct swc_node *node)
{
    const struct swc_node *parent =
        node->parent_index > 0 ? &swc->nodes[node->parent_index - 1] : NULL;
    if (!parent && swc->scene->swc_form != SWC_ROUND)
        return 0;
    if (has_shape(swc, node, parent))
        return add_shape(swc, node, parent);
    swc->skipped++;
    return 0;
}

/* After all nodes were read. */
static int add_shapes(struct swc *swc)
{
    if (node_count(swc) == 0)
        return complain(EXIT_BAD, swc->scene->file, "no node was found");
    const char *const file = swc->scene->file;
    const size_t missing = find_parents(swc);
    int status = refuse_cycles(swc);
    for (size_t i = 0; i < node_count(swc) && status == 0; i++)
        status = convert_node(swc, &swc->nodes[i]);
    if (status != 0)
        return status;
    if (missing > 0)
        complain(0, file, "roots whose parents are not in the file: %llu",
                 (unsigned long long)missing);
    if (swc->skipped > 0)
        complain(0, file, "nodes without a shape, of no length or radius: %llu",
                 (unsigned long long)swc->skipped);
    return 0;
}

int swc_read(struct scene *scene)
{
    struct swc swc = {.scene = scene};
    int status = read_lines(scene->file, 1, add_node, &swc);
    if (status == 0)
        status = add_shapes(&swc);
    free(swc.nodes);
    names_free(&swc.numbers);
    return status;
}
