// pipeline/stages/target.h - the values that a batch reads from a render target and writes to it.
#pragma once
#include <array>
#include <cstdint>

#include "pipeline/stages/target_handle.h"
#include "rasterizer/base/vector.h"
#include "rasterizer/coverage/fragment_batch.h"

namespace strata::pipeline {

using rasterizer::batch_capacity;
using rasterizer::FragmentBatch;
using rasterizer::Lanes;

// The values of a clear: a colour, converted to the target's format like a source colour; a depth, clamped to [0,1]
// unless the profile stores it unclamped (pipeline/reference/formats.md 5.5); a stencil value.
struct ClearValue {
    Rgba color{0, 0, 0, 0};
    float depth = 1.0f;
    std::uint8_t stencil = 0;
};

// A batch's stored colours, one array per channel: 8-bit codes, half bits or binary32 bits, zero-extended.
using ColorCodes = std::array<Lanes<std::uint32_t>, 4>;
// A batch's colours r g b a as binary32.
using ColorLanes = std::array<Lanes<float>, 4>;

}  // namespace strata::pipeline
