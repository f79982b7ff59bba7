/*
 * sampling.c - points spread evenly over squares, discs and hemispheres
 *
 * [Burley 2020] Practical hash-based Owen scrambling, JCGT 9(4).
 * [Laine & Karras 2011] Stratified sampling for stochastic transparency,
 *     Computer Graphics Forum 30(4): x ^= x * even carries each bit upwards
 *     only, which scrambles the reversed number as a tree.
 * [Shirley & Chiu 1997] A low distortion map between disk and square,
 *     journal of graphics tools 2(3).
 */
#include "sampling.h"

/* Multiplications by odd numbers and shifts, each invertible: different words
 * stay different. */
static uint32_t mixed_word(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

uint32_t hash_words(uint32_t a, uint32_t b)
{
    return mixed_word(mixed_word(a + 0x9e3779b9u) ^ b);
}

static uint32_t reversed(uint32_t x)
{
    x = x >> 16 | x << 16;
    x = (x & 0xff00ff00u) >> 8 | (x & 0x00ff00ffu) << 8;
    x = (x & 0xf0f0f0f0u) >> 4 | (x & 0x0f0f0f0fu) << 4;
    x = (x & 0xccccccccu) >> 2 | (x & 0x33333333u) << 2;
    return (x & 0xaaaaaaaau) >> 1 | (x & 0x55555555u) << 1;
}

/* Scrambles the reversed number, so that high digits change low ones. */
static uint32_t scrambled_from_below(uint32_t x, uint32_t seed)
{
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    return x ^ x * 0x8d22f6e6u;
}

static uint32_t scrambled(uint32_t x, uint32_t seed)
{
    return reversed(scrambled_from_below(reversed(x), seed));
}

/* The second coordinate of point i; its generator matrix is Pascal's
 * triangle modulo 2, a column of which follows from the one before. */
static uint32_t sobol_second(uint32_t i)
{
    uint32_t x = 0;
    for (uint32_t column = 0x80000000u; i; i >>= 1) {
        x ^= i & 1 ? column : 0;
        column ^= column >> 1;
    }
    return x;
}

void sample_square(uint32_t i, uint32_t seed, double point[2])
{
    const double unit_of_word = 1 / 4294967296.0;
    const uint32_t k = scrambled(i, seed);
    point[0] = unit_of_word * scrambled(reversed(k), hash_words(seed, 1));
    point[1] = unit_of_word * scrambled(sobol_second(k), hash_words(seed, 2));
}

/* Maps squares about the centre to circles [Shirley & Chiu 1997]. */
struct vector sample_disc(uint32_t i, uint32_t seed, struct vector n)
{
    const double quarter = 0.78539816339744831; /* pi / 4 */
    double square[2];
    sample_square(i, seed, square);
    const double x = 2 * square[0] - 1, y = 2 * square[1] - 1;
    const int is_wide = fabs(x) > fabs(y);
    const double radius = is_wide ? x : y;
    const double turn = radius == 0 ? 0
                        : is_wide   ? quarter * (y / x)
                                    : quarter * (2 - x / y);
    const struct vector u = perpendicular(n);
    return plus(times(radius * cos(turn), u), radius * sin(turn), cross(n, u));
}

/* Lifts points of the disc to the hemisphere above it. */
struct vector sample_hemisphere(uint32_t i, uint32_t seed, struct vector n)
{
    const struct vector disc = sample_disc(i, seed, n);
    return plus(disc, sqrt(fmax(0, 1 - dot(disc, disc))), n);
}
