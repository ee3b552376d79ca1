// tests/tools/oracle/picture/pictures.h - small pictures made by hand, and functions that change pixels.
#pragma once
#include <array>
#include <functional>

#include "tools/oracle/picture/picture.h"

namespace strata::test {

// The codes of a pixel, red first.
using Texel = std::array<std::uint32_t, 4>;

// One target; the codes of pixel (x, y) are texel(x, y).
[[nodiscard]] oracle::TargetImage make_target(const std::string& part, oracle::Code code, int width, int height,
                                              int channels, const std::function<Texel(int x, int y)>& texel);
[[nodiscard]] oracle::Picture make_picture(std::vector<oracle::TargetImage> targets);

// 40 x 30 pixels of 8-bit colours with alpha 255: an ellipse of many colours on (10, 20, 30).
[[nodiscard]] bool is_in_ellipse(double x, double y);
[[nodiscard]] Texel ellipse_texel(int x, int y);
[[nodiscard]] oracle::Picture ellipse();

}  // namespace strata::test
