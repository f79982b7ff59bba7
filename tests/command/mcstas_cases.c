/* Cases for the function for McStas in cylint(7), which stands above this text, and
 * for the quadratic formula, which it replaces: rays from 64 m that graze a sample,
 * rays parallel to the axis but for a subnormal velocity (McCode, issue 986), and
 * hollow samples (issues 2502, 997).  Prints how many are wrong; returns 1 if the
 * library's are. */
#include <math.h>
#include <stdio.h>

static int by_formula(double *t0, double *t1, double x, double y, double z,
                      double vx, double vy, double vz, double r, double h)
{
    const double a = vx * vx + vz * vz, b = x * vx + z * vz;
    const double d = b * b - a * (x * x + z * z - r * r);
    double y0, y1;
    if (d < 0)
        return 0;
    *t0 = (-b - sqrt(d)) / a;
    *t1 = (-b + sqrt(d)) / a;
    y0 = y + *t0 * vy;
    y1 = y + *t1 * vy;
    if (fmin(y0, y1) > h / 2 || fmax(y0, y1) < -h / 2)
        return 0;
    if (fabs(y0) > h / 2)
        *t0 = (copysign(h / 2, y0) - y) / vy;
    if (fabs(y1) > h / 2)
        *t1 = (copysign(h / 2, y1) - y) / vy;
    return 1;
}

typedef int intersection(double *, double *, double, double, double, double,
                         double, double, double, double);

/* Rays along z from 64 m: they meet the sample if and only if |x| <= r. */
static int far_faults(intersection *meets)
{
    const double r = 0.005;
    int faults = 0;
    for (int i = -500; i <= 500; i++) {
        const double x = r * (1 + i * 0x1p-50);
        double t0, t1;
        faults +=
            (meets(&t0, &t1, x, 0, -64, 0, 0, 1, r, 0.01) != 0) != (x <= r);
    }
    return faults;
}

/* Rays from inside whose velocity across the axis is tiny leave by both ends. */
static int parallel_faults(intersection *meets)
{
    int faults = 0;
    for (int e = 0; e < 300; e += 3) {
        double t0 = 0, t1 = 0;
        const int bits = meets(&t0, &t1, 0.001, 0, 0.001, pow(10, -e - 20), 1,
                               0, 0.005, 0.01);
        faults += !(bits && t0 == -0.005 && t1 == 0.005);
    }
    return faults;
}

/* The ends of a thin wall ascend on rays that graze its void. */
static int hollow_faults(intersection *meets)
{
    const double outer = 0.012;
    int faults = 0;
    for (int i = 0; i < 2000; i++) {
        const double inner = outer * (1 - (1 + i % 4) * 0x1p-52);
        const double x = outer * (1 - i * 0x1p-46), vy = 0.00001 * (i % 23);
        double t[4] = {0};
        const int both =
            meets(&t[0], &t[3], x, 0, -64, 0, vy, 1, outer, 0.004) != 0;
        if (meets(&t[1], &t[2], x, 0, -64, 0, vy, 1, inner, 0.004))
            faults += !(both && t[0] <= t[1] && t[1] <= t[2] && t[2] <= t[3]);
    }
    return faults;
}

/* Rays in the plane x = 0 and a sample of radius 1 and height 2: the bits of the
 * ends by which they enter and leave. */
static int wrong_bits(void)
{
    static const struct {
        double y, z, vy, vz;
        int bits;
    } ray[] = {{-5, 0, 1, 0, 1 + 4 + 8}, {5, 0, -1, 0, 1 + 2 + 16},
               {0, -5, 0, 1, 1},         {2, -1, -1, 1, 1 + 2},
               {-2, -1, 1, 1, 1 + 4},    {0, -1.5, 1, 1, 1 + 8},
               {0, -1.5, -1, 1, 1 + 16}, {2, 0, 0, 1, 0}};
    int wrong = 0;
    for (size_t i = 0; i < sizeof ray / sizeof *ray; i++) {
        double t0, t1;
        wrong += cylinder_intersect(&t0, &t1, 0, ray[i].y, ray[i].z, 0,
                                    ray[i].vy, ray[i].vz, 1, 2) != ray[i].bits;
    }
    return wrong;
}

int main(void)
{
    const int far = far_faults(by_formula),
              parallel = parallel_faults(by_formula);
    const int ours = far_faults(cylinder_intersect) +
                     parallel_faults(cylinder_intersect) +
                     hollow_faults(cylinder_intersect) + wrong_bits();
    printf("     the formula: %d of 1001 far, %d of 100 parallel ones wrong; "
           "cylint: %d\n",
           far, parallel, ours);
    return ours || !far || !parallel;
}
