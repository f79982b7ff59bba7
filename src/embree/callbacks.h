/*
 * callbacks.h - the functions that Embree calls with rays
 */
#ifndef CYLINT_EMBREE_CALLBACKS_H
#define CYLINT_EMBREE_CALLBACKS_H

#include "api.h"

void cylint_embree_intersect_callback(
    const struct RTCIntersectFunctionNArguments *args);
void cylint_embree_occluded_callback(
    const struct RTCOccludedFunctionNArguments *args);

#endif
