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
#include "scenes.h"
#include "scene/records.h"
#include "shapes/shape_facts.h"

enum { CASES = 2000, BLOCK = 64 };

/* Hulls of two balls too, of which one holds the other; and shapes that were
 * refused. */
TEST(a_scene_returns_its_shapes)
{
    for (int family = 0; family < family_count(); family++) {
        static cylint_shape shapes[BLOCK];
        cylint_shape back;
        OWN_SCENE *scene = cylint_scene_begin(0);
        for (int block = 0; block < 2; block++) {
            for (int i = 0; i < BLOCK; i++) {
                struct family_case c;
                family_case(9, family, (uint64_t)(block * BLOCK + i), &c);
                shapes[i] = c.shape;
            }
            cylint_sphere(shapes, (double[]){0, 0, 0}, -1, CYLINT_ENDS_CAPPED);
            CHECK(cylint_scene_add(scene, shapes, BLOCK) == CYLINT_SCENE_OK);
        }
        CHECK(cylint_scene_size(scene) == 2 * BLOCK);
        CHECK(cylint_scene_finish(scene, 1, NULL, NULL) == CYLINT_SCENE_OK);
        for (int i = 0; i < BLOCK; i++) {
            cylint_scene_shape(scene, (size_t)(BLOCK + i), &back);
            if (!CHECK(same_bytes(&back, &shapes[i], sizeof back)))
                REPORT("family %s, shape %d", family_name(family), i);
        }
    }
}

/* Local coordinates depend on the rounding mode of their constructor. */
TEST(a_shape_is_made_again_in_its_rounding_mode)
{
    static const double p[3] = {0.1, 0.2, 0.3}, q[3] = {1, 2, 7};
    for (int i = 0; i < ROUNDINGS; i++) {
        cylint_shape shape, back;
        fesetround(roundings[i]);
        CHECK(cylint_cylinder(&shape, p, q, 0.7, CYLINT_ENDS_CAPPED) ==
              CYLINT_OK);
        fesetround(roundings[ROUNDINGS - 1 - i]);
        OWN_SCENE *scene = cylint_scene_new(&shape, 1, 1, NULL);
        fesetround(roundings[i]);
        cylint_scene_shape(scene, 0, &back);
        fesetround(FE_TONEAREST);
        CHECK(same_bytes(&back, &shape, sizeof back));
    }
}

TEST(a_finished_scene_takes_no_shape)
{
    const cylint_shape shape = shape_of("sphere 0 0 0 1");
    OWN_SCENE *scene = cylint_scene_begin(1);
    CHECK(cylint_scene_add(scene, NULL, 0) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_add(scene, &shape, (size_t)-1) == CYLINT_SCENE_ESIZE);
    CHECK(cylint_scene_add(scene, &shape, 1) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_finish(scene, 0, NULL, NULL) == CYLINT_SCENE_OK);
    CHECK(cylint_scene_add(scene, &shape, 1) == CYLINT_SCENE_EFINISHED);
    CHECK(cylint_scene_finish(scene, 0, NULL, NULL) == CYLINT_SCENE_EFINISHED);
    CHECK(cylint_scene_size(scene) == 1);
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
