// peeling/frame/shadow_light.h - a light's shadow map: one depth pass over the opaque scene from the light's view.
// It runs literally and before the eye's passes, which sample it anywhere. Transparent surfaces cast no shadow, even
// where --alpha makes all of them transparent.
#pragma once
#include <memory>

#include "pipeline/formats/image.h"
#include "pipeline/textures/shadow_stage.h"

namespace strata::pipeline {
class Region;
}

namespace strata::peeling {

// Publishes the nearest depths of the transparent list.
void draw_depth(pipeline::Region& region);

struct LightMap {
    pipeline::Image depth;
    rasterizer::RasterState state;  // the state of the light's pass
    pipeline::ShadowStage stage;    // points to the codes of `depth`, which stay at their address when this is moved
};

// The map of the list's light, in the device's own depth; `eye` provides the conventions: clip depth, y direction,
// depth range. Null without a light, or if the device does not support that depth, because then no frame runs.
[[nodiscard]] std::unique_ptr<const LightMap> light_map(const pipeline::DrawList& list,
                                                        const pipeline::DeviceProfile& profile,
                                                        const rasterizer::RasterState& eye, int threads);

}  // namespace strata::peeling
