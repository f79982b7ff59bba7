/*
 * vectors.h - products of vectors in doubles, for tests and benchmarks
 */
#ifndef CYLINT_TEST_VECTORS_H
#define CYLINT_TEST_VECTORS_H

static inline double dot3(const double u[3], const double v[3])
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

/* to = u x v; `to` is neither of them. */
static inline void cross3(double to[3], const double u[3], const double v[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[i] = u[j] * v[k] - u[k] * v[j];
    }
}

#endif
