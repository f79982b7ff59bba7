/*
 * distance_elliptic.c - one point and one elliptic shape
 *
 *     distance_elliptic [TURNS]
 *
 * 1024 different pairs of point and shape, half of them cones; nanoseconds a
 * question, the minimum of TURNS turns (20).
 * CSV: form of the shapes, place of the points, ns of cylint_distance(), of
 * cylint_safety(), mean of safety / distance.
 */
#include <stdio.h>
#include <stdlib.h>

#include "cylint_distance.h"
#include "elliptic_solids.h"
#include "timing.h"

enum { PAIRS = 1024 };

static cylint_shape shapes[PAIRS];
static double points[PAIRS][3];
static volatile double sink;

static void make_pairs(enum form form, enum where where)
{
    for (int i = 0; i < PAIRS; i++) {
        struct solid e;
        do
            draw_solid(&e, form, i % 2);
        while (!make_solid(&shapes[i], &e, CYLINT_ENDS_CAPPED));
        draw_place(&e, where, points[i]);
    }
}

static double turn(int is_safety)
{
    cylint_closest a;
    double sum = 0;
    const struct timing start = timing_now();
    for (int i = 0; i < PAIRS; i++)
        sum += is_safety ? cylint_safety(&shapes[i], points[i])
                         : cylint_distance(&shapes[i], points[i], 0, &a);
    const double ns = timing_since(start).ns / PAIRS;
    sink = sum;
    return ns;
}

static double mean_ratio(void)
{
    cylint_closest a;
    double sum = 0;
    for (int i = 0; i < PAIRS; i++)
        sum += cylint_safety(&shapes[i], points[i]) /
               fabs(cylint_distance(&shapes[i], points[i], 0, &a));
    return sum / PAIRS;
}

int main(int argc, char **argv)
{
    const int turns = argc > 1 ? atoi(argv[1]) : 20;
    timing_begin();
    printf("form,place,distance_ns,safety_ns,safety_over_distance\n");
    for (int form = 0; form < FORMS; form++)
        for (int where = 0; where < PLACES; where++) {
            double least[2] = {HUGE_VAL, HUGE_VAL};
            make_pairs((enum form)form, (enum where)where);
            for (int n = 0; n < turns; n++)
                for (int is_safety = 0; is_safety < 2; is_safety++)
                    least[is_safety] = fmin(least[is_safety], turn(is_safety));
            printf("%s,%s,%.0f,%.0f,%.3f\n", form_names[form],
                   place_names[where], least[0], least[1], mean_ratio());
        }
    return 0;
}
