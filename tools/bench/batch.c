/*
 * batch.c - time of the batch functions, and the limits of the processor
 *
 *     batch [SECONDS] [MOST] [PART]
 *
 * Writes CSV.  Each row has the ns of a test (one line against one shape) and
 * the ns of the plain quadratic, or for round kinds of the prepared formula of
 * lean.h, which answers the same tests one by one in the same race.  SECONDS is
 * the longest time of a large race, MOST the largest number of shapes, PART one
 * of these parts (default: all):
 *
 *   core      the processor: ns a result of independent divisions and roots
 *   cache     512 shapes or lines, by kind, arrangement and share of hits
 *   growth    one line against 1, 2, 4, ... shapes, and the time of reading
 *             the bytes that the first pass reads
 *   families  pairs, 16 x 256 cases of each family, both t
 *   drawing   pairs on an integer grid, and exact tangents only
 *   bytes     bytes of memory a shape
 */
#include "batch_parts.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch_core.h"

/* 512 questions, so that the processor cannot memorise the outcomes of the
 * branches from turn to turn. */
enum { CACHED = 512, RUNNERS = 300, ROUNDS = 1000 };

static void print_header(void)
{
    puts("part,kernels,shapes,arrangement,query,n,hits_percent,"
         "reached_percent,undecided_percent,ns,plain_ns,single_ns");
}

void print_row(const struct row *r)
{
    printf("%s,%s,%s,%s,%s,%zu,%.3g,%.3g,%.3g,%.4g,%.4g,%.4g\n", r->part,
           r->kernels, r->shapes, r->arrangement, r->query, r->n, r->hits,
           r->reached, r->undecided, r->ns, r->plain, r->single);
}

const struct row no_row = {"-", "-", "-", "-", "-", 1,
                           NAN, NAN, NAN, NAN, NAN, NAN};

/* ----------------------------------------------------------- the core -- */

static void measure_core(double seconds)
{
    static const char *const names[CORE_WORKS] = {"divide", "root"};
    struct core_turn turns[8];
    struct runner runners[8];
    int n = 0;
    for (int k = 0; core_width(k) != 0; k++)
        for (int work = 0; work < CORE_WORKS; work++, n++) {
            turns[n] = (struct core_turn){core_width(k), (enum core_work)work};
            runners[n] = (struct runner){core_turn, &turns[n], {0, 0}};
        }
    race(runners, n, 16, ROUNDS, seconds / 4);
    for (int i = 0; i < n; i++) {
        char width[16];
        struct row r = no_row;
        snprintf(width, sizeof width, "%d bits", turns[i].width);
        r.part = "core";
        r.kernels = width;
        r.query = names[turns[i].work];
        r.ns = runners[i].least.ns / CORE_RESULTS;
        print_row(&r);
    }
}

/* ----------------------------------------------------------- in cache -- */

static const struct {
    int kind;
    const char *name;
} kinds[] = {{CYLINT_KIND_CYLINDER, "cylinder"},
             {CYLINT_KIND_CONE, "cone"},
             {CYLINT_KIND_ECYLINDER, "elliptic cylinder"},
             {CYLINT_KIND_SPHERE, "sphere"},
             {CYLINT_KIND_CAPSULE, "capsule"},
             {CYLINT_KIND_RCONE, "rounded cone"}};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

struct cache_race {
    struct scene scenes[KINDS];
    struct turn turns[RUNNERS];
    struct runner runners[RUNNERS];
    int n;
};

static void add_turn(struct cache_race *r, const struct turn *t)
{
    r->turns[r->n] = *t;
    r->runners[r->n] = (struct runner){batch_turn, &r->turns[r->n], {0, 0}};
    r->n++;
}

/* The plain quadratic has no elliptic shapes. */
static void add_all_turns(struct cache_race *r, int kind, int away)
{
    const struct scene *s = &r->scenes[kind];
    for (int k = -1; k < kernels_count(); k++)
        for (int a = 0; a < ARRANGEMENTS; a++)
            for (int query = 0; query < QUERIES; query++) {
                const struct turn t = {s, away ? s->away : s->lines,
                                       k < 0 ? NULL : cylint_kernels_name(k),
                                       (enum arrangement)a, (enum query)query};
                if ((a != ONE_LINE && (query < QUERY_RELATIONS || away)) ||
                    (k < 0 && !scene_has_rival(s)))
                    continue;
                add_turn(r, &t);
            }
}

static int kind_of(const struct cache_race *r, const struct turn *t)
{
    return (int)(t->scene - r->scenes);
}

/* ns a test of the plain quadratic for the same query; NaN if not measured. */
static double plain_of(const struct cache_race *r, const struct turn *t)
{
    for (int i = 0; i < r->n; i++) {
        const struct turn *p = &r->turns[i];
        if (!p->kernels && p->scene == t->scene && p->query == t->query &&
            p->arrangement == t->arrangement)
            return r->runners[i].least.ns / (double)turn_tests(p);
    }
    return NAN;
}

static void print_cached(const struct cache_race *race)
{
    double hits = NAN, reached = NAN;
    for (int i = 0; i < race->n; i++) {
        const struct turn *t = &race->turns[i];
        struct row r = no_row;
        if (i == 0 || t->scene != t[-1].scene ||
            t->arrangement != t[-1].arrangement)
            turn_shares(t, CACHED, &hits, &reached);
        if (!t->kernels)
            continue;
        r.part = "cache";
        r.kernels = t->kernels;
        r.shapes = kinds[kind_of(race, t)].name;
        r.arrangement = arrangement_name(t->arrangement);
        r.query = query_name(t->query);
        r.n = turn_tests(t);
        r.hits = hits;
        r.reached = reached;
        r.ns = race->runners[i].least.ns / (double)r.n;
        r.plain = plain_of(race, t);
        print_row(&r);
    }
    fflush(stdout);
}

/* share: the share of hits.  For 0 the lines miss everything. */
static void measure_share(struct cache_race *r, double share, double seconds)
{
    r->n = 0;
    for (int k = 0; k < KINDS; k++) {
        scene_allocate(&r->scenes[k], CACHED, CACHED);
        scene_scatter(&r->scenes[k], kinds[k].kind,
                      scene_radius(kinds[k].kind, share > 0 ? share : 0.1));
        add_all_turns(r, k, share == 0);
    }
    race(r->runners, r->n, CACHED, ROUNDS, seconds);
    print_cached(r);
    for (int k = 0; k < KINDS; k++)
        scene_free(&r->scenes[k]);
}

static void measure_cache(double seconds)
{
    static const double shares[] = {0, 0.01, 0.1, 0.5};
    struct cache_race *r = malloc(sizeof *r);
    if (!r) {
        fputs("bench: out of memory\n", stderr);
        exit(4);
    }
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++)
        measure_share(r, shares[i], seconds);
    free(r);
}

/* ------------------------------------------------------------- growth -- */

/* The first pass reads the bounding ball of a shape: 4 doubles. */
enum { FIRST_PASS = 4 * sizeof(double), GROWTH_LINES = 512, TESTS = 1 << 20 };

static int lines_for(size_t n)
{
    return n > TESTS / 2              ? 2
           : n < TESTS / GROWTH_LINES ? GROWTH_LINES
                                      : (int)(TESTS / n);
}

static void print_growth(const struct runner *runner, const char *kernels,
                         const char *query, size_t n, double plain)
{
    struct row r = no_row;
    r.part = "growth";
    r.kernels = kernels;
    r.shapes = "cylinder";
    r.arrangement = arrangement_name(ONE_LINE);
    r.query = query;
    r.n = n;
    r.ns = runner->least.ns / (double)n;
    r.plain = plain;
    print_row(&r);
}

/* Races over n shapes: `nearest` at 1 % hits, `any` at 0 % hits, and reading
 * the bytes of the first pass. */
static void measure_size(struct scene *s, size_t n, double seconds)
{
    struct turn turns[40];
    struct runner runners[40];
    struct read_turn bytes = {s->pack.memory, n * FIRST_PASS};
    int k = 0;
    scene_use_first(s, n);
    for (int i = -1; i < kernels_count(); i++)
        for (int any = 0; any < 2; any++, k++) {
            turns[k] = (struct turn){s, any ? s->away : s->lines,
                                     i < 0 ? NULL : cylint_kernels_name(i),
                                     ONE_LINE, any ? QUERY_ANY : QUERY_NEAREST};
            runners[k] = (struct runner){batch_turn, &turns[k], {0, 0}};
        }
    runners[k] = (struct runner){read_turn, &bytes, {0, 0}};
    race(runners, k + 1, lines_for(n), ROUNDS, seconds);
    for (int i = 0; i < k; i++)
        print_growth(&runners[i],
                     turns[i].kernels ? turns[i].kernels : "plain quadratic",
                     query_name(turns[i].query), n,
                     runners[i % 2].least.ns / (double)n);
    print_growth(&runners[k], "reading", "read", n, NAN);
    fflush(stdout);
}

static void measure_growth(size_t most, double seconds)
{
    struct scene s;
    scene_allocate(&s, most, GROWTH_LINES);
    scene_scatter(&s, CYLINT_KIND_CYLINDER,
                  scene_radius(CYLINT_KIND_CYLINDER, 0.01));
    for (size_t n = 1; n < most; n *= n < 64 ? 2 : 4)
        measure_size(&s, n, seconds);
    measure_size(&s, most, seconds);
    scene_free(&s);
}

static void print_bytes(void)
{
    struct row r = no_row;
    r.part = "bytes";
    r.shapes = "as made";
    r.ns = sizeof(cylint_shape);
    print_row(&r);
    r.shapes = "packed";
    r.ns = (double)(cylint_pack_bytes(1000001) - cylint_pack_bytes(1)) / 1e6;
    print_row(&r);
    r.shapes = "read by the first pass";
    r.ns = FIRST_PASS;
    print_row(&r);
}

static int wanted(const char *part, const char *name)
{
    return !part || !strcmp(part, name);
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 4;
    const size_t most = argc > 2 ? (size_t)atof(argv[2]) : 4000000;
    const char *part = argc > 3 ? argv[3] : NULL;
    timing_begin();
    print_header();
    if (wanted(part, "bytes"))
        print_bytes();
    if (wanted(part, "core"))
        measure_core(seconds);
    if (wanted(part, "cache"))
        measure_cache(seconds);
    if (wanted(part, "families"))
        measure_families(seconds / 8);
    if (wanted(part, "drawing"))
        measure_drawings(seconds / 2);
    if (wanted(part, "growth"))
        measure_growth(most, seconds / 8);
    return 0;
}
