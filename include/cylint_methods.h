/*
 * cylint_methods - published methods to intersect a line with a cylinder or a
 * cone
 *
 *     cylint_answer answer;
 *     if (cylint_quadratic(&shape, &line, CYLINT_WANT_T, &answer) == CYLINT_OK)
 *         printf("%d hits\n", answer.n);
 *
 * Each is a method as its author published it, in double precision, corrected
 * where the print is wrong; the comments of its source file list the
 * corrections.  The methods serve to compare run time with error, which
 * `make bench` measures.  Their answers can be wrong; use cylint_intersect()
 * for correct ones.
 *
 * Full references: cylint(3), REFERENCES.
 */
#ifndef CYLINT_METHODS_H
#define CYLINT_METHODS_H

#include "cylint.h"

#ifdef __cplusplus
extern "C" {
#endif

/*
 * A method writes the same members of an answer as cylint_intersect(), for the
 * shapes and ends that it supports, and returns CYLINT_OK.  For others it writes a
 * miss with CYLINT_FLAG_INVALID and returns CYLINT_EMETHOD.
 */
typedef cylint_status cylint_method_fn(const cylint_shape *shape,
                                       const cylint_line *line, unsigned want,
                                       cylint_answer *answer);

CYLINT_API cylint_method_fn cylint_shene_cylinder; /* Gems IV  */
CYLINT_API cylint_method_fn cylint_shene_cone;     /* Gems V   */
CYLINT_API cylint_method_fn cylint_gullotti;       /* elliptic, by affine map */
CYLINT_API cylint_method_fn cylint_closest_points; /* d^2 of closest points */
CYLINT_API cylint_method_fn cylint_quadratic;      /* plain b^2 - 4ac */
CYLINT_API cylint_method_fn cylint_cychosz_waggenspack; /* Gems IV */

typedef struct cylint_method {
    const char *name;   /* as in cylint --method=NAME */
    const char *source; /* one line: author, title, where */
    const char *shapes; /* one line: the shapes and ends that it supports */
    cylint_method_fn *answer;
} cylint_method;

/* All methods; the last entry's name is NULL. */
CYLINT_API const cylint_method *cylint_methods(void);

#ifdef __cplusplus
}
#endif

#endif
