// tests/pipeline/frames.h - a frame for a test's draw list, for bodies and passes written against Region.
#pragma once
#include <utility>

#include "pipeline/region/executor.h"
#include "pipeline/region/region.h"
#include "tests/support/fragment_scene.h"

namespace strata::testing {

// Owns what its `frame` points to, so it can be neither copied nor moved.
class TestFrame {
  public:
    TestFrame(pipeline::DrawList draws, const pipeline::View& view, int width, int height, const char* profile,
              int tile_size = 8, const pipeline::CoordinateUnits& units = {})
        : list_{std::move(draws)} {
        const pipeline::DeviceProfile& device = *pipeline::find_profile(profile);
        rasterizer::RasterState raster;
        raster.viewport = {0, 0, width, height};
        raster.depth_format = device.has_d32f ? pipeline::DepthFormat::d32f : pipeline::DepthFormat::d24;
        pipeline::PrepareOptions options{
            .selection = pipeline::Selection::transparent, .tile_size = tile_size, .threads = 1, .units = units};
        transparent_ = pipeline::prepare(list_, view, raster, device, options);
        options.selection = pipeline::Selection::opaque;
        opaque_ = pipeline::prepare(list_, view, raster, device, options);
        frame.profile = &device;
        frame.transparent = &transparent_;
        if (!opaque_.geometry.triangles.empty()) frame.opaque = &opaque_;
        frame.depth = {device.raster.depth_path, raster.depth_format};
        frame.background = {0, 0, 0, 0};
    }
    TestFrame(const FragmentScene& scene, const char* profile, int tile_size = 8)
        : TestFrame{draw_list(scene), {}, scene.width, scene.height, profile, tile_size} {}
    TestFrame(const TestFrame&) = delete;
    TestFrame& operator=(const TestFrame&) = delete;

    pipeline::Frame frame;

  private:
    pipeline::DrawList list_;
    pipeline::PreparedDraw transparent_, opaque_;
};

}  // namespace strata::testing
