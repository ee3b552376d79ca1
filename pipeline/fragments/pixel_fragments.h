// pipeline/fragments/pixel_fragments.h - joins the fragments that a triangle has at the samples of a pixel into one,
// for passes whose program runs once a pixel, or whose colours depend on the tests of all samples.
//
// Rule     Fragments of one triangle and one pixel are one fragment; the pieces of a clipped triangle are triangles.
// Its
//          values are those of the covered sample with the lowest number, with which those of the others agree under
//          per-pixel shading. Order: by triangle as submitted and piece, row by row.
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
    std::array<Lanes<std::uint8_t>, 2> kept{};  // MASK keeps the fragment with its colour; bit s: with that at sample s
};

class PixelFragments {
  public:
    explicit PixelFragments(const rasterizer::Rect& region) : region_{region}, last_batch_(region.area()) {}

    // Adds the lanes of a sample's batch that are covered. `kept`: MASK keeps the lane. The reference is set: it is the
    // program's depth.
    void add(const FragmentBatch& batch, const Lanes<std::uint32_t>& covered, const Lanes<std::uint32_t>& kept,
             std::uint32_t piece, std::size_t sample) {
        add_as(batch, covered, kept, piece, static_cast<std::uint32_t>(sample));
    }
    // Adds the colours of the same fragments at the sample itself.
    void add_colors(const FragmentBatch& batch, const Lanes<std::uint32_t>& kept, std::uint32_t piece,
                    std::size_t sample);
    // Passes what was added to `sink`, in batches in which no pixel occurs twice, and forgets it.
    void join(const std::function<void(PixelBatch&)>& sink);

    static constexpr std::uint32_t most_pieces = 16;

  private:
    static constexpr std::uint32_t first_color = 8;

    struct SampleFragment {
        std::uint64_t place;   // triangle as submitted, piece, pixel
        std::uint32_t number;  // of the sample; of the colour at it, first_color more
        bool is_kept;
        std::uint16_t x, y;
        std::uint32_t code, sample_code;
        float shader_z;
        double reference_z;
        std::array<float, 4> color;
    };

    void add_as(const FragmentBatch& batch, const Lanes<std::uint32_t>& covered, const Lanes<std::uint32_t>& kept,
                std::uint32_t piece, std::uint32_t number);
    void start(const SampleFragment& fragment);

    rasterizer::Rect region_;
    std::vector<SampleFragment> fragments_;
    std::vector<std::uint32_t> last_batch_;  // per pixel, the number of the last batch that has a fragment of it
    std::uint32_t number_ = 1;
    PixelBatch pixels_;
};

}  // namespace strata::pipeline
