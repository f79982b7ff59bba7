/*
 * critical_zeros_template.h - the zeros of a polynomial of degree 4 in
 * [-CRITICAL_REACH, CRITICAL_REACH]
 *
 * Included for doubles and for triples.  The macros are
 *
 *   NUMBER      the type
 *   ZEROS(name) the function's name for that type
 *   PLUS, MINUS, TIMES, OVER, TIMES_DOUBLE, FROM_DOUBLE, ROUNDED
 *   SMALL_STEP  after such a step of Newton's iteration the error is below
 *               the rounding
 *   NOISE       the rounding error of a value, relative to the coefficients
 */

/* p[0] + p[1] t + ..., and its derivative. */
static NUMBER ZEROS(value)(const NUMBER *p, int degree, NUMBER t, NUMBER *slope)
{
    NUMBER value = p[degree], derivative = FROM_DOUBLE(0);
    for (int i = degree - 1; i >= 0; i--) {
        derivative = PLUS(TIMES(derivative, t), value);
        value = PLUS(TIMES(value, t), p[i]);
    }
    *slope = derivative;
    return value;
}

static NUMBER ZEROS(middle)(NUMBER x, NUMBER y)
{
    return TIMES_DOUBLE(PLUS(x, y), 0.5);
}

/* The zero between `below` and `above`, at which the signs differ.  high_sign:
 * the sign at `above`. */
static NUMBER ZEROS(zero_between)(const NUMBER *p, int degree, NUMBER below,
                                  NUMBER above, int high_sign)
{
    NUMBER x = ZEROS(middle)(below, above);
    for (int step = 0; step < MOST_STEPS; step++) {
        NUMBER slope;
        const NUMBER value = ZEROS(value)(p, degree, x, &slope);
        const double sign = ROUNDED(value);
        if (sign == 0)
            break;
        if ((sign > 0) == (high_sign > 0))
            above = x;
        else
            below = x;
        const NUMBER by = OVER(value, slope), next = MINUS(x, by);
        const int is_between =
            ROUNDED(MINUS(next, below)) > 0 && ROUNDED(MINUS(above, next)) > 0;
        if (fabs(ROUNDED(by)) <= SMALL_STEP)
            return is_between ? next : x;
        x = is_between ? next : ZEROS(middle)(below, above);
    }
    return x;
}

static double ZEROS(noise)(const NUMBER *p, int degree)
{
    double sum = 0;
    for (int i = 0; i <= degree; i++)
        sum += fabs(ROUNDED(p[i]));
    return NOISE * sum;
}

/* The zeros, given those of the derivative, ascending.  *uncertain = 1: the sign
 * between two of them is below the rounding. */
static int ZEROS(next_zeros)(const NUMBER *p, int degree, const NUMBER *turn,
                             int turns, NUMBER *zero, int *uncertain)
{
    int n = 0;
    NUMBER low = FROM_DOUBLE(-CRITICAL_REACH), slope;
    double at_low = ROUNDED(ZEROS(value)(p, degree, low, &slope));
    const double noise = ZEROS(noise)(p, degree);
    for (int i = 0; i <= turns; i++) {
        const NUMBER high = i < turns ? turn[i] : FROM_DOUBLE(CRITICAL_REACH);
        const double at_high = ROUNDED(ZEROS(value)(p, degree, high, &slope));
        if (i < turns && fabs(at_high) <= noise)
            *uncertain = 1;
        if (at_low == 0)
            zero[n++] = low;
        else if ((at_low < 0 && at_high > 0) || (at_low > 0 && at_high < 0))
            zero[n++] =
                ZEROS(zero_between)(p, degree, low, high, at_high > 0 ? 1 : -1);
        low = high;
        at_low = at_high;
    }
    return n;
}

static int ZEROS(all_zeros)(const NUMBER p[DEGREE + 1], NUMBER zero[MOST_ZEROS],
                            int *uncertain)
{
    NUMBER q[DEGREE][DEGREE + 1], turn[MOST_ZEROS];
    int n = 0;
    *uncertain = 0;
    for (int i = 0; i <= DEGREE; i++)
        q[0][i] = p[i];
    for (int k = 1; k < DEGREE; k++)
        for (int i = 0; i <= DEGREE - k; i++)
            q[k][i] = TIMES_DOUBLE(q[k - 1][i + 1], i + 1);
    for (int k = DEGREE - 1; k >= 0; k--) {
        const int turns = n;
        for (int i = 0; i < turns; i++)
            turn[i] = zero[i];
        n = ZEROS(next_zeros)(q[k], DEGREE - k, turn, turns, zero, uncertain);
    }
    return n;
}

#undef NUMBER
#undef ZEROS
#undef PLUS
#undef MINUS
#undef TIMES
#undef OVER
#undef TIMES_DOUBLE
#undef FROM_DOUBLE
#undef ROUNDED
#undef SMALL_STEP
#undef NOISE
