/*
 * solids.c - the solids of a scene that are made of shapes: in=NAME, out=NAME
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "main.h"
#include "message.h"
#include "report.h"
#include "solids.h"
#include "text.h"

enum {
    CLAUSE_MOST = 1000000000, /* clauses without a number follow the others */
    NAME_SHOWN = 32
};

/* Returns an array with space for one more element, or NULL.  At least doubles
 * the capacity if there is none. */
static void *grown(void *array, size_t count, size_t *capacity, size_t size)
{
    if (count < *capacity)
        return array;
    const size_t more = *capacity > 0 ? 2 * *capacity : 64;
    void *larger = more <= SIZE_MAX / size ? realloc(array, more * size) : NULL;
    if (larger)
        *capacity = more;
    return larger;
}

int solids_add(struct solids *s, const cylint_member *member)
{
    cylint_member *more =
        grown(s->member, s->count, &s->capacity, sizeof *s->member);
    if (!more)
        return out_of_memory();
    s->member = more;
    s->member[s->count++] = *member;
    return 0;
}

void solids_free(struct solids *s)
{
    free(s->member);
    free(s->name);
    free(s->bytes);
    free(s->bucket);
    memset(s, 0, sizeof *s);
}

/* -------------------------------------------------------------- names -- */

static size_t hash(const char *text, size_t length)
{
    uint64_t h = 14695981039346656037u; /* FNV-1a */
    for (size_t i = 0; i < length; i++)
        h = (h ^ (unsigned char)text[i]) * 1099511628211u;
    return (size_t)(h ^ h >> 32);
}

/* The bucket that has the name, or the empty one where it belongs. */
static size_t *bucket_of(const struct solids *s, const char *text,
                         size_t length)
{
    size_t i = hash(text, length) & (s->buckets - 1);
    for (; s->bucket[i] > 0; i = (i + 1) & (s->buckets - 1)) {
        const struct solid_name *n = &s->name[s->bucket[i] - 1];
        if (n->length == length &&
            memcmp(s->bytes + n->begin, text, length) == 0)
            break;
    }
    return &s->bucket[i];
}

/* Keeps at least half of the buckets empty.  Returns 0 if there is no memory. */
static int grow_buckets(struct solids *s)
{
    if (2 * (s->names + 1) <= s->buckets)
        return 1;
    const size_t buckets = s->buckets > 0 ? 2 * s->buckets : 64;
    size_t *bucket = calloc(buckets, sizeof *bucket);
    if (!bucket)
        return 0;
    free(s->bucket);
    s->bucket = bucket;
    s->buckets = buckets;
    for (size_t i = 0; i < s->names; i++) {
        const struct solid_name *n = &s->name[i];
        *bucket_of(s, s->bytes + n->begin, n->length) = i + 1;
    }
    return 1;
}

/* Returns 0 if there is no memory. */
static int store_name(struct solids *s, const char *text, size_t length)
{
    struct solid_name *name =
        grown(s->name, s->names, &s->names_capacity, sizeof *s->name);
    if (!name)
        return 0;
    s->name = name;
    while (s->bytes_capacity - s->length < length) {
        char *bytes = grown(s->bytes, s->bytes_capacity, &s->bytes_capacity, 1);
        if (!bytes)
            return 0;
        s->bytes = bytes;
    }
    memcpy(s->bytes + s->length, text, length);
    s->name[s->names++] = (struct solid_name){s->length, length};
    s->length += length;
    return 1;
}

/* Writes the number of the solid with this name.  Returns 0, or an exit status
 * after a message. */
static int find_solid(struct solids *s, const char *text, size_t length,
                      size_t *solid)
{
    if (!grow_buckets(s))
        return out_of_memory();
    size_t *bucket = bucket_of(s, text, length);
    if (*bucket == 0) {
        if (!store_name(s, text, length))
            return out_of_memory();
        *bucket = s->names;
    }
    *solid = *bucket - 1;
    return 0;
}

/* -------------------------------------------------------------- words -- */

static int refuse(struct fault *fault, const char *what, int expected,
                  const char *at, const char *end)
{
    *fault = (struct fault){
        .what = what, .expected = expected, .at = at, .end = end};
    return EXIT_BAD;
}

/* Reads an integer from 1 to CLAUSE_MOST, or returns 0. */
static int read_clause(const char *p, const char *end)
{
    int clause = 0;
    for (; p < end; p++) {
        if (*p < '0' || *p > '9' || clause > CLAUSE_MOST / 10 - 1)
            return 0;
        clause = 10 * clause + (*p - '0');
    }
    return clause;
}

/* Reads the word [text, end): in=NAME or out=NAME, perhaps with /CLAUSE. */
static int read_word_of_solid(struct solids *s, size_t shape, const char *text,
                              const char *end, struct fault *fault)
{
    const int is_out = *text == 'o';
    const char *name = text + strlen(is_out ? OUT_WORD : IN_WORD);
    const char *slash = memchr(name, '/', (size_t)(end - name));
    const char *name_end = slash ? slash : end;
    int clause = is_out ? 0 : 1;
    cylint_member member = {.shape = shape};
    if (name_end == name) {
        return refuse(fault,
                      is_out ? "out= without a name" : "in= without a name", 0,
                      text, end);
    }
    if (memchr(name, '=', (size_t)(name_end - name))) {
        return refuse(fault, "the name of a solid has no '='", 0, name,
                      name_end);
    }
    if (slash && (clause = read_clause(slash + 1, end)) == 0) {
        return refuse(fault, "a clause, an integer from 1 to 999999999", 1,
                      slash + 1, end);
    }
    if (clause > s->last_clause)
        s->last_clause = clause;
    member.clause = is_out ? -clause : clause;
    const int status =
        find_solid(s, name, (size_t)(name_end - name), &member.solid);
    return status != 0 ? status : solids_add(s, &member);
}

int solids_read(struct solids *s, size_t shape, const char *words,
                size_t length, struct fault *fault)
{
    const char *const end = words + length;
    int status = 0;
    for (const char *p = words; p < end && status == 0;) {
        const char *after = field_end(p, end);
        status = read_word_of_solid(s, shape, p, after, fault);
        p = skip_separator(after, end);
    }
    return status;
}

/* -------------------------------------------------------------- scene -- */

/* Writes the number that the library gives to each solid. */
static void number_solids(const struct solids *s, size_t *number)
{
    for (size_t i = 0; i < s->names; i++)
        number[i] = SIZE_MAX;
    for (int is_complement = 0; is_complement < 2; is_complement++) {
        for (size_t i = 0; i < s->count; i++) {
            const cylint_member *m = &s->member[i];
            if (number[m->solid] == SIZE_MAX &&
                (m->clause < 0) == is_complement)
                number[m->solid] = m->shape; /* shapes ascend */
        }
    }
}

static void show_name(const struct solids *s, size_t solid,
                      char shown[4 * NAME_SHOWN + 4])
{
    const char *name = s->bytes + s->name[solid].begin;
    escape_bytes(shown, name, name + s->name[solid].length, NAME_SHOWN);
}

/* Names two solids that have the same number. */
static void complain_of_numbers(const struct solids *s, const size_t *number,
                                size_t *solid_at)
{
    for (size_t i = 0; i < s->names; i++) {
        const size_t other = solid_at[number[i]];
        if (other > 0) {
            char a[4 * NAME_SHOWN + 4], b[4 * NAME_SHOWN + 4], text[512];
            struct text t = {text, 0};
            show_name(s, other - 1, a);
            show_name(s, i, b);
            put_string(&t, "the solids '");
            put_string(&t, a);
            put_string(&t, "' and '");
            put_string(&t, b);
            put_string(&t, "' have the same first shape, number ");
            put_whole(&t, number[i] + 1);
            put_string(&t, "; write that shape twice, once for each solid");
            put_char(&t, '\0');
            complain(s->file, text);
            return;
        }
        solid_at[number[i]] = i + 1;
    }
}

static int refuse_numbers(const struct solids *s, size_t shapes)
{
    size_t *number = malloc((s->names + 1) * sizeof *number);
    size_t *solid_at = calloc(shapes + 1, sizeof *solid_at);
    int status = EXIT_BAD;
    if (number && solid_at) {
        number_solids(s, number);
        complain_of_numbers(s, number, solid_at);
    } else {
        status = out_of_memory();
    }
    free(number);
    free(solid_at);
    return status;
}

void solids_complete(struct solids *s)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->member[i].clause == 0)
            s->member[i].clause = -++s->last_clause;
}

int solids_give(struct solids *s, cylint_scene *scene)
{
    solids_complete(s);
    const cylint_scene_status status =
        cylint_scene_set_solids(scene, s->member, s->count);
    if (status == CYLINT_SCENE_OK)
        return 0;
    if (status == CYLINT_SCENE_EMEMORY)
        return out_of_memory();
    if (status == CYLINT_SCENE_ESOLID)
        return refuse_numbers(s, cylint_scene_size(scene));
    complain(s->file, cylint_scene_strerror((int)status));
    return EXIT_BAD;
}
