// pipeline/fragments/compared_depths.cpp - columns sorted by the depth that programs compare where that is more than a code: with an epsilon,
// not rounded, or another path's binary32 (execution.md 7.1).
//
// Rule     Words are (stored key, place), in the order of (compared depth, place); depths stand beside them. Whatever a program asks of a
//          depth and of bounds is true from some depth on, so that windows are ranges of numbers. A NaN is sorted nowhere.
// Tests    tests/pipeline/fragments/compared_depths_test.cpp
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <tuple>
#include <utility>

#include "pipeline/fragments/sorted_fragments.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

namespace {

[[nodiscard]] std::uint32_t key_of(std::uint64_t word) noexcept { return static_cast<std::uint32_t>(word >> 32); }
[[nodiscard]] std::uint32_t place_of(std::uint64_t word) noexcept { return static_cast<std::uint32_t>(word); }

}  // namespace

// Depths of words as they stand.
bool SortedFragments::take_compared(const FragmentStore& store) {
    const DepthCompare& compare = *request_.compared;
    const bool is_value = request_.key == DepthKey::shader_z;
    is_value ? compared_.resize(words_.size()) : stored_.resize(words_.size() + few_stored);
    if (size() == 0) return true;  // not even what stands between columns has a place then
    const auto batch = std::make_unique<rasterizer::FragmentBatch>();
    rasterizer::FragmentNeeds reference_alone;
    reference_alone.shader_z = reference_alone.code = reference_alone.color = false;
    reference_alone.reference = true;
    rasterizer::Lanes<std::uint32_t> places;
    bool has_order = true;
    for (std::size_t first = 0; first < words_.size(); first += places.size()) {
        const std::size_t count = std::min(places.size(), words_.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint64_t word = words_[first + i];
            places[i] = word == ~std::uint64_t{0} ? 0 : static_cast<std::uint32_t>(word);  // between columns: any
        }
        store.fetch({places.data(), count}, reference_alone, FragmentStore::Numbers::no, *batch);
        for (std::size_t i = 0; i < count; ++i) {
            const double z = batch->reference_z[i];
            const double own = is_value ? compare.own(z) : compare.own(batch->reference_code[i], z);
            own_depth(first + i) = own;
            has_order &= !std::isnan(own);
        }
    }
    return has_order;
}

// Columns become (compared depth, word) for as long as they are sorted.
bool SortedFragments::sort_compared(const FragmentStore& store, const std::uint32_t* surface) {
    if (!take_compared(store)) return false;
    const bool is_value = request_.key == DepthKey::shader_z;
    const auto is_hidden = [&](std::uint64_t word, std::uint32_t code) {
        return key_of(word) >= (is_value ? rasterizer::ordered_code(std::bit_cast<float>(code)) : code);
    };
    std::vector<std::pair<double, std::uint64_t>> column;
    const auto arrives_before = [](const auto& a, const auto& b) {
        return a.first != b.first ? a.first < b.first : place_of(a.second) < place_of(b.second);
    };
    for (const std::uint32_t p : occupied_) {
        columns_[p].arrival = ColumnArrival::mixed;
        const std::size_t begin = columns_[p].begin, end = begin + columns_[p].size;
        for (std::size_t k = begin; surface != nullptr && k < end; ++k)
            if (is_hidden(words_[k], surface[p])) own_depth(k) = std::numeric_limits<double>::infinity();
        const auto pair = [this](std::size_t k) { return std::pair{own_depth(k), words_[k]}; };
        bool is_sorted = true;
        for (std::size_t k = begin + 1; k < end; ++k) is_sorted &= !arrives_before(pair(k), pair(k - 1));
        if (is_sorted) continue;
        column.clear();
        for (std::size_t k = begin; k < end; ++k) column.push_back(pair(k));
        std::ranges::sort(column, arrives_before);
        for (std::size_t k = begin; k < end; ++k) std::tie(own_depth(k), words_[k]) = column[k - begin];
    }
    for (auto& cursor : compared_cursors_) cursor.assign(occupied_.size(), 0);
    if (is_value)
        take_extremes();
    else
        end_columns();
    return true;
}

void SortedFragments::end_columns() {
    constexpr Stored nothing{std::numeric_limits<double>::infinity(), ~std::uint64_t{0}, 0};
    for (const std::uint32_t begin : begin_) stored_[begin - 1] = nothing;
    std::fill_n(stored_.end() - few_stored, few_stored, nothing);
    surfaces_.assign(occupied_.size(), ~0u);  // which no code is
}

void SortedFragments::take_extremes() {
    for (auto* const keys : {&least_key_, &greatest_key_}) keys->resize(words_.size());
    for (const std::uint32_t p : occupied_) {
        const std::size_t begin = columns_[p].begin, end = begin + columns_[p].size;
        std::uint32_t greatest = 0, least = ~0u;
        for (std::size_t k = begin; k < end; ++k) greatest_key_[k] = greatest = std::max(greatest, key_of(words_[k]));
        for (std::size_t k = end; k-- > begin;) least_key_[k] = least = std::min(least, key_of(words_[k]));
    }
}

// Compared and stored depths rise together but for a few bits: nothing behind the first fragments is less than them.
std::array<std::uint64_t, 2> SortedFragments::extremes(std::size_t number, std::uint32_t first,
                                                       std::uint32_t last) const noexcept {
    const std::size_t begin = begin_[number] + first, end = begin_[number] + last;
    std::uint64_t least = words_[begin], greatest = words_[end - 1];
    for (std::size_t k = begin + 1; k < end && least_key_[k] < key_of(least); ++k)
        if (key_of(words_[k]) < key_of(least)) least = words_[k];
    for (std::size_t k = end - 1; k > begin && greatest_key_[k - 1] > key_of(greatest); --k)
        if (key_of(words_[k - 1]) > key_of(greatest)) greatest = words_[k - 1];
    return {least, greatest};
}

}  // namespace strata::pipeline
