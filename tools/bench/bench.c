/*
 * bench.c - the registry of cases and the timing loop
 *
 *     bench [-s SECONDS] [-n MOST] [-o TEXT] CASE...
 *
 * Each contest takes SECONDS (0.3), but at least three turns of each contestant.
 * Scenes have at most MOST shapes; `stages` takes MOST cases of each family.
 * TEXT: only subjects that contain it; the status is 4 if no CASE has one.  Without
 * a CASE the program prints their names.  Output is CSV; a ratio below 1 means that
 * the library is faster.
 *
 * A new case needs a line in the table, a function in bench.h and an object in
 * bench.mk.
 */
#define _GNU_SOURCE /* sched_setaffinity(), getopt() */
#include "bench.h"

#include <string.h>
#include <unistd.h>
#ifdef __linux__
#include <sched.h>
#endif

#include "random.h"

static const struct {
    const char *name, *text;
    void (*run)(void);
} cases[] = {
    {"single", "one line and one shape", bench_single},
    {"batch", "many lines or many shapes", bench_batch},
    {"distance", "points and one shape", bench_distance},
    {"methods", "time against error of published methods", bench_methods},
    {"scene", "queries of scenes; build, move, save, open", bench_scene},
    {"pieces", "pieces of a line in scenes", bench_pieces},
    {"calls", "which call when: shapes, a pack, a scene", bench_calls},
#ifdef CYLINT_EMBREE
    {"embree", "shapes in scenes of Embree", bench_embree},
#endif
#ifdef CYLINT_COUNT_STAGES
    {"stages", "share of questions that reach each stage", bench_stages},
#endif
};
enum { CASES = sizeof cases / sizeof *cases, ROUNDS = 3, NO_SUBJECT = 4 };

static struct {
    double seconds, most;
    const char *only, *name;
} user = {0.3, 0, "", NULL};

static volatile double sink;
static int rows_printed;

/* ------------------------------------------------------------------ time -- */

double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Keeps this thread on the last core that it may use. */
static void stay_on_one_core(void)
{
#ifdef __linux__
    cpu_set_t allowed, one;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
        return;
    for (size_t i = CPU_SETSIZE; i-- > 0;)
        if (CPU_ISSET(i, &allowed)) {
            CPU_ZERO(&one);
            CPU_SET(i, &one);
            sched_setaffinity(0, sizeof one, &one);
            return;
        }
#endif
}

/* --------------------------------------------------------------- kernels -- */

static int kernels_count(void)
{
    int n = 0;
    while (cylint_kernels_name(n))
        n++;
    require(n <= KERNELS_MOST, "more kernels than expected");
    return n;
}

int kernels_in_use(void)
{
    int k = 0;
    while (strcmp(cylint_kernels_name(k), cylint_kernels_in_use()))
        k++;
    return k;
}

int use_kernels(int k)
{
    const char *name = cylint_kernels_name(k);
    cylint_use_kernels(name);
    return name != NULL;
}

/* -------------------------------------------------------------- the loop -- */

struct contestant {
    const char *kernels; /* of the library; NULL: the rival */
    bench_turn *turn;
    const void *input;
    double least;
};

static void shuffle(int *order, int n)
{
    static uint64_t random = 1;
    for (int i = n - 1; i > 0; i--) {
        const int j = random_int(&random, i + 1), kept = order[i];
        order[i] = order[j];
        order[j] = kept;
    }
}

/* Before a shuffled turn another one fills the caches: a branch predictor
 * remembers thousands of outcomes of an order that repeats. */
static void take_turn(struct contestant *a, int *order, int n, int is_shuffled)
{
    cylint_use_kernels(a->kernels);
    if (is_shuffled) {
        sink = a->turn(a->input, order, n);
        shuffle(order, n);
    }
    const double start = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    sink = a->turn(a->input, order, n);
    a->least = fmin(a->least, seconds_of(CLOCK_THREAD_CPUTIME_ID) - start);
}

static void print_row(const struct contest *c, int is_shuffled,
                      const char *unit, double theirs, const double *ours);

/* The kernels of the library, from the plainest to the best, into list[1
 * ...]; the rival is list[0]. Returns how many there are in all. */
static int list_contestants(const struct contest *c, struct contestant *list)
{
    int n = 1;
    list[0] = (struct contestant){NULL, c->theirs,
                                  c->others ? c->others : c->input, HUGE_VAL};
    for (int k = kernels_count(); k-- > 0;)
        list[n++] = (struct contestant){cylint_kernels_name(k), c->ours,
                                        c->input, HUGE_VAL};
    return n;
}

static int takes_part(const struct contest *c, const struct contestant *a,
                      int is_best)
{
    return a->kernels ? is_best || !c->only_best_kernels : c->rival != NULL;
}

/* Writes the ns of a question: of the rival, then of the library with each of its
 * kernels.  NaN: it took no part. */
static void race(const struct contest *c, int is_shuffled,
                 double times[1 + KERNELS_MOST])
{
    struct contestant list[1 + KERNELS_MOST];
    const int n = list_contestants(c, list);
    int *order = allocate((size_t)c->questions * sizeof *order);
    for (int i = 0; i < c->questions; i++)
        order[i] = i;
    const double start = seconds_of(CLOCK_THREAD_CPUTIME_ID);
    for (int round = 0;
         round < ROUNDS ||
         seconds_of(CLOCK_THREAD_CPUTIME_ID) - start < user.seconds;
         round++)
        for (int i = 0; i < n; i++)
            if (takes_part(c, &list[i], i == n - 1))
                take_turn(&list[i], order, c->questions, is_shuffled);
    const double per = 1e9 / c->questions / (c->units > 0 ? c->units : 1);
    for (int i = 0; i < n; i++)
        times[i] = list[i].least < HUGE_VAL ? per * list[i].least : (double)NAN;
    cylint_use_kernels(NULL);
    free(order);
}

double compete(const struct contest *c)
{
    double times[1 + KERNELS_MOST] = {0};
    for (int is_shuffled = 0;
         is_shuffled <= !!c->is_shuffled && is_wanted(c->subject);
         is_shuffled++) {
        race(c, is_shuffled, times);
        print_row(c, is_shuffled, "ns", times[0], times + 1);
    }
    return times[kernels_count()];
}

/* ------------------------------------------------------------- the lines -- */

/* A field of a line, padded behind its comma. */
static void print_text(const char *text, int width)
{
    const char *const quote = strchr(text, ',') ? "\"" : "";
    const int n = printf("%s%s%s,", quote, text, quote);
    printf("%*s", n < width ? width - n : 1, "");
}

static void print_number(double x, const char *end)
{
    if (x == x)
        printf("%.4g%s", x, end);
    else
        printf("-%s", end);
}

static void print_header(void)
{
    printf("case,subject,question,order,rival,unit,theirs");
    for (int k = kernels_count(); k-- > 0;)
        printf(",%s", cylint_kernels_name(k));
    puts(",ratio");
}

/* ours: a number for each of the kernels. */
static void print_row(const struct contest *c, int is_shuffled,
                      const char *unit, double theirs, const double *ours)
{
    double best = NAN; /* the time of the last kernels, the best */
    char question[96];
    snprintf(question, sizeof question, "%s%s%s", c->question,
             c->setup ? "; " : "", c->setup ? c->setup : "");
    print_text(user.name, 10);
    print_text(c->subject, 20);
    print_text(question, 44);
    print_text(c->is_shuffled ? is_shuffled ? "shuffled" : "in order" : "-",
               10);
    print_text(c->rival ? c->rival : "-", 22);
    print_text(unit, 4);
    print_number(theirs, ", ");
    for (int k = 0; k < kernels_count(); k++) {
        print_number(ours[k], ", ");
        best = ours[k] == ours[k] ? ours[k] : best;
    }
    print_number(best / theirs, "\n");
    fflush(stdout);
    rows_printed++;
}

void print_figure(const char *subject, const char *question, const char *setup,
                  const char *rival, const char *unit, double theirs,
                  double ours)
{
    const struct contest c = {.subject = subject,
                              .question = question,
                              .setup = setup,
                              .rival = rival};
    double each[KERNELS_MOST];
    for (int k = 0; k < KERNELS_MOST; k++)
        each[k] = k == kernels_count() - 1 ? ours : (double)NAN;
    if (is_wanted(subject))
        print_row(&c, 0, unit, theirs, each);
}

/* ---------------------------------------------------------------- others -- */

int is_wanted(const char *subject)
{
    return subject && strstr(subject, user.only);
}

double most_or(double usual)
{
    return user.most > 0 ? user.most : usual;
}

int compare_doubles(const void *x, const void *y)
{
    const double a = *(const double *)x, b = *(const double *)y;
    return (a > b) - (a < b);
}

void require(int is_true, const char *message)
{
    if (!is_true) {
        fprintf(stderr, "bench: %s\n", message);
        exit(1);
    }
}

void *allocate(size_t bytes)
{
    void *memory = malloc(bytes ? bytes : 1);
    require(memory != NULL, "out of memory");
    return memory;
}

/* The number of a case, or CASES. */
static int case_of(const char *name)
{
    int i = 0;
    while (i < CASES && strcmp(cases[i].name, name))
        i++;
    return i;
}

static void run(int i)
{
    const int before = rows_printed;
    user.name = cases[i].name;
    cases[i].run();
    if (rows_printed == before)
        fprintf(stderr, "bench: -o and -n leave no subject of %s\n", user.name);
}

/* The number of an option. */
static double number_of(const char *text)
{
    char *end;
    const double x = strtod(text, &end);
    require(end > text && *end == '\0' && x > 0 && x < HUGE_VAL,
            "-s and -n need a number above 0");
    return x;
}

int main(int argc, char **argv)
{
    for (int option; (option = getopt(argc, argv, "s:n:o:")) != -1;) {
        require(option != '?', "options are -s -n -o");
        if (option == 's')
            user.seconds = number_of(optarg);
        else if (option == 'n')
            user.most = number_of(optarg);
        else
            user.only = optarg;
    }
    for (int at = optind; at < argc; at++)
        require(case_of(argv[at]) < CASES,
                "no such CASE; without one their names are printed");
    for (int i = 0; i < CASES && optind == argc; i++)
        printf("%-10s %s\n", cases[i].name, cases[i].text);
    if (optind == argc)
        return 0;
    stay_on_one_core();
    print_header();
    for (int at = optind; at < argc; at++)
        run(case_of(argv[at]));
    return rows_printed > 0 ? 0 : NO_SUBJECT;
}
