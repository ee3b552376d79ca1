// tools/oracle/judge/seen_alpha.h - the values of --alpha that a picture shows.
//
// Rule     All surfaces are transparent, and their alphas are multiplied by the value; the pixels of a square are
//          composited exactly with each hundredth, then with each thousandth near the best. The best hundredth comes
//          first, unless a thousandth is closer by a fifth. A picture that no value comes near shows none.
// Tests    tests/tools/strata/compare/forgotten_test.cpp
#pragma once
#include <array>
#include <vector>

#include "peeling/frame_request.h"
#include "tools/oracle/fragments/sample.h"

namespace strata::oracle {

// At most two, the given one not among them. `part`: the square that is looked at.
[[nodiscard]] std::vector<float> seen_alphas(const peeling::FrameRequest& input, const verdict::Colors& picture,
                                             const std::array<double, 3>& background, const rasterizer::Rect& part);

}  // namespace strata::oracle
