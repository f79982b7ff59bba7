/*
 * embree_race.c - scenes that take turns in tracing the same rays
 */
#include "embree_race.h"

#include <math.h>

void query_nearest(struct contestant *c, const struct rays *rays)
{
    c->hits = trace_nearest(&c->rival, rays, &c->t);
}

void query_any(struct contestant *c, const struct rays *rays)
{
    cylint_rtc_context context;
    cylint_rtc_init(&context);
    c->hits = 0;
    c->t = 0;
    for (int i = 0; i < rays->n; i++) {
        struct RTCRay ray = rays->ray[i];
        cylint_rtc_any(c->rival.scene, &context, &ray);
        c->hits += ray.tfar < 0;
    }
}

void compete(struct contestant *c, int n, query *trace, const struct rays *rays,
             double seconds)
{
    const struct timing start = timing_now();
    for (int i = 0; i < n; i++)
        c[i].least = (struct timing){HUGE_VAL, HUGE_VAL};
    for (int round = 0; round < 3 || timing_since(start).ns < seconds * 1e9;
         round++)
        for (int i = 0; i < n; i++) {
            const struct timing begin = timing_now();
            trace(&c[i], rays);
            timing_keep_least(&c[i].least, timing_since(begin));
        }
}
