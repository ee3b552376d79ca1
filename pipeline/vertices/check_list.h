// pipeline/vertices/check_list.h - checks the scene, the view and the device that a caller passes to `prepare`.
//
// Rule     InputError names the field ("draw list: meshes[2].indices[7]: expected less than 24, found 31"). Positions,
//          colours and matrices may have any bits: vertices that are not finite are dropped and counted.
// Tests    tests/pipeline/vertices/check_list_test.cpp
#pragma once
#include "pipeline/device/profile.h"
#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {

// Checks sizes, indices, enums and the floats on which decisions depend, with one pass over the indices of every mesh;
// the sums of vertices and indices must fit in 32 bits.
void check(const DrawList& list);
void check(const View& view);
// Every field must have a value allowed by the table of profile_fields.h, and no two fields may conflict.
void check(const DeviceProfile& profile);

}  // namespace strata::pipeline
