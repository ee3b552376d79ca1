// scenes/gltf/mesh.h - converts a glTF primitive to a triangle mesh.
//
// Rule     Triangles take their corners in the order of glTF 3.7.2.1: strips (i, i+1+i%2, i+2-i%2), fans (i+1, i+2, 0).
//          Vertices that no triangle uses are left out; the others keep their order. Without NORMAL a lit primitive is
//          flat: each triangle has its own vertices, whose normal is the cross product of its sides, in binary64,
//          normalised, rounded once. A triangle without area gets (0, 0, 1). Positions may be NaN or infinite (the
//          rasterizer counts and drops them); other attributes may not.
// Source   glTF 2.0, 3.7.2; KHR_mesh_quantization.
// Tests    tests/scenes/gltf/gltf_mesh_test.cpp
#pragma once
#include <optional>

#include "scenes/gltf/accessor.h"
#include "scenes/gltf/material.h"
#include "scenes/gltf/pose.h"

namespace strata::scenes {

struct PrimitiveSource {
    const tinygltf::Primitive& primitive;
    FileLocation location;
    const LoadedMaterial& material;
    Accessors& accessors;
    Budget& budget;
    Warnings& warnings;
    pipeline::ColorSpace color_space;
    JsonAt json;  // the primitive
    const Pose& pose;
    std::span<const pipeline::Matrix> joints;  // of the pose's skin; empty: not skinned
    bool& ignores_alpha;                       // set if an opaque material ignores the alpha of a vertex colour
};

// Empty if the primitive has no triangle.
[[nodiscard]] std::optional<pipeline::Mesh> load_primitive(const PrimitiveSource& source);

}  // namespace strata::scenes
