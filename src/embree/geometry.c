/*
 * geometry.c - makes, updates and releases geometries
 */
#include <math.h>
#include <string.h>

#include "../bvh/distant.h"
#include "../bvh/float_bounds.h"
#include "../dispatch.h"
#include "geometry.h"

int cylint_embree_version(void)
{
    return CYLINT_EMBREE;
}

const char *cylint_embree_strerror(int status)
{
    static const char *const text[] = {
        [CYLINT_EMBREE_OK] = "no error",
        [CYLINT_EMBREE_ESHAPE] = ("a shape is invalid, unbounded, or has a "
                                  "coordinate of 1.844e18 or more"),
        [CYLINT_EMBREE_EMOTION] =
            "the two states of a shape differ in kind or ends",
        [CYLINT_EMBREE_EMEMORY] = "out of memory",
        [CYLINT_EMBREE_EDEVICE] = "the Embree device made no geometry",
        [CYLINT_EMBREE_EVERSION] = "the device is of another version of Embree",
        [CYLINT_EMBREE_EPART] = "the geometry numbers of merged parts are "
                                "invalid or do not ascend"};
    return status >= 0 && status < (int)(sizeof text / sizeof *text)
               ? text[status]
               : "unknown status";
}

/* ---------------------------------------------------------------- boxes -- */

/*
 * Each face is moved out by the error of Embree's traversal, which has no robust
 * mode for user geometries, with or without RTC_SCENE_FLAG_ROBUST.  Embree
 * computes where a ray crosses a face b as b r - o r in floats, fused or not,
 * where r is about 1 / d: an estimate with an error of at most 1.5 2^-12, then a
 * Newton step, which squares that error and rounds three times: less than
 * 6 2^-24.  The products round by 2^-24 of |b| and |o|, and so does their
 * difference.  The error is at most |r| times
 *
 *     2^-24 (6 |b - o| + |b| + |o| + |b - o|)
 *     <= 2^-21 |b - o| + 2^-23 |b|,         for |o| <= |b| + |b - o|,
 *
 * and moving the face by that compensates it.  Faces are moved for origins within
 * `sizes` sizes of the geometry's box, where |b - o| <= (sizes + 1) S; a size S
 * is the longest side of the box, M its largest coordinate.  2^-124 covers
 * subnormal floats flushed to zero: b at time 1 minus b at time 0, times the time,
 * the sum, and b - o, each off by less than 2^-126.
 *
 * The padding also keeps Embree from choosing between shapes hit at nearly the
 * same t: it skips a box whose computed entry is beyond tfar (single rays) or
 * not below it (packets).
 */
static double box_pad(const cylint_extent *all, int sizes)
{
    double S = 0, M = 0;
    for (int j = 0; j < 3; j++) {
        const double lower = all->lower[j], upper = all->upper[j];
        S = fmax(S, upper - lower);
        M = fmax(M, fmax(fabs(lower), fabs(upper)));
    }
    return 0x1p-21 * (sizes + 1) * S + 0x1p-23 * M + 0x1p-124;
}

/* Writes the padded box, within the limits of Embree. */
static void write_bounds(const struct RTCBoundsFunctionArguments *args)
{
    const cylint_embree_data *data = args->geometryUserPtr;
    const double most = (double)CYLINT_EXTENT_LIMIT * (1 - 0x1p-23);
    const int moves = data->options.moved != NULL;
    cylint_extent box = data->box;
    if (!data->traversal) {
        cylint_shape shape[2];
        for (int i = 0; i <= moves; i++)
            cylint_embree_shape(data->shapes, args->primID, i, &shape[i]);
        box = cylint_embree_box(&shape[0], moves ? &shape[1] : NULL,
                                (int)args->timeStep);
    }
    *args->bounds_o = (struct RTCBounds){.align0 = 0};
    float *lower = &args->bounds_o->lower_x, *upper = &args->bounds_o->upper_x;
    for (int j = 0; j < 3; j++) {
        lower[j] = cylint_float_below(fmax(box.lower[j] - data->pad, -most));
        upper[j] = cylint_float_above(fmin(box.upper[j] + data->pad, most));
    }
}

/* Boxes are padded for rays that begin within FAR_SIZES sizes of the geometry
 * if it has one box, within NEAR_SIZES sizes if each shape has a box: more
 * padding would cost too much there. */
enum { NEAR_SIZES = 3, FAR_SIZES = 4095 };

/* Writes *problem, unless that is NULL.  Returns the status. */
static int report(cylint_embree_problem *problem, int status, size_t shape)
{
    if (problem)
        *problem = (cylint_embree_problem){status, shape};
    return status;
}

/* The shape of a rank or, without ranks, of a number. */
static const cylint_shape *shape_of_rank(const void *owner, uint32_t rank,
                                         cylint_shape *spare)
{
    const cylint_embree_data *data = owner;
    const uint32_t number = data->number ? data->number[rank] : rank;
    const cylint_embree_array *from =
        data->arrays + cylint_embree_array_at(data, 0, number);
    (void)spare;
    return &from->part.shapes[number - from->first];
}

/* The numbers of merged arrays ascend, and are geometries'. */
static int check_arrays(const cylint_embree_data *data,
                        cylint_embree_problem *problem)
{
    for (size_t i = 0; i < data->n_arrays; i++) {
        const cylint_embree_array *at = data->arrays + i;
        if (at->part.geomID == RTC_INVALID_GEOMETRY_ID ||
            (i > 0 && at->part.geomID <= at[-1].part.geomID))
            return report(problem, CYLINT_EMBREE_EPART, i);
    }
    return CYLINT_EMBREE_OK;
}

/* Writes the box of all shapes, each of which can be a primitive. */
static int check_shapes(cylint_embree_data *data,
                        cylint_embree_problem *problem)
{
    cylint_extent *all = &data->box;
    const int moves = data->options.moved != NULL;
    *all = cylint_extent_empty();
    for (size_t i = 0; i < data->n; i++) {
        const cylint_shape *shape = data->arrays->part.shapes + i;
        const cylint_shape *moved = moves ? data->options.moved + i : NULL;
        if (i >= RTC_INVALID_GEOMETRY_ID || !cylint_is_bounded(shape) ||
            (moved && !cylint_is_bounded(moved)))
            return report(problem, CYLINT_EMBREE_ESHAPE, i);
        if (moved &&
            (moved->ends != shape->ends ||
             cylint_constructor_kind(moved) != cylint_constructor_kind(shape)))
            return report(problem, CYLINT_EMBREE_EMOTION, i);
        for (int step = 0; step <= moves; step++) {
            const cylint_extent box = cylint_embree_box(shape, moved, step);
            if (!cylint_extent_is_valid(&box))
                return report(problem, CYLINT_EMBREE_ESHAPE, i);
            cylint_extent_include(all, &box);
        }
    }
    return CYLINT_EMBREE_OK;
}

/* Ranks the shapes in the order in which leaves first name them: so records of
 * shapes that are together in leaves are together in memory. */
static void rank_by_leaves(cylint_embree_data *data)
{
    const size_t n = data->n;
    uint32_t *const number = data->order_memory.data, *const rank = number + n;
    uint32_t *const array = data->is_merged ? rank + n : NULL;
    data->n_in_leaves = cylint_bvh_rank(&data->bvh, n, number, rank);
    for (size_t i = 0; i < n && array; i++)
        array[i] = (uint32_t)cylint_embree_array_at(data, 0, number[i]);
    data->number = number;
    data->rank = rank;
    data->array = array;
}

static int build_bvh(cylint_embree_data *data, const cylint_bvh_input *input,
                     cylint_embree_problem *problem)
{
    const size_t bytes = data->n * sizeof(uint32_t);
    size_t shape = 0;
    if (!cylint_memory_allocate(&data->order_memory, &data->source,
                                data->is_merged ? 3 * bytes : 2 * bytes))
        return report(problem, CYLINT_EMBREE_EMEMORY, 0);
    const cylint_bvh_status status = cylint_bvh_build_near(
        &data->bvh, input, data->order_memory.data, &shape, &data->box);
    if (status == CYLINT_BVH_OK)
        rank_by_leaves(data);
    return report(problem,
                  status == CYLINT_BVH_OK       ? CYLINT_EMBREE_OK
                  : status == CYLINT_BVH_ESHAPE ? CYLINT_EMBREE_ESHAPE
                                                : CYLINT_EMBREE_EMEMORY,
                  shape);
}

/* Frees what was computed from the shapes. */
static void free_state(cylint_embree_data *data)
{
    cylint_bvh_free(&data->bvh);
    cylint_memory_free(&data->shapes[0].memory);
    cylint_memory_free(&data->shapes[1].memory);
    cylint_memory_free(&data->order_memory);
}

/* Computes from the shapes what rays read, of which there is nothing yet.  Returns
 * the status. */
static int compute_state(cylint_embree_data *data,
                         cylint_embree_problem *problem)
{
    const cylint_view now = {
        .scale = 1, .shape_at = shape_of_rank, .owner = data};
    const cylint_view moved = cylint_plain_view(data->options.moved);
    cylint_bvh_input from = {.view = &now,
                             .n = data->n,
                             .threads = data->options.threads,
                             .source = &data->source};
    int status = check_arrays(data, problem);
    if (status == CYLINT_EMBREE_OK)
        status = data->traversal ? build_bvh(data, &from, problem)
                                 : check_shapes(data, problem);
    if (status != CYLINT_EMBREE_OK)
        return status;
    int has_memory = cylint_embree_shapes_copy(&data->shapes[0], &from);
    from.view = &moved;
    if (has_memory && data->options.moved)
        has_memory = cylint_embree_shapes_copy(&data->shapes[1], &from);
    return has_memory ? status : report(problem, CYLINT_EMBREE_EMEMORY, 0);
}

/* Loads the present state of the shapes and commits the geometry.  On failure the
 * old state stays.  Returns the status. */
static int load_geometry(RTCGeometry geometry, cylint_embree_data *data,
                         cylint_embree_problem *problem)
{
    cylint_embree_data next = *data;
    next.bvh = (cylint_bvh){0};
    next.order_memory = (cylint_memory){0};
    next.number = NULL;
    next.shapes[0] = next.shapes[1] = (cylint_embree_shapes){0};
    const int status = compute_state(&next, problem);
    if (status != CYLINT_EMBREE_OK) {
        free_state(&next);
        /* Embree has no function that reports an error to its device.  This call
         * makes it report RTC_ERROR_INVALID_ARGUMENT. */
        if (status != CYLINT_EMBREE_EMEMORY)
            rtcSetGeometryInstancedScene(geometry, NULL);
        return status;
    }
    next.pad = box_pad(&next.box, data->traversal ? FAR_SIZES : NEAR_SIZES);
    free_state(data);
    *data = next;
    rtcSetGeometryUserPrimitiveCount(
        geometry, data->traversal ? data->bvh.n_leaves > 0 : (unsigned)data->n);
    rtcCommitGeometry(geometry);
    return report(problem, CYLINT_EMBREE_OK, 0);
}

/* --------------------------------------------------------------- making -- */

/* Memory in buffers of the device. */
static void *allocate_buffer(void *device, size_t bytes, void **handle)
{
    RTCBuffer buffer = rtcNewBuffer(device, bytes);
    *handle = buffer;
    return buffer ? rtcGetBufferData(buffer) : NULL;
}

static void release_buffer(void *buffer)
{
    rtcReleaseBuffer(buffer);
}

cylint_float_filter *cylint_float_filter_used(int many)
{
    return many ? CYLINT_OF_KERNELS(cylint_float_filter_plain,
                                    cylint_float_filter_avx2,
                                    cylint_float_filter_avx2)
                : CYLINT_OF_KERNELS(cylint_float_filter_plain,
                                    cylint_float_filter_fma,
                                    cylint_float_filter_fma);
}

/* The arrays, at least one, are behind the data. */
static cylint_embree_data *new_data(RTCDevice device,
                                    const cylint_embree_part *parts, size_t n,
                                    int is_merged,
                                    const cylint_embree_options *options)
{
    const cylint_memory_source source = {device, allocate_buffer,
                                         release_buffer};
    const size_t size = sizeof(cylint_embree_array);
    cylint_memory self;
    if (n > SIZE_MAX / 2 / size ||
        !cylint_memory_allocate(&self, &source,
                                sizeof(cylint_embree_data) + n * size))
        return NULL;
    cylint_embree_data *data = self.data;
    cylint_embree_array *arrays = (cylint_embree_array *)(data + 1);
    *data = (cylint_embree_data){
        .self = self,
        .source = source,
        .arrays = arrays,
        .n_arrays = n,
        .is_merged = is_merged,
        .filter = {cylint_float_filter_used(0), cylint_float_filter_used(1)},
        .trace_packet = CYLINT_OF_KERNELS(cylint_packet_trace_plain,
                                          cylint_packet_trace_avx2,
                                          cylint_packet_trace_avx2)};
    if (options)
        data->options = *options;
    if (is_merged)
        data->options.moved = NULL;
    if (data->options.threads < 1)
        data->options.threads = 1;
    if (is_merged ||
        !(data->options.flags & CYLINT_EMBREE_SINGLE || data->options.moved))
        data->traversal = cylint_traversal_used();
    for (size_t i = 0; i < n; data->n += parts[i++].n)
        arrays[i] = (cylint_embree_array){parts[i], data->n};
    return data;
}

static RTCGeometry make(RTCDevice device, const cylint_embree_part *parts,
                        size_t n, int is_merged,
                        const cylint_embree_options *options,
                        cylint_embree_problem *problem)
{
    report(problem, CYLINT_EMBREE_EVERSION, 0);
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION_MAJOR) !=
        CYLINT_EMBREE)
        return NULL;
    report(problem, CYLINT_EMBREE_EDEVICE, 0);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    if (!geometry)
        return NULL;
    report(problem, CYLINT_EMBREE_EMEMORY, 0);
    cylint_embree_data *data = new_data(device, parts, n, is_merged, options);
    rtcSetGeometryUserData(geometry, data);
    rtcSetGeometryTimeStepCount(geometry, data && data->options.moved ? 2 : 1);
    rtcSetGeometryMask(geometry, 0xFFFFFFFFu);
    rtcSetGeometryBoundsFunction(geometry, write_bounds, NULL);
    rtcSetGeometryIntersectFunction(geometry, cylint_embree_intersect_callback);
    rtcSetGeometryOccludedFunction(geometry, cylint_embree_occluded_callback);
    if (data && load_geometry(geometry, data, problem) == CYLINT_EMBREE_OK)
        return geometry;
    cylint_embree_release(geometry);
    return NULL;
}

RTCGeometry cylint_embree_geometry(RTCDevice device, const cylint_shape *shapes,
                                   size_t n,
                                   const cylint_embree_options *options,
                                   cylint_embree_problem *problem)
{
    const cylint_embree_part all = {shapes, n, 0};
    return make(device, &all, 1, 0, options, problem);
}

RTCGeometry cylint_embree_merge(RTCDevice device,
                                const cylint_embree_part *parts, size_t n,
                                const cylint_embree_options *options,
                                cylint_embree_problem *problem)
{
    const cylint_embree_part none = {NULL, 0, 0};
    return make(device, n > 0 ? parts : &none, n > 0 ? n : 1, 1, options,
                problem);
}

int cylint_embree_update(RTCGeometry geometry, cylint_embree_problem *problem)
{
    return load_geometry(geometry, rtcGetGeometryUserData(geometry), problem);
}

void cylint_embree_release(RTCGeometry geometry)
{
    if (!geometry)
        return;
    cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    if (data) { /* not where memory for it was refused */
        cylint_memory self = data->self;
        free_state(data);
        cylint_memory_free(&self);
    }
    rtcReleaseGeometry(geometry);
}

size_t cylint_embree_bytes(RTCGeometry geometry)
{
    const cylint_embree_data *data = rtcGetGeometryUserData(geometry);
    return data->self.bytes + data->bvh.node_memory.bytes +
           data->bvh.leaf_memory.bytes + data->order_memory.bytes +
           data->shapes[0].memory.bytes + data->shapes[1].memory.bytes;
}
