// pipeline/fragments/find_fragments.h - finds the fragments that a pass processes: intervals of sorted lists, reduced
// by the pass's selection.
//
// Rule     The rules of FragmentSelection (frame/selection.h), with planes of one entry per pixel instead of targets.
// Source   pipeline/reference/execution.md 7.1.
// Tests    tests/pipeline/fragments/find_fragments_test.cpp; tests/peeling/execution/selection_test.cpp
#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "pipeline/fragments/fragment_waves.h"
#include "pipeline/fragments/sorted_lists.h"
#include "pipeline/stages/depth_compare.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

// A bound of the keys of each pixel.
class BoundPlane {
  public:
    enum class Contents : std::uint8_t {
        codes,
        depths,
        values
    };  // keys; bits of binary32 keys; binary32 values of codes
    BoundPlane() = default;
    BoundPlane(const std::uint32_t* entries, bool includes, Contents contents, rasterizer::DepthFormat format)
        : entries_{entries}, includes_{includes}, contents_{contents}, format_{format} {}
    [[nodiscard]] bool exists() const noexcept { return entries_ != nullptr; }
    // The least key behind the bound: greater than it, or not less if the bound is included.
    [[nodiscard]] std::uint64_t first_behind(std::size_t pixel) const noexcept {
        if (contents_ == Contents::values) return first_near_value(pixel, 0);
        return key(pixel) + (includes_ ? 0 : 1);
    }
    // One more than the greatest key in front of the bound: less than it, or not greater if the bound is included.
    [[nodiscard]] std::uint64_t end_before(std::size_t pixel) const noexcept {
        if (contents_ == Contents::values) return first_near_value(pixel, 1);
        return key(pixel) + (includes_ ? 1 : 0);
    }
    [[nodiscard]] std::uint64_t key(std::size_t pixel) const noexcept {
        return contents_ == Contents::depths ? rasterizer::ordered_code(std::bit_cast<float>(entries_[pixel]))
                                             : entries_[pixel];
    }

  private:
    // For values the intervals extend to the nearest code: the program decides about the fragments there.
    [[nodiscard]] std::uint64_t first_near_value(std::size_t pixel, std::uint64_t more) const noexcept {
        const auto value = std::bit_cast<float>(entries_[pixel]);
        if (value != value) return more << 32;
        if (value < 0) return 0;
        if (format_ == rasterizer::DepthFormat::d32f) return (value == 0 ? 0 : entries_[pixel]) + more;
        return rasterizer::to_depth_code(value, format_, rasterizer::DepthRounding::nearest) + more;
    }

    const std::uint32_t* entries_ = nullptr;
    bool includes_ = false;
    Contents contents_ = Contents::codes;
    rasterizer::DepthFormat format_ = rasterizer::DepthFormat::d32f;
};

// The depth intervals of a selection.
struct KeyIntervals {
    BoundPlane near{};
    std::array<BoundPlane, 2> far{};
    // Binary32: keys from -near to far, both included; without `range_far` to the last.
    const std::uint32_t *range_near = nullptr, *range_far = nullptr;
    std::uint64_t least = 0, end = std::uint64_t{1} << 32;
};

// The codes with which a depth test LESS compares: nothing passes against a binary32 that is negative or NaN.
struct StoredCodes {
    const std::uint32_t* codes;
    bool is_float;
    [[nodiscard]] std::uint32_t of(std::size_t pixel) const noexcept {
        return is_float && codes[pixel] > 0x7f800000u ? 0 : codes[pixel];
    }
};

// All functions below add fragments to `waves`. find_nearest adds the first fragment of every interval, if it is in
// front of the stored code.
void find_nearest(SortedLists& sorted, const KeyIntervals& intervals, const StoredCodes& stored, FragmentWaves& waves);
// Adds the nearest fragment, by stored code, among those of intervals without a near bound whose compared depth is
// behind `behind`.
void find_nearest_behind(SortedLists& sorted, const TileFragments& fragments, const DepthCompare& compare,
                         const KeyIntervals& intervals, const std::uint32_t* behind, const StoredCodes& stored,
                         FragmentWaves& waves);
// Adds all fragments of every interval. Returns false and adds nothing if these are more than half of all fragments,
// because it is then faster to process all.
[[nodiscard]] bool find_intervals(SortedLists& sorted, const KeyIntervals& intervals, FragmentWaves& waves);
// Adds the fragments with the first and with the last key of each interval, and the nearest and the farthest fragment
// between. With `one_outside` also one fragment from outside, if the interval contains only the first key or is empty.
void find_ends(SortedLists& sorted, const KeyIntervals& intervals, bool one_outside, FragmentWaves& waves);
// Adds the fragments with the first key of each interval, and the first one behind them.
void find_groups(SortedLists& sorted, const KeyIntervals& intervals, FragmentWaves& waves);
// find_ends for an interval of compared depths instead of keys.
void find_ends_compared(SortedLists& sorted, const TileFragments& fragments, const DepthCompare& compare,
                        const KeyIntervals& intervals, bool one_outside, FragmentWaves& waves);

}  // namespace strata::pipeline
