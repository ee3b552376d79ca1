// tests/peeling/sequences/disordered_sequences.h - pixels with random fragments in every degree of disorder.
#pragma once
#include <algorithm>

#include "tests/support/fragment_scene.h"
#include "tests/support/random_numbers.h"

namespace strata::testing {

// An ascending, a descending or a half-sorted list of `length` depths k / 512 with ties, then some swaps of neighbours
// or distant entries: from sorted to random.
[[nodiscard]] inline std::vector<float> disordered_depths(Random& random, int length) {
    std::vector<float> depths;
    for (int i = 0; i < length; ++i) depths.push_back(static_cast<float>(random_int(random, 0, 511)) / 512.0f);
    const int kind = random_int(random, 0, 5);
    if (kind == 5) return depths;
    std::sort(depths.begin(), depths.end());
    if (kind == 1) std::reverse(depths.begin(), depths.end());
    if (kind == 2) std::rotate(depths.begin(), depths.begin() + length / 2, depths.end());
    const int exchanges = kind < 3 ? random_int(random, 0, 2) : kind == 3 ? length / 16 : length / 4;
    for (int i = 0; i < exchanges && length > 1; ++i)
        std::swap(depths[static_cast<std::size_t>(random_int(random, 0, length - 1))],
                  depths[static_cast<std::size_t>(random_int(random, 0, length - 1))]);
    return depths;
}

// Mostly short lists, some up to `longest`; every third pixel has an opaque surface at one of the depths.
[[nodiscard]] inline FragmentScene disordered(std::uint64_t seed, int width, int height, int longest) {
    FragmentScene scene{width, height};
    Random random{seed};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        const int most = p % 16 == 0 ? longest : std::max(1, longest / random_int(random, 4, 40));
        for (const float depth : disordered_depths(random, random_int(random, 1, most)))
            scene.pixels[p].fragments.push_back({depth, random_color(random)});
        if (p % 3 == 0)
            scene.pixels[p].opaque =
                GivenFragment{static_cast<float>(random_int(random, 256, 511)) / 512.0f, random_color(random)};
    }
    return scene;
}

}  // namespace strata::testing
