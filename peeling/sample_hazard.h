// peeling/sample_hazard.h - counts the layers that a multisampled peel loses, doubles or misplaces at its samples,
// because it shades once per pixel or compares with a depth that another sample has stored.
//
// Rule     A sample's true layers are the distinct keys of its own fragments before the opaque surface, evaluated at
//          the sample. Lost: never composited; doubled: composited more than once; misplaced: composited behind a
//          farther one. A sample with any of them is at a silhouette if the samples of its pixel have different numbers
//          of fragments, at an inner edge if they have the same number but not the same triangles, else inside.
// Source   pipeline/reference/fragment-stages.md 13.5; peel_errors.h.
// Tests    tests/peeling/frame/sample_hazard_test.cpp
#pragma once
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/formats/image.h"

namespace strata::peeling {

// Where a pixel lies, by the fragments of its samples.
enum class SampleEdge : std::uint8_t { inside, inner_edge, silhouette };

struct SampleHazard {
    std::optional<pipeline::Refusal> refusal;  // if set, all other members are empty
    std::uint64_t layers = 0, lost = 0, doubled = 0, misplaced = 0;
    std::uint64_t samples = 0;  // that have a layer
    std::uint64_t at_silhouettes = 0, at_inner_edges = 0, inside = 0;
    std::uint64_t programs = 0;  // runs of the program if one pass draws everything
    int passes = 0;
    bool ended = true;        // false: stopped by a limit, as a peel that finds the same layer in every pass
    pipeline::Image picture;  // resolved
};

// The options say how many samples a pixel has and where programs are evaluated (RasterState::interpolation). All
// fragments and traces are held in memory, so frames should be of modest size.
[[nodiscard]] SampleHazard measure_samples(const FrameRequest& request, const Algorithm& algorithm);

// The kind of every pixel, row by row from the top.
[[nodiscard]] std::vector<SampleEdge> sample_edges(const FrameRequest& request, const Algorithm& algorithm);

}  // namespace strata::peeling
