/*
 * embree_counts.c - nodes, leaves, pieces and shapes that a ray visits
 *
 * usage: embree_counts MOST
 *
 * The scenes and rays of embree.c with an adapter that counts its visits.
 * Calls of the float filter and of cylint_intersect() are counted by wrappers
 * (linked with --wrap).
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "embree/float_filter.h"
#include "bvh/traverse.h"
#include "embree_rivals.h"

enum { RAYS = 100000 };

static struct {
    long shapes, exactly;
} counted;

static cylint_float_filter *filter;

static void count_questions(const cylint_float_filter_question of[], int n,
                            cylint_float_filter_answer to[])
{
    counted.shapes += n;
    filter(of, n, to);
}

cylint_float_filter *__real_cylint_float_filter_of_one(void);
cylint_float_filter *__wrap_cylint_float_filter_of_one(void);
cylint_float_filter *__wrap_cylint_float_filter_of_one(void)
{
    filter = __real_cylint_float_filter_of_one();
    return count_questions;
}

int __real_cylint_intersect(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *answer);
int __wrap_cylint_intersect(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *answer);
int __wrap_cylint_intersect(const cylint_shape *shape, const cylint_line *line,
                            unsigned want, cylint_answer *answer)
{
    counted.exactly++;
    return __real_cylint_intersect(shape, line, want, answer);
}

static void count(const struct cylinder_kind *kind, size_t n, enum form form)
{
    static const char *const names[] = {"cylinders", "cones", "rounded cones"};
    struct cylinders cylinders = draw_cones(kind, n, form);
    struct rival rival = build_shapes(&cylinders, 0, "threads=1");
    for (int camera = 0; camera < 2; camera++) {
        struct rays rays =
            camera ? draw_camera_rays(RAYS) : draw_incoherent_rays(RAYS);
        double t;
        memset(&counted, 0, sizeof counted);
        memset(&cylint_visits, 0, sizeof cylint_visits);
        trace_nearest(&rival, &rays, &t);
        const double n_rays = rays.n;
        printf("%s %s\t%zu\t%s\t%.2f\t%.2f\t%.2f\t%.2f\t%.4f\n", kind->name,
               names[form], n, camera ? "coherent" : "incoherent",
               (double)cylint_visits.nodes / n_rays,
               (double)cylint_visits.leaves / n_rays,
               (double)cylint_visits.lanes / n_rays,
               (double)counted.shapes / n_rays,
               (double)counted.exactly / n_rays);
        free_rays(&rays);
    }
    free_rival(&rival);
    free_cylinders(&cylinders);
}

int main(int argc, char **argv)
{
    const size_t most = argc > 1 ? (size_t)atof(argv[1]) : 1000000;
    puts("# visits a ray; fewer is better");
    printf("scene\tn\trays\tnodes/ray\tleaves/ray\tpieces/ray\tshapes/ray\t"
           "exactly/ray\n");
    for (size_t n = 1000; n <= most; n *= 10)
        count(&thin, n, CYLINDERS);
    for (size_t n = 1000; n <= most; n *= 1000)
        count(&fat, n, CYLINDERS);
    if (most >= 100000)
        count(&fibre, 100000, CYLINDERS);
    for (int form = CONES; form <= ROUND_CONES; form++) {
        count(&thin, most, form);
        count(&fat, most, form);
        count(&fibre, most < 100000 ? most : 100000, form);
    }
    return 0;
}
