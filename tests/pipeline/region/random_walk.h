// tests/pipeline/region/random_walk.h - peels that go on as they began but for a few passes, in which something is
// different.
#pragma once
#include <cstdint>
#include <vector>

#include "tests/support/random_numbers.h"

namespace strata::testing {

// `Step` names what a pass of a peel does, `first` and `next` among it; a walk begins with the former.
template <class Step>
struct Walk {
    std::vector<Step> steps;
    std::uint64_t seed;
};

// Of up to `most` passes more, each of them any step up to `last` now and then, or never.
template <class Step>
[[nodiscard]] Walk<Step> random_walk(Random& random, int most, Step last) {
    Walk<Step> walk{{Step::first}, random()};
    const int disturbed = random_int(random, 0, 2);  // how often
    for (int n = random_int(random, 2, most); n-- > 0;) {
        const bool is_plain = random_int(random, 0, 3) >= disturbed;
        walk.steps.push_back(is_plain ? Step::next : static_cast<Step>(random_int(random, 0, static_cast<int>(last))));
    }
    return walk;
}

}  // namespace strata::testing
