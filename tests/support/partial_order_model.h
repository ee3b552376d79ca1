// tests/support/partial_order_model.h - expected result of Carr's algorithms and related ones at one pixel. Written
// from peeling/reference/algorithms.md 9 to 14 with the target arithmetic of composite_model.h; it shares no code with
// the implementation.
#pragma once
#include "tests/support/composite_model.h"

namespace strata::testing {

// UNDER of non-premultiplied fragments, near to far; each is premultiplied as it is blended.
[[nodiscard]] inline Rgba under_model(const TargetModel& target, const std::vector<Rgba>& near_to_far,
                                      const Rgba& background) {
    Rgba front{0, 0, 0, 1};
    for (const Rgba& s : near_to_far) {
        for (std::size_t c = 0; c < 3; ++c) front[c] = target.under(front[c], front[3], s[c] * s[3]);
        front[3] = target.faded(front[3], s[3]);
    }
    Rgba result{0, 0, 0, 1};
    for (std::size_t c = 0; c < 3; ++c) {
        const float through = front[3] * background[c];
        result[c] = target.stored(front[c] + through);
    }
    return result;
}

// Sorted by depth; of equal depths the first submitted is in front.
[[nodiscard]] inline std::vector<Rgba> in_first_order(const std::vector<GivenFragment>& fragments) {
    std::vector<Rgba> colors;
    for (const auto& [depth, sources] : groups_of(fragments))
        colors.insert(colors.end(), sources.begin(), sources.end());
    return colors;
}

// peeling/reference/algorithms.md 13: samples hold non-premultiplied colours; the program that sorts them computes in
// binary32.
[[nodiscard]] inline Rgba routed_model(const TargetModel& target, const std::vector<Rgba>& near_to_far,
                                       const Rgba& background) {
    Rgba sum{0, 0, 0, 1};
    for (const Rgba& s : near_to_far) {
        const float alpha = target.stored(s[3]);
        for (std::size_t c = 0; c < 3; ++c) {
            const float premultiplied = alpha * target.stored(s[c]);
            const float added = sum[3] * premultiplied;
            sum[c] = sum[c] + added;
        }
        const float left = 1.0f - alpha;
        sum[3] = sum[3] * left;
    }
    Rgba result{0, 0, 0, 1};
    for (std::size_t c = 0; c < 3; ++c) {
        const float through = sum[3] * background[c];
        result[c] = target.stored(sum[c] + through);
    }
    return result;
}

// peeling/reference/algorithms.md 14: the four nearest fragments so far are held back.
[[nodiscard]] inline std::vector<Rgba> k_buffer_order(const std::vector<GivenFragment>& fragments) {
    std::vector<Rgba> out;
    std::multimap<float, Rgba> held;  // equal keys keep the order of their insertion
    for (const GivenFragment& f : fragments) {
        held.insert({f.depth, f.color});
        if (held.size() <= 4) continue;
        out.push_back(held.begin()->second);
        held.erase(held.begin());
    }
    for (const auto& [depth, color] : held) out.push_back(color);
    return out;
}

}  // namespace strata::testing
