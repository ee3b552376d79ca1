// tools/oracle/compare/small_text.h - letters of 3 by 5 pixels, for captions in images that must not depend on
// installed fonts.
#pragma once
#include <string_view>

#include "pipeline/formats/image.h"

namespace strata::oracle {

inline constexpr int letter_width_px = 4, letter_height_px = 6;  // including the gap to the next letter

// White on whatever is there; small letters a to z, digits and " ._-:/()"; any other character is a full block. Cut at
// the image's edge. Each pixel of a letter is a square of `scale` by `scale`.
void draw_text(pipeline::Image& rgba8, int x, int y, std::string_view text, int scale = 1);

}  // namespace strata::oracle
