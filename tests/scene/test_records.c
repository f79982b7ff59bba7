/*
 * test_records.c - a record holds its shape, and local coordinates in doubles
 * decide right or not at all
 *
 * The shapes are those of the families of families.h.  A decision is compared with
 * cylint_occluded() in every rounding mode.  CYLINT_CASES is the number of cases of
 * each family.
 */
#include "check.h"
#include "cylint_scene.h"
#include "environment.h"
#include "families.h"
#include "intersect.h"
#include "same.h"
#include "scene_file.h"
#include "scenes.h"
#include "scene/records.h"
#include "shapes/shape_facts.h"

enum { CASES = 2000 };

/* Whether a record with this tag is sound, alone or after one with semi-axes. */
static int is_sound(int tag, cylint_record record)
{
    cylint_record both[2] = {record, {{0, 0, 0}, 0, {0, 0, 1}, 1}};
    uint8_t tags[2] = {(uint8_t)tag, CYLINT_KIND_ECYLINDER};
    cylint_semi_axes axes = {{1, 0, 0}, {0, 1, 0}};
    cylint_records one = {both, tags, NULL, 1, 1, 0, 0},
                   two = {both, tags, &axes, 2, 2, 1, 1};
    return cylint_records_are_sound(&one) &&
           CHECK(cylint_records_are_sound(&two));
}

/* Shapes along each coordinate from p to q, with radii r0 and r1. */
TEST(only_records_that_constructors_accept_are_sound)
{
    enum { PLAIN = CYLINT_TAG_PLAIN, ENDS = CYLINT_TAG_ENDS };
    enum { CYLINDER = CYLINT_KIND_CYLINDER, CONE, ACONE };
    enum { SPHERE = CYLINT_KIND_SPHERE, CAPSULE, RCONE };
    static const double most = CYLINT_WINDOW, far = CYLINT_FAR;
    static const struct {
        int tag, is_sound;
        double p, r0, q, r1;
    } of[] = {{PLAIN | CYLINDER, 1, 0, 1, 1, 1},
              {PLAIN | CYLINDER | 3 * ENDS, 1, 0, 1, 1, 1},
              {PLAIN | CYLINDER | 4 * ENDS, 0, 0, 1, 1, 1},
              {PLAIN | CYLINDER, 0, 0, 1, 1, 2},
              {PLAIN | CYLINDER, 0, 0, -1, 1, -1},
              {PLAIN | CYLINDER, 0, 0, 0, 1, 0},
              {PLAIN | CYLINDER, 1, 0, most, 1, most},
              {PLAIN | CYLINDER, 0, 0, 2 * most, 1, 2 * most},
              {PLAIN | CYLINDER, 0, 0, NAN, 1, NAN},
              {PLAIN | CYLINDER, 0, 1, 1, 1, 1},
              {PLAIN | CYLINDER, 0, NAN, 1, 1, 1},
              {PLAIN | CYLINDER, 0, 0, 1, NAN, 1},
              {PLAIN | CYLINDER, 0, 0, 1, HUGE_VAL, 1},
              {PLAIN | CYLINDER, 1, 0, 1, most, 1},
              {PLAIN | CYLINDER, 0, 0, 1, 4 * most, 1},
              {PLAIN | CYLINDER, 1, far, 1, 0x1.00000000001p100, 1},
              {PLAIN | CYLINDER, 0, 2 * far, 1, 0x1.00000000001p101, 1},
              {PLAIN | CONE, 1, 0, 0, 1, 2},
              {PLAIN | CONE, 0, 0, 2, 1, 2},
              {PLAIN | CONE, 0, 0, -1, 1, 2},
              {PLAIN | CONE, 0, 0, 2, 1, -1},
              {PLAIN | CONE, 0, 0, 2 * most, 1, 1},
              {PLAIN | CONE, 1, 0, 1, 0x1p-120, 2},
              {PLAIN | CONE, 0, 0, 1, 0x1p-123, 2},
              {PLAIN | CONE, 0, 0, 1, 1, 2 * most},
              {PLAIN | ACONE, 0, 0, 0, 1, 1},
              {PLAIN | SPHERE, 0, 0, 1, 1, 1},
              {PLAIN | CAPSULE, 1, 0, 1, 1, 1},
              {PLAIN | CAPSULE, 0, 0, 1, 1, 2},
              {PLAIN | RCONE, 1, 0, 0, 1, 0.5},
              {PLAIN | RCONE, 1, 0, 1, 1, 1.9979},
              {PLAIN | RCONE, 0, 0, 1, 1, 1.99999},
              {PLAIN | RCONE, 0, 0, 1, 1, 2},
              {PLAIN | RCONE, 0, 0, 1, 1, 4},
              {CYLINDER, 1, 0, 1, 1, 1},
              {CYLINDER | 4 * ENDS, 1, 0, 1, 1, 1},
              {CYLINDER | 6 * ENDS, 0, 0, 1, 1, 1},
              {CYLINDER, 0, 0, -1, 1, -1},
              {RCONE, 1, 0, 1, 1, 9},
              {CYLINT_KIND_HALFSPACE + 1, 0, 0, 1, 1, 1}};
    for (size_t n = 0; n < 3 * sizeof of / sizeof *of; n++) {
        const size_t i = n / 3, k = n % 3;
        cylint_record record = {{0, 0, 0}, of[i].r0, {0, 0, 0}, of[i].r1};
        record.p0[k] = of[i].p;
        record.p1[k] = of[i].q;
        if (!CHECK(is_sound(of[i].tag, record) == of[i].is_sound))
            REPORT("record %zu, coordinate %zu", i, k);
    }
}

TEST(semi_axes_belong_to_elliptic_records_in_their_order)
{
    cylint_record record[2] = {{{0, 0, 0}, 0, {0, 0, 1}, 1},
                               {{0, 0, 0}, 1, {0, 0, 1}, 1}};
    uint8_t tag[2] = {CYLINT_KIND_ECYLINDER, CYLINT_KIND_ECYLINDER};
    cylint_semi_axes axes[3] = {
        {{1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 2, 0}}, {{1, 0, 0}, {0, 3, 0}}};
    for (size_t n = 0; n <= 3; n++) {
        const cylint_records r = {record, tag, axes, 2, 2, n, n};
        CHECK(cylint_records_are_sound(&r) == (n == 2));
    }
    const cylint_records r = {record, tag, axes, 2, 2, 2, 2};
    record[1].r0 = 0;
    CHECK(!cylint_records_are_sound(&r));
}

/* Added one by one: what is reserved for more is given back. */
TEST(records_take_65_bytes_and_semi_axes_48)
{
    enum { N = 10 };
    static const char *const shapes[] = {"ecylinder 0 0 0  1 0 0  0 1 0  0 0 1",
                                         "sphere 0 0 0 1"};
    cylint_records r = {.n = 0};
    for (int i = 0; i < 2 * N; i++) {
        const cylint_shape shape = shape_of(shapes[i % 2]);
        CHECK(cylint_records_add(&r, &shape, 1));
    }
    cylint_records_trim(&r);
    CHECK(cylint_records_bytes(&r) == 2 * N * 65 + N * 48);
    CHECK(cylint_records_are_sound(&r));
    cylint_records_free(&r);
}

TEST(calls_for_a_scene_in_another_state_are_refused)
{
    const cylint_shape shape = shape_of("sphere 0 0 0 1");
    const cylint_member member = {0, 0, 1};
    OWN_BYTES b = {NULL, NULL, 0};
    OWN_SCENE *scene = cylint_scene_begin(1);
    CHECK(cylint_scene_add(scene, NULL, 0) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_add(scene, &shape, 1) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_add(scene, &shape, (size_t)-1) == CYLINT_SCENE_ESIZE);
    CHECK(cylint_scene_add(scene, &shape, 1 << 28) == CYLINT_SCENE_ESIZE);
    CHECK(cylint_scene_refit(scene, 0, 1, &shape) == CYLINT_SCENE_EUNFINISHED);
    CHECK(cylint_scene_set_solids(scene, &member, 1) ==
          CYLINT_SCENE_EUNFINISHED);
    CHECK(cylint_scene_write(scene, bytes_append, &b) ==
          CYLINT_SCENE_EUNFINISHED);
    CHECK(cylint_scene_finish(scene, 0, NULL, NULL) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_members(scene) == 0);
    OWN_SCENE *opened = scene_file_reopen(scene, &b);
    CHECK(cylint_scene_refit(opened, 0, 1, &shape) == CYLINT_SCENE_EOPENED);
    for (int i = 0; i < 2; i++) {
        cylint_scene *s = i ? opened : scene;
        CHECK(cylint_scene_add(s, &shape, 1) == CYLINT_SCENE_EFINISHED);
        CHECK(cylint_scene_finish(s, 0, NULL, NULL) == CYLINT_SCENE_EFINISHED);
        CHECK(cylint_scene_size(s) == 1);
        CHECK(cylint_scene_set_solids(s, &member, 1) == CYLINT_SCENE_OK);
        CHECK(cylint_scene_members(s) == 1);
    }
}

/* Totals over all lines and shapes. */
static struct {
    long decided, undecided;
} total;

static void check_decision(const cylint_records *records,
                           const struct family_case *c, int mode)
{
    const int hit = cylint_occluded(&c->shape, &c->line);
    fesetround(mode);
    const int is =
        cylint_occluded_in_doubles(cylint_record_kind(records, 0), (int)c->ends,
                                   &records->record[0], &c->line);
    fesetround(FE_TONEAREST);
    total.decided += is != CYLINT_UNDECIDED;
    total.undecided += is == CYLINT_UNDECIDED;
    if (!CHECK(is == CYLINT_UNDECIDED || is == hit)) {
        REPORT("%d instead of %d, mode %d:", is, hit, mode);
        family_report(c);
    }
}

TEST(local_coordinates_in_doubles_decide_right_or_not_at_all)
{
    const long cases = (long)check_setting("CYLINT_CASES", CASES);
    EACH_CASE(c, 31, cases) {
        cylint_records records = {.n = 0};
        c.ends = (cylint_ends)(number % 4); /* planes */
        family_make(&c);
        CHECK(cylint_records_add(&records, &c.shape, 1));
        if (records.tag[0] & CYLINT_TAG_PLAIN)
            for (int m = 0; m < ROUNDINGS; m++)
                check_decision(&records, &c, roundings[m]);
        cylint_records_free(&records);
    }
    CHECK(total.decided > 10 * cases && total.undecided > 0);
    printf("note: %ld decisions, %ld undecided\n", total.decided,
           total.undecided);
}
