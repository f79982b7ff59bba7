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

/*
 * What auto does.  A hierarchy answers sooner than a batch from PAYS_FROM
 * shapes on, but takes about as long to be made, loading Embree included, as
 * PAYS_AFTER lines take by batches: 1.3 to 2.4 microseconds a shape against
 * some 0.9 ns a shape and line (make bench-scene).  Who goes by batches until
 * then and builds it then needs at most about twice the time that the better
 * way would have taken, however many lines there will be.
 */
enum { PAYS_FROM = 64, PAYS_AFTER = 2048 };

/* The hierarchy, which one of the threads may still be making. */
struct tree {
    const struct hierarchy *by;
    cylint_scene *scene; /* NULL: not there yet, or never */
    size_t asked;        /* lines, before it was there */
};

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

static int make_pack(struct search *s)
{
    s->memory = malloc(cylint_pack_bytes(s->count));
    if (!s->memory) {
        return out_of_memory();
    }
    cylint_pack_shapes(&s->pack, s->memory, s->shapes, s->count);
    return 0;
}

/* Returns an exit status; *why, if it is not 0. */
static int make_scene(const struct search *s, const char **why)
{
    cylint_scene_status status;
    struct tree *tree = s->tree;
    tree->by = load_hierarchy(why);
    if (!tree->by) {
        return EXIT_USAGE;
    }
    cylint_scene *scene = tree->by->make(s->shapes, s->count, s->threads,
                                         &status);
    *why = tree->by->error((int)status);
    __atomic_store_n(&tree->scene, scene, __ATOMIC_RELEASE);
    return scene ? 0
        : status == CYLINT_SCENE_EMEMORY ? EXIT_MEMORY : EXIT_USAGE;
}

int search_make(struct search *s, const cylint_shape *shapes, size_t count,
                enum accel accel, int threads)
{
    memset(s, 0, sizeof *s);
    s->shapes = shapes;
    s->count = count;
    s->threads = threads;
    if (accel == ACCEL_EMBREE || (accel == ACCEL_AUTO && count >= PAYS_FROM
                                  && search_has_embree())) {
        s->tree = calloc(1, sizeof *s->tree);
        if (!s->tree) {
            return out_of_memory();
        }
    }
    if (accel == ACCEL_EMBREE) {
        const char *why;
        const int status = make_scene(s, &why);
        if (status != 0) {
            complain("--accel=embree", why);
        }
        return status;
    }
    return make_pack(s);
}

void search_free(struct search *s)
{
    if (s->tree && s->tree->scene) {
        s->tree->by->release(s->tree->scene);
    }
    free(s->tree);
    free(s->memory);
    memset(s, 0, sizeof *s);
}

/* The hierarchy, if it is there. */
static const cylint_scene *scene_of(const struct search *s)
{
    return s->tree ? __atomic_load_n(&s->tree->scene, __ATOMIC_ACQUIRE)
                   : NULL;
}

/* The same; one line more is to be asked.  The thread that asks the one that
 * makes it pay makes it, while the others go on by batches. */
static const cylint_scene *scene_for_line(const struct search *s)
{
    const cylint_scene *scene = scene_of(s);
    const char *why; /* does not matter: batches will do */
    if (s->tree && !scene
        && __atomic_add_fetch(&s->tree->asked, 1, __ATOMIC_RELAXED)
           == PAYS_AFTER) {
        make_scene(s, &why);
        scene = scene_of(s);
    }
    return scene;
}

size_t search_nearest(const struct search *s, const cylint_line *line)
{
    const cylint_scene *scene = scene_for_line(s);
    cylint_hit hit;
    return scene ? s->tree->by->nearest(scene, line, 0, &hit)
        : cylint_nearest(&s->pack, line, 0, &hit);
}

size_t search_count(const struct search *s, const cylint_line *line,
                    size_t enough)
{
    const cylint_scene *scene = scene_for_line(s);
    return scene ? s->tree->by->count(scene, line, enough)
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
    const cylint_scene *scene = first == 0 ? scene_for_line(s) : scene_of(s);
    if (scene) {
        return s->tree->by->all(scene, line, first, numbers, room);
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
