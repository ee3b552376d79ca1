// pipeline/region/region_targets.h - a region's render targets, including those of the opaque scene: creates, clears,
// copies and reads them.
//
// Rule     Targets have the same indices in every region of a frame, because the body creates them in the same order.
//          Clears fill the region: scissor and write masks belong to passes.
// Source   pipeline/reference/execution.md 1.1; formats.md 5.
// Tests    tests/pipeline/region/region_test.cpp, region_rarities_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/stages/target_storage.h"
#include "pipeline/textures/depth_texels.h"

namespace strata::pipeline {

struct RegionShared;

class Targets {
  public:
    // Creates the two targets of the opaque scene, with depth 1 and the background.
    explicit Targets(const RegionShared& shared);

    [[nodiscard]] Target make(Format format, int samples = 1);
    [[nodiscard]] Target make_depth();
    // A target with one element for each pixel, which passes once a pixel write and all passes load.
    [[nodiscard]] Target make_of_pixels(Format format);
    [[nodiscard]] Target opaque_depth() const noexcept { return opaque_depth_; }
    [[nodiscard]] Target opaque_color() const noexcept { return opaque_color_; }
    // True if it is 1 everywhere, as before the first opaque triangle.
    [[nodiscard]] bool opaque_depth_is_cleared() const noexcept { return opaque_depth_is_cleared_; }
    // True if its depths are within the depth range, as those of sorted fragments are: codes outside have no order
    // (rasterizer/reference/depth.md 2.9).
    [[nodiscard]] bool has_ordered_surface() const;
    void note_written(Target target) noexcept { opaque_depth_is_cleared_ &= target != opaque_depth_; }

    void set_name(Target target, std::string_view name) const;
    void clear(Target target, const ClearValue& value, std::uint8_t sample_mask = 0xff);
    void copy(Target from, Target to);  // same format and samples: a bit copy
    // glCopyTexSubImage2D from a depth or colour buffer to a texture of the frame's size and of the same format, with
    // one sample each: copies the rectangle `from_rect` of the frame to the same rectangle moved by (dx, dy); y down,
    // as in memory. Throws NeedsFrame if a region would have to read outside itself.
    void copy_rectangle(Target from, const rasterizer::Rect& from_rect, Target to, int dx, int dy);

    [[nodiscard]] int count() const noexcept { return static_cast<int>(storages_.size()); }
    [[nodiscard]] std::vector<TargetStorage>& all() noexcept { return storages_; }
    [[nodiscard]] TargetStorage& at(Target t) { return storages_[static_cast<std::size_t>(t.id)]; }
    [[nodiscard]] const TargetStorage& at(Target t) const { return storages_[static_cast<std::size_t>(t.id)]; }
    // The first element of a sample of the frame; of a target of pixels always 0.
    [[nodiscard]] std::size_t first_element(Target t, std::size_t sample) const;
    [[nodiscard]] bool is_one_sample(Target t) const { return t.exists() && at(t).samples() == 1; }
    // Null if there is no such target.
    [[nodiscard]] const std::uint32_t* codes_of(Target t) const { return t.exists() ? at(t).depth(0) : nullptr; }
    // A sample of a depth target as a texture; its `t` increases in the frame's y direction.
    [[nodiscard]] DepthTexels depth_texels(Target depth, std::size_t sample = 0) const;
    // The contents of a target: one element's colour as a program would load it, or the codes of one sample of every
    // pixel as an image of the region. An image has the target's own samples, too.
    [[nodiscard]] Rgba color(Target target, std::uint32_t element, int own_sample = 0) const;
    [[nodiscard]] Image image(Target target, std::size_t sample = 0) const;
    // The image of all samples: the mean of colours by the profile's rule, the nearest depth (fragment-stages.md 13.3).
    [[nodiscard]] Image resolved(Target target) const;
    // Row y of the region, from 0 on, in Image order.
    void read_row(Target target, int y, std::uint32_t* out, std::size_t sample = 0) const;
    // Reports colour targets with infinity, NaN or, where halves have none, the greatest half, that were not cleared to
    // it: all if Frame::checks_targets is set, else the published one. The executor calls it after the body.
    void report_overflow(Target published) const;
    // Throws std::logic_error if a target has other codes than in `others`, the result of a selection.
    void require_equal(const std::vector<TargetStorage>& others) const;

  private:
    void copy_row(const TargetStorage& source, const rasterizer::Rect& written, int y, int dx, int dy,
                  std::uint32_t first, TargetStorage& texture);

    const RegionShared& shared_;
    std::vector<TargetStorage> storages_;
    mutable std::vector<std::pair<int, std::string>>
        names_;                            // names of targets by index, if Frame::checks_targets is set
    std::vector<int> cleared_non_finite_;  // targets cleared to infinity or NaN
    Target opaque_depth_, opaque_color_;
    bool opaque_depth_is_cleared_ = true;
};

}  // namespace strata::pipeline
