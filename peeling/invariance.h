// peeling/invariance.h - one experiment of `strata invariance`: measures a peel whose stored and compared depths are
// computed differently.
//
// Rule     `write` computes the depth that is stored, `compare` the depth that a later pass compares with it. The
//          fragments of both are paired and counted; the peel is then run on the emulated device with that pair and
//          the given remedy (bias, epsilon, quantisation), and its trace and image are compared with the exact
//          A-buffer.
// Source   Everitt 2001; peeling/reference/audit.md 11; pipeline/reference/texturing.md 4.1;
//          rasterizer/reference/numbers.md 6.
// Tests    tests/peeling/invariance_test.cpp
#pragma once
#include <optional>

#include "peeling/audit/image_error.h"
#include "peeling/audit/peel_errors.h"
#include "peeling/audit/safe_range.h"
#include "peeling/render_options.h"
#include "pipeline/device/check.h"
#include "pipeline/formats/image.h"

namespace strata::pipeline {
struct DrawList;
struct View;
}  // namespace strata::pipeline

namespace strata::peeling {

struct FrameFragments;  // peeling/render.h

struct InvarianceCase {
    // Size, format, alpha, the remedy, and what later passes draw (second list, vertex path, clamp). The experiment
    // sets depth_path, reference_path, max_passes and audit itself.
    RenderOptions render;
    Match match = Match::triangle;          // how fragments of later passes are matched with those of the first
    std::array<int, 2> moved_window{0, 0};  // offset of the viewport of later passes, in pixels; if not 0, only codes
                                            // are compared and there is no peel
    rasterizer::DepthPath write = rasterizer::DepthPath::float32;
    rasterizer::DepthPath compare = rasterizer::DepthPath::float32;
    const Algorithm* algorithm = nullptr;
    // A peel by two depths may not terminate: the limit stops one that finds the same layer again and again.
    int max_passes = 0;  // limit on geometry passes; 0: twice as many as a peel of the true layers needs
};

// Safe ranges for this scene. A range is absent where the premises of its rule do not hold: later passes draw something
// else, or the reference is not quantised.
struct Advice {
    std::optional<SafeRange> epsilon_ulps;
    std::optional<SafeAbsolute> epsilon;
    // For polygon offset, in units. Only for fixed-point formats, where a unit is a code, and only if the offset moves
    // the stored depth and not the compared one.
    std::optional<SafeRange> bias;
};

struct Measurement {
    std::optional<pipeline::Refusal> refusal;  // if set, all other members are empty
    PathComparison paths;
    PeelErrors errors;
    int passes = 0;     // geometry passes of the peel
    bool ended = true;  // false: stopped by the limit before the last layer
    ImageError image;
    Advice advice;
    bool peeled = true;  // false: only compared
    pipeline::Image picture, truth;
    double seconds = 0;  // duration of the peel's passes
};

// The fragments with their keys as codes: an algorithm that peels by the program's float depth names its layers by the
// ordered bits of that float, but captures contain the stored code.
[[nodiscard]] FrameFragments keyed(FrameFragments fragments, pipeline::DepthKey key);

// If the profile lacks a required feature, the result has a refusal; no exception is thrown.
[[nodiscard]] Measurement measure(const pipeline::DrawList& list, const pipeline::View& view,
                                  const pipeline::DeviceProfile& profile, const InvarianceCase& experiment);

}  // namespace strata::peeling
