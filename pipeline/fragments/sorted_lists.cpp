// pipeline/fragments/sorted_lists.cpp - builds and sorts the per-pixel lists of a tile (sorted_lists.h).
#include "pipeline/fragments/sorted_lists.h"

#include <algorithm>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/stages/alpha_test.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

namespace {

[[nodiscard]] bool holds(const std::vector<PrimitiveRange>& ranges, std::uint32_t primitive) noexcept {
    const auto behind = std::ranges::upper_bound(ranges, primitive, {}, &PrimitiveRange::first);
    return behind != ranges.begin() && primitive < std::prev(behind)->last;
}

// Reserves the size that the limit admits at once, as TileFragments does, because an array that grows repeatedly leaves
// its old memory in the allocator. The contents are not copied.
template <class T>
void take_room(UninitializedVector<T>& array, std::size_t admitted) {
    constexpr std::size_t most_at_once = std::size_t{1} << 20;
    array.clear();
    array.reserve(std::min(admitted, most_at_once));
}

}  // namespace

bool SortedLists::sort(const TileFragments& fragments, const SortRequest& request, std::size_t pixels,
                       std::uint64_t limit, const std::uint32_t* surface) {
    request_ = request;
    state_ = State::declined;
    if (!has_order(fragments)) return false;
    const auto admitted = static_cast<std::size_t>(limit / sizeof(std::uint64_t));
    take_room(entries_, admitted);
    const bool has_all = request.primitives.empty() && !request.alpha.enabled && surface == nullptr;
    if (!has_all) {
        take_room(taken_, admitted);
        choose(fragments, surface);
    }
    const auto pixel = fragments.pixel();
    count_.assign(pixels, 0);
    std::uint32_t* const count = count_.data();
    for (std::size_t index = 0; index < pixel.size(); ++index) count[pixel[index]] += has_all ? 1u : taken_[index] & 1u;
    begin_.assign(1, 0);
    std::uint64_t entries = 0;
    size_ = 0;
    for (std::size_t first = 0; first < pixels; first += block_lanes) {
        std::uint32_t tallest = 0;
        for (std::size_t p = first; p < std::min(first + block_lanes, pixels); ++p) {
            tallest = std::max(tallest, count_[p]);
            size_ += count_[p];
        }
        entries += std::uint64_t{tallest} * block_lanes;
        if (entries * sizeof(std::uint64_t) > limit || entries > 0xffffffff) return false;
        begin_.push_back(static_cast<std::uint32_t>(entries));
    }
    previous_ranges_.assign(pixels, {});
    distribute_entries(fragments, has_all);
    for (std::size_t block = 0; !request.by_submission && block < blocks(); ++block)
        sort_levels(entries_.data() + begin_[block], height(block));
    state_ = State::sorted;
    return true;
}

// True if the order of entries is the order of depths.
bool SortedLists::has_order(const TileFragments& fragments) const {
    std::uint32_t without = 0;
    if (request_.key == DepthKey::shader_z)
        for (const float z : fragments.shader_z()) without |= z != z ? 1u : 0u;
    else if (request_.is_float)
        for (const std::uint32_t code : fragments.code()) without |= code > 0x7f800000u ? 1u : 0u;
    return without == 0;
}

void SortedLists::choose(const TileFragments& fragments, const std::uint32_t* surface) {
    taken_.resize(fragments.size());
    std::ranges::fill(taken_, ~0u);
    const auto primitive = fragments.primitive();
    for (std::size_t index = 0; !request_.primitives.empty() && index < taken_.size(); ++index)
        taken_[index] = mask(holds(request_.primitives, primitive[index]));
    for (std::size_t index = 0; surface != nullptr && index < taken_.size(); ++index)
        taken_[index] &= mask(fragments.code()[index] < surface[fragments.pixel()[index]]);
    rasterizer::Lanes<float> alpha;
    for (std::size_t first = 0; request_.alpha.enabled && first < taken_.size(); first += alpha.size()) {
        const std::size_t count = std::min(alpha.size(), taken_.size() - first);
        for (std::size_t i = 0; i < count; ++i) alpha[i] = fragments.color()[first + i][3];
        alpha_test(request_.alpha, request_.eight_bit_alpha, alpha.data(), &taken_[first], static_cast<int>(count));
    }
}

// Writes each entry at the end of its pixel's list so far; then ~0 past the end of every list.
void SortedLists::distribute_entries(const TileFragments& fragments, bool has_all) {
    entries_.resize(begin_.back());
    std::vector<std::uint32_t> ends(blocks() * block_lanes);
    for (std::size_t p = 0; p < ends.size(); ++p)
        ends[p] = begin_[p / block_lanes] + static_cast<std::uint32_t>(p % block_lanes);
    const auto add_all = [&, entries = entries_.data(), next = ends.data()](auto key_of) {
        const auto pixel = fragments.pixel();
        for (std::size_t index = 0; index < pixel.size(); ++index) {
            if (!has_all && taken_[index] == 0) continue;
            const std::uint32_t at = next[pixel[index]];
            entries[at] = std::uint64_t{key_of(index)} << 32 | static_cast<std::uint32_t>(index);
            next[pixel[index]] = at + block_lanes;
        }
    };
    if (request_.key == DepthKey::shader_z)
        add_all([z = fragments.shader_z().data()](std::size_t index) { return rasterizer::ordered_code(z[index]); });
    else
        add_all([code = fragments.code().data()](std::size_t index) { return code[index]; });
    for (std::size_t p = 0; p < ends.size(); ++p)
        for (std::uint32_t at = ends[p]; at < begin_[p / block_lanes + 1]; at += block_lanes)
            entries_[at] = ~std::uint64_t{0};
}

}  // namespace strata::pipeline
