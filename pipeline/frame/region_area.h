// pipeline/frame/region_area.h - where a region lies, and the words in which its callers say what they ask of it.
#pragma once
#include <cstddef>
#include <cstdint>

#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

enum class Extent : std::uint8_t { frame, tile };
enum class Counting : std::uint8_t { counted, silent };  // a pass of the algorithm, or a look of the emulator's own

struct RegionArea {
    rasterizer::Rect rect;
    std::size_t tile = 0;  // its number; of an extent `tile`
    Extent extent = Extent::frame;
};

}  // namespace strata::pipeline
