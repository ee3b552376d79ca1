// rasterizer/walk/depth_drawn.h - how many fragments a pass of rows made, and how many of them passed its depth test.
#pragma once
#include <cstdint>

namespace strata::rasterizer {

struct DepthDrawn {
    std::uint64_t fragments = 0, passed = 0;
};

}  // namespace strata::rasterizer
