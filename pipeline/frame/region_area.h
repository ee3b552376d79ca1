// pipeline/frame/region_area.h - the rectangle of a region, and the enums with which callers describe their use of it.
#pragma once
#include <cstddef>
#include <cstdint>

#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

enum class Extent : std::uint8_t { frame, tile };
enum class Counting : std::uint8_t { counted, silent };  // a pass of the algorithm, or a query of the emulator itself

struct RegionArea {
    rasterizer::Rect rect;
    std::size_t tile = 0;  // tile number, if the extent is `tile`
    Extent extent = Extent::frame;
};

}  // namespace strata::pipeline
