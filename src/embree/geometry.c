/*
 * geometry.c - making, updating and releasing geometries
 */
#include <string.h>

#include "../bvh/threads.h"
#include "callbacks.h"
#include "geometry.h"
#include "motion.h"
#include "box_pad.h"

int cylint_embree_version(void)
{
    return CYLINT_EMBREE;
}

const char *cylint_embree_strerror(int status)
{
    switch (status) {
    case CYLINT_EMBREE_OK:
        return "no error";
    case CYLINT_EMBREE_ESHAPE:
        return "a shape is refused, unbounded or beyond 1.844e18";
    case CYLINT_EMBREE_EMOTION:
        return "a shape cannot move into one of another kind or ends";
    case CYLINT_EMBREE_EMEMORY:
        return "out of memory";
    case CYLINT_EMBREE_EDEVICE:
        return "the Embree device refused";
    case CYLINT_EMBREE_EVERSION:
        return "the device is of another version of Embree";
    default:
        return "unknown status";
    }
}

/* ---------------------------------------------------------------- boxes -- */

static void box_of(const cylint_embree_data *data, size_t number, int step,
                   cylint_extent *box)
{
    const cylint_shape *shape = data->shapes + number;
    if (data->moved) {
        cylint_motion_bounds(shape, data->moved + number, step, box);
        return;
    }
    const cylint_view view = cylint_plain_view(data->shapes);
    *box = cylint_swept_disc_box(&view, (uint32_t)number);
}

static void group_bounds(const struct RTCBoundsFunctionArguments *args)
{
    const cylint_embree_data *data = args->geometryUserPtr;
    *args->bounds_o = cylint_padded_box(&data->box, data->pad);
}

static void shape_bounds(const struct RTCBoundsFunctionArguments *args)
{
    const cylint_embree_data *data = args->geometryUserPtr;
    cylint_extent box;
    box_of(data, args->primID, (int)args->timeStep, &box);
    *args->bounds_o = cylint_padded_box(&box, data->pad);
}

static int check_shape(const cylint_embree_data *data, size_t i,
                       cylint_extent *all)
{
    const cylint_shape *shape = data->shapes + i;
    if (i >= RTC_INVALID_GEOMETRY_ID || !cylint_is_bounded(shape) ||
        (data->moved && !cylint_is_bounded(data->moved + i)))
        return CYLINT_EMBREE_ESHAPE;
    if (data->moved && !cylint_can_move_into(shape, data->moved + i))
        return CYLINT_EMBREE_EMOTION;
    for (int step = 0; step < (data->moved ? 2 : 1); step++) {
        cylint_extent box;
        box_of(data, i, step, &box);
        if (!cylint_extent_is_valid(&box))
            return CYLINT_EMBREE_ESHAPE;
        cylint_extent_include(all, &box);
    }
    return CYLINT_EMBREE_OK;
}

/* From how many sizes of the geometry rays come for which boxes are wide
 * enough: the one box of a group may be wider than each of very many. */
enum { NEAR_SIZES = 3, FAR_SIZES = 4095 };

static int refused(cylint_embree_problem *problem, int status, size_t shape)
{
    *problem = (cylint_embree_problem){status, shape};
    return 0;
}

static void take_box(cylint_embree_data *data, const cylint_extent *all)
{
    data->box = *all;
    data->pad = cylint_box_pad(all, data->walk ? FAR_SIZES : NEAR_SIZES);
}

static int check_shapes(cylint_embree_data *data,
                        cylint_embree_problem *problem)
{
    cylint_extent all = cylint_extent_empty();
    for (size_t i = 0; i < data->n; i++) {
        const int status = check_shape(data, i, &all);
        if (status != CYLINT_EMBREE_OK)
            return refused(problem, status, i);
    }
    take_box(data, &all);
    return 1;
}

static int ask_for_room(cylint_memory *memory, cylint_embree_data *data,
                        size_t bytes)
{
    *memory = (cylint_memory){0};
    return bytes == 0 || cylint_memory_allocate(memory, &data->source, bytes);
}

/* What float_filter.c asks of the shapes, being made, in the order of `number`. */
typedef struct {
    const cylint_shape *shapes;
    const uint32_t *number;
    cylint_memory memory;
    cylint_float_filter_shapes made;
    cylint_mutex lock; /* of what is below */
    int fits;          /* they are as small as they should be */
} asking;

static void copy_asked(void *self, size_t from, size_t to)
{
    asking *a = self;
    cylint_float_filter_small *small = a->memory.data;
    cylint_float_filter_shape *large = a->memory.data;
    size_t i = from;
    if (a->made.small)
        while (i < to && cylint_float_filter_small_of(&small[i],
                                                      &a->shapes[a->number[i]]))
            i++;
    else
        for (; i < to; i++)
            cylint_float_filter_shape_of(&large[i], &a->shapes[a->number[i]]);
    cylint_mutex_lock(&a->lock);
    a->fits &= i == to;
    cylint_mutex_unlock(&a->lock);
}

/* The shapes in the order in which blocks, which nobody uses yet, name them
 * first, and then their ranks in the blocks.  All ranks are UINT32_MAX. */
static void name_by_rank(const cylint_bvh *group, uint32_t *rank,
                         uint32_t *number)
{
    uint32_t next = 0;
    for (size_t i = 0; i < group->n_leaves; i++) {
        cylint_leaf *block = (cylint_leaf *)&group->leaves[i];
        for (int lane = 0; lane < cylint_leaf_used(block); lane++) {
            uint32_t *here = &rank[block->number[lane]];
            if (*here == UINT32_MAX) {
                number[next] = block->number[lane];
                *here = next++;
            }
            block->number[lane] = *here;
        }
    }
}

/* What lies together in blocks is to lie together where it is asked.  0:
 * refused. */
static int sort_by_blocks(cylint_memory *number, const cylint_bvh *group,
                          cylint_embree_data *data)
{
    const size_t bytes = data->n * sizeof(uint32_t);
    cylint_memory rank;
    if (!ask_for_room(&rank, data, bytes))
        return 0;
    const int made = ask_for_room(number, data, bytes);
    if (made && data->n > 0) {
        memset(rank.data, 0xff, bytes);
        name_by_rank(group, rank.data, number->data);
    }
    cylint_memory_free(&rank);
    return made;
}

/* Small, unless one of them does not fit: mostly the first.  0: refused. */
static int make_asked(asking *a, cylint_embree_data *data)
{
    for (int small = 1; small >= 0; small--) {
        const size_t size = small ? sizeof(cylint_float_filter_small)
                                  : sizeof(cylint_float_filter_shape);
        if (!ask_for_room(&a->memory, data, data->n * size))
            return 0;
        a->made = (cylint_float_filter_shapes){a->memory.data, small};
        a->fits = 1;
        cylint_threads_run(cylint_threads_for(data->n, data->threads), data->n,
                           copy_asked, a);
        if (a->fits)
            break;
        cylint_memory_free(&a->memory);
    }
    return 1;
}

/* What was before stays where it fails. */
static int group_shapes(cylint_embree_data *data,
                        cylint_embree_problem *problem)
{
    const cylint_view view = cylint_plain_view(data->shapes);
    asking asked = {.shapes = data->shapes, .lock = CYLINT_MUTEX_INITIALIZER};
    cylint_bvh group;
    size_t shape;
    const cylint_bvh_input members = {.view = &view,
                                      .n = data->n,
                                      .threads = data->threads,
                                      .source = &data->source};
    switch (cylint_bvh_build(&group, &members, &shape)) {
    case CYLINT_BVH_OK:
        break;
    case CYLINT_BVH_ESHAPE:
        return refused(problem, CYLINT_EMBREE_ESHAPE, shape);
    default:
        return refused(problem, CYLINT_EMBREE_EMEMORY, 0);
    }
    cylint_memory number = {0};
    int made = sort_by_blocks(&number, &group, data);
    asked.number = number.data;
    made = made && make_asked(&asked, data);
    cylint_mutex_destroy(&asked.lock);
    if (!made) {
        cylint_memory_free(&number);
        cylint_bvh_free(&group);
        return refused(problem, CYLINT_EMBREE_EMEMORY, 0);
    }
    cylint_bvh_free(&data->group);
    cylint_memory_free(&data->asked_memory);
    cylint_memory_free(&data->number_memory);
    data->group = group;
    data->asked_memory = asked.memory;
    data->number_memory = number;
    data->number = number.data;
    data->asked = asked.made;
    take_box(data, &group.box);
    return 1;
}

/* Embree has no call by which one could tell its device of an error, but a
 * null handle is RTC_ERROR_INVALID_ARGUMENT to it. */
static void tell_device(RTCGeometry geometry)
{
    rtcSetGeometryInstancedScene(geometry, NULL);
}

/* --------------------------------------------------------------- making -- */

/* Takes the shapes as they are now. */
static int fill(RTCGeometry geometry, cylint_embree_data *data,
                cylint_embree_problem *problem)
{
    if (!(data->walk ? group_shapes : check_shapes)(data, problem)) {
        if (problem->status != CYLINT_EMBREE_EMEMORY)
            tell_device(geometry);
        return 0;
    }
    problem->status = CYLINT_EMBREE_OK;
    rtcSetGeometryUserPrimitiveCount(
        geometry, data->walk ? data->group.n_leaves > 0 : (unsigned)data->n);
    rtcCommitGeometry(geometry);
    return 1;
}

static void attach(RTCGeometry geometry, cylint_embree_data *data)
{
    rtcSetGeometryUserData(geometry, data);
    rtcSetGeometryTimeStepCount(geometry, data->moved ? 2 : 1);
    rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
    rtcSetGeometryBoundsFunction(
        geometry, data->walk ? group_bounds : shape_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, cylint_embree_intersect_callback);
    rtcSetGeometryOccludedFunction(geometry, cylint_embree_occluded_callback);
}

static cylint_embree_data *new_data(RTCDevice device,
                                    const cylint_shape *shapes, size_t n,
                                    const cylint_embree_options *options)
{
    const cylint_memory_source source = cylint_device_memory(device);
    cylint_memory self;
    if (!cylint_memory_allocate(&self, &source, sizeof(cylint_embree_data)))
        return NULL;
    cylint_embree_data *data = self.data;
    *data = (cylint_embree_data){.self = self,
                                 .source = source,
                                 .shapes = shapes,
                                 .n = n,
                                 .threads = 1,
                                 .quick = cylint_float_filter_used(),
                                 .many = cylint_packet_filter_build(0)};
    if (options) {
        data->moved = options->moved;
        data->how = options->how;
        data->user = options->user;
        data->threads = options->threads > 1 ? options->threads : 1;
    }
    if (!(data->how & CYLINT_EMBREE_SINGLE) && !data->moved)
        data->walk = cylint_traversal_used();
    return data;
}

static void free_data(cylint_embree_data *data)
{
    cylint_memory self = data->self;
    cylint_bvh_free(&data->group);
    cylint_memory_free(&data->asked_memory);
    cylint_memory_free(&data->number_memory);
    cylint_memory_free(&self);
}

static RTCGeometry make(RTCDevice device, const cylint_shape *shapes, size_t n,
                        const cylint_embree_options *options,
                        cylint_embree_problem *problem)
{
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR) !=
        CYLINT_EMBREE) {
        problem->status = CYLINT_EMBREE_EVERSION;
        return NULL;
    }
    problem->status = CYLINT_EMBREE_EDEVICE;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    if (!geometry)
        return NULL;
    problem->status = CYLINT_EMBREE_EMEMORY;
    cylint_embree_data *data = new_data(device, shapes, n, options);
    if (data) {
        attach(geometry, data);
        if (fill(geometry, data, problem))
            return geometry;
        free_data(data);
    }
    rtcReleaseGeometry(geometry);
    return NULL;
}

RTCGeometry cylint_embree_geometry(RTCDevice device, const cylint_shape *shapes,
                                   size_t n,
                                   const cylint_embree_options *options,
                                   cylint_embree_problem *problem)
{
    cylint_embree_problem here = {CYLINT_EMBREE_OK, 0};
    RTCGeometry geometry = make(device, shapes, n, options, &here);
    if (problem)
        *problem = here;
    return geometry;
}

int cylint_embree_update(RTCGeometry geometry, cylint_embree_problem *problem)
{
    cylint_embree_problem here = {CYLINT_EMBREE_OK, 0};
    fill(geometry, rtcGetGeometryUserData(geometry), &here);
    if (problem)
        *problem = here;
    return here.status;
}

void cylint_embree_release(RTCGeometry geometry)
{
    if (!geometry)
        return;
    free_data(rtcGetGeometryUserData(geometry));
    rtcReleaseGeometry(geometry);
}

size_t cylint_embree_bytes(RTCGeometry geometry)
{
    const cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    return data->self.bytes + data->group.memory.bytes +
           data->asked_memory.bytes + data->number_memory.bytes;
}
