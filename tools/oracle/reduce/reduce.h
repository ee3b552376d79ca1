// tools/oracle/reduce/reduce.h - a failing scene made small: the fewest triangles, the smallest frame, the simplest
// state that still differ.
//
// Rule     A scene fails if the candidate's picture of it has a pixel that the right picture has not, and which differs
//          in the kind (compare.h) of most pixels that differ in the whole scene: a reduction does not slip from one
//          mistake to another. A scene that the candidate fails to draw is neither right nor wrong: it is not taken.
//          First the frame is cut to a window around one differing pixel, with the triangles that cover it: the
//          smallest window that still fails counts. Then triangles are left out by halves, quarters, ... until no
//          single one can be left out; then rows and columns of the frame; then the state goes back to its defaults, a
//          field at a time; and all of it again until nothing is left to take away. Tolerances of codes hold at every
//          step, budgets of pixels for the whole scene alone: a cut frame has fewer pixels.
// Source   Zeller and Hildebrandt 2002, "Simplifying and Isolating Failure-Inducing Input", algorithm ddmin.
// Tests    tests/tools/oracle/reduce/reduce_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <string>

#include "tools/oracle/compare.h"
#include "tools/oracle/pack/golden.h"
#include "tools/oracle/picture.h"

namespace strata::oracle {

// Draws a scene; nothing where it could not be drawn. Of `Golden` the scene, its own view, the profile, the options and
// the first algorithm count.
using Candidate = std::function<std::optional<Picture>(const Golden& scene)>;

// What a window of the frame becomes: a frame of its own, or the scissor's rectangle in the whole frame, for what shows
// in frames of that size alone; then pixels outside of it are not compared.
enum class Frame : std::uint8_t { cut, whole };

struct ReduceRules {
    Tolerances tolerances{};
    Frame frame = Frame::cut;
};

struct Reduction {
    Golden scene{};  // the smallest one that fails
    std::size_t triangles_before = 0, triangles = 0;
    int width_before = 0, height_before = 0;
    int runs = 0, undrawn = 0;            // of the candidate; those that drew nothing
    Kind kind = Kind::none;               // of the failure
    std::vector<std::string> defaults{};  // fields that went back to their defaults
    Comparison comparison{};              // of the right picture and the candidate's, inside the window
    rasterizer::Rect window{};            // of the smallest scene's frame, all of it unless the frame stays whole
    // "2 triangles in a frame of 1x1 pixels still differ ..."
    [[nodiscard]] std::string sentence() const;
};

// The picture that a candidate ought to draw. Throws Refused.
[[nodiscard]] Picture right_picture(const Golden& scene);

// What a pixel of the picture holds where nothing is drawn: a small frame may have no such pixel. Throws Refused.
[[nodiscard]] Background background_of(const Golden& scene);

// Nothing if the candidate draws the scene right, or within the tolerances; InputError if it draws no picture of it, or
// one of another size. `on_run` is called before each run of the candidate.
[[nodiscard]] std::optional<Reduction> reduce(const Golden& scene, const Candidate& candidate,
                                              const std::function<void(const Golden&)>& on_run = {},
                                              const ReduceRules& rules = {});

}  // namespace strata::oracle
