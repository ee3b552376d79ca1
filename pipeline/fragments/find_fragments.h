// pipeline/fragments/find_fragments.h - which fragments a pass processes: intervals of sorted lists, and what a
// selection keeps of them.
//
// Rule     FragmentSelection's (frame/selection.h), with planes of entries in place of targets: one entry a pixel.
// Source   execution.md 7.1.
// Tests    tests/pipeline/fragments/find_fragments_test.cpp; tests/peeling/selection_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "pipeline/fragments/fragment_waves.h"
#include "pipeline/fragments/sorted_lists.h"
#include "pipeline/stages/depth_compare.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

// Bounds of keys by pixel.
class BoundPlane {
  public:
    enum class Holds : std::uint8_t { codes, depths, values };  // keys; bits of binary32 keys; binary32 values of codes
    BoundPlane() = default;
    BoundPlane(const std::uint32_t* entries, bool includes, Holds holds, rasterizer::DepthFormat format)
        : entries_{entries}, includes_{includes}, holds_{holds}, format_{format} {}
    [[nodiscard]] bool exists() const noexcept { return entries_ != nullptr; }
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
        return holds_ == Holds::depths ? rasterizer::ordered_code(std::bit_cast<float>(entries_[pixel]))
                                       : entries_[pixel];
    }

  private:
    // Of values intervals are as wide as the nearest code: a program decides what lies there.
    [[nodiscard]] std::uint64_t first_near_value(std::size_t pixel, std::uint64_t more) const noexcept {
        const auto value = std::bit_cast<float>(entries_[pixel]);
        if (value != value) return more << 32;
        if (value < 0) return 0;
        if (format_ == rasterizer::DepthFormat::d32f) return (value == 0 ? 0 : entries_[pixel]) + more;
        return rasterizer::to_depth_code(value, format_, rasterizer::DepthRounding::nearest) + more;
    }

    const std::uint32_t* entries_ = nullptr;
    bool includes_ = false;
    Holds holds_ = Holds::codes;
    rasterizer::DepthFormat format_ = rasterizer::DepthFormat::d32f;
};

// The intervals of a selection.
struct KeyIntervals {
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

// Each adds to `waves`.
// The first of every interval, where it lies before what is stored.
void find_nearest(SortedLists& sorted, const KeyIntervals& intervals, const StoredCodes& stored, FragmentWaves& waves);
// The nearest by stored codes of those in intervals without a near bound whose compared depth lies behind what `behind`
// holds.
void find_nearest_behind(SortedLists& sorted, const TileFragments& fragments, const DepthCompare& compare,
                         const KeyIntervals& intervals, const std::uint32_t* behind, const StoredCodes& stored,
                         FragmentWaves& waves);
// All of every interval. False, and nothing added, where that is more than half of all: to process all is then quicker.
[[nodiscard]] bool find_intervals(SortedLists& sorted, const KeyIntervals& intervals, FragmentWaves& waves);
// The fragments of the first and of the last key, and the nearest and the farthest between. `one_outside`: and one from
// outside, where the first key is all that an interval holds, or it holds nothing.
void find_ends(SortedLists& sorted, const KeyIntervals& intervals, bool one_outside, FragmentWaves& waves);
// The same of a range of compared depths.
void find_ends_compared(SortedLists& sorted, const TileFragments& fragments, const DepthCompare& compare,
                        const KeyIntervals& intervals, bool one_outside, FragmentWaves& waves);

}  // namespace strata::pipeline
