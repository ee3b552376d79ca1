// tests/support/random_numbers.h - random values for tests from one generator; each test names its seed.
#pragma once
#include <cstdint>
#include <random>

#include "pipeline/vertices/draw_list.h"

namespace strata::testing {

using Random = std::mt19937_64;

[[nodiscard]] inline int random_int(Random& random, int low, int high) {  // low to high, both inclusive
    return low + static_cast<int>(random() % (static_cast<std::uint64_t>(high - low) + 1));
}

[[nodiscard]] inline float random_float(Random& random, float low, float high) {
    return low + (high - low) * (static_cast<float>(random() >> 40) * 0x1p-24f);
}

// A channel value: an 8-bit code / 255 or a binary fraction of 24 digits; 0 and 1 are frequent.
[[nodiscard]] inline float random_channel(Random& random) {
    switch (random_int(random, 0, 7)) {
        case 0: return 0.0f;
        case 1: return 1.0f;
        case 2:
        case 3:
        case 4: return static_cast<float>(random_int(random, 0, 255)) / 255.0f;
        default: return static_cast<float>(random() >> 40) * 0x1p-24f;
    }
}

[[nodiscard]] inline pipeline::Rgba random_color(Random& random) {
    pipeline::Rgba color{};
    for (float& channel : components(color)) channel = random_channel(random);
    return color;
}

}  // namespace strata::testing
