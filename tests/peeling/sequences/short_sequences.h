// tests/peeling/sequences/short_sequences.h - every sequence of up to six fragments on five depths, one per pixel.
#pragma once
#include <array>

#include "tests/support/fragment_scene.h"
#include "tests/support/random_numbers.h"

namespace strata::testing {

inline constexpr std::array<float, 5> short_depths{0.0f, 0.125f, 0.5f, 0.625f, 1.0f - 0x1p-10f};

// Colours and alphas are random. Pixels after the last sequence are empty.
[[nodiscard]] inline FragmentScene all_short_sequences(std::uint64_t seed, const std::array<float, 5>& depths) {
    FragmentScene scene{256, 128};
    Random random{seed};
    std::size_t pixel = 0;
    for (int length = 0, count = 1; length <= 6; ++length, count *= 5)
        for (int number = 0; number < count; ++number, ++pixel)
            for (int place = 0, digits = number; place < length; ++place, digits /= 5)
                scene.pixels[pixel].fragments.push_back(
                    {depths[static_cast<std::size_t>(digits % 5)], random_color(random)});
    return scene;
}

}  // namespace strata::testing
