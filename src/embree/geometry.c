/*
 * geometry.c - makes, updates and releases geometries
 */
#include <string.h>

#include "../bvh/threads.h"
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
        return "a shape is invalid, unbounded, or has a coordinate of 1.844e18 "
               "or more";
    case CYLINT_EMBREE_EMOTION:
        return "the two states of a shape differ in kind or ends";
    case CYLINT_EMBREE_EMEMORY:
        return "out of memory";
    case CYLINT_EMBREE_EDEVICE:
        return "the Embree device made no geometry";
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

static void whole_bounds(const struct RTCBoundsFunctionArguments *args)
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

/* Boxes are padded for rays that begin within FAR_SIZES sizes of the geometry
 * if it has one box, within NEAR_SIZES sizes if each shape has a box: more
 * padding would cost too much there. */
enum { NEAR_SIZES = 3, FAR_SIZES = 4095 };

static int refuse(cylint_embree_problem *problem, int status, size_t shape)
{
    *problem = (cylint_embree_problem){status, shape};
    return 0;
}

static void set_box(cylint_embree_data *data, const cylint_extent *all)
{
    data->box = *all;
    data->pad = cylint_box_pad(all, data->traversal ? FAR_SIZES : NEAR_SIZES);
}

static int check_shapes(cylint_embree_data *data,
                        cylint_embree_problem *problem)
{
    cylint_extent all = cylint_extent_empty();
    for (size_t i = 0; i < data->n; i++) {
        const int status = check_shape(data, i, &all);
        if (status != CYLINT_EMBREE_OK)
            return refuse(problem, status, i);
    }
    set_box(data, &all);
    return 1;
}

static int allocate(cylint_memory *memory, cylint_embree_data *data,
                    size_t bytes)
{
    *memory = (cylint_memory){0};
    return bytes == 0 || cylint_memory_allocate(memory, &data->source, bytes);
}

/* Copies shapes for the float filter, in the order of `number`. */
typedef struct {
    const cylint_shape *shapes;
    const uint32_t *number;
    cylint_memory memory;
    cylint_float_filter_shapes made;
    cylint_mutex mutex; /* protects the member below */
    int fits;           /* all shapes fit into small records, if these are
                           wanted */
} filter_job;

static void copy_shapes(void *self, size_t from, size_t to)
{
    filter_job *a = self;
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
    cylint_mutex_lock(&a->mutex);
    a->fits &= i == to;
    cylint_mutex_unlock(&a->mutex);
}

/* Ranks the shapes in the order in which leaves first name them, writes their
 * numbers in that order, and replaces the numbers in the leaves by ranks.  No
 * query uses the leaves yet.  All ranks are UINT32_MAX before. */
static void rank_shapes(const cylint_bvh *bvh, uint32_t *rank, uint32_t *number)
{
    uint32_t next = 0;
    for (size_t i = 0; i < bvh->n_leaves; i++) {
        cylint_leaf *leaf = (cylint_leaf *)&bvh->leaves[i];
        for (int lane = 0; lane < cylint_leaf_used(leaf); lane++) {
            uint32_t *here = &rank[leaf->number[lane]];
            if (*here == UINT32_MAX) {
                number[next] = leaf->number[lane];
                *here = next++;
            }
            leaf->number[lane] = *here;
        }
    }
}

/* Shapes that are together in leaves get neighbouring ranks, so that the
 * filter's shapes are together in memory.  Returns 0 if memory is refused. */
static int rank_by_leaves(cylint_memory *number, const cylint_bvh *bvh,
                          cylint_embree_data *data)
{
    const size_t bytes = data->n * sizeof(uint32_t);
    cylint_memory rank;
    if (!allocate(&rank, data, bytes))
        return 0;
    const int made = allocate(number, data, bytes);
    if (made && data->n > 0) {
        memset(rank.data, 0xff, bytes);
        rank_shapes(bvh, rank.data, number->data);
    }
    cylint_memory_free(&rank);
    return made;
}

/* Makes small records or, if a shape does not fit, large ones; usually the first
 * shape decides.  Returns 0 if memory is refused. */
static int make_filter_shapes(filter_job *a, cylint_embree_data *data)
{
    for (int small = 1; small >= 0; small--) {
        const size_t size = small ? sizeof(cylint_float_filter_small)
                                  : sizeof(cylint_float_filter_shape);
        if (!allocate(&a->memory, data, data->n * size))
            return 0;
        a->made = (cylint_float_filter_shapes){a->memory.data, small};
        a->fits = 1;
        cylint_threads_run(cylint_threads_for(data->n, data->threads), data->n,
                           copy_shapes, a);
        if (a->fits)
            break;
        cylint_memory_free(&a->memory);
    }
    return 1;
}

/* Builds the hierarchy.  On failure the present one stays. */
static int build_bvh(cylint_embree_data *data, cylint_embree_problem *problem)
{
    const cylint_view view = cylint_plain_view(data->shapes);
    filter_job job = {.shapes = data->shapes,
                      .mutex = CYLINT_MUTEX_INITIALIZER};
    cylint_bvh bvh;
    size_t shape;
    const cylint_bvh_input input = {.view = &view,
                                    .n = data->n,
                                    .threads = data->threads,
                                    .source = &data->source};
    switch (cylint_bvh_build(&bvh, &input, &shape)) {
    case CYLINT_BVH_OK:
        break;
    case CYLINT_BVH_ESHAPE:
        return refuse(problem, CYLINT_EMBREE_ESHAPE, shape);
    default:
        return refuse(problem, CYLINT_EMBREE_EMEMORY, 0);
    }
    cylint_memory number = {0};
    int made = rank_by_leaves(&number, &bvh, data);
    job.number = number.data;
    made = made && make_filter_shapes(&job, data);
    cylint_mutex_destroy(&job.mutex);
    if (!made) {
        cylint_memory_free(&number);
        cylint_bvh_free(&bvh);
        return refuse(problem, CYLINT_EMBREE_EMEMORY, 0);
    }
    cylint_bvh_free(&data->bvh);
    cylint_memory_free(&data->filter_memory);
    cylint_memory_free(&data->number_memory);
    data->bvh = bvh;
    data->filter_memory = job.memory;
    data->number_memory = number;
    data->number = number.data;
    data->filter_shapes = job.made;
    set_box(data, &bvh.box);
    return 1;
}

/* Embree has no function that reports an error to its device.  This call with a
 * null handle makes it report RTC_ERROR_INVALID_ARGUMENT. */
static void raise_device_error(RTCGeometry geometry)
{
    rtcSetGeometryInstancedScene(geometry, NULL);
}

/* --------------------------------------------------------------- making -- */

/* Loads the present state of the shapes and commits the geometry. */
static int load_shapes(RTCGeometry geometry, cylint_embree_data *data,
                       cylint_embree_problem *problem)
{
    if (!(data->traversal ? build_bvh : check_shapes)(data, problem)) {
        if (problem->status != CYLINT_EMBREE_EMEMORY)
            raise_device_error(geometry);
        return 0;
    }
    problem->status = CYLINT_EMBREE_OK;
    rtcSetGeometryUserPrimitiveCount(
        geometry, data->traversal ? data->bvh.n_leaves > 0 : (unsigned)data->n);
    rtcCommitGeometry(geometry);
    return 1;
}

static void attach(RTCGeometry geometry, cylint_embree_data *data)
{
    rtcSetGeometryUserData(geometry, data);
    rtcSetGeometryTimeStepCount(geometry, data->moved ? 2 : 1);
    rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
    rtcSetGeometryBoundsFunction(
        geometry, data->traversal ? whole_bounds : shape_bounds, NULL);
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
    *data =
        (cylint_embree_data){.self = self,
                             .source = source,
                             .shapes = shapes,
                             .n = n,
                             .threads = 1,
                             .filter_one = cylint_float_filter_of_one(),
                             .filter_many = cylint_float_filter_of_many(),
                             .traverse_packet = cylint_traverse_packet_used()};
    if (options) {
        data->moved = options->moved;
        data->flags = options->flags;
        data->user = options->user;
        data->threads = options->threads > 1 ? options->threads : 1;
    }
    if (!(data->flags & CYLINT_EMBREE_SINGLE) && !data->moved)
        data->traversal = cylint_traversal_used();
    return data;
}

static void free_data(cylint_embree_data *data)
{
    cylint_memory self = data->self;
    cylint_bvh_free(&data->bvh);
    cylint_memory_free(&data->filter_memory);
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
        if (load_shapes(geometry, data, problem))
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
    load_shapes(geometry, rtcGetGeometryUserData(geometry), &here);
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
    return data->self.bytes + data->bvh.node_memory.bytes +
           data->bvh.leaf_memory.bytes + data->filter_memory.bytes +
           data->number_memory.bytes;
}
