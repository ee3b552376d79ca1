// pipeline/selections/key_windows.h - the windows of a selection in the sorted columns of a tile: keys in [low, high) at every pixel
// (execution.md 7.1).
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

#include "pipeline/fragments/selected_fragments.h"
#include "pipeline/fragments/sorted_fragments.h"
#include "pipeline/frame/frame.h"
#include "pipeline/frame/selection.h"
#include "pipeline/stages/lane_words.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

// The codes of a depth target in the form of sorted keys.
class KeyBound {
  public:
    KeyBound(const std::uint32_t* codes, DepthKey key) : codes_{codes}, is_float_key_{key == DepthKey::shader_z} {}
    [[nodiscard]] bool exists() const noexcept { return codes_ != nullptr; }
    [[nodiscard]] std::uint64_t of(std::size_t pixel) const noexcept {
        return is_float_key_ ? ordered(codes_[pixel]) : codes_[pixel];
    }
    // keys[k] = key_of(the bound of pixels[k]).
    template <class KeyOf>
    void put(std::span<const std::uint32_t> pixels, std::vector<std::uint64_t>& keys, const KeyOf& key_of) const {
        keys.resize(pixels.size());
        for (std::size_t k = 0; is_float_key_ && k < keys.size(); ++k)
            keys[k] = key_of(std::uint64_t{ordered(codes_[pixels[k]])});
        for (std::size_t k = 0; !is_float_key_ && k < keys.size(); ++k)
            keys[k] = key_of(std::uint64_t{codes_[pixels[k]]});
    }
    // keys[k] = narrowed(keys[k], the bound of pixels[k]), if there is a bound.
    template <class Narrowed>
    void narrow(std::span<const std::uint32_t> pixels, std::vector<std::uint64_t>& keys,
                const Narrowed& narrowed) const noexcept {
        for (std::size_t k = 0; exists() && is_float_key_ && k < keys.size(); ++k)
            keys[k] = narrowed(keys[k], std::uint64_t{ordered(codes_[pixels[k]])});
        for (std::size_t k = 0; exists() && !is_float_key_ && k < keys.size(); ++k)
            keys[k] = narrowed(keys[k], std::uint64_t{codes_[pixels[k]]});
    }

  private:
    [[nodiscard]] static std::uint32_t ordered(std::uint32_t code) noexcept {
        return rasterizer::ordered_code(std::bit_cast<float>(code));
    }

    const std::uint32_t* codes_;
    bool is_float_key_;
};

// Depths that a channel of a float target holds (depth_float.h), as bounds of stored codes: which have greater values.
class ValueBound {
  public:
    ValueBound() = default;
    ValueBound(Plane values, DepthFormat format) : values_{values.words}, format_{format} {}
    [[nodiscard]] bool exists() const noexcept { return values_ != nullptr; }
    // Raises keys to the least ones whose values are greater; to 2^32 if there is none.
    void narrow_behind(std::span<const std::uint32_t> pixels, std::vector<std::uint64_t>& keys) const noexcept {
        for (std::size_t k = 0; exists() && k < keys.size(); ++k) {
            const float bound = std::bit_cast<float>(values_[pixels[k]]);
            keys[k] = std::max(keys[k], first([=](float value) { return value > bound; }, bound));
        }
    }
    // Lowers keys to the least ones whose values are not less.
    void narrow_before(std::span<const std::uint32_t> pixels, std::vector<std::uint64_t>& keys) const noexcept {
        for (std::size_t k = 0; exists() && k < keys.size(); ++k) {
            const float bound = std::bit_cast<float>(values_[pixels[k]]);
            const bool is_number = bound == bound;
            keys[k] = std::min(keys[k], is_number ? first([=](float value) { return value >= bound; }, bound) : 0);
        }
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

// Pixels of (-near, far) in a float target: keys from near to far, both included; of an empty range none.
class RangeBound {
  public:
    RangeBound() = default;
    explicit RangeBound(const Texels& range) : near_{range.plane(0).words}, far_{range.plane(1).words} {}
    [[nodiscard]] bool exists() const noexcept { return near_ != nullptr; }
    // Where there is a range, low[k] and high[k] are raised and lowered to the one of pixels[k].
    void narrow(std::span<const std::uint32_t> pixels, WindowEnds& ends) const noexcept {
        for (std::size_t k = 0; exists() && k < pixels.size(); ++k) {
            const float near = -std::bit_cast<float>(near_[pixels[k]]), far = std::bit_cast<float>(far_[pixels[k]]);
            const bool is_empty = !(near <= far);
            ends.low[k] = is_empty ? std::uint64_t{1} << 32 : std::max<std::uint64_t>(ends.low[k], ordered(near));
            ends.high[k] = is_empty ? 0 : std::min(ends.high[k], std::uint64_t{ordered(far)} + 1);
        }
    }

  private:
    [[nodiscard]] static std::uint32_t ordered(float z) noexcept { return rasterizer::ordered_code(z); }

    const std::uint32_t *near_ = nullptr, *far_ = nullptr;
};

// The bounds of a selection's windows.
struct KeyWindow {
    using Key = std::uint64_t;
    std::uint64_t least, end;
    KeyBound behind, from, at, before, also_before, up_to;
    ValueBound behind_value, before_value;
    std::uint64_t behind_codes, greatest;
    RangeBound range;

    // Whether something ends windows.
    [[nodiscard]] bool has_high() const noexcept {
        return at.exists() || end <= 0xffffffff || before.exists() || also_before.exists() || up_to.exists() ||
               before_value.exists() || range.exists();
    }
    // The ends of the windows of `pixels`, bound after bound.
    void put(std::span<const std::uint32_t> pixels, WindowEnds& ends) const {
        put_low(pixels, ends);
        put_high(pixels, ends);
        range.narrow(pixels, ends);
    }
    void put_low(std::span<const std::uint32_t> pixels, WindowEnds& ends) const {
        const auto greater = [](Key key, Key code) { return std::max(key, code); };
        if (behind.exists())
            behind.put(pixels, ends.low, [first = least, raised = behind_codes, most = greatest](Key code) {
                return std::max(first, std::min(code + raised, most) + 1);
            });
        else
            ends.low.assign(pixels.size(), least);
        from.narrow(pixels, ends.low, greater);
        at.narrow(pixels, ends.low, greater);
        behind_value.narrow_behind(pixels, ends.low);
    }
    void put_high(std::span<const std::uint32_t> pixels, WindowEnds& ends) const {
        const auto less = [](Key key, Key code) { return std::min(key, code); };
        const auto none_greater = [](Key key, Key code) { return std::min(key, code + 1); };
        ends.high.assign(has_high() ? pixels.size() : 0, end);
        at.narrow(pixels, ends.high, none_greater);
        before.narrow(pixels, ends.high, less);
        also_before.narrow(pixels, ends.high, less);
        up_to.narrow(pixels, ends.high, none_greater);
        before_value.narrow_before(pixels, ends.high);
    }
};

// The codes that a depth test LESS compares with, in the order of keys: a binary32 that is negative or NaN lies before every
// stored code, or before none.
class StoredDepth {
  public:
    StoredDepth(const std::uint32_t* codes, bool is_float) : codes_{codes}, is_float_{is_float} {}
    void put(std::span<const std::uint32_t> pixels, WindowEnds& ends) const {
        ends.surface.resize(pixels.size());
        for (std::size_t k = 0; k < pixels.size(); ++k) ends.surface[k] = of(pixels[k]);
    }
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
            static_cast<std::uint64_t>(s.compared ? s.compared->epsilon.ulps : 0),
            greatest,
            s.range.exists() ? RangeBound{storage_of(s.range).texels(0)} : RangeBound{}};
}

// Calls `visit` with the columns of some neighbouring pixels after those of others, as few as the first cache holds the words of.
template <class Visit>
void for_some_columns(const SortedFragments& sorted, const Visit& visit) {
    constexpr std::size_t some = 64;
    const auto occupied = sorted.occupied();
    for (std::size_t from = 0; from < occupied.size(); from += some)
        visit(from, occupied.subspan(from, std::min(some, occupied.size() - from)));
}

// A column of sorted fragments, and its window: numbers [first, last), keys from `low` on; [first, tested) lies before what is stored,
// if that is asked for.
struct WindowColumn {
    std::uint32_t number, pixel;
    std::span<const std::uint64_t> words;
    std::uint32_t first, last, tested;
    std::uint64_t low;
};

// Calls `visit` with every column.
template <class Visit>
void for_each_column(SortedFragments& sorted, const KeyWindow& window, const StoredDepth* stored, WindowEnds& ends,
                     const Visit& visit) {
    using Cursor = SortedFragments::Cursor;
    for_some_columns(sorted, [&](std::size_t from, std::span<const std::uint32_t> pixels) {
        window.put(pixels, ends);
        const auto first = sorted.numbers_below(from, ends.low, Cursor::low);
        const bool is_open = ends.high.empty();
        const auto end = is_open ? first : sorted.numbers_below(from, ends.high, Cursor::high);
        if (stored != nullptr) stored->put(pixels, ends);
        const auto surface = stored == nullptr ? end : sorted.numbers_below(from, ends.surface, Cursor::surface);
        for (std::size_t k = 0; stored != nullptr && k < pixels.size(); ++k)
            sorted.expect(from + k, pixels[k], first[k]);
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            const auto words = sorted.column(from + k);
            const std::uint32_t last = is_open ? static_cast<std::uint32_t>(words.size()) : std::max(first[k], end[k]);
            const std::uint32_t tested = stored == nullptr ? last : std::min(last, surface[k]);
            visit(WindowColumn{static_cast<std::uint32_t>(from + k), pixels[k], words, first[k], last, tested,
                               ends.low[k]});
        }
    });
}

}  // namespace strata::pipeline
