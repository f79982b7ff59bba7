/*
 * bench.h - the one timing loop, and the one form of a line of output
 *
 * A case draws its input and holds contests.  In a contest a rival and the
 * library, once with each of its kernels (plain, AVX2, AVX-512), answer the
 * same questions in turns within one run, on one core.  The least processor
 * time of each counts.
 */
#ifndef BENCH_BENCH_H
#define BENCH_BENCH_H

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "cylint.h"

/* Answers the n questions whose numbers are in `order`, or all in an order
 * of its own. Returns a sum that depends on every answer. */
typedef double bench_turn(const void *input, const int *order, int n);

/* A turn that adds `answer`, an expression in the number i of a question.  Its
 * declarations come first. */
#define BENCH_TURN(name, declarations, answer)                     \
    static double name(const void *input, const int *order, int n) \
    {                                                              \
        double sum = 0;                                            \
        declarations;                                              \
        (void)input;                                               \
        for (int k = 0; k < n; k++) {                              \
            const int i = order[k];                                \
            sum += (double)(answer);                               \
        }                                                          \
        return sum;                                                \
    }

struct contest {
    const char *subject, *question;
    const char *setup; /* of the question; or NULL */
    const char *rival; /* its name; NULL: the library has no rival */
    bench_turn *theirs, *ours;
    const void *input;  /* of both, */
    const void *others; /* or of the rival, if this is not NULL */
    int questions;
    double units;          /* of work in a question; 0 stands for 1 */
    int is_shuffled;       /* also in a new random order each turn */
    int only_best_kernels; /* measured with the best kernels only */
};

/* Holds a contest and prints a line for each order.  Returns the printed figure of
 * the best kernels. */
double compete(const struct contest *c);

/* Prints another figure, of both or, if `theirs` is NaN, of the library
 * alone. */
void print_figure(const char *subject, const char *question, const char *setup,
                  const char *rival, const char *unit, double theirs,
                  double ours);

/* Whether the user wants this subject; contests of others end at once.  0 of
 * NULL. */
int is_wanted(const char *subject);

/* The option -n, or `usual` if there is none. */
double most_or(double usual);

enum { KERNELS_MOST = 8 };
/* The number of the kernels in use, from 0, the best. */
int kernels_in_use(void);
/* Uses kernels number k.  Behind the last returns 0, and the best are used. */
int use_kernels(int k);

/* For qsort(): doubles, or structures that begin with one, upwards. */
int compare_doubles(const void *x, const void *y);

double seconds_of(clockid_t clock);

/* malloc(), or ends the program. */
void *allocate(size_t bytes);

/* Ends the program with this message if `is_true` is 0. */
void require(int is_true, const char *message);

/* The cases, one file each. */
void bench_single(void), bench_batch(void), bench_distance(void),
    bench_methods(void), bench_scene(void), bench_pieces(void),
    bench_calls(void), bench_embree(void), bench_stages(void);

#endif
