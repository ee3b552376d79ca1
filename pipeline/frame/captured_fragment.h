// pipeline/frame/captured_fragment.h - a single fragment of the transparent list, after MASK and before any test.
#pragma once
#include <cstdint>

#include "pipeline/vertices/draw_list.h"

namespace strata::pipeline {

struct CapturedFragment {
    std::uint32_t pixel = 0, primitive = 0;
    std::uint32_t code = 0, exact_code = 0;
    float shader_z = 0;
    Rgba color{};
};

}  // namespace strata::pipeline
