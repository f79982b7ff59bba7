/*
 * stress.c - compares the library with the oracle on 1e8 cases (make stress)
 *
 * All families, and the constructed coincidences with all their neighbours:
 * relation, number, parts, sides, and every bit of t, of each component of
 * point and normal, of z and of phi.  The table counts the components that are
 * not the nearest doubles; a hit has 9.  Several processes share the work in
 * rounds.  A case depends only on the seed and its number, not on the number of
 * processes.
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
enum { MOST_FAMILIES = 51, MOST_JOBS = 64, SHOWN = 10 };
enum { CASES_A_ROUND = 200, BASES_A_ROUND = 4, WILD_A_ROUND = 40 };
enum { PLAIN_A_ROUND = 800 };
enum { EXTRA = 3 }; /* families beside those of families.c */

static const char *const extra_names[EXTRA] = {
    "coincidences, neighbours", "wild exponents", "plain numbers"};

struct tally {
    long cases, hits, failed;
    long verdicts, components[MEASURES]; /* wrong */
    double worst;                        /* the largest error, in ulp */
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
    char text[1600];
    FILE *to = fmemopen(text, sizeof text, "w");
    if (!to)
        return;
    family_print(to, c);
    fprintf(to, "  # %s: relation %d n %d", whose, answer->relation, answer->n);
    for (int i = 0; i < answer->n; i++) {
        const cylint_hit *h = &answer->hit[i];
        fprintf(to,
                "\n#   %a part %d side %d point %a %a %a normal %a %a %a z %a "
                "phi %a",
                h->t, h->part, h->side, h->point[0], h->point[1], h->point[2],
                h->normal[0], h->normal[1], h->normal[2], h->z, h->phi);
    }
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

/* Counts the components that are not the nearest doubles. */
static int same_numbers(const cylint_answer *got, const cylint_answer *want,
                        struct tally *sum)
{
    int same = 1;
    for (int i = 0; i < want->n; i++) {
        double off[COMPONENTS];
        ulps_of_components(&got->hit[i], &want->hit[i], oracle_other(i), off);
        for (int k = 0; k < COMPONENTS; k++) {
            sum->components[measure_of[k]] += off[k] > 0;
            sum->worst = fmax(sum->worst, off[k]);
            same &= off[k] == 0;
        }
    }
    return same;
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
    const int good = verdict && same_numbers(&got, &want, sum);
    sum->verdicts += !verdict;
    sum->failed += !good;
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

static void add_tally(struct tally *sum, const struct tally *part)
{
    sum->cases += part->cases;
    sum->hits += part->hits;
    sum->failed += part->failed;
    sum->verdicts += part->verdicts;
    for (int k = 0; k < MEASURES; k++)
        sum->components[k] += part->components[k];
    sum->worst = fmax(sum->worst, part->worst);
}

static long add(struct report *sum, const struct report *part)
{
    long cases = 0;
    for (int f = 0; f < MOST_FAMILIES; f++) {
        add_tally(&sum->of[f], &part->of[f]);
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
    printf("%-24s %9ld %9ld %7ld", name, t->cases, t->hits, t->verdicts);
    for (int k = 0; k < MEASURES; k++)
        printf(" %7ld", t->components[k]);
    printf("  %6g\n", t->worst);
}

static int print_table(const struct report *sum)
{
    struct tally all = {0};
    puts(
        "                                               wrong   components "
        "that are not the nearest   worst\n"
        "family                       cases      hits verdict       t   point  "
        "normal       z     phi     ulp");
    for (int f = 0; f < family_count() + EXTRA; f++) {
        print_row(name_of(f), &sum->of[f]);
        add_tally(&all, &sum->of[f]);
    }
    print_row("all", &all);
    printf("%ld passed, %ld failed\n", all.cases - all.failed, all.failed);
    return all.failed == 0;
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
