/*
 * stress.c - compares the library with the oracle on 1e8 cases (make stress)
 *
 * All families, and the constructed coincidences with all their neighbours:
 * relation, number, parts, sides, every bit of t, and each component of point,
 * normal, z and phi within 4 units in its own last place.  Several processes
 * share the work in rounds.  A case depends only on the seed and its number,
 * not on the number of processes.
 *
 *   CYLINT_CASES    in all, default 1e8      CYLINT_SEED  default 20240
 *   CYLINT_SECONDS  stops after that time    CYLINT_JOBS  default 2
 *   CYLINT_FAMILY   only families whose name begins so: CYLINT_FAMILY=round
 */
#ifdef HAVE_MPFR

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "constructed.h"
#include "oracle.h"
#include "program.h"
#include "ulps.h"

/* A report is written at once if it has at most PIPE_BUF bytes, 4096. */
enum { MOST_FAMILIES = 48, MOST_JOBS = 64, SHOWN = 10 };
enum { CASES_A_ROUND = 200, BASES_A_ROUND = 4, WILD_A_ROUND = 40 };
enum { PLAIN_A_ROUND = 800, ULPS = 4 };
enum { EXTRA = 3 }; /* families beside those of families.c */

static const char *const extra_names[EXTRA] = {
    "coincidences, neighbours", "wild exponents", "plain numbers"};

struct tally {
    long cases, hits, verdicts, roots, derived; /* the last three: wrong */
    double off[MEASURES];                       /* the largest error */
};

/* A process writes this after each round. */
struct report {
    struct tally of[MOST_FAMILIES];
};

static const char *name_of(int family)
{
    return family < family_count() ? family_name(family)
                                   : extra_names[family - family_count()];
}

static int is_wanted(int family)
{
    const char *start = getenv("CYLINT_FAMILY");
    return !start || strncmp(name_of(family), start, strlen(start)) == 0;
}

/* --------------------------------------------------------- comparing -- */

static void show(const struct family_case *c, const cylint_answer *answer,
                 const char *whose)
{
    char text[1200];
    FILE *to = fmemopen(text, sizeof text, "w");
    if (!to)
        return;
    family_print(to, c);
    fprintf(to, "  # %s: relation %d n %d", whose, answer->relation, answer->n);
    for (int i = 0; i < answer->n; i++)
        fprintf(to, "  %a part %d side %d", answer->hit[i].t,
                answer->hit[i].part, answer->hit[i].side);
    fclose(to);
    fprintf(stderr, "%s\n", text);
}

static int same_verdict(const cylint_answer *got, const cylint_answer *want)
{
    if (got->relation != want->relation || got->n != want->n ||
        got->flags != want->flags)
        return 0;
    for (int i = 0; i < want->n; i++)
        if (got->hit[i].part != want->hit[i].part ||
            got->hit[i].side != want->hit[i].side)
            return 0;
    return 1;
}

static int same_roots(const cylint_answer *got, const cylint_answer *want)
{
    for (int i = 0; i < want->n; i++)
        if (!(got->hit[i].t == want->hit[i].t))
            return 0;
    return 1;
}

static int near_numbers(const cylint_answer *got, const cylint_answer *want,
                        struct tally *sum)
{
    int near = 1;
    for (int i = 0; i < want->n; i++) {
        double off[MEASURES];
        ulps_of_hit(&got->hit[i], &want->hit[i], off);
        for (int k = ULPS_POINT; k < MEASURES; k++) {
            sum->off[k] = fmax(sum->off[k], off[k]);
            near &= off[k] <= ULPS;
        }
    }
    return near;
}

static void try_case(const struct family_case *c, struct tally *sum)
{
    static int shown;
    cylint_answer got, want;
    cylint_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &got);
    oracle_intersect(&c->shape, &c->line, CYLINT_WANT_ALL, &want);
    sum->cases++;
    sum->hits += want.n;
    const int verdict = same_verdict(&got, &want);
    const int root = verdict && same_roots(&got, &want);
    const int good = root && near_numbers(&got, &want, sum);
    sum->verdicts += !verdict;
    sum->roots += verdict && !root;
    sum->derived += root && !good;
    if (!good && shown++ < SHOWN) {
        show(c, &got, "got");
        show(c, &want, "want");
    }
}

/* ------------------------------------------------------------ working -- */

static void do_round(uint64_t seed, uint64_t round, struct report *part)
{
    const int families = family_count();
    struct family_case c, base;
    memset(part, 0, sizeof *part);
    for (int f = 0; f < families; f++) {
        const int most = family_is_wild(f) ? WILD_A_ROUND : CASES_A_ROUND;
        const int n = is_wanted(f) ? most : 0;
        for (uint64_t i = 0; i < (uint64_t)n; i++) {
            family_case(seed, f, round * (uint64_t)most + i, &c);
            try_case(&c, &part->of[f]);
        }
    }
    for (uint64_t i = 0; is_wanted(families) && i < BASES_A_ROUND; i++) {
        constructed_base(seed, round * BASES_A_ROUND + i, &base);
        for (int k = 0; k < constructed_neighbours(&base); k++)
            if (constructed_neighbour(&base, k, &c))
                try_case(&c, &part->of[families]);
    }
    for (uint64_t i = 0; is_wanted(families + 1) && i < WILD_A_ROUND; i++) {
        constructed_wild(seed, round * WILD_A_ROUND + i, &c);
        try_case(&c, &part->of[families + 1]);
    }
    for (uint64_t i = 0; is_wanted(families + 2) && i < PLAIN_A_ROUND; i++) {
        constructed_plain(seed, round * PLAIN_A_ROUND + i, &c);
        try_case(&c, &part->of[families + 2]);
    }
}

static void work(uint64_t seed, int job, int jobs, long cases, time_t until,
                 int to)
{
    struct report part;
    long done = 0;
    for (uint64_t round = (uint64_t)job; done < cases && time(NULL) < until;
         round += (uint64_t)jobs) {
        do_round(seed, round, &part);
        for (int f = 0; f < MOST_FAMILIES; f++)
            done += part.of[f].cases;
        if (write(to, &part, sizeof part) != (ssize_t)sizeof part)
            exit(1);
    }
    exit(0);
}

/* ---------------------------------------------------------- reporting -- */

static long add(struct report *sum, const struct report *part)
{
    long cases = 0;
    for (int f = 0; f < MOST_FAMILIES; f++) {
        sum->of[f].cases += part->of[f].cases;
        sum->of[f].hits += part->of[f].hits;
        sum->of[f].verdicts += part->of[f].verdicts;
        sum->of[f].roots += part->of[f].roots;
        sum->of[f].derived += part->of[f].derived;
        for (int k = 0; k < MEASURES; k++)
            sum->of[f].off[k] = fmax(sum->of[f].off[k], part->of[f].off[k]);
        cases += sum->of[f].cases;
    }
    return cases;
}

static void progress(double cases, double wanted, time_t began)
{
    static time_t last;
    const time_t now = time(NULL);
    if (now < last + 10)
        return;
    last = now;
    fprintf(stderr, "%.3g of %.3g cases, %.0f s\n", cases, wanted,
            difftime(now, began));
}

/* Adds up the reports of all processes; returns 0 if one failed. */
static int collect(int from, int jobs, double wanted, struct report *sum)
{
    struct report part;
    const time_t began = time(NULL);
    int well = 1;
    while (read(from, &part, sizeof part) == (ssize_t)sizeof part)
        progress((double)add(sum, &part), wanted, began);
    for (int i = 0; i < jobs; i++) {
        int status;
        well &= wait(&status) > 0 && status == 0;
    }
    return well;
}

static void print_row(const char *name, const struct tally *t)
{
    printf("%-24s %9ld %9ld %7ld %7ld %7ld  %6g %6g %6g %6g\n", name, t->cases,
           t->hits, t->verdicts, t->roots, t->derived, t->off[ULPS_POINT],
           t->off[ULPS_NORMAL], t->off[ULPS_Z], t->off[ULPS_PHI]);
}

static int print_table(const struct report *sum)
{
    struct tally all = {0};
    puts("                                               wrong            "
         "         worst, ulp\n"
         "family                       cases      hits verdict       t  beside"
         "   point normal      z    phi");
    for (int f = 0; f < family_count() + EXTRA; f++) {
        const struct tally *t = &sum->of[f];
        print_row(name_of(f), t);
        all.cases += t->cases;
        all.hits += t->hits;
        all.verdicts += t->verdicts;
        all.roots += t->roots;
        all.derived += t->derived;
        for (int k = 0; k < MEASURES; k++)
            all.off[k] = fmax(all.off[k], t->off[k]);
    }
    print_row("all", &all);
    const long failed = all.verdicts + all.roots + all.derived;
    printf("%ld passed, %ld failed\n", all.cases - failed, failed);
    return failed == 0;
}

int main(void)
{
    const double wanted = check_number("CYLINT_CASES", 1e8);
    const uint64_t seed = (uint64_t)check_number("CYLINT_SEED", 20240);
    const double seconds = check_number("CYLINT_SECONDS", 1e9);
    int jobs = (int)check_number("CYLINT_JOBS", 2), ends[2];
    jobs = jobs < 1 ? 1 : jobs > MOST_JOBS ? MOST_JOBS : jobs;
    struct report sum;
    memset(&sum, 0, sizeof sum);
    if (family_count() + EXTRA > MOST_FAMILIES || sizeof sum > 4096) {
        puts("there are more families than MOST_FAMILIES");
        return 1;
    }
    if (pipe(ends) != 0)
        return 1;
    const time_t until = time(NULL) + (time_t)seconds;
    printf("seed %llu, %d processes\n", (unsigned long long)seed, jobs);
    fflush(stdout);
    for (int job = 0; job < jobs; job++) {
        const pid_t pid = fork();
        if (pid < 0)
            return 1;
        if (pid == 0) {
            close(ends[0]);
            work(seed, job, jobs, (long)(wanted / jobs), until, ends[1]);
        }
    }
    close(ends[1]);
    const int well = collect(ends[0], jobs, wanted, &sum);
    if (!well)
        puts("a process died");
    return print_table(&sum) && well ? 0 : 1;
}

#else

#include "program.h"

int main(void)
{
    return check_skip("no MPFR: no oracle to compare with (make deps)");
}

#endif
