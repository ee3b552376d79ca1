// pipeline/fragments/find_visits.h - which fragments a pass visits: windows of sorted columns, and what a selection keeps of them.
//
// Rule     FragmentSelection's (frame/selection.h), with planes of words in place of targets: one word a pixel.
// Source   execution.md 7.1.
// Tests    tests/pipeline/fragments/find_visits_test.cpp; tests/peeling/selection_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "pipeline/fragments/sorted_columns.h"
#include "pipeline/fragments/visits.h"
#include "pipeline/stages/depth_compare.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

// Bounds of keys by pixel.
class BoundPlane {
  public:
    enum class Holds : std::uint8_t { codes, depths, values };  // keys; bits of binary32 keys; binary32 values of codes
    BoundPlane() = default;
    BoundPlane(const std::uint32_t* words, bool includes, Holds holds, rasterizer::DepthFormat format)
        : words_{words}, includes_{includes}, holds_{holds}, format_{format} {}
    [[nodiscard]] bool exists() const noexcept { return words_ != nullptr; }
    // The least key that is greater, or not less where the bound is included.
    [[nodiscard]] std::uint64_t first_behind(std::size_t pixel) const noexcept {
        if (holds_ == Holds::values) return first_near_value(pixel, 0);
        return key(pixel) + (includes_ ? 0 : 1);
    }
    // One more than the greatest key that is less, or not greater where the bound is included.
    [[nodiscard]] std::uint64_t end_before(std::size_t pixel) const noexcept {
        if (holds_ == Holds::values) return first_near_value(pixel, 1);
        return key(pixel) + (includes_ ? 1 : 0);
    }
    [[nodiscard]] std::uint64_t key(std::size_t pixel) const noexcept {
        return holds_ == Holds::depths ? rasterizer::ordered_code(std::bit_cast<float>(words_[pixel])) : words_[pixel];
    }

  private:
    // Of values windows are as wide as the nearest code: a program decides what lies there.
    [[nodiscard]] std::uint64_t first_near_value(std::size_t pixel, std::uint64_t more) const noexcept {
        const auto value = std::bit_cast<float>(words_[pixel]);
        if (value != value) return more << 32;
        if (value < 0) return 0;
        if (format_ == rasterizer::DepthFormat::d32f) return (value == 0 ? 0 : words_[pixel]) + more;
        return rasterizer::to_depth_code(value, format_, rasterizer::DepthRounding::nearest) + more;
    }

    const std::uint32_t* words_ = nullptr;
    bool includes_ = false;
    Holds holds_ = Holds::codes;
    rasterizer::DepthFormat format_ = rasterizer::DepthFormat::d32f;
};

// The windows of a selection.
struct Windows {
    BoundPlane near{};
    std::array<BoundPlane, 2> far{};
    const std::uint32_t *range_near = nullptr, *range_far = nullptr;  // binary32: keys from -near to far, both included
    std::uint64_t least = 0, end = std::uint64_t{1} << 32;
};

// Codes that a depth test LESS compares with: a binary32 that is negative or NaN has none before it.
struct StoredCodes {
    const std::uint32_t* codes;
    bool is_float;
    [[nodiscard]] std::uint32_t of(std::size_t pixel) const noexcept {
        return is_float && codes[pixel] > 0x7f800000u ? 0 : codes[pixel];
    }
};

// Each adds to `visits`.
// The first of every window, where it lies before what is stored.
void find_nearest(SortedColumns& sorted, const Windows& windows, const StoredCodes& stored, Visits& visits);
// The nearest by stored codes of those in windows without a near bound whose compared depth lies behind what `behind` holds.
void find_nearest_behind(SortedColumns& sorted, const TileFragments& fragments, const DepthCompare& compare,
                         const Windows& windows, const std::uint32_t* behind, const StoredCodes& stored,
                         Visits& visits);
// All of every window. False, and nothing added, where that is more than half of all: to visit all is then quicker.
[[nodiscard]] bool find_windows(SortedColumns& sorted, const Windows& windows, Visits& visits);
// The fragments of the first and of the last key, and the nearest and the farthest between. `one_outside`: and one from outside, where the
// first key is all that a window holds, or it holds nothing.
void find_ends(SortedColumns& sorted, const Windows& windows, bool one_outside, Visits& visits);
// The same of a range of compared depths.
void find_ends_compared(SortedColumns& sorted, const TileFragments& fragments, const DepthCompare& compare,
                        const Windows& windows, bool one_outside, Visits& visits);

}  // namespace strata::pipeline
