// tests/pipeline/region/random_walk.h - random sequences of peel passes that are regular except for a few.
#pragma once
#include <cstdint>
#include <vector>

#include "tests/support/random_numbers.h"

namespace strata::testing {

// `Step` enumerates the kinds of passes and has `first` and `next`; a walk begins with `first`.
template <class Step>
struct Walk {
    std::vector<Step> steps;
    std::uint64_t seed;
};

// Up to `most` further passes; each is `next` or, now and then or never, any step up to `last`.
template <class Step>
[[nodiscard]] Walk<Step> random_walk(Random& random, int most, Step last) {
    Walk<Step> walk{{Step::first}, random()};
    const int disturbed = random_int(random, 0, 2);  // frequency of other steps
    for (int n = random_int(random, 2, most); n-- > 0;) {
        const bool is_plain = random_int(random, 0, 3) >= disturbed;
        walk.steps.push_back(is_plain ? Step::next : static_cast<Step>(random_int(random, 0, static_cast<int>(last))));
    }
    return walk;
}

}  // namespace strata::testing
