// rasterizer/walk/depth_drawn.h - the number of fragments of a depth-only pass, and how many of them passed the depth
// test.
#pragma once
#include <cstdint>

namespace strata::rasterizer {

struct DepthDrawn {
    std::uint64_t fragments = 0, passed = 0;
};

}  // namespace strata::rasterizer
