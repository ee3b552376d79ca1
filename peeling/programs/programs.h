// peeling/programs/programs.h - shared parts of several algorithms' fragment programs and passes. Functions over the
// lanes of a batch are defined by loops in namespace scalar; outside it are the same loops compiled for the chosen
// instruction set (programs_simd.cpp). Tests: tests/peeling/programs/programs_test.cpp
#pragma once
#include <bit>
#include <cstdint>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/frame/pass.h"
#include "pipeline/stages/depth_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/numerics.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::peeling {
inline namespace strict {

using rasterizer::ordered_code;  // the trace's form of a shader_z key

[[nodiscard]] inline std::size_t lanes(const pipeline::FragmentBatch& batch) noexcept {
    return static_cast<std::size_t>(batch.count);
}

// out = (c a, a): what UNDER and additive blending expect.
void premultiply(const pipeline::ColorLanes& color, pipeline::ColorLanes& out, std::size_t count) noexcept;
// Discards a fragment unless its code is greater than the one already peeled at its pixel.
void discard_peeled(const pipeline::FragmentBatch& in, const pipeline::Lanes<std::uint32_t>& peeled,
                    pipeline::Outputs& out) noexcept;

// Discards a fragment unless it is behind the one already peeled, by the frame's comparison including reference and
// epsilon. Needs the reference arrays unless the comparison is plain.
inline void discard_peeled(const pipeline::DepthCompare& compare, const pipeline::FragmentBatch& in,
                           const pipeline::Lanes<std::uint32_t>& peeled, pipeline::Outputs& out) noexcept {
    if (compare.is_plain()) return discard_peeled(in, peeled, out);
    for (std::size_t i = 0; i < lanes(in); ++i)
        out.alive[i] &= pipeline::mask(compare.is_behind(in.reference_code[i], in.reference_z[i], peeled[i]));
}

namespace scalar {

inline void premultiply(const pipeline::ColorLanes& color, pipeline::ColorLanes& out, std::size_t count) noexcept {
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < count; ++i) out[c][i] = color[c][i] * color[3][i];
    for (std::size_t i = 0; i < count; ++i) out[3][i] = color[3][i];
}

inline void discard_peeled(const pipeline::Lanes<std::uint32_t>& code, const pipeline::Lanes<std::uint32_t>& peeled,
                           pipeline::Lanes<std::uint32_t>& alive, std::size_t count) noexcept {
    for (std::size_t i = 0; i < count; ++i) alive[i] &= pipeline::mask(code[i] > peeled[i]);
}

}  // namespace scalar

}  // namespace strict
}  // namespace strata::peeling
