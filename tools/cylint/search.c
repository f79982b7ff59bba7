/*
 * search.c - how the shapes that a line hits are found among all
 */
#ifdef CYLINT_EMBREE
#include <dlfcn.h>
#endif
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "hierarchy.h"
#include "main.h"
#include "report.h"
#include "search.h"

const char *const accel_words[] = {"auto", "none", "embree", NULL};

/* From so many shapes on a hierarchy answers a line sooner than a batch
 * (make bench-scene), and is built in less time than the shapes are read. */
enum { PAYS_FROM = 256 };

#ifdef CYLINT_EMBREE

int search_has_embree(void)
{
    return 1;
}

/* NULL: *why says what is in the way. */
static const struct hierarchy *load_hierarchy(const char **why)
{
    void *module = dlopen(HIERARCHY_MODULE, RTLD_NOW | RTLD_LOCAL);
    const struct hierarchy *found = module
        ? dlsym(module, HIERARCHY_SYMBOL) : NULL;
    *why = found ? NULL : dlerror();
    return found;
}

#else

int search_has_embree(void)
{
    return 0;
}

static const struct hierarchy *load_hierarchy(const char **why)
{
    *why = "not built in";
    return NULL;
}

#endif

static int make_pack(struct search *s, const cylint_shape *shapes)
{
    s->memory = malloc(cylint_pack_bytes(s->count));
    if (!s->memory) {
        return out_of_memory();
    }
    cylint_pack_shapes(&s->pack, s->memory, shapes, s->count);
    return 0;
}

/* Returns an exit status; *why, if it is not 0. */
static int make_tree(struct search *s, const cylint_shape *shapes,
                     int threads, const char **why)
{
    cylint_scene_status status;
    s->by = load_hierarchy(why);
    if (!s->by) {
        return EXIT_USAGE;
    }
    s->tree = s->by->make(shapes, s->count, threads, &status);
    *why = s->by->error(status);
    return s->tree ? 0
        : status == CYLINT_SCENE_EMEMORY ? EXIT_MEMORY : EXIT_USAGE;
}

int search_make(struct search *s, const cylint_shape *shapes, size_t count,
                enum accel accel, int threads)
{
    memset(s, 0, sizeof *s);
    s->count = count;
    if (accel == ACCEL_EMBREE || (accel == ACCEL_AUTO && count >= PAYS_FROM)) {
        const char *why;
        const int status = make_tree(s, shapes, threads, &why);
        if (status != 0 && accel == ACCEL_EMBREE) {
            complain("--accel=embree", why);
            return status;
        }
    }
    return s->tree ? 0 : make_pack(s, shapes);
}

void search_free(struct search *s)
{
    if (s->tree) {
        s->by->release(s->tree);
    }
    free(s->memory);
    memset(s, 0, sizeof *s);
}

size_t search_nearest(const struct search *s, const cylint_line *line)
{
    cylint_hit hit;
    return s->tree ? s->by->nearest(s->tree, line, 0, &hit)
        : cylint_nearest(&s->pack, line, 0, &hit);
}

size_t search_count(const struct search *s, const cylint_line *line,
                    size_t enough)
{
    return s->tree ? s->by->count(s->tree, line, enough)
        : cylint_count(&s->pack, line, enough);
}

/* Most shapes are missed: look at eight at a time. */
static size_t next_hit(const signed char *n, size_t from, size_t count)
{
    uint64_t eight = 0;
    while (count - from >= sizeof eight) {
        memcpy(&eight, n + from, sizeof eight);
        if (eight != 0) {
            break;
        }
        from += sizeof eight;
    }
    while (from < count && n[from] == 0) {
        from++;
    }
    return from;
}

size_t search_hits(const struct search *s, const cylint_line *line,
                   signed char *hits, size_t first, size_t *numbers,
                   size_t room)
{
    size_t found = 0;
    if (s->tree) {
        return s->by->all(s->tree, line, first, numbers, room);
    }
    if (first == 0) {
        cylint_columns columns = {0};
        columns.n = hits;
        cylint_intersect_shapes(&s->pack, line, &columns);
    }
    for (size_t i = next_hit(hits, first, s->count);
         i < s->count && found < room; i = next_hit(hits, i + 1, s->count)) {
        numbers[found++] = i;
    }
    return found;
}
