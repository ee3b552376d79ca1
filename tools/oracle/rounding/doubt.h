// tools/oracle/rounding/doubt.h - reasons not to call a picture right, or explained by a mistake, although one
// hypothesis reaches every pixel.
//
// Rule     A picture of codes with a value more than 5 codes from the exact one is doubted, whatever its hypothesis.
//          A picture that is 4 codes off where more than 5 are possible must have many different pixels.
//          Otherwise: with many layers a wide hypothesis reaches nearly any value. Rounding is told from a mistake by
//          three properties: it moves a value by a few codes, whatever the number of layers; over many pixels its mean
//          is near 0; and it does not grow with the layers, or with the transmittance. Distances are measured from
//          the middle of the values under the definite hypothesis without slack that is nearest to the picture.
// Numbers  40 right pictures of engines need at most 4 codes, and right pictures of other precisions 5. Two pixels in
//          10,000 may need more than their layers ask for. A mean of half a code and a slope of 0.45 codes per standard
//          deviation are accepted, with three standard errors each; one code where a front accumulator of codes rounds
//          the transmittance, which goes one way if all layers have one alpha.
// Tests    tests/tools/oracle/verdict/picture_verdict_test.cpp
#pragma once
#include <string>

#include "tools/oracle/search/account.h"

namespace strata::oracle::verdict {

class SceneFragments;
class Colors;

inline constexpr double most_codes_of_right = 5;

// The codes that rounding needs under so many layers.
[[nodiscard]] constexpr double most_codes(std::size_t layers) noexcept {
    const double wanted = static_cast<double>((layers + 1) / 2 + 1);
    return wanted < most_codes_of_right ? wanted : most_codes_of_right;
}

// The first reason, as words after "not decided: "; empty if there is none.
[[nodiscard]] std::string doubt_of(const SceneFragments& scene, const Colors& candidate, const CheckedAccount& checked,
                                   const Families& definite);

}  // namespace strata::oracle::verdict
