// peeling/invariance.h - one experiment of the invariance laboratory: a peel whose passes see two depths, measured.
//
// Rule     `write` computes the depth that is stored, `compare` the depth that a later pass compares with it. The
//          fragments of both are paired and counted; the peel is then run on the emulated machine with that pair and
//          the given remedy (bias, epsilon, quantisation), and its trace and picture are held against the exact
//          A-buffer.
// Source   Everitt 2001; audit.md 11; texturing.md 4.1; numbers.md 6.
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

struct Experiment {
    // Size, format, alpha, the remedy, and what further passes draw (second list, vertex path, clamp); depth_path,
    // reference_path, max_passes and audit are the experiment's to set.
    RenderOptions render;
    Match match = Match::triangle;  // of what further passes draw with what the first one drew
    std::array<int, 2> moved_window{
        0, 0};  // further passes draw into a viewport elsewhere, in pixels: compared, not peeled
    rasterizer::DepthPath write = rasterizer::DepthPath::float32;
    rasterizer::DepthPath compare = rasterizer::DepthPath::float32;
    const Algorithm* algorithm = nullptr;
    // A peel by two depths may never end: the limit stops one that meets a layer again and again.
    int max_passes = 0;  // geometry passes at most; 0: twice as many as a peel of the true layers needs
};

// Safe ranges for this scene. A range is absent where its rule's premises do not hold: further passes that draw
// something else, a reference that is not quantised.
struct Advice {
    std::optional<SafeRange> epsilon_ulps;
    std::optional<SafeAbsolute> epsilon;
    // Of polygon offset, in units. Fixed-point formats alone, where a unit is a code; and only if the offset moves the
    // stored depth and not the compared one.
    std::optional<SafeRange> bias;
};

struct Measurement {
    pipeline::Verdict refusal;  // then nothing else is set
    PathComparison paths;
    PeelErrors errors;
    int passes = 0;     // geometry passes of the peel
    bool ended = true;  // false: the limit ended it, not the last layer
    ImageError image;
    Advice advice;
    bool peeled = true;  // false: compared alone
    pipeline::Image picture, truth;
    double seconds = 0;  // of the peel's passes
};

// A profile that lacks what the experiment needs gives a refusal instead of an exception.
[[nodiscard]] Measurement measure(const pipeline::DrawList& list, const pipeline::View& view,
                                  const pipeline::DeviceProfile& profile, const Experiment& experiment);

}  // namespace strata::peeling
