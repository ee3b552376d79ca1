// tools/oracle/pairs.h - which target of a candidate stands for which of the reference, made comparable channel by
// channel.
//
// Rule     Grey beside colour is three equal channels. Where one of two colours has no alpha, its alpha is 1, and a
//          note says so. Straight colours beside premultiplied ones are multiplied by their alpha where that is below
//          1, to the nearest code, a half up: of codes that were divided by alpha this gives back what they were made
//          of.
// Tests    tests/tools/oracle/pairs_test.cpp
#pragma once
#include <algorithm>
#include <deque>
#include <string>
#include <vector>

#include "tools/oracle/picture.h"

namespace strata::oracle {

struct Pair {
    const Target* reference = nullptr;
    const Target* candidate = nullptr;
    [[nodiscard]] int channels() const noexcept { return reference->channels; }  // the candidate has as many
    [[nodiscard]] bool is_equal_at(std::size_t pixel) const noexcept { return distance_at(pixel) == 0; }
    // Of the worst channel.
    [[nodiscard]] std::uint32_t distance_at(std::size_t pixel) const noexcept {
        std::uint32_t worst = 0;
        for (int c = 0; c < channels(); ++c)
            worst = std::max(worst, distance(reference->at(pixel, c), candidate->at(pixel, c)));
        return worst;
    }
};

// Which channels of colours count.
enum class ColorChannels : std::uint8_t { all, rgb };

struct Pairing {
    std::vector<Pair> pairs;
    std::vector<std::string> not_compared{};  // sentences
    std::vector<std::string> notes{};         // what was done to make targets comparable
    std::deque<Target> made{};                // what pairs point at that neither picture has
};

// InputError as compare() says, and for numbers of channels that no rule above makes alike.
[[nodiscard]] Pairing pair_targets(const Picture& reference, const Picture& candidate,
                                   ColorChannels channels = ColorChannels::all);

}  // namespace strata::oracle
