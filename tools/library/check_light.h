// tools/library/check_light.h - the one rule of a frame's light, for all functions that draw a scene.
#pragma once
#include "rasterizer/base/input_error.h"
#include "strata/render.h"
#include "tools/request/complete.h"

namespace strata {
inline namespace v0_1 {

// Throws InputError for a target that encodes what is blended, of a scene whose colours are encoded already.
inline void check_light(const Scene& scene, const RenderOptions& options) {
    if (const auto found = tools::light_conflict(options, scene.space()))
        throw InputError("scene", "color_space: " + *found);
}

}  // namespace v0_1
}  // namespace strata
