// peeling/as_shown.h - converts results from the device's memory layout to what a caller sees: depths instead of keys,
// top row first.
//
// Rule     Under reversed depth memory holds keys (rasterizer/rules/depth_key.h); depth targets are returned as depths.
//          With the origin lower_left memory begins at the lowest row; images and pixel coordinates are returned with y
//          counted from the top. The first of several pixels is the first in memory.
// Tests    tests/peeling/reversed_depth_test.cpp, frame/origin_test.cpp
#pragma once
#include <cstdint>
#include <vector>

#include "peeling/render_options.h"
#include "pipeline/device/profile.h"
#include "pipeline/frame/frame_result.h"

namespace strata::peeling {

struct AuditResult;     // peeling/audit/audit_result.h
struct FrameFragments;  // peeling/render.h
struct RegionTrace;     // peeling/audit/region_trace.h

class AsShown {
  public:
    AsShown(const RenderOptions& options, const pipeline::DeviceProfile& profile) noexcept
        : turns_keys_{options.raster.depth_order == rasterizer::DepthOrder::greater},
          format_{profile.depth_buffer(options.depth)},
          turns_rows_{profile.origin == pipeline::Origin::lower_left},
          width_{options.width},
          height_{options.height} {}

    // An image of the whole frame.
    void turn(pipeline::Image& image) const;
    void turn(pipeline::FrameResult& result) const;
    void turn(AuditResult& result) const noexcept;
    void turn(FrameFragments& fragments) const;
    void turn(std::vector<RegionTrace>& traces) const;
    // Values of a whole frame, row by row.
    void turn_rows(std::vector<double>& numbers) const;

    // Converts row y between the picture and memory, in either direction; likewise a pixel's index in the frame.
    [[nodiscard]] int row(int y) const noexcept { return turns_rows_ ? height_ - 1 - y : y; }
    [[nodiscard]] std::uint32_t pixel(std::uint32_t pixel) const noexcept {
        const auto width = static_cast<std::uint32_t>(width_);
        return static_cast<std::uint32_t>(row(static_cast<int>(pixel / width))) * width + pixel % width;
    }
    [[nodiscard]] rasterizer::Rect rect(const rasterizer::Rect& r) const noexcept {
        return turns_rows_ ? rasterizer::Rect{r.x0, height_ - r.y1, r.x1, height_ - r.y0} : r;
    }

  private:
    bool turns_keys_;
    rasterizer::DepthFormat format_;  // of the codes that are keys
    bool turns_rows_;
    int width_, height_;
};

}  // namespace strata::peeling
