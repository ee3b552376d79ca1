// pipeline/region_scratch.h - the arrays that one batch passes through; one set a region, nothing is allocated per batch.
#pragma once
#include "pipeline/region.h"

namespace strata::pipeline {

struct alignas(64) Region::Scratch {
    Loads loads;
    Outputs out;
    FragmentBatch screen;
    ColorLanes texel;
    ColorCodes codes;
    Lanes<std::uint32_t> alive;         // of one sample
    Lanes<std::uint32_t> depth_stored;  // of a pixel that is stored alone
    Lanes<std::uint32_t> depth_pass;
    Lanes<std::uint32_t> stencil_stored;
    Lanes<std::uint32_t> saturated;
};

}  // namespace strata::pipeline
