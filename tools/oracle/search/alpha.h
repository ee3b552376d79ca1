// tools/oracle/search/alpha.h - compares the alpha of a picture with the alpha that its layers give.
//
// Rule     Alpha is 1 - T (1 - b): T is the transmittance of a pixel's layers, b the background's alpha, or 1 where an
//          opaque surface is behind (algorithms.md 0.8). Alpha is compared separately from the colours, with an error
//          of up to one code per blend. A mistake is named only if it gives the alpha of every pixel.
// Tests    tests/tools/oracle/search/alpha_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/oracle/rounding/composite.h"
#include "tools/oracle/rounding/hypothesis.h"

namespace strata::oracle::verdict {

class SceneFragments;
class Colors;

enum class AlphaState : std::uint8_t {
    absent,  // the picture has none
    opaque,  // 1 everywhere, as on an opaque canvas, where the right alpha would not be
    right,
    wrong
};

// What explains the alpha of every pixel of a picture with wrong alpha.
enum class AlphaMistake : std::uint8_t {
    unknown,
    other_background,    // the background has another alpha
    weighted_by_itself,  // blended by SRC_ALPHA, as colours are: a a + (1 - a) d
    inverted,            // the transmittance
    unwritten            // 0 everywhere
};

struct AlphaChecked {
    AlphaState state = AlphaState::absent;
    AlphaMistake mistake = AlphaMistake::unknown;
    double background = 1;  // its alpha; of `other_background` the candidate's
    bool is_told = false;   // the verdict mentions alpha: it is wrong, or the background transparent
    std::vector<std::uint32_t> wrong_pixels{};  // row-major, ascending
};

// The alpha that layers can leave, by a hypothesis about colours, with an error of one code per blend.
class AlphaReach {
  public:
    explicit AlphaReach(const Hypothesis& colors);
    [[nodiscard]] Interval of(const Stack& stack) const;
    // If alpha is blended by SRC_ALPHA.
    [[nodiscard]] Interval weighted_by_itself(const Stack& stack) const;

  private:
    [[nodiscard]] Interval with_error(const Interval& alpha, const Stack& stack) const;

    Compositor compositor_;
    double error_;
};

// `colors`: the hypothesis under which the picture's colours are right.
[[nodiscard]] AlphaChecked check_alpha(const SceneFragments& scene, const Colors& candidate, const Hypothesis& colors);

// True if the candidate has this alpha in every pixel.
[[nodiscard]] bool is_everywhere(const Colors& candidate, double alpha);

// A sentence about alpha; "" if `is_told` is false.
[[nodiscard]] std::string describe(const AlphaChecked& alpha);
[[nodiscard]] std::string_view name(AlphaState state) noexcept;
[[nodiscard]] std::string_view name(AlphaMistake mistake) noexcept;

}  // namespace strata::oracle::verdict
