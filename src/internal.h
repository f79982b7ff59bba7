/*
 * internal.h - what the library's files tell each other
 *
 * Which way the calls point: query.c -> decide.c, root.c, hit.c -> surd.c ->
 * exact.c.
 */
#ifndef CYLINT_INTERNAL_H
#define CYLINT_INTERNAL_H

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "bounds.h"
#include "cylint.h"
#include "each.h"
#include "eft.h"
#include "environment.h"
#include "exact.h"

/* 2^e for -1022 <= e <= 1023. */
static inline double cylint_power_of_two(int e)
{
    const uint64_t bits = (uint64_t)(e + 1023) << 52;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* The e of 2^e <= |x| < 2^(e+1) for normal x; below -1022 otherwise. */
static inline int cylint_exponent(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (int)(bits >> 52 & 0x7ff) - 1023;
}

/* By the bits: right for subnormals even where they are taken for zero. */
static inline int cylint_sign(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits << 1 == 0 ? 0 : bits >> 63 ? -1 : 1;
}

/* Sums with such a number may have a part that a processor flushes. */
static inline int cylint_too_small(double x)
{
    const uint64_t least = (uint64_t)(1023 - 900) << 53; /* without the sign */
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (bits << 1) - 1 < least - 1; /* a zero wraps round */
}

/* x < y by the bits, likewise; neither is a NaN. */
static inline int cylint_less(double x, double y)
{
    int64_t a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &y, sizeof b);
    a = a < 0 ? INT64_MIN - a : a; /* ascending with x, both zeros 0 */
    b = b < 0 ? INT64_MIN - b : b;
    return a < b;
}

static inline double cylint_largest(const double x[3])
{
    return cylint_larger(cylint_larger(fabs(x[0]), fabs(x[1])), fabs(x[2]));
}

/* x - y as a pair, exactly unless it overflows (then lo = 0), in whatever
 * floating-point environment. */
pair cylint_wild_difference(double x, double y);
static inline pair cylint_difference(double x, double y)
{
    const pair d = two_diff(x, y);
    const int tame = !cylint_too_small(x) && !cylint_too_small(y) &&
                     fabs(d.hi) <= DBL_MAX && cylint_rounds_to_nearest();
    return tame ? d : cylint_wild_difference(x, y);
}

/* x 2^e, rounded at most once. */
double cylint_scaled(double x, int e);

/* to - from, scaled by 2^e, as pairs; e brings both below overflow. */
void cylint_scaled_difference(double hi[3], double lo[3], const double to[3],
                              const double from[3], int e);

/* center, ball, size and ordinary of a shape; size and ordinary of a line. */
void cylint_measure_shape(cylint_shape *shape);
void cylint_measure_line(cylint_line *line);

/* The double nearest to the tangent of an angle in (0, 90) degrees. */
double cylint_tangent(double degrees);

/* A build that asks every question again in every digit (make PARANOID=1). */
#ifdef CYLINT_PARANOID
#include <stdlib.h>
#define CYLINT_IS_PARANOID 1
#define cylint_contradiction(wrong) ((wrong) ? abort() : (void)0)
#else
#define CYLINT_IS_PARANOID 0
#define cylint_contradiction(wrong) ((void)(0 && (wrong)))
#endif

/* A build that counts how far questions must go (make stages); not for
 * several threads. */
enum {
    CYLINT_STAGE_FILTER, /* asked one by one: the kernels did not decide */
    CYLINT_STAGE_QUANTA, /* a sign near 0, but nothing was rounded */
    CYLINT_STAGE_PAIRS,
    CYLINT_STAGE_EXACT,
    CYLINT_STAGE_MIDDLE, /* a root beside the middle of two doubles */
    CYLINT_STAGES
};
#ifdef CYLINT_COUNT_STAGES
extern CYLINT_API unsigned long long cylint_stages[CYLINT_STAGES];
#define cylint_reached(stage) ((void)cylint_stages[CYLINT_STAGE_##stage]++)
#else
#define cylint_reached(stage) ((void)0)
#endif

/* ------------------------------------------- the three arithmetics ----- */

/* A double and the size of what was summed up to it (bounds.h). */
typedef struct {
    double v, size;
} ball;

static inline ball ball_add(ball x, ball y)
{
    return (ball){x.v + y.v, x.size + y.size};
}
static inline ball ball_sub(ball x, ball y)
{
    return (ball){x.v - y.v, x.size + y.size};
}
static inline ball ball_mul(ball x, ball y)
{
    return (ball){x.v * y.v, x.size * y.size};
}

#define INLINE static inline
#define NUM ball
#define FORM(name) name##_ball
#define ADD(x, y) ball_add(x, y)
#define SUB(x, y) ball_sub(x, y)
#define MUL(x, y) ball_mul(x, y)
#define MEMORY
#define BEGIN (void)L;
#define RETURN(x) return x;
#include "forms.h"

/* Doubles alone, and sizes alone, where one bound serves many. */
#define NUM double
#define FORM(name) name##_double
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) - (y))
#define MUL(x, y) ((x) * (y))
#include "forms.h"

#define NUM double
#define FORM(name) name##_size
#define ADD(x, y) ((x) + (y))
#define SUB(x, y) ((x) + (y))
#define MUL(x, y) ((x) * (y))
#include "forms.h"

/* The binary exponent of what a number is certainly a multiple of: the same
 * formulas over exponents.  A zero is a multiple of anything. */
static inline int quantum_add(int x, int y)
{
    return x < y ? x : y;
}
static inline int quantum_mul(int x, int y)
{
    return x + y;
}

#define NUM int
#define FORM(name) name##_quantum
#define ADD(x, y) quantum_add(x, y)
#define SUB(x, y) quantum_add(x, y)
#define MUL(x, y) quantum_mul(x, y)
#include "forms.h"

/* A pair of doubles and what its error is at most, in units of
 * CYLINT_PAIR_ROUNDING: unlike a size it stays small where sums cancel and are
 * squared.  x' and y' for x and y miss x y by x' (y' - y) + y (x' - x). */
typedef struct {
    pair v;
    double off;
} wide;

static inline wide wide_add(wide x, wide y)
{
    return (wide){pair_add(x.v, y.v),
                  x.off + y.off + (fabs(x.v.hi) + fabs(y.v.hi))};
}
static inline wide wide_sub(wide x, wide y)
{
    return wide_add(x, (wide){pair_neg(y.v), y.off});
}
static inline wide wide_mul(wide x, wide y)
{
    const double a = fabs(x.v.hi), b = fabs(y.v.hi);
    return (wide){pair_mul(x.v, y.v),
                  a * y.off + (b + CYLINT_PAIR_ROUNDING * y.off) * x.off +
                      a * b};
}

#define NUM wide
#define FORM(name) name##_wide
#define ADD(x, y) wide_add(x, y)
#define SUB(x, y) wide_sub(x, y)
#define MUL(x, y) wide_mul(x, y)
#include "forms.h"
#undef MEMORY
#undef BEGIN
#undef RETURN

/* Every digit. */
#define NUM exact
#define FORM(name) name##_exact
#define ADD(x, y) cylint_exact_add(L->arena, x, y)
#define SUB(x, y) cylint_exact_add(L->arena, x, cylint_exact_neg(y))
#define MUL(x, y) cylint_exact_mul(L->arena, x, y)
#define MEMORY cylint_arena *arena;
#define BEGIN const int used_before = L->arena->used;
#define RETURN(x) return cylint_exact_keep(L->arena, used_before, x);
#include "forms.h"
#undef MEMORY
#undef BEGIN
#undef RETURN

static inline double ball_error(ball x)
{
    return CYLINT_FILTER_BOUND * x.size + CYLINT_UNDERFLOW;
}

static inline double wide_error(wide x)
{
    return CYLINT_PAIR_UNIT * x.off + CYLINT_UNDERFLOW;
}

/* --------------------------------------------------- one question ------ */

enum { /* what of cylint_query has been made */
       CYLINT_READY_TOP = 1,
       CYLINT_READY_WIDE = 2,
       CYLINT_READY_WIDE_LINE = 4,
       CYLINT_READY_EXACT = 8,
       CYLINT_READY_EXACT_LINE = 16,
       CYLINT_READY_QUADRATIC = 32,
       CYLINT_READY_QUANTUM = 64
};

typedef struct {
    const cylint_shape *shape; /* as given: what exact answers are about */
    const cylint_line *line;
    int kind, ends;
    int filters;                    /* 0: data too wild, exact stage only */
    int t_exponent;                 /* t = 2^t_exponent * t of the filters */
    double t_error;                 /* of the last root as a pair, relative */
    const cylint_shape *near_shape; /* what the filters see: as given, or */
    const cylint_line *near_line;   /* scaled by powers of two */
    cylint_shape scaled_shape;
    cylint_line scaled_line;
    unsigned ready; /* which letters are there */
    letters_ball ball;
    letters_wide wide;
    letters_quantum quantum;
    int quanta; /* 1: every datum of the filters is exact */
    letters_exact exact;
    exact exact_coefficient[3]; /* A, B, C */
    cylint_arena arena;
} cylint_query;

void cylint_query_open(cylint_query *q, const cylint_shape *shape,
                       const cylint_line *line);

/* The letters of the slower arithmetics, made when first asked for. */
letters_wide *cylint_wide(cylint_query *q);      /* data and shape only */
letters_wide *cylint_wide_line(cylint_query *q); /* moments as well */
const letters_ball *cylint_ball_with_top(cylint_query *q);
const letters_exact *cylint_exact(cylint_query *q); /* likewise */
const letters_exact *cylint_exact_line(cylint_query *q);

/* Exact signs of the forms, by the cheapest arithmetic that is certain. */
int cylint_sign_alpha(cylint_query *q, int cap);
int cylint_sign_beta(cylint_query *q);
int cylint_sign_det(cylint_query *q); /* before shape->flip is set */
int cylint_sign_along(cylint_query *q);
int cylint_sign_E(cylint_query *q, int cap);
int cylint_sign_N(cylint_query *q, int cap);
int cylint_sign_G(cylint_query *q);
int cylint_sign_A(cylint_query *q);
int cylint_sign_B(cylint_query *q);
int cylint_sign_C(cylint_query *q);
int cylint_sign_T(cylint_query *q);
int cylint_sign_rho0(cylint_query *q);

/* Places on the line where something begins or ends. */
typedef enum {
    ROOT_ENTRY,  /* of the lateral quadric, Q falling */
    ROOT_EXIT,   /* ... rising */
    ROOT_DOUBLE, /* both at once: G = 0 */
    ROOT_APEX,   /* rho = 0 */
    ROOT_CAP0,   /* the planes */
    ROOT_CAP1
} cylint_root;

/* Whether tmin <= root <= tmax, exactly.  Where t is wanted, it becomes the
 * double nearest to such a root and *more what that misses, nearly. */
int cylint_root_within(cylint_query *q, cylint_root root, int wanted, double *t,
                       double *more);

/* Finds a root's pair anew where t_error is larger than pairs allow. */
void cylint_polish_root(cylint_query *q, cylint_root root, pair *t);

/* A value with a binary exponent of its own: v 2^e, 1/4 < |v| < 4 or v = 0. */
typedef struct {
    pair v;
    int e;
} floating;

floating cylint_floating(exact x);
floating cylint_floating_sqrt(floating x);

/* A root in every digit: t = (-B + s R) / A with R^2 = B^2 - A C, or the limit
 * of that for A = 0. */
typedef struct {
    exact A, B, C;
    int s;      /* 1 at the exit, -1 at the entry, else 0 */
    floating R; /* 0: not found yet */
} surd;

/* Makes what must stay in the arena; what comes after it may be let go by
 * setting arena.used to the answer. */
int cylint_exact_mark(cylint_query *q, cylint_root root);

surd cylint_surd(cylint_query *q, cylint_root root);

/* f0 + f1 t: its sign, exactly; its value to CYLINT_SURD_ERROR, relative. */
int cylint_sign_at(cylint_query *q, const surd *t, exact f0, exact f1);
floating cylint_value_at(cylint_query *q, surd *t, exact f0, exact f1);

/* The wanted members of a hit but part and side.  t + more is the root;
 * apex: whether the hit is the apex of a cone. */
void cylint_describe_hit(cylint_query *q, cylint_root root, double t,
                         double more, int part, int apex, unsigned want,
                         cylint_hit *hit);

#endif
