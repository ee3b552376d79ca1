// pipeline/fragments/sorted_fragments.cpp - sorting, and finding bounds in what is sorted (execution.md 7.1).
#include "pipeline/fragments/sorted_fragments.h"

#include <algorithm>
#include <bit>
#include <memory>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/stages/alpha_test.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

using rasterizer::FragmentBatch;
using rasterizer::Lanes;

namespace {

constexpr std::uint64_t bytes_per_fragment = sizeof(std::uint64_t) + sizeof(std::uint32_t);
constexpr std::uint64_t more_by_reference = 2 * sizeof(std::uint64_t);
constexpr std::uint64_t bytes_per_pixel = 32;  // start, end of the updates, three fingers
constexpr std::uint32_t not_counted = ~0u;

[[nodiscard]] bool is_at_most(float value, float most) noexcept {
    return std::bit_cast<std::uint32_t>(value) <= std::bit_cast<std::uint32_t>(most);  // false for -0 and NaN
}

// Fragments of a batch, and how many of them have no word, by the first reason for it.
struct Fates {
    std::uint64_t rasterized, masked, hidden, alpha_killed;
};

[[nodiscard]] bool holds(std::span<const PrimitiveRange> ranges, std::uint32_t primitive) noexcept {
    const auto behind = std::ranges::upper_bound(ranges, primitive, {}, &PrimitiveRange::first);
    return behind != ranges.begin() && primitive < std::prev(behind)->last;
}

// Whether any of `ranges` may hold a primitive of `batch`; and whether one of them holds them all.
[[nodiscard]] bool meets(std::span<const PrimitiveRange> ranges, const PrimitiveRange& batch) noexcept {
    const auto from = std::ranges::upper_bound(ranges, batch.first, {}, &PrimitiveRange::last);
    return from != ranges.end() && from->first < batch.last;
}
[[nodiscard]] bool covers(std::span<const PrimitiveRange> ranges, const PrimitiveRange& batch) noexcept {
    const auto from = std::ranges::upper_bound(ranges, batch.first, {}, &PrimitiveRange::last);
    return from != ranges.end() && from->first <= batch.first && batch.last <= from->last;
}

// Of neighbouring passes bounds are the same or a few words apart: steps that double, from where the last one was.
[[nodiscard]] std::uint32_t first_from(std::span<const std::uint64_t> words, std::uint64_t word,
                                       std::uint32_t hint) noexcept {
    const auto size = static_cast<std::uint32_t>(words.size());
    std::uint32_t low = 0, high = size, step = 1;  // the answer lies in [low, high]
    if (hint < size && words[hint] < word) {
        low = hint + 1;
        while (low + step <= size && words[low + step - 1] < word) low += step, step *= 2;
        high = std::min(size, low + step - 1);
    } else {
        high = hint;
        while (high >= step && words[high - step] >= word) high -= step, step *= 2;
        low = high >= step ? high - step + 1 : 0;
    }
    const auto found = std::lower_bound(words.begin() + low, words.begin() + high, word);
    return static_cast<std::uint32_t>(found - words.begin());
}

// What arrived in order of depth, either way, needs no sorting. Far to near, equal keys would stand in reverse.
void sort_column(std::span<std::uint64_t> words) {
    if (std::ranges::is_sorted(words)) return;
    const auto falls = [](std::uint64_t a, std::uint64_t b) { return a >> 32 <= b >> 32; };
    if (std::ranges::adjacent_find(words, falls) == words.end())
        std::ranges::reverse(words);
    else
        std::ranges::sort(words);
}

}  // namespace

bool SortedFragments::sort(const FragmentStore& store, const SortRequest& request, std::size_t pixels,
                           std::uint64_t limit, const std::uint32_t* surface) {
    request_ = request;
    state_ = State::declined;
    start_.assign(pixels + 1, 0);
    if (!take(store, limit, surface)) return false;
    for (std::size_t p = 0; p < pixels && !request.by_arrival; ++p)
        sort_column({words_.data() + start_[p], start_[p + 1] - start_[p]});
    if (request.by_reference) take_stored(store);
    for (auto& finger : finger_) finger.assign(pixels, Found{});
    updates_end_.assign(pixels, not_counted);
    updates_.resize(words_.size());
    state_ = State::sorted;
    return true;
}

// Every batch is recalled once. Its words go where the pixels' columns begin as soon as all columns' heights are known:
// until then they stand in the order of arrival.
bool SortedFragments::take(const FragmentStore& store, std::uint64_t limit, const std::uint32_t* surface) {
    rasterized_ = masked_ = alpha_killed_ = hidden_ = 0;
    has_plain_colors_ = stores_reference_ = true;
    const std::size_t pixels = start_.size() - 1;
    if (store.batches() >= std::size_t{1} << 24) return false;
    const auto batch = std::make_unique<FragmentBatch>();
    Lanes<std::uint32_t> alive;
    const auto for_each_alive = [&](auto&& visit) {
        for (std::size_t number = 0; number < store.batches(); ++number) {
            const std::span<const PrimitiveRange> ranges = request_.primitives;
            if (!ranges.empty() && !meets(ranges, store.primitives(number))) continue;
            store.recall(number, *batch, alive);
            const auto count = static_cast<std::size_t>(batch->count);
            const auto dead = [&] {
                return static_cast<std::uint64_t>(std::count(alive.begin(), alive.begin() + batch->count, 0u));
            };
            std::uint64_t others = 0;  // that are none of this request's
            for (std::size_t i = 0; i < count && !ranges.empty() && !covers(ranges, store.primitives(number)); ++i)
                if (!holds(ranges, batch->primitive[i])) alive[i] = 0, ++others;
            const std::uint64_t masked = dead();
            for (std::size_t i = 0; request_.by_arrival && i < count; ++i)
                alive[i] &= mask(batch->code[i] < surface[batch->pixel[i]]);
            const std::uint64_t unseen = dead();
            if (request_.alpha.enabled)
                alpha_test(request_.alpha, request_.eight_bit_alpha, batch->color[3].data(), alive.data(),
                           batch->count);
            if (!visit(number, count, alive, Fates{count - others, masked - others, unseen - masked, dead() - unseen}))
                return false;
        }
        return true;
    };
    const bool sortable =
        for_each_alive([&](std::size_t, std::size_t count, const Lanes<std::uint32_t>& is_alive, const Fates& lost) {
            rasterized_ += lost.rasterized;
            masked_ += lost.masked;
            hidden_ += lost.hidden;
            alpha_killed_ += lost.alpha_killed;
            for (std::size_t i = 0; i < count; ++i) start_[batch->pixel[i] + 1] += is_alive[i] & 1u;
            look_at_values(store, *batch);
            return has_sortable_keys(*batch);
        });
    if (!sortable) return false;
    for (std::size_t p = 0; p < pixels; ++p) start_[p + 1] += start_[p];
    if (store.used_bytes() + needed_bytes() > limit) return false;
    words_.resize(start_[pixels]);
    updates_end_.assign(start_.begin(), start_.end() - 1);  // for now: where the column's next word goes
    return for_each_alive(
        [&](std::size_t number, std::size_t count, const Lanes<std::uint32_t>& is_alive, const Fates&) {
            for (std::size_t i = 0; i < count; ++i) {
                if (is_alive[i] == 0) continue;
                const std::uint32_t key = request_.by_reference ? batch->reference_code[i]
                                          : request_.key == DepthKey::shader_z
                                              ? rasterizer::ordered_code(batch->shader_z[i])
                                              : batch->code[i];
                words_[updates_end_[batch->pixel[i]]++] = std::uint64_t{key} << 32 | FragmentStore::place(number, i);
            }
            return true;
        });
}

bool SortedFragments::has_sortable_keys(const FragmentBatch& batch) const noexcept {
    bool sortable = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
        sortable &= request_.key == DepthKey::shader_z ? batch.shader_z[i] == batch.shader_z[i]
                                                       : !request_.is_float || batch.code[i] <= 0x7f800000u;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count) && request_.by_reference; ++i)
        sortable &= !request_.is_float || batch.reference_code[i] <= 0x7f800000u;
    return sortable;
}

std::uint64_t SortedFragments::needed_bytes() const noexcept {
    return size() * (bytes_per_fragment + (request_.by_reference ? more_by_reference : 0)) + pixels() * bytes_per_pixel;
}

void SortedFragments::look_at_values(const FragmentStore& store, const FragmentBatch& batch) noexcept {
    const auto count = static_cast<std::size_t>(batch.count);
    const bool has_colors = store.needs().color, has_reference = store.needs().reference;
    bool plain = has_colors, same = has_reference;
    for (std::size_t i = 0; i < count && has_colors; ++i)
        for (std::size_t c = 0; c < 4; ++c) plain &= is_at_most(batch.color[c][i], c == 3 ? 1.0f : 1024.0f);
    for (std::size_t i = 0; i < count && has_reference; ++i) same &= batch.reference_code[i] == batch.code[i];
    has_plain_colors_ &= plain;
    stores_reference_ &= same;
}

std::uint32_t SortedFragments::below(std::size_t pixel, std::uint64_t bound, Finger finger) noexcept {
    if (bound > 0xffffffff) return start_[pixel + 1] - start_[pixel];
    Found& last = finger_[static_cast<std::size_t>(finger)][pixel];
    if (last.bound != bound) last = {static_cast<std::uint32_t>(bound), first_from(of(pixel), bound << 32, last.at)};
    return last.at;
}

// A fragment passes if every fragment of the range that arrived before it is farther. Fragments nearer than the first
// are peeled, so those that pass are the first in depth, the nearest behind it that arrived earlier, and so on.
std::uint32_t SortedFragments::passing(std::size_t pixel, std::uint32_t first, std::uint32_t last) {
    if (first >= last) return 0;
    if (updates_end_[pixel] != last) count_updates(pixel, last);
    return updates_[start_[pixel] + first];
}

// From the far end on; next_nearer_ is, in depth order, the next fragment that arrived before this one.
void SortedFragments::count_updates(std::size_t pixel, std::uint32_t last) {
    const std::span<const std::uint64_t> words = of(pixel);
    std::uint32_t* const updates = updates_.data() + start_[pixel];
    if (next_nearer_.size() < words.size()) next_nearer_.resize(2 * words.size());
    const auto place = [&](std::uint32_t k) { return static_cast<std::uint32_t>(words[k]); };
    for (std::uint32_t k = last; k-- > 0;) {
        std::uint32_t next = k + 1;
        while (next < last && place(next) > place(k)) next = next_nearer_[next];
        next_nearer_[k] = next;
        updates[k] = 1 + (next < last ? updates[next] : 0);
    }
    updates_end_[pixel] = last;
}

// Chains lead from the nearest to those that passed before it, one update fewer each.
std::uint32_t SortedFragments::update(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                      std::uint32_t updates) {
    const std::span<const std::uint64_t> words = of(pixel);
    const auto place = [&](std::uint32_t k) { return static_cast<std::uint32_t>(words[k]); };
    std::uint32_t at = first;
    for (std::uint32_t left = passing(pixel, first, last); left > updates; --left) {
        const std::uint32_t from = place(at);
        while (place(++at) > from) {
        }
    }
    return at;
}

}  // namespace strata::pipeline
