// pipeline/fragments/pixel_fragments.h - joins the fragments that a triangle has at the samples of a pixel into one,
// for passes whose program runs once a pixel, or whose colours depend on the tests of all samples.
//
// Rule     Fragments of one triangle as submitted and of one pixel are one fragment: the pieces of a clipped triangle
//          are not told apart. Its values are those of the covered sample with the lowest number, with which those of
//          the others agree under per-pixel shading. Order: by triangle, row by row.
// Source   pipeline/reference/fragment-stages.md 13.9.
// Tests    tests/pipeline/fragments/pixel_fragments_test.cpp
#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "pipeline/stages/target.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {

// Fragments of pixels: `pixel` is the pixel's index in the region, `code` the depth that the program reads. shader_z,
// the reference and the colour are set, and all else is not.
struct PixelBatch {
    FragmentBatch batch{};
    Lanes<std::uint8_t> covered{};                              // bit s: sample s
    std::array<Lanes<std::uint32_t>, 8> sample_code{};          // the depth that sample s stores, where it is covered
    std::array<std::array<Lanes<float>, 4>, 8> sample_color{};  // the colour at sample s, if it was added
};

class PixelFragments {
  public:
    explicit PixelFragments(const rasterizer::Rect& region) : region_{region}, last_batch_(region.area()) {}

    // Adds the lanes of a sample's batch that are alive. The reference is set: it is the program's depth.
    void add(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive, std::size_t sample) {
        add_as(batch, alive, sample);
    }
    // Adds the colours of the same fragments at the sample itself.
    void add_colors(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive, std::size_t sample) {
        add_as(batch, alive, first_color + sample);
    }
    // Passes what was added to `sink`, in batches in which no pixel occurs twice, and forgets it.
    void join(const std::function<void(PixelBatch&)>& sink);

  private:
    static constexpr std::uint32_t first_color = 8;

    struct SampleFragment {
        std::uint64_t place;   // triangle, y, x
        std::uint32_t number;  // of the sample; of the colour at it, first_color more
        std::uint32_t code, sample_code;
        float shader_z;
        double reference_z;
        std::array<float, 4> color;
    };

    void add_as(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive, std::size_t number);
    void start(const SampleFragment& fragment, std::uint32_t pixel);

    rasterizer::Rect region_;
    std::vector<SampleFragment> fragments_;
    std::vector<std::uint32_t> last_batch_;  // per pixel, the number of the last batch that has a fragment of it
    std::uint32_t number_ = 1;
    PixelBatch pixels_;
};

}  // namespace strata::pipeline
