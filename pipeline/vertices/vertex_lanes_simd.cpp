// pipeline/vertices/vertex_lanes_simd.cpp - vertex_lanes.h, compiled once per instruction set. How kernels are written:
// rasterizer/reference/kernels.md. Tests: tests/pipeline/vertices/prepare_test.cpp
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "pipeline/vertices/vertex_lanes_simd.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"
#include "pipeline/vertices/vertex_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace strata::pipeline::HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, vertex_lane_count>;
using V = hn::Vec<F>;

HWY_INLINE V set(float v) { return hn::Set(F{}, v); }
// Summed from left to right, every operation rounded, in the order of vertex_stage.h.
HWY_INLINE V sum_of_three(V a, float ma, V b, float mb, V c, float mc) {
    return hn::Add(hn::Add(hn::Mul(set(ma), a), hn::Mul(set(mb), b)), hn::Mul(set(mc), c));
}

void transform(const std::array<float, 16>& m, const Vec3* positions, VertexLanes& out) noexcept {
    for (std::size_t i = 0; i < vertex_lane_count; i += hn::Lanes(F{})) {
        V x, y, z;
        hn::LoadInterleaved3(F{}, &positions[i].x, x, y, z);
        for (std::size_t r = 0; r < 4; ++r)
            hn::Store(hn::Add(sum_of_three(x, m[r], y, m[4 + r], z, m[8 + r]), set(m[12 + r])), F{},
                      &out.position[r][i]);
    }
}

// VertexStage::light_of for every lane; a length of 0 or NaN gives the factor 0.25, whatever the division returns.
void light(const std::array<float, 9>& m, const Vec3& toward_eye, const Vec3* normals, VertexLanes& out) noexcept {
    for (std::size_t i = 0; i < vertex_lane_count; i += hn::Lanes(F{})) {
        V n[3], world[3];
        hn::LoadInterleaved3(F{}, &normals[i].x, n[0], n[1], n[2]);
        for (std::size_t r = 0; r < 3; ++r) world[r] = sum_of_three(n[0], m[r], n[1], m[3 + r], n[2], m[6 + r]);
        const auto [x, y, z] = world;
        const V length = hn::Sqrt(hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z)));
        const V dot = sum_of_three(x, toward_eye[0], y, toward_eye[1], z, toward_eye[2]);
        const V factor = hn::Add(set(0.25f), hn::Mul(set(0.75f), hn::Abs(hn::Div(dot, length))));
        hn::Store(hn::IfThenElse(hn::Gt(length, hn::Zero(F{})), factor, set(0.25f)), F{}, &out.light[i]);
    }
}

}  // namespace

const VertexKernels* vertex_table() {
    static constexpr VertexKernels kernels{transform, light};
    return &kernels;
}

}  // namespace strata::pipeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "rasterizer/base/simd_dispatch.h"

namespace strata::pipeline {
STRATA_EXPORT(vertex_table);

const VertexKernels* vertex_kernels() noexcept {
    return simd_is_scalar() ? nullptr : kernel_of(HWY_DISPATCH_TABLE(vertex_table))();
}

}  // namespace strata::pipeline
#endif
