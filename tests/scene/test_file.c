/*
 * test_file.c - a scene that was saved and opened returns the same bits, and no
 * damaged file makes a query fail
 *
 * CYLINT_CASES: how many files with several changed numbers are opened.
 */
#if defined(__linux__)
#define _DEFAULT_SOURCE 1 /* fork() with -std=c99 */
#endif
#include <errno.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CHECK_OWN_MAIN
#include "check.h"
#include "cylint_scene.h"
#include "environment.h"
#include "answers.h"
#include "scene_file.h"
#include "ulps.h"
#include "../fuzz/scene_file.c"

#if defined(__unix__) || defined(__APPLE__)
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#define HAS_PROCESSES
#endif

enum { SHAPES = 400, SMALL = 6, MEMBERS = 7 };

static const char path[] = "file"; /* in a folder of the test's own */

/* ---------------------------------------------------------------- tests -- */

TEST(an_opened_scene_answers_as_the_saved_one_and_saves_the_same_bytes)
{
    OWN_BYTES first = {NULL, NULL, 0}, again = {NULL, NULL, 0};
    static const unsigned flags[] = {0, CYLINT_SCENE_READ, CYLINT_SCENE_TRUSTED,
                                     CYLINT_SCENE_READ | CYLINT_SCENE_TRUSTED};
    for (int k = 0; k < 3 * SCENE_KINDS; k++) {
        static const size_t sizes[] = {1, 16, SHAPES};
        const int kind = k / 3, slow = scene_is_slow(kind) && k % 3 == 2;
        cylint_scene_status status = CYLINT_SCENE_EFILE;
        OWN_SHAPES of =
            scene_generate(kind, slow ? SHAPES / 10 : sizes[k % 3], 7);
        OWN_SCENE *built = cylint_scene_new(of.shapes, of.n, 1, NULL);
        CHECK(cylint_scene_save(built, path) == CYLINT_SCENE_OK);
        scene_file_write(built, &first);
        for (int i = 0; i < 4; i++) {
            OWN_SCENE *opened = cylint_scene_open(path, flags[i], &status);
            if (!CHECK(opened && status == CYLINT_SCENE_OK))
                continue;
            const int wrong = differences(built, opened, &of, 11);
            if (!CHECK(wrong == 0))
                REPORT("%s, flags %u: %d differ", of.name, flags[i], wrong);
            scene_file_write(opened, &again);
            CHECK(first.n == again.n &&
                  same_bytes(first.data, again.data, first.n));
            const size_t bytes = cylint_scene_bytes(opened),
                         of_built = cylint_scene_bytes(built);
            CHECK(bytes >= first.n && bytes < of_built + 1024 &&
                  of_built < bytes + 1024);
            CHECK(cylint_scene_add(opened, of.shapes, 1) ==
                  CYLINT_SCENE_EFINISHED);
        }
    }
    remove(path);
}

/* A cylinder, a ball, an elliptic cone, a round cone, an infinite cylinder and the
 * nappe of a tangent cone, with labels; two solids. */
static void write_small(struct bytes *b)
{
    static const uint64_t ends[SMALL] = {1, 2, 2, 4, 5, 6};
    static const cylint_scene_labels labels = {ends, "abcdef"};
    static const cylint_member members[MEMBERS] = {
        {0, 0, 1},  {1, 0, -2}, {3, 1, 1}, {2, 1, 1},
        {5, 1, -7}, {4, 1, -7}, {4, 1, 8}};
    const cylint_shape shape[SMALL] = {
        shape_of("cylinder 0 0 0  3 1 2  0.125"),
        shape_of("sphere 3 1 2  0.5"),
        shape_of("econe 3 1 2  1 0.5 0  0 1 0.25  0 0 2  0.5 ends=open"),
        shape_of("rcone 0 0 0 0.5  1 0.5 0 0.25"),
        shape_of("cylinder 0 0 0  3 1 2  0.25 ends=infinite"),
        shape_of("acone 1 0.5 0  3 1 2  30 ends=nappe")};
    OWN_SCENE *scene = cylint_scene_new(shape, SMALL, 1, NULL);
    cylint_scene_set_labels(scene, &labels);
    CHECK(cylint_scene_set_solids(scene, members, MEMBERS) == CYLINT_SCENE_OK);
    scene_file_write(scene, b);
}

TEST(bytes_in_memory_open_at_every_address)
{
    OWN_BYTES b = {NULL, NULL, 0};
    OWN_SHAPES of = scene_generate(SCENE_MIXED, SHAPES, 3);
    OWN_SCENE *built = cylint_scene_new(of.shapes, of.n, 1, NULL);
    scene_file_write(built, &b);
    for (size_t shift = 0; shift < 80; shift += 8) {
        char *copy = malloc(b.n + shift);
        memcpy(copy + shift, b.data, b.n);
        cylint_scene *opened =
            cylint_scene_open_memory(copy + shift, b.n, 0, NULL);
        if ((uintptr_t)(copy + shift) % 64 != 0)
            memset(copy, 0, b.n + shift); /* it was copied */
        CHECK(opened && differences(built, opened, &of, shift) == 0);
        cylint_scene_free(opened);
        free(copy);
    }
}

TEST(an_empty_scene_can_be_saved)
{
    static const uint64_t before[2] = {9, 9};
    const cylint_scene_labels none = {before + 1, "of no shape"};
    OWN_BYTES b = {NULL, NULL, 0};
    OWN_SCENE *empty = cylint_scene_new(NULL, 0, 1, NULL);
    cylint_scene_set_labels(empty, &none);
    OWN_SCENE *opened = scene_file_reopen(empty, &b);
    CHECK(b.n == 512 && opened && cylint_scene_size(opened) == 0 &&
          !cylint_scene_get_labels(opened));
}

TEST(labels_are_saved)
{
    static const char text[] = "axon\0dend";
    static const uint64_t ends[2][3] = {{4, 4, 9}, {0, 0, 0}};
    const cylint_shape rod = shape_of("cylinder 0 0 0  0 0 1  1"),
                       shape[3] = {rod, rod, rod};
    OWN_BYTES b = {NULL, NULL, 0};
    for (int k = 0; k < 2; k++) {
        const cylint_scene_labels labels = {ends[k], text};
        OWN_SCENE *scene = cylint_scene_new(shape, 3, 1, NULL);
        CHECK(!cylint_scene_get_labels(scene));
        cylint_scene_set_labels(scene, &labels);
        OWN_SCENE *opened = scene_file_reopen(scene, &b);
        const cylint_scene_labels *got = cylint_scene_get_labels(opened);
        CHECK(got && memcmp(got->end, ends[k], sizeof ends[k]) == 0 &&
              (ends[k][2] == 0 || memcmp(got->text, text, 9) == 0));
        cylint_scene_set_labels(opened, NULL);
        CHECK(!cylint_scene_get_labels(opened));
    }
}

static int write_few(void *context, const void *data, size_t n)
{
    int *calls = context;
    (void)data;
    (void)n;
    return --*calls > 0;
}

TEST(a_failure_has_its_status_and_errno)
{
    cylint_scene_status status = CYLINT_SCENE_OK;
    OWN_SHAPES of = scene_generate(SCENE_FAT, SMALL, 3);
    OWN_SCENE *scene = cylint_scene_begin(0);
    CHECK(cylint_scene_add(scene, of.shapes, of.n) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_save(scene, path) == CYLINT_SCENE_EUNFINISHED);
    CHECK(!cylint_scene_open(path, 0, &status) &&
          status == CYLINT_SCENE_EFILE && errno == ENOENT);
    CHECK(cylint_scene_finish(scene, 1, NULL, NULL) == CYLINT_SCENE_OK);
    for (int calls = 1; calls < 6; calls++) {
        int more = calls;
        CHECK(cylint_scene_write(scene, write_few, &more) ==
              CYLINT_SCENE_ESTOPPED);
    }
    errno = 0;
    CHECK(cylint_scene_save(scene, "missing/x") == CYLINT_SCENE_EFILE &&
          errno == ENOENT);
#ifdef HAS_PROCESSES
    CHECK(!cylint_scene_open("/", 0, &status) && status == CYLINT_SCENE_EFILE);
    /* a full disk: what is buffered fails at the end */
    for (size_t n = 1; n <= SHAPES && access("/dev/full", W_OK) == 0;
         n += SHAPES - 1) {
        OWN_SHAPES some = scene_generate(SCENE_FAT, n, 3);
        OWN_SCENE *lost = cylint_scene_new(some.shapes, n, 1, NULL);
        errno = 0;
        CHECK(cylint_scene_save(lost, "/dev/full") == CYLINT_SCENE_EFILE &&
              errno == ENOSPC);
    }
#endif
}

#ifdef HAS_PROCESSES

/* Whether a command for a shell succeeds; in it $PPID is this process. */
static int shell(const char *command)
{
    return system(command) == 0;
}

/* The new file may not have more than 4096 bytes. */
TEST(a_failure_leaves_the_old_file)
{
    struct rlimit usual;
    OWN_SHAPES of = scene_generate(SCENE_FAT, SHAPES, 3);
    OWN_SCENE *old = cylint_scene_new(of.shapes, 3, 1, NULL);
    OWN_SCENE *larger = cylint_scene_new(of.shapes, of.n, 1, NULL);
    CHECK(cylint_scene_save(old, path) == CYLINT_SCENE_OK);
    CHECK(getrlimit(RLIMIT_FSIZE, &usual) == 0);
    const struct rlimit little = {4096, usual.rlim_max};
    signal(SIGXFSZ, SIG_IGN);
    CHECK(setrlimit(RLIMIT_FSIZE, &little) == 0);
    CHECK(cylint_scene_save(larger, path) == CYLINT_SCENE_EFILE &&
          errno == EFBIG);
    CHECK(setrlimit(RLIMIT_FSIZE, &usual) == 0);
    signal(SIGXFSZ, SIG_DFL);
    CHECK(shell("test ! -e file.$PPID.new"));
    OWN_SCENE *opened = cylint_scene_open(path, 0, NULL);
    CHECK(opened && differences(old, opened, &of, 5) == 0);
    remove(path);
}

/* Commands before and after a scene is saved to a file of this name. */
static char longest_name[256];
static const struct {
    const char *before, *name, *after;
    cylint_scene_status status;
} saves[] = {
    /* a link of the new file's name would lead the writer to another file */
    {"ln -s target file.$PPID.new", "file", "test ! -e target && test -s file",
     CYLINT_SCENE_OK},
    /* where a link leads, the old file stays until it is replaced */
    {"echo old >file; ln file file.old; ln -s file link", "link",
     "test -h link && test -s file && grep -q old file.old", CYLINT_SCENE_OK},
    {"ln -s file link", "link", "test -h link && test -s file",
     CYLINT_SCENE_OK},
    /* the permissions of the old file, whatever the umask */
    {"touch file; chmod 600 file", "file", "find file -perm 600 | grep -q f",
     CYLINT_SCENE_OK},
    {"touch file; chmod 666 file", "file", "find file -perm 666 | grep -q f",
     CYLINT_SCENE_OK},
    {"touch file; chmod 755 file", "file", "find file -perm 755 | grep -q f",
     CYLINT_SCENE_OK},
    /* its owner, too, if this process may set it */
    {"touch file; chown 65534 file 2>&-; find file -user 65534 >file.owned",
     "file", "find file -user 65534 | cmp - file.owned", CYLINT_SCENE_OK},
    {"touch $(printf %0255d 0)", longest_name, "test -s $(printf %0255d 0)",
     CYLINT_SCENE_OK},
    /* a folder cannot be replaced by a file */
    {"mkdir file", "file", "test ! -e file.$PPID.new && rmdir file",
     CYLINT_SCENE_EFILE}};

TEST(a_file_takes_the_place_of_the_old_one)
{
    OWN_SCENE *empty = cylint_scene_new(NULL, 0, 1, NULL);
    snprintf(longest_name, sizeof longest_name, "%0255d", 0);
    for (size_t i = 0; i < sizeof saves / sizeof *saves; i++)
        if (!CHECK(shell(saves[i].before) &&
                   cylint_scene_save(empty, saves[i].name) == saves[i].status &&
                   shell(saves[i].after) && shell("rm -rf file* link 00*")))
            REPORT("%s; save %s; %s", saves[i].before, saves[i].name,
                   saves[i].after);
}

/* As /dev/stdout, if that is a temporary file that has no name. */
TEST(a_link_to_a_removed_file_is_written_through)
{
    char name[64];
    struct stat about;
    OWN_SCENE *empty = cylint_scene_new(NULL, 0, 1, NULL);
    FILE *file = fopen(path, "wb");
    if (!CHECK(file && remove(path) == 0))
        return;
    snprintf(name, sizeof name, "/proc/self/fd/%d", fileno(file));
    if (access(name, W_OK) == 0)
        CHECK(cylint_scene_save(empty, name) == CYLINT_SCENE_OK &&
              fstat(fileno(file), &about) == 0 && about.st_size == 512);
    fclose(file);
}

/* Such a file has one reader, who must not close and open it again. */
TEST(a_named_pipe_is_written_to_and_read_and_not_replaced)
{
    int status = 1;
    struct stat about;
    OWN_SHAPES of = scene_generate(SCENE_FAT, SMALL, 3);
    OWN_SCENE *built = cylint_scene_new(of.shapes, of.n, 1, NULL);
    CHECK(mkfifo(path, 0600) == 0);
    const pid_t child = fork();
    if (child == 0)
        _exit(cylint_scene_save(built, path) != CYLINT_SCENE_OK);
    OWN_SCENE *opened = cylint_scene_open(path, 0, NULL);
    CHECK(opened && differences(built, opened, &of, 5) == 0);
    CHECK(waitpid(child, &status, 0) == child && status == 0);
    CHECK(stat(path, &about) == 0 && S_ISFIFO(about.st_mode));
    remove(path);
}

/* Of a pipe without a scene, which may have no end. */
TEST(only_the_first_bytes_of_another_file_are_read)
{
    static const char zeros[1 << 16];
    int status = 1;
    cylint_scene_status opened;
    CHECK(mkfifo(path, 0600) == 0);
    const pid_t child = fork();
    if (child == 0) {
        const int to = open(path, O_WRONLY);
        signal(SIGPIPE, SIG_IGN);
        for (int i = 0; i < 1000; i++)
            if (write(to, zeros, sizeof zeros) < 0)
                _exit(0);
        _exit(1);
    }
    CHECK(!cylint_scene_open(path, CYLINT_SCENE_TRUSTED, &opened) &&
          opened == CYLINT_SCENE_EFORMAT);
    CHECK(waitpid(child, &status, 0) == child && status == 0);
    remove(path);
    CHECK(access("/dev/zero", R_OK) != 0 ||
          (!cylint_scene_open("/dev/zero", 0, &opened) &&
           opened == CYLINT_SCENE_EFORMAT));
}

/* The mapping of a file that is replaced stays as it was.  A file that was read may
 * become shorter. */
TEST(an_opened_file_may_be_replaced)
{
    OWN_SHAPES of = scene_generate(SCENE_THIN, SHAPES, 3);
    OWN_SCENE *built = cylint_scene_new(of.shapes, of.n, 1, NULL);
    CHECK(cylint_scene_save(built, path) == CYLINT_SCENE_OK);
    OWN_SCENE *opened = cylint_scene_open(path, 0, NULL);
    OWN_SCENE *other = cylint_scene_new(of.shapes, 3, 1, NULL);
    CHECK(cylint_scene_save(other, path) == CYLINT_SCENE_OK);
    CHECK(opened && differences(built, opened, &of, 6) == 0);
    OWN_SCENE *copied = cylint_scene_open(path, CYLINT_SCENE_READ, NULL);
    CHECK(truncate(path, 0) == 0);
    CHECK(copied && differences(other, copied, &of, 7) == 0);
    remove(path);
}

#endif

/* Shapes whose axes and radii are subnormal, or nearly, in some coordinates. */
static void fill_tiny(cylint_shape shape[20])
{
    static const double tiny[] = {0, 0x1p-1074, 0x1p-1023, 0x1p-1021, 0x1p-400};
    for (int i = 0; i < 20; i++) {
        const double x = tiny[i / 4], y = i % 2 ? x : 0;
        const double p[3] = {i, y, 0.25}, q[3] = {i + 1, 0, y};
        if (i % 4 == 0)
            cylint_cylinder(&shape[i], p, q, x > 0 ? x : 1, CYLINT_ENDS_OPEN);
        else if (i % 4 == 1)
            cylint_cone(&shape[i], p, x, q, 0.5, CYLINT_ENDS_CAPPED);
        else if (i % 4 == 2)
            cylint_round_cone(&shape[i], p, x, q, 0.9979, CYLINT_ENDS_CAPPED);
        else
            cylint_sphere(&shape[i], p, x > 0 ? x : 1, CYLINT_ENDS_CAPPED);
    }
}

/* That was saved in one environment, and opens in each other one.  Up to four balls
 * are so far away that the middle of their box is rounded, unless the box was. */
TEST(a_file_opens_in_every_environment)
{
    enum { BALLS = 4 };
    OWN_BYTES b = {NULL, NULL, 0};
    cylint_shape tiny[20], ball[BALLS];
    fill_tiny(tiny);
    for (int i = 0; i < BALLS; i++)
        cylint_sphere(&ball[i], (double[]){0x1p52 + 1 + i, 0, 0}, 0.25,
                      CYLINT_ENDS_CAPPED);
    EACH_ENVIRONMENT(there)
        for (size_t n = 0; n <= BALLS; n++) {
            const double at[3] = {0x1p52 + (double)n, 0, 0};
            environment_set(there);
            OWN_SCENE *built = n > 0 ? cylint_scene_new(ball, n, 1, NULL)
                                     : cylint_scene_new(tiny, 20, 1, NULL);
            scene_file_write(built, &b);
            environment_reset();
            EACH_ENVIRONMENT(other) {
                environment_set(other);
                OWN_SCENE *opened =
                    cylint_scene_open_memory(b.data, b.n, 0, NULL);
                environment_reset();
                CHECK(opened && same_shapes(built, opened));
                CHECK(n == 0 || cylint_scene_contains(opened, at, 0) == 1);
            }
        }
}

/* One of them is beside the hierarchy, and the box of the others is too small for
 * one. */
TEST(a_file_of_tiny_shapes_and_a_distant_one_opens)
{
    enum { BALLS = 64 };
    OWN_BYTES b = {NULL, NULL, 0};
    cylint_shape ball[BALLS];
    for (int i = 0; i < BALLS; i++)
        cylint_sphere(&ball[i], (double[]){i == 7 ? 1 : i * 0x1p-420, 0, 0},
                      0x1p-420, CYLINT_ENDS_CAPPED);
    OWN_SCENE *built = cylint_scene_new(ball, BALLS, 1, NULL);
    OWN_SCENE *opened = scene_file_reopen(built, &b);
    CHECK(opened && same_shapes(built, opened));
    for (int i = 0; i < 3; i++) {
        const double p[3] = {i < 2 ? i : 20 * 0x1p-420, 0, 0};
        const size_t holding = i == 0 ? 2 : i == 1 ? 1 : 3;
        CHECK(cylint_scene_contains(built, p, 0) == holding);
        CHECK(opened && cylint_scene_contains(opened, p, 0) == holding);
    }
}

/* ------------------------------------------------------- damaged files -- */

/* Changes of a byte, by exclusive or: of one bit, of all.  Returns 0 after the
 * last. */
static int next_change(int change)
{
    return change == 0 ? 1 : change == 128 ? 255 : 2 * change % 510;
}

/* With the checksum made right after the change, no query fails. */
TEST(every_changed_byte_is_refused_or_makes_no_query_fail)
{
    OWN_BYTES b = {NULL, NULL, 0};
    int opened = 0;
    write_small(&b);
    CHECK(scene_file_try(b.data, b.n) == CYLINT_SCENE_OK);
    for (size_t i = 0; i < b.n; i++)
        for (int change = 1; change != 0; change = next_change(change)) {
            const char changed = (char)(b.data[i] ^ change);
            const cylint_scene_status repaired =
                scene_file_with(&b, &b.data[i], &changed, 1);
            scene_file_repair(b.data, b.n);
            b.data[i] = changed;
            const cylint_scene_status status = scene_file_try(b.data, b.n);
            if (!CHECK(status == (i < 8    ? CYLINT_SCENE_EFORMAT
                                  : i < 24 ? CYLINT_SCENE_EVERSION
                                           : CYLINT_SCENE_EDAMAGED)))
                REPORT("byte %zu ^ %d: status %d", i, change, (int)status);
            CHECK(repaired == CYLINT_SCENE_OK || repaired == status ||
                  repaired == CYLINT_SCENE_EDAMAGED);
            opened += repaired == CYLINT_SCENE_OK;
            b.data[i] = (char)(changed ^ change);
        }
    CHECK(opened > 100);
    b.data[CYLINT_FILE_CHECKSUM]++; /* is not read then */
    OWN_SCENE *trusted =
        cylint_scene_open_memory(b.data, b.n, CYLINT_SCENE_TRUSTED, NULL);
    CHECK(trusted != NULL);
}

TEST(every_shorter_file_is_refused)
{
    OWN_BYTES b = {NULL, NULL, 0};
    write_small(&b);
    for (size_t n = 0; n < b.n; n++) {
        char *copy = malloc(n + 1); /* so that a read beyond it is found */
        memcpy(copy, b.data, n);
        const cylint_scene_status status = scene_file_try(copy, n);
        CHECK(status == (n < 8 ? CYLINT_SCENE_EFORMAT : CYLINT_SCENE_EDAMAGED));
        free(copy);
    }
    b.n += 64;
    CHECK(scene_file_try(b.data, b.n) == CYLINT_SCENE_EDAMAGED);
}

/* NaN is in no order with other numbers.  test_records.c has more records.  The
 * bounds of the frame are doubles, those of the hierarchy floats. */
TEST(damaged_records_and_boxes_are_refused)
{
    enum { FIRST_RECORD = 512, FRAME = 136, BOXES_END = 208 };
    static const double zero = 0, nine = 9, nan = NAN;
    OWN_BYTES b = {NULL, NULL, 0};
    write_small(&b);
    CHECK(scene_file_with(&b, b.data + FIRST_RECORD, &zero, 8) ==
          CYLINT_SCENE_OK);
    CHECK(scene_file_with(&b, b.data + FIRST_RECORD, &nan, 8) ==
          CYLINT_SCENE_EDAMAGED);
    for (size_t i = FRAME; i < BOXES_END; i += 8)
        CHECK(scene_file_with(&b, b.data + i, &nan, 8) ==
              CYLINT_SCENE_EDAMAGED);
    CHECK(scene_file_with(&b, b.data + FRAME, &nine, 8) ==
          CYLINT_SCENE_EDAMAGED);
}

enum { RECORDS, TAGS, BOUNDED = 5, OTHERS, LABEL_ENDS, LABEL_TEXT, SOLIDS };

/* By one element, in the last block of the section. */
TEST(a_longer_or_shorter_section_is_refused)
{
    static const struct {
        int section;
        uint64_t element;
    } of[] = {{TAGS, 1}, {BOUNDED, 4}, {LABEL_ENDS, 8}, {LABEL_TEXT, 1}};
    OWN_BYTES b = {NULL, NULL, 0};
    write_small(&b);
    for (size_t i = 0; i < 2 * sizeof of / sizeof *of; i++) {
        uint64_t *bytes = &scene_file_sizes(&b)[of[i / 2].section];
        const uint64_t element = of[i / 2].element,
                       other = i % 2 ? *bytes + element : *bytes - element;
        if (!CHECK(scene_file_with(&b, bytes, &other, sizeof other) ==
                   CYLINT_SCENE_EDAMAGED))
            REPORT("section %d, %d bytes", of[i / 2].section, (int)other);
    }
}

/* Of the small file, where shapes 0 to 3 are bounded and members are shape, solid
 * and clause.  of: a section, a place in it, the number there, and another one. */
TEST(damaged_numbers_of_shapes_and_members_are_refused)
{
    enum { LAST = 3 * (MEMBERS - 1) };
    static const uint32_t of[][4] = {
        {BOUNDED, 1, 1, 0},       {BOUNDED, 2, 2, 0},
        {BOUNDED, 3, 3, 2},       {BOUNDED, 3, 3, SMALL},
        {OTHERS, 0, 4, 5},        {OTHERS, 1, 5, 3},
        {OTHERS, 1, 5, 4},        {OTHERS, 1, 5, SMALL},
        {SOLIDS, 0, 0, SMALL},    {SOLIDS, 0, 0, UINT32_MAX},
        {SOLIDS, 1, 0, MEMBERS},  {SOLIDS, 1, 0, UINT32_MAX},
        {SOLIDS, 2, 1, 0},        {SOLIDS, 2, 1, 1u << 31},
        {SOLIDS, LAST, 4, SMALL}, {SOLIDS, LAST + 1, 1, MEMBERS},
        {SOLIDS, LAST + 2, 8, 0}};
    OWN_BYTES b = {NULL, NULL, 0};
    write_small(&b);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        uint32_t *number = scene_file_section(&b, (int)of[i][0]);
        number += of[i][1];
        if (!CHECK(*number == of[i][2] &&
                   scene_file_with(&b, number, &of[i][3], 4) ==
                       CYLINT_SCENE_EDAMAGED))
            REPORT("section %u, number %u", of[i][0], of[i][1]);
    }
}

/* Of one shape that was refused: a record less, and a shape more beside the
 * hierarchy; the end of its label behind the file, and a text of nearly 2^64
 * bytes. */
TEST(sections_of_other_sizes_with_the_same_sum_are_refused)
{
    enum { BLOCK = 64 };
    static const int section[][2] = {{RECORDS, OTHERS},
                                     {LABEL_TEXT, LABEL_ENDS}};
    static const uint64_t size[][2] = {{0, 4}, {0 - (uint64_t)BLOCK, 8}};
    OWN_BYTES b = {NULL, NULL, 0};
    cylint_shape shape;
    cylint_sphere(&shape, (double[]){0, 0, 0}, -1, CYLINT_ENDS_CAPPED);
    OWN_SCENE *scene = cylint_scene_new(&shape, 1, 1, NULL);
    for (int i = 0; i < 2; i++) {
        scene_file_write(scene, &b);
        memcpy(b.data + b.n, &size[1][0], sizeof size[1][0]);
        for (int k = 0; k < 2; k++)
            scene_file_sizes(&b)[section[i][k]] = size[i][k];
        scene_file_repair(b.data, b.n);
        CHECK(scene_file_try(b.data, b.n) == CYLINT_SCENE_EDAMAGED);
    }
}

/* Shape 3 is in the hierarchy already. */
TEST(a_shape_is_not_in_both_lists)
{
    static const uint32_t others[] = {3, 4, 5};
    OWN_BYTES b = {NULL, NULL, 0};
    write_small(&b);
    memcpy(scene_file_section(&b, OTHERS), others, sizeof others);
    scene_file_sizes(&b)[OTHERS] = sizeof others;
    scene_file_repair(b.data, b.n);
    CHECK(scene_file_try(b.data, b.n) == CYLINT_SCENE_EDAMAGED);
}

/* Of one shape that was refused, without nodes, or of one in the hierarchy. */
TEST(more_bounded_shapes_than_there_are_are_refused)
{
    enum { N_BOUNDED = 48, HI = 160 };
    static const double hi[3] = {1, 1, 1};
    OWN_BYTES b = {NULL, NULL, 0};
    for (uint64_t n = 0; n < 2; n++) {
        const uint64_t more = n + 1;
        cylint_shape shape;
        cylint_sphere(&shape, hi, n > 0 ? 1 : -1, CYLINT_ENDS_CAPPED);
        OWN_SCENE *scene = cylint_scene_new(&shape, 1, 1, NULL);
        scene_file_write(scene, &b);
        CHECK(memcmp(b.data + N_BOUNDED, &n, sizeof n) == 0);
        memcpy(b.data + HI, hi, sizeof hi); /* a box that is not empty */
        CHECK(scene_file_with(&b, b.data + N_BOUNDED, &more, sizeof more) ==
              CYLINT_SCENE_EDAMAGED);
    }
}

/* A number at a limit or next to it, any other number, or x with a change. */
static double any_number(double x)
{
    static const double limits[] = {
        0, 0x1p-1074, DBL_MIN, 0x1p-537, 0x1p-400, 0x1p-120, 0x1p-60,  0.5,
        1, 0x1p60,    0x1p100, 0x1p200,  0x1p400,  DBL_MAX,  HUGE_VAL, NAN};
    const double limit = limits[one_of(sizeof limits / sizeof *limits)];
    const uint64_t bits = random_bits(&stream);
    switch (one_of(8)) {
    case 0:
        memcpy(&x, &bits, sizeof x);
        return x;
    case 1:
        return x * limit;
    case 2:
        return stepped(x, one_of(2) ? 1 : -1);
    case 3:
        return -x;
    case 4:
        return stepped(limit, one_of(2) ? 1 : -1);
    default:
        return one_of(2) ? limit : -limit;
    }
}

/* In place of libFuzzer's, which is not linked here: changes bytes, copies some, or
 * changes a number.  Once in 64 times the file becomes longer or shorter. */
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most)
{
    const size_t bytes = (size_t)1 << one_of(8), to = below(size / bytes),
                 from = below(size / bytes);
    double x;
    switch (one_of(4)) {
    case 0:
        data[below(size)] ^= (uint8_t)random_bits(&stream);
        break;
    case 1:
        memmove(data + to * bytes, data + from * bytes, bytes);
        break;
    default:
        data += below(size / 8) * 8;
        memcpy(&x, data, sizeof x);
        x = any_number(x);
        memcpy(data, &x, sizeof x);
    }
    return one_of(64) || size + 64 > most ? size : size + 64 - 128 * below(2);
}

/* Random changes of files of all kinds and sizes, by the target for fuzzing. */
TEST(no_changed_numbers_make_a_query_fail)
{
    const int cases = (int)check_setting("CYLINT_CASES", 6000);
    static uint8_t file[1 << 15];
    for (int i = 0; i < cases; i++) {
        const unsigned kind = 64 * (unsigned)below(SCENE_KINDS * 8);
        const uint64_t bits = random_bits(&stream);
        size_t size = LLVMFuzzerCustomMutator(file, 0, sizeof file, kind);
        for (int k = 1 + one_of(4); k > 0; k--)
            size = LLVMFuzzerCustomMutator(file, size, sizeof file, 1);
        memcpy(file + CYLINT_FILE_CHECKSUM, &bits, sizeof bits);
        LLVMFuzzerTestOneInput(file, size);
    }
    CHECK(files_opened > cases / 4);
}

int main(void)
{
#ifdef HAS_PROCESSES
    char folder[64];
    snprintf(folder, sizeof folder, "%s/scene_file.XXXXXX",
             getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    if (!mkdtemp(folder) || chdir(folder) != 0)
        return check_skip("no folder for temporary files");
    const int failed = check_all();
    rmdir(folder);
    return failed;
#else
    return check_all();
#endif
}
