// pipeline/region/region_windows.h - the windows of a selection in the sorted columns of a tile: keys in [low, high) at every pixel
// (execution.md 7.1).
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "pipeline/fragments/sorted_fragments.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/selection.h"
#include "pipeline/region/target_storage.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

inline constexpr std::size_t pixels_ahead = 12;  // whose words are asked for: about as many as memory answers at once

// The codes of a depth target in the form of sorted keys.
class KeyBound {
  public:
    KeyBound(const std::uint32_t* codes, DepthKey key) : codes_{codes}, is_float_key_{key == DepthKey::shader_z} {}
    [[nodiscard]] bool exists() const noexcept { return codes_ != nullptr; }
    [[nodiscard]] std::uint64_t of(std::size_t pixel) const noexcept {
        return is_float_key_ ? rasterizer::ordered_code(std::bit_cast<float>(codes_[pixel])) : codes_[pixel];
    }

  private:
    const std::uint32_t* codes_;
    bool is_float_key_;
};

// Depths that a channel of a float target holds (depth_float.h), as bounds of stored codes: which have greater values.
class ValueBound {
  public:
    ValueBound() = default;
    ValueBound(Plane values, DepthFormat format) : values_{values.words}, format_{format} {}
    [[nodiscard]] bool exists() const noexcept { return values_ != nullptr; }
    // The least key whose value is greater; 2^32 if there is none.
    [[nodiscard]] std::uint64_t first_behind(std::size_t pixel) const noexcept {
        const float bound = std::bit_cast<float>(values_[pixel]);
        return first([=](float value) { return value > bound; }, bound);
    }
    // The least key whose value is not less.
    [[nodiscard]] std::uint64_t first_from(std::size_t pixel) const noexcept {
        const float bound = std::bit_cast<float>(values_[pixel]);
        return bound == bound ? first([=](float value) { return value >= bound; }, bound) : 0;
    }

  private:
    // Values rise with their codes: from the nearest code, one step or two.
    template <class Holds>
    [[nodiscard]] std::uint64_t first(const Holds& holds, float bound) const noexcept {
        if (bound != bound) return std::uint64_t{1} << 32;
        if (bound < 0) return 0;
        if (format_ == DepthFormat::d32f) {
            const std::uint64_t code = bound == 0 ? 0 : std::bit_cast<std::uint32_t>(bound);
            return holds(bound) ? code : code + 1;
        }
        const std::uint64_t end = std::uint64_t{rasterizer::max_code(format_)} + 1;
        const auto value = [&](std::uint64_t code) {
            return static_cast<float>(rasterizer::depth_value(static_cast<std::uint32_t>(code), format_));
        };
        std::uint64_t code = rasterizer::to_depth_code(bound, format_, rasterizer::DepthRounding::nearest);
        while (code > 0 && holds(value(code - 1))) --code;
        while (code < end && !holds(value(code))) ++code;
        return code;
    }

    const std::uint32_t* values_ = nullptr;
    DepthFormat format_ = DepthFormat::d32f;
};

// The bounds of a selection's window at a pixel: keys in [low, high).
struct KeyWindow {
    std::uint64_t least, end;
    KeyBound behind, from, at, before, also_before, up_to;
    ValueBound behind_value, before_value;
    std::uint64_t behind_codes, greatest;

    [[nodiscard]] std::uint64_t low(std::size_t p) const noexcept {
        std::uint64_t key = least;
        if (behind.exists()) key = std::max(key, std::min(behind.of(p) + behind_codes, greatest) + 1);
        if (from.exists()) key = std::max(key, from.of(p));
        if (at.exists()) key = std::max(key, at.of(p));
        if (behind_value.exists()) key = std::max(key, behind_value.first_behind(p));
        return key;
    }
    [[nodiscard]] bool has_high() const noexcept {
        return end <= 0xffffffff || before.exists() || also_before.exists() || up_to.exists() || before_value.exists();
    }
    [[nodiscard]] std::uint64_t high(std::size_t p) const noexcept {
        std::uint64_t key = end;
        if (before.exists()) key = std::min(key, before.of(p));
        if (also_before.exists()) key = std::min(key, also_before.of(p));
        if (up_to.exists()) key = std::min(key, up_to.of(p) + 1);
        if (before_value.exists()) key = std::min(key, before_value.first_from(p));
        return key;
    }
    // The end of the window of a column that begins with number `first`.
    [[nodiscard]] std::uint32_t last(SortedFragments& sorted, std::size_t p, std::uint32_t first) const noexcept {
        return has_high() ? std::max(first, sorted.below(p, high(p), SortedFragments::Finger::high))
                          : static_cast<std::uint32_t>(sorted.of(p).size());
    }
};

// The codes that a depth test LESS compares with, in the order of keys: a binary32 that is negative or NaN lies before every
// stored code, or before none.
class StoredDepth {
  public:
    explicit StoredDepth(const TargetStorage& depth)
        : codes_{depth.depth(0)}, is_float_{depth.format() == Format::d32f} {}
    [[nodiscard]] std::uint32_t of(std::size_t pixel) const noexcept {
        return is_float_ && codes_[pixel] > 0x7f800000u ? 0 : codes_[pixel];
    }

  private:
    const std::uint32_t* codes_;
    bool is_float_;
};

template <class StorageOf>
KeyWindow window_of(const FragmentSelection& s, const Frame& frame, const StorageOf& storage_of) {
    const auto codes_of = [&](Target t) { return t.exists() ? storage_of(t).depth(0) : nullptr; };
    const auto value = [&](FragmentSelection::Channel c) {
        return c.target.exists() ? ValueBound{storage_of(c.target).texels(0).plane(static_cast<std::size_t>(c.channel)),
                                              frame.key_request().format}
                                 : ValueBound{};
    };
    const auto bound = [&](Target t) { return KeyBound{codes_of(t), frame.key}; };
    // Codes that are raised are stored ones, and stop at the greatest; binary32 keys are not raised.
    const std::uint64_t greatest =
        frame.key == DepthKey::shader_z ? ~0u : rasterizer::max_code(frame.key_request().format);
    return {s.least,
            std::uint64_t{s.most} + 1,
            bound(s.behind),
            bound(s.from),
            bound(s.at),
            bound(s.before),
            bound(s.also_before),
            bound(s.up_to),
            value(s.behind_value),
            value(s.before_value),
            s.behind_codes,
            greatest};
}

// Calls visit(pixel, its words, the number of its window's first) wherever there is a fragment.
template <class Visit>
void for_each_column(SortedFragments& sorted, const KeyWindow& window, Visit&& visit) {
    const auto occupied = sorted.occupied();
    for (std::size_t k = 0; k < occupied.size(); ++k) {
        if (k + pixels_ahead < occupied.size())
            sorted.prefetch(occupied[k + pixels_ahead], SortedFragments::Finger::low);
        const std::uint32_t p = occupied[k];
        visit(p, sorted.of(p), sorted.below(p, window.low(p), SortedFragments::Finger::low));
    }
}

}  // namespace strata::pipeline
