/*
 * solids.c - the solids of a scene that are made of shapes: in=NAME, out=NAME
 */
#include <stdlib.h>
#include <string.h>

#include "scene.h"

enum { NAME_SHOWN = 32 };

int solids_add(struct solids *s, const cylint_member *member)
{
    cylint_member *larger =
        grown(s->member, s->count, &s->capacity, sizeof *s->member);
    if (!larger)
        return out_of_memory();
    s->member = larger;
    s->member[s->count++] = *member;
    return 0;
}

void solids_free(struct solids *s)
{
    free(s->member);
    names_free(&s->names);
    memset(s, 0, sizeof *s);
}

/* Reads a word in=NAME or out=NAME, perhaps with /CLAUSE. */
static int read_member(struct solids *s, struct string word,
                       cylint_member *member, struct notes *notes)
{
    const int is_out = *word.text == 'o';
    const char *begin = word.text + strlen(is_out ? OUT_WORD : IN_WORD);
    const char *slash = memchr(begin, '/', (size_t)(end_of(word) - begin));
    const struct string name = between(begin, slash ? slash : end_of(word));
    unsigned long long clause = is_out ? 0 : 1;
    if (name.length == 0)
        return refuse_text(
            notes, is_out ? "out= without a name" : "in= without a name", word);
    if (memchr(name.text, '=', name.length))
        return refuse_text(notes, "the name of a solid has no '='", name);
    if (slash &&
        (!read_whole(between(slash + 1, end_of(word)), CLAUSE_MOST, &clause) ||
         clause == 0))
        return refuse_other(notes, "/CLAUSE, an integer from 1 to 999999999",
                            between(slash, end_of(word)));
    member->clause = is_out ? -(int)clause : (int)clause;
    return names_add(&s->names, name, &member->solid) ? 0 : out_of_memory();
}

int solids_read(struct solids *s, size_t shape, struct string words,
                struct notes *notes)
{
    cylint_member member = {.shape = shape};
    int status = 0;
    while (words.length > 0 && status == 0) {
        status = read_member(s, take_field(&words), &member, notes);
        if (status == 0)
            status = solids_add(s, &member);
    }
    return status;
}

/* ------------------------------------------------------------- clauses -- */

int compare_by_solid(const void *a, const void *b)
{
    const cylint_member *m = a, *n = b;
    return m->solid != n->solid ? (m->solid > n->solid ? 1 : -1)
                                : abs(m->clause) - abs(n->clause);
}

/* Gives each clause of its own the number above all of its solid so far.  Returns 0
 * if there is no memory. */
static int number_clauses(struct solids *s)
{
    int *largest = calloc(s->names.texts.count + 1, sizeof *largest);
    if (!largest)
        return 0;
    for (size_t i = 0; i < s->count; i++) {
        const cylint_member *m = &s->member[i];
        if (abs(m->clause) > largest[m->solid])
            largest[m->solid] = abs(m->clause);
    }
    for (size_t i = 0; i < s->count; i++) {
        cylint_member *m = &s->member[i];
        if (m->clause == 0)
            m->clause = -++largest[m->solid];
    }
    free(largest);
    return 1;
}

/* ------------------------------------------------------ equal numbers -- */

/* Complements count behind all other shapes. */
size_t *solids_numbers(const struct solids *s)
{
    const size_t behind = SIZE_MAX / 2;
    size_t *number = calloc(s->count + 1, sizeof *number);
    for (size_t i = 0; i < s->count && number; i++) {
        const cylint_member *m = &s->member[i];
        const size_t rank = m->shape + 1 + (m->clause < 0 ? behind : 0);
        if (number[m->solid] == 0 || rank < number[m->solid])
            number[m->solid] = rank;
    }
    for (size_t i = 0; i < s->count && number; i++)
        number[i] -= number[i] > behind ? behind : 0;
    return number;
}

static int refuse_number(const struct solids *s, const char *file, size_t solid,
                         size_t other, size_t number)
{
    char a[SHOWN_CAPACITY], b[SHOWN_CAPACITY];
    return complain(EXIT_BAD, file,
                    "the solids '%s' and '%s' have the same first shape, "
                    "number %llu; write that shape twice, once for each solid",
                    escape(a, names_get(&s->names, solid), NAME_SHOWN),
                    escape(b, names_get(&s->names, other), NAME_SHOWN),
                    (unsigned long long)number);
}

/* Prints a message if the name of the first solid of complements only, which is
 * unbounded, may be another's with a typing error. */
static int remark_slip(const struct solids *s, const char *file)
{
    char shown[SHOWN_CAPACITY], meant[SHOWN_CAPACITY];
    const size_t count = s->names.texts.count;
    char *has_shape = calloc(count + 1, 1);
    size_t solid = 0;
    if (!has_shape)
        return out_of_memory();
    for (size_t i = 0; i < s->count; i++)
        has_shape[s->member[i].solid] |= s->member[i].clause > 0;
    while (has_shape[solid])
        solid++;
    size_t other = solid == count ? count : 0;
    while (other < count &&
           !(has_shape[other] &&
             is_near(names_get(&s->names, solid), names_get(&s->names, other))))
        other++;
    if (other < count)
        complain(0, file,
                 "the solid '%s' has complements only; did you mean %s?",
                 escape(shown, names_get(&s->names, solid), NAME_SHOWN),
                 escape(meant, names_get(&s->names, other), NAME_SHOWN));
    free(has_shape);
    return 0;
}

/* lint: out_of_memory() is not 0, so both arrays were allocated */
int solids_complete(struct solids *s, size_t shapes, const char *file)
{
    size_t *number = number_clauses(s) ? solids_numbers(s) : NULL;
    size_t *solid_of = calloc(shapes + 1, sizeof *solid_of); /* of a number */
    int status = number && solid_of ? 0 : out_of_memory();
    for (size_t i = 0; status == 0 && i < s->names.texts.count; i++) {
        size_t *other = &solid_of[number[i]];
        if (*other > 0)
            status = refuse_number(s, file, *other - 1, i, number[i]);
        *other = i + 1;
    }
    free(number);
    free(solid_of);
    return status != 0 ? status : remark_slip(s, file);
}
