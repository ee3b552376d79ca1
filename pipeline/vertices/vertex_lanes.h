// pipeline/vertices/vertex_lanes.h - kernels for positions and lighting of sixteen vertices at a time; vertex_stage.h
// defines the meaning.
#pragma once
#include <array>
#include <cstddef>

#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {

inline constexpr std::size_t vertex_lane_count = 16;

// Sixteen vertices, one array per component.
struct VertexLanes {
    alignas(64) std::array<std::array<float, vertex_lane_count>, 4> position;  // x, y, z, w in clip space
    alignas(64) std::array<float, vertex_lane_count> light;                    // the lighting factor
};

struct VertexKernels {
    // For VertexPath::separate; `m` is column-major.
    void (*transform)(const std::array<float, 16>& m, const Vec3* positions, VertexLanes& out) noexcept;
    void (*light)(const std::array<float, 9>& m, const Vec3& toward_eye, const Vec3* normals,
                  VertexLanes& out) noexcept;
};

// The kernels of the selected instruction set; null for scalar, which has none.
[[nodiscard]] const VertexKernels* vertex_kernels() noexcept;

}  // namespace strata::pipeline
