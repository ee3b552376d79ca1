// pipeline/vertices/check_list.h - what `prepare` asks of the scene, the view and the device that a caller hands in.
//
// Rule     InputError names the field ("draw list: meshes[2].indices[7]: expected less than 24, found 31"). Positions,
//          colours and matrices may hold any bits: vertices that are not finite are dropped and counted.
// Tests    tests/pipeline/vertices/check_list_test.cpp
#pragma once
#include "pipeline/device/profile.h"
#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {

// One pass over the indices of every mesh.
// Sizes, indices, enums and floats that decide something; the sums of vertices and indices must fit 32 bits.
void check(const DrawList& list);
void check(const View& view);
// Every field has a value that the table of profile_fields.h lists, and no two of them exclude each other.
void check(const DeviceProfile& profile);

}  // namespace strata::pipeline
