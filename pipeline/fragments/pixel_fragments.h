// pipeline/fragments/pixel_fragments.h - joins the fragments that a triangle has at the samples of a pixel into one,
// for passes whose program runs once a pixel.
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

// Fragments for which a program runs once a pixel: `pixel` is the pixel's index in the region, `code` the depth that
// the program reads, shader_z and color are set, and all else is not.
struct PixelBatch {
    FragmentBatch batch{};
    Lanes<std::uint8_t> covered{};                      // bit s: sample s
    std::array<Lanes<std::uint32_t>, 8> sample_code{};  // the depth that sample s stores, where it is covered
};

class PixelFragments {
  public:
    explicit PixelFragments(const rasterizer::Rect& region) : region_{region}, last_batch_(region.area()) {}

    // Adds the lanes of a sample's batch that are alive. `reference_code` is set: it is the program's depth.
    void add(const FragmentBatch& batch, const Lanes<std::uint32_t>& alive, std::size_t sample);
    // Passes what was added to `sink`, in batches in which no pixel occurs twice, and forgets it.
    void join(const std::function<void(PixelBatch&)>& sink);

  private:
    struct SampleFragment {
        std::uint64_t place;  // triangle, y, x
        std::uint32_t sample, code, sample_code;
        float shader_z;
        std::array<float, 4> color;
    };

    void start(const SampleFragment& fragment, std::uint32_t pixel);

    rasterizer::Rect region_;
    std::vector<SampleFragment> fragments_;
    std::vector<std::uint32_t> last_batch_;  // per pixel, the number of the last batch that has a fragment of it
    std::uint32_t number_ = 1;
    PixelBatch pixels_;
};

}  // namespace strata::pipeline
