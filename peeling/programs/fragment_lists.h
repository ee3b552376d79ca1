// peeling/programs/fragment_lists.h - the visible fragments of a region, pixel by pixel, in submission order.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/region/region.h"

namespace strata::peeling {

struct KeyedFragment {
    std::uint32_t key = 0;         // in the algorithm's key: a stored code, or ordered_code(shader_z)
    std::uint32_t exact_code = 0;  // by DepthPath::exact
    std::uint32_t primitive = 0;
    pipeline::Rgba color{};  // straight
    friend bool operator==(const KeyedFragment&, const KeyedFragment&) = default;
};

struct FragmentLists {
    std::vector<std::uint32_t> start;  // pixels + 1 offsets
    std::vector<KeyedFragment> fragments;
    [[nodiscard]] std::span<const KeyedFragment> of(std::uint32_t pixel) const {
        return std::span{fragments}.subspan(start[pixel], start[pixel + 1] - start[pixel]);
    }
};

// A fragment is visible if its key lies before the opaque surface's.
[[nodiscard]] FragmentLists visible_fragments(pipeline::Region& region, pipeline::Bookkeeping bookkeeping);

}  // namespace strata::peeling
