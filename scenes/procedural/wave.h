// scenes/procedural/wave.h - the colour wheel of stacks: red, green and blue are cosines a third of a period apart.
#pragma once
#include "scenes/numbers/elementary.h"

namespace strata::scenes {

// 0.5 + 0.5 cos(2 pi (t - shift)), rounded once to binary32; t and shift in turns.
[[nodiscard]] inline float wave(double t, double shift) noexcept {
    return static_cast<float>(0.5 + 0.5 * cos(2 * pi * (t - shift)));
}

}  // namespace strata::scenes
