// peeling/shadow_light.h - a light's shadow map: one depth pass over the opaque scene from the light's view.
// It runs before anything is drawn for the eye, literally: later passes sample it anywhere. Transparent surfaces let
// the light through, also where --alpha makes all of them transparent.
#pragma once
#include <memory>

#include "pipeline/formats/image.h"
#include "pipeline/textures/shadow_stage.h"

namespace strata::pipeline {
class Region;
}

namespace strata::peeling {

// The nearest depths of the transparent list, published.
void draw_depth(pipeline::Region& region);

struct LightMap {
    pipeline::Image depth;
    rasterizer::RasterState state;  // of the light's pass
    pipeline::ShadowStage stage;    // looks at `depth`, whose codes stay where they are when this is moved
};

// The map of the list's light, in the depth that the device writes by itself; `eye` lends its conventions: clip depth,
// y direction, depth range. None without a light, or if the device cannot have that depth, for then nothing runs.
[[nodiscard]] std::unique_ptr<const LightMap> light_map(const pipeline::DrawList& list,
                                                        const pipeline::DeviceProfile& profile,
                                                        const rasterizer::RasterState& eye, int threads);

}  // namespace strata::peeling
