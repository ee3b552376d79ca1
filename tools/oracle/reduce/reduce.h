// tools/oracle/reduce/reduce.h - reduces a failing scene to the fewest triangles, the smallest frame and the simplest
// state that still differ.
//
// Rule     A scene fails if the candidate's image has a pixel that differs from the correct image, in the kind
//          (compare.h) of most pixels that differ in the whole scene, so that a reduction does not change from one
//          mistake to another. A scene that the candidate fails to draw is neither correct nor wrong and is not used.
//          First the frame is reduced to a window around one differing pixel, with the triangles that cover it: the
//          smallest window that still fails is used. Then triangles are removed by halves, quarters, ... until no
//          single one can be removed; then rows and columns of the frame; then the state is reset to its defaults, one
//          field at a time; and all of this is repeated until nothing more can be removed. Tolerances of codes apply at
//          every step, budgets of pixels only to the whole scene, because a smaller frame has fewer pixels.
// Source   Zeller and Hildebrandt 2002, "Simplifying and Isolating Failure-Inducing Input", algorithm ddmin.
// Tests    tests/tools/oracle/reduce/reduce_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "tools/oracle/compare/compare.h"
#include "tools/oracle/pack/golden.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// Draws a scene; empty if it could not be drawn. Of `Golden` the scene, its own view, the profile, the options and the
// first algorithm are used.
using Candidate = std::function<std::optional<Picture>(const Golden& scene)>;

// How a window of the frame is drawn: as a frame of its own, or as the scissor's rectangle in the whole frame, for
// failures that only occur in frames of that size; then pixels outside it are not compared.
enum class FrameExtent : std::uint8_t { cut, whole };

struct ReduceRules {
    Tolerances tolerances{};
    FrameExtent frame = FrameExtent::cut;
};

struct Reduction {
    Golden scene{};  // the smallest one that fails
    std::size_t triangles_before = 0, triangles = 0;
    int width_before = 0, height_before = 0;
    int runs = 0, undrawn = 0;            // runs of the candidate; undrawn: those that drew nothing
    Kind kind = Kind::none;               // of the failure
    std::vector<std::string> defaults{};  // fields that were reset to their defaults
    Comparison comparison{};              // of the correct image with the candidate's, inside the window
    rasterizer::Rect window{};            // of the smallest scene's frame; all of it unless `Frame::whole` is used
    // "2 triangles in a frame of 1x1 pixels still differ ..."
    [[nodiscard]] std::string description() const;
};

// The image that a candidate should draw. Throws Refused.
[[nodiscard]] Picture right_picture(const Golden& scene);

// The value of a pixel where nothing is drawn, because a small frame may have no such pixel. Throws Refused.
[[nodiscard]] Background background_of(const Golden& scene);

// Empty if the candidate draws the scene correctly or within the tolerances; InputError if it draws no image of it, or
// one of another size. `on_run` is called before each run of the candidate.
[[nodiscard]] std::optional<Reduction> reduce(const Golden& scene, const Candidate& candidate,
                                              const std::function<void(const Golden&)>& on_run = {},
                                              const ReduceRules& rules = {});

}  // namespace strata::oracle
