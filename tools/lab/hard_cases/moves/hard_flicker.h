// tools/lab/hard_cases/moves/hard_flicker.h - counts pixels that flip along a smooth camera path although the exact
// answer does not change.
//
// Rule     64 frames of the path (hard_moves.h), each compared with the next. Pixels whose exact answer changes, or
//          depends on the rounding of binary64, are not counted. Other pixels flip in order if the same fragments are
//          visible in both frames, but layers change their order or number; they flip in coverage if other fragments
//          are visible. With exact depths instead of stored ones no pixel flips in order.
// Tests    tests/tools/lab/hard_cases/hard_flicker_test.cpp
#pragma once
#include <nlohmann/json.hpp>
#include <vector>

#include "tools/lab/hard_cases/moves/hard_stability.h"

namespace strata::tools {

struct Flicker {
    std::uint64_t compared = 0;  // pixels of all pairs of frames where the exact answer does not change
    std::uint64_t order = 0, coverage = 0;
    friend bool operator==(const Flicker&, const Flicker&) = default;
};

class PathCase {
  public:
    explicit PathCase(const scenes::HardCase& hard);
    ~PathCase();
    [[nodiscard]] Flicker flicker(const RenderFunction& render) const;
    // The flicker of the visible fragments of `render` sorted by their exact depths.
    [[nodiscard]] Flicker flicker_of_exact_depths(const RenderFunction& render) const;

  private:
    struct Frame;
    [[nodiscard]] Flicker flicker(const std::function<ResultPixels(std::size_t frame)>& pixels_of) const;

    scenes::Scene scene_;
    std::vector<Frame> frames_;
};

[[nodiscard]] nlohmann::ordered_json to_json(const Flicker& flicker);

}  // namespace strata::tools
