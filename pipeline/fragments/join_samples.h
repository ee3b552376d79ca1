// pipeline/fragments/join_samples.h - rasterizes the triangles of all samples together and joins their fragments by
// pixel.
//
// Rule     Triangle after triangle: an algorithm that draws all samples of a triangle before the next one sees a
//          pixel's fragments in the order of submission.
// Source   pipeline/reference/fragment-stages.md 13.7 and 13.9.
// Tests    tests/peeling/frame/pixel_lists_test.cpp, tests/peeling/frame/centroid_test.cpp
#pragma once
#include <functional>
#include <span>

#include "pipeline/fragments/pixel_fragments.h"
#include "pipeline/vertices/prepare.h"
#include "pipeline/vertices/primitive_range.h"

namespace strata::pipeline {

// Where colours are evaluated: where the geometry's state says, or at the centre and at every covered sample.
enum class JoinedColors : std::uint8_t { once, at_centre_and_samples };

struct SamplesToJoin {
    const PreparedDraw& list;
    std::size_t samples;
    std::function<std::span<const std::uint32_t>(std::size_t sample)> triangles;  // that may touch the region
    rasterizer::DepthRequest depth;
    rasterizer::FragmentNeeds needs;  // with code and reference
    JoinedColors colors;
    // The material stage: returns the lanes that MASK keeps. `again`: the same fragments with other colours.
    std::function<const Lanes<std::uint32_t>&(FragmentBatch& batch, bool again)> shade;
};

// Passes the joined fragments of a part of the region of `joined` to the sink.
void join_samples(const SamplesToJoin& samples, const rasterizer::Rect& part, PixelFragments& joined,
                  const std::function<void(PixelBatch&)>& sink);

// The triangles of a range of primitives. Triangles are in submission order, and the pieces of a clipped one have its
// index, so they are contiguous.
[[nodiscard]] std::span<const std::uint32_t> triangles_in(const rasterizer::Geometry& geometry,
                                                          std::span<const std::uint32_t> triangles,
                                                          const PrimitiveRange& range) noexcept;

}  // namespace strata::pipeline
