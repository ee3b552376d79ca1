// peeling/programs/fragment_lists.h - the visible fragments of a region's pixels, pixel by pixel, in submission order.
//
// Rule     A fragment is visible if its key is less than the opaque surface's. Lists are built for as many pixels at a
//          time as fit into a given amount of memory, in row-major order; the coverage is an upper bound on the
//          fragments of a pixel.
// Tests    tests/peeling/programs/fragment_lists_test.cpp
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/frame/region_area.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::pipeline {
class Region;
}  // namespace strata::pipeline

namespace strata::peeling {

struct KeyedFragment {
    std::uint32_t key = 0;         // in the algorithm's key: a stored code, or ordered_code(shader_z)
    std::uint32_t exact_code = 0;  // by DepthPath::exact
    std::uint32_t primitive = 0;
    pipeline::Rgba color{};  // not premultiplied
    friend bool operator==(const KeyedFragment&, const KeyedFragment&) = default;
};

// Elements of a region, numbered sample by sample and row by row: whole rows, or part of one row. Below, a pixel is one
// sample of a pixel.
struct PixelRange {
    std::uint32_t first = 0, last = 0;  // half-open
    [[nodiscard]] std::uint32_t size() const noexcept { return last - first; }
    friend bool operator==(const PixelRange&, const PixelRange&) = default;
};
// The rectangle of a range of sample 0.
[[nodiscard]] rasterizer::Rect rect_of(const PixelRange& pixels, const rasterizer::Rect& region) noexcept;

// The number of fragments of each pixel of the region, before MASK and before any test.
[[nodiscard]] std::vector<std::uint32_t> coverage_of(pipeline::Region& region);

// The longest range that starts at pixel `first` and has at most `most` fragments in total; at least one pixel, however
// many it has.
[[nodiscard]] PixelRange next_range(std::span<const std::uint32_t> coverage, int width, std::uint32_t first,
                                    std::uint64_t most) noexcept;

struct FragmentLists {
    PixelRange pixels;
    std::vector<std::size_t> start, end;   // per pixel of the range, offsets in `fragments`
    std::vector<KeyedFragment> fragments;  // may be longer than needed
    std::vector<std::uint8_t> samples;     // of lists of pixels: the mask of each fragment; else empty
    std::vector<std::uint32_t>
        at_opaque;  // per pixel of the range: fragments that LESS hides behind a surface of the same key
    // `pixel` is an index in the region.
    [[nodiscard]] std::span<const KeyedFragment> of(std::uint32_t pixel) const noexcept {
        const std::size_t p = pixel - pixels.first;
        return {fragments.data() + start[p], end[p] - start[p]};
    }
    // The mask of fragment i of a pixel; in lists of samples it has one bit.
    [[nodiscard]] std::uint8_t samples_of(std::uint32_t pixel, std::size_t i) const noexcept {
        return samples.empty() ? std::uint8_t{1} : samples[start[pixel - pixels.first] + i];
    }
};

// Fills `fragment_lists` with those of `pixels`, reusing its memory. `coverage` is the region's. Counted as a pass of
// the algorithm if the range is the whole region, else not counted.
void list_visible(pipeline::Region& region, const PixelRange& pixels, std::span<const std::uint32_t> coverage,
                  pipeline::Counting counting, FragmentLists& fragment_lists);

// The same for lists of pixels (fixed_passes/pixel_lists.h): ranges and coverage are of pixels, keys are the depths of
// the program, and exact codes are 0.
[[nodiscard]] std::vector<std::uint32_t> coverage_of_pixels(pipeline::Region& region);
void list_pixels(pipeline::Region& region, const PixelRange& pixels, std::span<const std::uint32_t> coverage,
                 pipeline::Counting counting, FragmentLists& fragment_lists);

// Counts the pass once, if its fragment lists are built in several parts.
void count_list_pass(pipeline::Region& region, bool once_a_pixel = false);

}  // namespace strata::peeling
