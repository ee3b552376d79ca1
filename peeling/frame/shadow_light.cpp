// peeling/frame/shadow_light.cpp - the light's pass: the device's own depth pass, from another view into a square
// target.
#include "peeling/frame/shadow_light.h"

#include "peeling/frame/check_options.h"
#include "pipeline/region/executor.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

using namespace pipeline;

// Starts from the opaque depths. LESS keeps the nearest; colours are neither computed nor stored.
void draw_depth(Region& region) {
    const Target depth = region.make_depth();
    region.copy(region.opaque_depth(), depth);
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
    state.depth_target = depth;
    state.needs = {.shader_z = false, .code = true, .color = false};
    region.begin_iteration();
    static_cast<void>(region.draw_depth(state));
    region.publish(depth);
}

namespace {

LightMap drawn_map(const DrawList& list, const DeviceProfile& profile, const rasterizer::RasterState& eye,
                   const rasterizer::DepthRequest& depth, int threads) {
    const ShadowLight& light = *list.light;
    // Viewport, scissor and clip planes belong to the eye's view and are reset; the clip depth range and the direction
    // of y belong to the device and are kept.
    rasterizer::RasterState state = eye;
    state.viewport = {0, 0, light.size_px, light.size_px};
    state.scissor.reset();
    state.sample.reset();
    state.interpolation = rasterizer::Interpolation::sample;
    state.sample_coverage = {};
    state.clip_plane_count = 0;
    // The offset is applied to the map and not to the lookup; its factor moves surfaces at grazing angles to the light
    // by more.
    state.polygon_offset = {.enabled = true, .factor = light.offset_factor, .units = light.offset_units};
    state.depth_format = depth.format;
    const View from{.view = light.view, .projection = light.projection};
    const PreparedDraw seen =
        prepare(list, from, state, profile, {.selection = Selection::opaque, .tile_size = 64, .threads = threads});
    Frame frame;
    frame.profile = &profile;
    frame.transparent = &seen;
    frame.depth = depth;
    frame.published_format = target_format(depth.format);
    // The whole map is one region: a pixel of the eye may look at any texel.
    frame.needs_frame = true;
    LightMap map{run(frame, draw_depth, Execution::literal, threads).color, state, {}};
    // Set after `depth` has been moved into the map: the stage keeps a pointer to its codes, which moving the vector
    // does not change.
    map.stage = shadow_stage(light, map.depth, state);
    return map;
}

}  // namespace

std::unique_ptr<const LightMap> light_map(const DrawList& list, const DeviceProfile& profile,
                                          const rasterizer::RasterState& eye, int threads) {
    // The map is compared with z, so it must contain neither w nor its logarithm.
    rasterizer::DepthPath path = profile.raster.depth_path;
    if (path == rasterizer::DepthPath::w_buffer) path = rasterizer::DepthPath::window_z;
    if (path == rasterizer::DepthPath::logarithmic) path = rasterizer::DepthPath::float32;
    const rasterizer::DepthRequest depth{path, eye.depth_format};
    if (!list.light || check_depth(profile, depth)) return nullptr;
    return std::make_unique<const LightMap>(drawn_map(list, profile, eye, depth, threads));
}

}  // namespace strata::peeling
