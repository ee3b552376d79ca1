// pipeline/frame/captured_fragment.h - a fragment of the transparent list as RegionShortcuts::capture returns it: it
// has passed the alpha cutoff of its material (glTF's alphaMode MASK), and no alpha, stencil or depth test has been
// applied.
#pragma once
#include <cstdint>

#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {

struct CapturedFragment {
    std::uint32_t pixel = 0, primitive = 0;  // the pixel's index in the frame, row-major; the triangle's in the list
    std::uint32_t code = 0, exact_code = 0;  // the depth as the frame's buffer stores it; the same by DepthPath::exact
    float shader_z = 0;                      // the depth that a fragment program reads, not quantized
    Rgba color{};                            // interpolated
    std::uint32_t sample = 0;                // of the pixel
};

}  // namespace strata::pipeline
