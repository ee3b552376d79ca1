// tools/oracle/pairs.h - which target of a candidate stands for which of the reference.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "tools/oracle/picture.h"

namespace strata::oracle {

struct Pair {
    const Target* reference = nullptr;
    const Target* candidate = nullptr;
    [[nodiscard]] int channels() const noexcept { return std::min(reference->channels, candidate->channels); }
    [[nodiscard]] bool is_equal_at(std::size_t pixel) const noexcept { return distance_at(pixel) == 0; }
    // Of the worst channel.
    [[nodiscard]] std::uint32_t distance_at(std::size_t pixel) const noexcept {
        std::uint32_t worst = 0;
        for (int c = 0; c < channels(); ++c)
            worst = std::max(worst, distance(reference->at(pixel, c), candidate->at(pixel, c)));
        return worst;
    }
};

struct Pairing {
    std::vector<Pair> pairs;
    std::vector<std::string> not_compared;  // sentences
};

// InputError as compare() says.
[[nodiscard]] Pairing pair_targets(const Picture& reference, const Picture& candidate);

}  // namespace strata::oracle
