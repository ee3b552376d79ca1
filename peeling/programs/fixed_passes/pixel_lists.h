// peeling/programs/fixed_passes/pixel_lists.h - lists of fragments a pixel instead of a sample: a node has a coverage
// mask, and is composited at the samples that it has.
//
// Rule     A pass runs its program once for each pixel of a triangle. A node's depth is the program's, at the pixel's
//          point of evaluation; its mask has the samples that the triangle covers in front of the opaque surface.
// Source   peeling/reference/algorithms.md 21.4; passes: pipeline/reference/fragment-stages.md 13.9.
// Tests    tests/peeling/frame/pixel_lists_test.cpp
#pragma once
#include "peeling/programs/algorithm_options.h"
#include "pipeline/region/region.h"

namespace strata::peeling {

// The state of a pass once a pixel over the visible fragments.
[[nodiscard]] inline pipeline::PassState state_of_pixels(const pipeline::Region& region) {
    pipeline::PassState state;
    state.depth = {.enabled = true, .func = pipeline::CompareFunc::less, .write = false};
    state.depth_target = region.opaque_depth();
    state.needs = {
        .shader_z = false, .code = true, .exact_code = false, .color = true, .texcoord = false, .facing = false};
    state.once_a_pixel = true;
    return state;
}

// Targets and lists of one granularity, in one region.
class ListElements {
  public:
    ListElements(pipeline::Region& region, ListGranularity granularity)
        : region_{region}, of_pixels_{granularity == ListGranularity::pixel && region.frame().samples() > 1} {}

    [[nodiscard]] bool are_pixels() const noexcept { return of_pixels_; }
    [[nodiscard]] std::uint32_t pixels() const noexcept { return static_cast<std::uint32_t>(region_.rect().area()); }
    // The number of lists.
    [[nodiscard]] std::size_t count() const noexcept { return of_pixels_ ? pixels() : region_.elements(); }
    // The list of an element, and the bit of its sample in the masks of the list's nodes.
    [[nodiscard]] std::uint32_t list_of(std::uint32_t element) const noexcept {
        return of_pixels_ ? element % pixels() : element;
    }
    [[nodiscard]] std::uint8_t bit_of(std::uint32_t element) const noexcept {
        return static_cast<std::uint8_t>(of_pixels_ ? 1u << element / pixels() : 1u);
    }
    // The samples of a fragment; without masks, the one bit of its own.
    [[nodiscard]] std::uint8_t samples_of(const pipeline::Outputs& out, std::size_t lane) const noexcept {
        return of_pixels_ ? out.samples[lane] : std::uint8_t{1};
    }
    // Calls visit(element) for the elements of a list whose samples are in the mask.
    template <class Visit>
    void for_each_element(std::uint32_t list, std::uint8_t samples, const Visit& visit) const {
        for (std::size_t element = list; element < region_.elements(); element += count())
            if ((samples & bit_of(static_cast<std::uint32_t>(element))) != 0)
                visit(static_cast<std::uint32_t>(element));
    }
    // Adds the test against the opaque surface to a pass: a program of samples loads it, as its first load, and calls
    // keep_visible; a program of pixels runs after the test.
    void see_visible(pipeline::PassState& state) const {
        if (!of_pixels_) {
            state.reads[0] = region_.opaque_depth();
            return;
        }
        const pipeline::PassState tested = state_of_pixels(region_);
        state.depth = tested.depth;
        state.depth_target = tested.depth_target;
        state.once_a_pixel = true;
    }
    void keep_visible(const pipeline::FragmentBatch& in, const pipeline::Loads& loads, pipeline::Outputs& out) const {
        for (std::size_t i = 0; !of_pixels_ && i < static_cast<std::size_t>(in.count); ++i)
            out.alive[i] &= pipeline::mask(in.code[i] < loads.depth(0)[i]);
    }
    [[nodiscard]] pipeline::Target make(pipeline::Format format) const {
        return of_pixels_ ? region_.targets().make_of_pixels(format) : region_.make(format);
    }

  private:
    pipeline::Region& region_;
    bool of_pixels_;
};

}  // namespace strata::peeling
