// tools/oracle/picture/pairs.h - pairs the targets of a candidate with those of the reference and makes their channels
// comparable.
//
// Rule     Grey compared with colour becomes three equal channels. If only one of two colours has alpha, the other's
//          alpha is 1, and a note says so. Colours that are not premultiplied, compared with premultiplied ones, are
//          multiplied by their alpha where that is below 1, rounded to the nearest code, halves up: for codes that were
//          divided by alpha this gives the original codes.
// Tests    tests/tools/oracle/picture/pairs_test.cpp
#pragma once
#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

struct TargetPair {
    const TargetImage* reference = nullptr;
    const TargetImage* candidate = nullptr;
    [[nodiscard]] int channels() const noexcept { return reference->channels; }  // the candidate has the same number
    [[nodiscard]] bool is_equal_at(std::size_t pixel) const noexcept { return distance_at(pixel) == 0; }
    // True if the pixel has the same words of one code type, which are equal.
    [[nodiscard]] bool has_same_words(std::size_t pixel) const noexcept {
        const auto first = static_cast<std::ptrdiff_t>(pixel * static_cast<std::size_t>(channels()));
        return reference->code == candidate->code &&
               std::equal(reference->codes.begin() + first, reference->codes.begin() + first + channels(),
                          candidate->codes.begin() + first);
    }
    // The distance of the worst channel.
    [[nodiscard]] std::uint32_t distance_at(std::size_t pixel) const noexcept {
        if (has_same_words(pixel)) return 0;
        std::uint32_t worst = 0;
        for (int c = 0; c < channels(); ++c)
            worst = std::max(worst, distance(reference->at(pixel, c), candidate->at(pixel, c)));
        return worst;
    }
};

// Straight colours multiplied by their alpha, rounded to the nearest code. Empty if all alphas are 1 or there are none.
[[nodiscard]] std::optional<TargetImage> premultiplied(const TargetImage& target);

// The channels of colours that are compared.
enum class ColorChannels : std::uint8_t { all, rgb };

struct Pairing {
    std::vector<TargetPair> pairs;
    std::vector<std::string> not_compared{};  // messages
    std::vector<std::string> notes{};         // conversions that made targets comparable
    std::deque<TargetImage> made{};           // owns converted targets that pairs point to
};

// InputError as compare(), and for numbers of channels that no rule above makes equal.
[[nodiscard]] Pairing pair_targets(const Picture& reference, const Picture& candidate,
                                   ColorChannels channels = ColorChannels::all);

}  // namespace strata::oracle
