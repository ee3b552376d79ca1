// peeling/programs/depth_range.h - shared parts of the fragment programs of Carr's algorithms: discard outside a range
// of stored codes, compositing in submission order, and sets of pixels for fault reports.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "peeling/programs/programs.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

using CodeLanes = pipeline::Lanes<std::uint32_t>;

// keep_behind, keep_before and so on: each keeps the fragments whose code has the named relation to the bound at their
// pixel, and discards the others. Codes of one format are ordered like depths.
inline void keep_behind(const pipeline::FragmentBatch& in, const CodeLanes& bound, pipeline::Outputs& out) noexcept {
    discard_peeled(in, bound, out);
}
inline void keep_from(const pipeline::FragmentBatch& in, const CodeLanes& bound, pipeline::Outputs& out) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) out.alive[i] &= pipeline::mask(in.code[i] >= bound[i]);
}
inline void keep_before(const pipeline::FragmentBatch& in, const CodeLanes& bound, pipeline::Outputs& out) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) out.alive[i] &= pipeline::mask(in.code[i] < bound[i]);
}
inline void keep_up_to(const pipeline::FragmentBatch& in, const CodeLanes& bound, pipeline::Outputs& out) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) out.alive[i] &= pipeline::mask(in.code[i] <= bound[i]);
}
inline void keep_at(const pipeline::FragmentBatch& in, const CodeLanes& bound, pipeline::Outputs& out) noexcept {
    for (std::size_t i = 0; i < lanes(in); ++i) out.alive[i] &= pipeline::mask(in.code[i] == bound[i]);
}

// The needs of a pass that reads only the stored code.
inline constexpr rasterizer::FragmentNeeds code_only{
    .shader_z = false, .code = true, .exact_code = false, .color = false, .texcoord = false, .facing = false};
inline constexpr rasterizer::FragmentNeeds code_with_color{
    .shader_z = false, .code = true, .exact_code = false, .color = true, .texcoord = false, .facing = false};

// The state of a pass without depth and stencil tests that blends the fragments its program keeps UNDER `accumulated`.
[[nodiscard]] inline pipeline::PassState composite_state(pipeline::Target accumulated) {
    pipeline::PassState state;
    state.color[0] = accumulated;
    state.blend[0] = pipeline::blend_mode::under;
    state.needs = code_with_color;
    return state;
}

inline void composite_under(const pipeline::FragmentBatch& in, pipeline::Outputs& out) {
    premultiply(in.color, out.color[0], lanes(in));
    out.traced = true;
    std::fill_n(out.side.begin(), lanes(in), pipeline::Side::front);
    std::copy_n(in.code.begin(), lanes(in), out.key.begin());
}

// A set of pixels of a region, each sample by itself.
class PixelSet {
  public:
    explicit PixelSet(const pipeline::Region& region)
        : area_{static_cast<std::uint32_t>(region.rect().area())}, has_(region.elements()) {}
    // True if the element was not yet in the set.
    bool add(std::uint32_t element) {
        if (has_[element]) return false;
        has_[element] = true;
        const std::uint32_t pixel = element % area_;
        first_ = pixels_++ == 0 || pixel < first_ ? pixel : first_;
        return true;
    }
    void clear() {
        if (pixels_ > 0) has_.assign(has_.size(), false);
        pixels_ = 0;
    }
    void report(pipeline::Region& region, pipeline::Fault fault, const std::string& detail) const {
        region.report(fault, pixels_, first_, detail);
    }

  private:
    std::uint32_t area_;
    std::vector<bool> has_;
    std::uint64_t pixels_ = 0;
    std::uint32_t first_ = 0;
};

// Detects ties at a peel's bound: more than one fragment at a pixel in a pass that composites by equality of depth.
class BoundTies {
  public:
    explicit BoundTies(const pipeline::Region& region) : tied_{region}, arrived_(region.elements()) {}
    void start() { ++pass_; }
    void add(const pipeline::FragmentBatch& in, const pipeline::Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i)
            if (out.alive[i] != 0) add(in.pixel[i]);
    }
    void add(std::uint32_t pixel) {
        if (std::exchange(arrived_[pixel], pass_) == pass_) tied_.add(pixel);
    }
    void report(pipeline::Region& region) const {
        tied_.report(region, pipeline::Fault::equal_at_bound,
                     "fragments of equal depth at the bound of a peel, composited in submission order");
    }

  private:
    PixelSet tied_;
    std::vector<std::uint32_t> arrived_;  // per pixel, the last pass in which it had such a fragment
    std::uint32_t pass_ = 1;
};

}  // namespace strata::peeling
