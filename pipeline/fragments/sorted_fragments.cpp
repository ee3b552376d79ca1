// pipeline/fragments/sorted_fragments.cpp - sorting, and finding bounds in what is sorted (execution.md 7.1).
#include "pipeline/fragments/sorted_fragments.h"

#include <algorithm>
#include <array>
#include <bit>
#include <memory>
#include <utility>

#include "pipeline/formats/lane_mask.h"
#include "pipeline/stages/alpha_test.h"
#include "rasterizer/rules/depth_code.h"

namespace strata::pipeline {

using rasterizer::FragmentBatch;
using rasterizer::FragmentNeeds;
using rasterizer::Lanes;

namespace {

constexpr std::uint64_t bytes_per_fragment = sizeof(std::uint64_t) + 2 * sizeof(std::uint32_t) + 1;  // and its index
constexpr std::uint64_t more_by_comparison = 2 * sizeof(std::uint64_t);
constexpr std::uint64_t bytes_per_pixel = 72;  // its column, what finds it, a word of ones

[[nodiscard]] bool is_at_most(float value, float most) noexcept {
    return std::bit_cast<std::uint32_t>(value) <= std::bit_cast<std::uint32_t>(most);  // false for -0 and NaN
}

// Fragments of a batch, and how many of them have no word, by the first reason for it.
struct Fates {
    std::uint64_t rasterized, masked, hidden, alpha_killed;
};

// Whether every alpha between `ends` passes: if both do, for all tests but notequal take what lies between two that they take.
[[nodiscard]] bool passes_between(const AlphaTest& test, bool eight_bit, const std::array<float, 2>& ends) noexcept {
    if (test.func == CompareFunc::notequal || ends[0] != ends[0]) return false;
    std::array<std::uint32_t, 2> alive{~0u, ~0u};
    alpha_test(test, eight_bit, ends.data(), alive.data(), 2);
    return (alive[0] & alive[1]) != 0;
}

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

}  // namespace

bool SortedFragments::sort(const FragmentStore& store, const SortRequest& request, std::size_t pixels,
                           std::uint64_t limit, const std::uint32_t* surface) {
    request_ = request;
    state_ = State::declined;
    columns_.assign(pixels, Column{});
    next_.assign(pixels, 0);
    if (!take(store, limit, surface)) return false;
    earliest_.forget();
    for (const std::uint32_t p : occupied_) {
        Column& column = columns_[p];
        if (!request.by_arrival && !request.compared)
            column.arrival = sort_arrivals({words_.data() + column.begin, column.size});
    }
    if (request.compared && !sort_compared(store, surface)) return false;
    if (!request.compared) updates_.resize(words_.size());
    for (auto& [bounds, cursors] : cursors_) {
        bounds.assign(occupied_.size(), ~std::uint64_t{0});  // that none is
        cursors.assign(occupied_.size(), 0);
    }
    state_ = State::sorted;
    return true;
}

// Every batch is recalled once. Its words go where the pixels' columns begin as soon as all columns' heights are known:
// until then they stand in the order of arrival.
bool SortedFragments::take(const FragmentStore& store, std::uint64_t limit, const std::uint32_t* surface) {
    rasterized_ = masked_ = alpha_killed_ = hidden_ = 0;
    has_plain_colors_.reset();
    size_ = 0;
    if (store.batches() >= std::size_t{1} << 24) return false;
    const auto batch = std::make_unique<FragmentBatch>();
    Lanes<std::uint32_t> alive;
    FragmentNeeds recalled{.shader_z = request_.key == DepthKey::shader_z,
                           .code = request_.key == DepthKey::stored_code || request_.by_arrival};
    const auto numbers = request_.primitives.empty() ? FragmentStore::Numbers::no : FragmentStore::Numbers::yes;
    const std::span<const PrimitiveRange> ranges = request_.primitives;
    std::vector<bool> is_bright(store.batches());  // known to lose nothing by the alpha test: it is not made
    for (std::size_t number = 0; request_.alpha.enabled && number < is_bright.size(); ++number)
        is_bright[number] = passes_between(request_.alpha, request_.eight_bit_alpha, store.alpha_ends(number));
    const auto for_each_alive = [&](auto&& visit) {
        for (std::size_t number = 0; number < store.batches(); ++number) {
            if (!ranges.empty() && !meets(ranges, store.primitives(number))) continue;
            const bool has_test = request_.alpha.enabled && !is_bright[number];
            recalled.color = has_test;
            store.recall(number, *batch, alive, recalled, numbers);
            const auto count = static_cast<std::size_t>(batch->count);
            const auto dead = [&] {
                return static_cast<std::uint64_t>(std::count(alive.begin(), alive.begin() + batch->count, 0u));
            };
            std::uint64_t others = 0;  // that are none of this request's
            const bool is_part = !ranges.empty() && !covers(ranges, store.primitives(number));
            for (std::size_t i = 0; is_part && i < count; ++i)
                if (!holds(ranges, batch->primitive[i])) alive[i] = 0, ++others;
            const std::uint64_t masked = is_part || store.has_dead(number) ? dead() : 0;
            for (std::size_t i = 0; request_.by_arrival && i < count; ++i)
                alive[i] &= mask(batch->code[i] < surface[batch->pixel[i]]);
            const std::uint64_t unseen = request_.by_arrival ? dead() : masked;
            if (has_test)
                alpha_test(request_.alpha, request_.eight_bit_alpha, batch->color[3].data(), alive.data(),
                           batch->count);
            const std::uint64_t killed = has_test ? dead() - unseen : 0;
            is_bright[number] = killed == 0;
            if (!visit(number, count, alive, Fates{count - others, masked - others, unseen - masked, killed}))
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
            for (std::size_t i = 0; i < count; ++i) next_[batch->pixel[i]] += is_alive[i] & 1u;
            return has_sortable_keys(*batch);
        });
    if (!sortable) return false;
    place_columns();
    if (store.used_bytes() + needed_bytes() > limit) return false;
    words_.resize(begin_.back());
    for (const std::uint32_t begin : begin_) words_[begin - 1] = ~std::uint64_t{0};
    return for_each_alive(
        [&](std::size_t number, std::size_t count, const Lanes<std::uint32_t>& is_alive, const Fates&) {
            const bool is_value = request_.key == DepthKey::shader_z;
            Lanes<std::uint32_t>& key = batch->code;
            for (std::size_t i = 0; is_value && i < count; ++i) key[i] = rasterizer::ordered_code(batch->shader_z[i]);
            std::uint32_t* const next = next_.data();
            std::uint64_t* const words = words_.data();
            // A word goes to another line each time: they are asked for beforehand, all of a batch.
            for (std::size_t i = 0; i < count; ++i) __builtin_prefetch(words + next[batch->pixel[i]], 1);
            for (std::size_t i = 0; i < count; ++i)
                if (is_alive[i] != 0)
                    words[next[batch->pixel[i]]++] = std::uint64_t{key[i]} << 32 | FragmentStore::place(number, i);
            return true;
        });
}

// Of heights in `next_` makes columns, and leaves there where the first word of each goes.
void SortedFragments::place_columns() {
    occupied_.clear();
    begin_.assign(1, 1);
    for (std::size_t p = 0; p < pixels(); ++p) {
        const std::uint32_t height = std::exchange(next_[p], begin_.back());
        columns_[p].begin = begin_.back();
        columns_[p].size = height;
        if (height == 0) continue;
        occupied_.push_back(static_cast<std::uint32_t>(p));
        begin_.push_back(begin_.back() + height + 1);
        size_ += height;
    }
}

bool SortedFragments::has_sortable_keys(const FragmentBatch& batch) const noexcept {
    bool sortable = true;
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
        sortable &= request_.key == DepthKey::shader_z ? batch.shader_z[i] == batch.shader_z[i]
                                                       : !request_.is_float || batch.code[i] <= 0x7f800000u;
    return sortable;
}

std::uint64_t SortedFragments::needed_bytes() const noexcept {
    return size() * (bytes_per_fragment + (request_.compared ? more_by_comparison : 0)) + pixels() * bytes_per_pixel;
}

bool SortedFragments::has_plain_colors(const FragmentStore& store) {
    if (has_plain_colors_) return *has_plain_colors_;
    bool plain = store.needs().color;
    const auto batch = std::make_unique<FragmentBatch>();
    Lanes<std::uint32_t> alive;
    for (std::size_t number = 0; plain && number < store.batches(); ++number) {
        store.recall(number, *batch, alive, {.shader_z = false, .code = false, .color = true});
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch->count); ++i)
                plain &= is_at_most(batch->color[c][i], c == 3 ? 1.0f : 1024.0f);
    }
    has_plain_colors_ = plain;
    return plain;
}

// Behind a column's last word none lies below a bound; the word before its first becomes 0 when 1 is added. No loop but a tight one has
// many words under way from memory at once.
std::span<const std::uint32_t> SortedFragments::numbers_below(std::size_t from, std::span<const std::uint64_t> bounds,
                                                              Cursor which) {
    auto& [all_bounds, all_cursors] = cursors_[static_cast<std::size_t>(which)];
    const std::span<std::uint64_t> last = std::span{all_bounds}.subspan(from, bounds.size());
    const std::span<std::uint32_t> cursors = std::span{all_cursors}.subspan(from, bounds.size());
    if (std::ranges::equal(last, bounds)) return cursors;
    const std::uint64_t* const all = words_.data();
    for (std::size_t k = 0; k < bounds.size(); ++k) {
        last[k] = bounds[k];
        const std::uint64_t word = bounds[k] > 0xffffffff ? ~std::uint64_t{0} : bounds[k] << 32;
        const std::uint64_t* at = all + begin_[from + k] + cursors[k];
        if (*at < word) {
            ++cursors[k];
            if (*++at >= word) continue;
        } else if (*--at + 1 > word) {
            --cursors[k];
            if (*--at + 1 <= word) continue;
        } else {
            continue;
        }
        cursors[k] = first_from(column(from + k), word, cursors[k]);
    }
    return cursors;
}

std::uint32_t SortedFragments::first_from(std::span<const std::uint64_t> words, std::uint64_t word,
                                          std::uint32_t hint) noexcept {
    return first_that(static_cast<std::uint32_t>(words.size()), hint,
                      [&](std::uint32_t k) { return words[k] >= word; });
}

// A fragment passes if every fragment of the range that arrived before it is farther. Fragments nearer than the first
// are peeled, so those that pass are the first in depth, the nearest behind it that arrived earlier, and so on.
// From the far end on; next_nearer_ is, in depth order, the next fragment that arrived before this one.
void SortedFragments::count_updates(std::size_t pixel, std::uint32_t last) {
    const std::span<const std::uint64_t> words = of(pixel);
    std::uint32_t* const updates = updates_.data() + columns_[pixel].begin;
    if (next_nearer_.size() < words.size()) next_nearer_.resize(2 * words.size());
    const auto place = [&](std::uint32_t k) { return static_cast<std::uint32_t>(words[k]); };
    for (std::uint32_t k = last; k-- > 0;) {
        std::uint32_t next = k + 1;
        while (next < last && place(next) > place(k)) next = next_nearer_[next];
        next_nearer_[k] = next;
        updates[k] = 1 + (next < last ? updates[next] : 0);
    }
    columns_[pixel].updates_end = last;
    columns_[pixel].update = {};
}

// Chains lead from the nearest to those that passed before it, one update fewer each; what lies between two of a chain has
// no fewer than the former. So the first with as many is the one. While nothing of the chain but its beginning is
// peeled, it stays where it was found.
std::uint32_t SortedFragments::update(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                      std::uint32_t updates) {
    Column& column = columns_[pixel];
    if (column.arrival == ColumnArrival::near_to_far) return first;
    if (column.arrival == ColumnArrival::far_to_near) return last - updates;
    static_cast<void>(passing(pixel, first, last));
    const std::uint32_t* const of_word = updates_.data() + column.begin;
    Found& found = column.update;
    std::uint32_t at = found.bound == updates && column.update_from <= first && first <= found.at ? found.at : first;
    while (of_word[at] > updates) ++at;
    found = {updates, at};
    column.update_from = first;
    return at;
}

// The chain from `first` leaves the range at the first fragment behind it that arrived before all of the range's.
std::uint32_t SortedFragments::passing_within(std::size_t pixel, std::uint32_t first, std::uint32_t last) {
    if (first >= last) return 0;
    const Column& of_pixel = columns_[pixel];
    if (of_pixel.arrival != ColumnArrival::mixed) return passing(pixel, first, last);
    if (of_pixel.updates_end < last) count_updates(pixel, last);
    const std::size_t column = of_pixel.begin, end = column + of_pixel.updates_end;
    const std::uint32_t place = earliest().earliest(column + first, column + last);
    const std::size_t left = earliest_.first_before(column + last, end, place);
    return updates_[column + first] - (left < end ? updates_[left] : 0);
}

// Between two dead ones those pass that arrived before all nearer ones.
std::uint32_t SortedFragments::passing_without(std::size_t pixel, std::uint32_t first, std::uint32_t last,
                                               std::span<const std::uint32_t> dead) {
    const std::size_t column = columns_[pixel].begin;
    const EarliestIndex& index = earliest();
    std::uint32_t passed = 0, before = ~0u, from = first;
    for (std::size_t k = 0; from < last; ++k) {
        const std::uint32_t until = k < dead.size() ? std::min(dead[k], last) : last;
        const std::size_t found = index.first_before(column + from, column + until, before);
        if (found < column + until) {
            passed += passing_within(pixel, static_cast<std::uint32_t>(found - column), until);
            before = index.earliest(found, column + until);
        }
        from = until + 1;
    }
    return passed;
}

namespace {

// How many places of those put down so far lie above a given one: a Fenwick tree over their ranks.
class LaterCounts {
  public:
    explicit LaterCounts(std::size_t size) : nodes_(size + 1) {}
    void put(std::size_t rank) noexcept {
        for (std::size_t n = rank + 1; n < nodes_.size(); n += n & (~n + 1)) ++nodes_[n];
        ++all_;
    }
    [[nodiscard]] std::uint32_t above(std::size_t rank) const noexcept {
        std::uint32_t up_to = 0;
        for (std::size_t n = rank + 1; n > 0; n &= n - 1) up_to += nodes_[n];
        return all_ - up_to;
    }

  private:
    std::vector<std::uint32_t> nodes_;
    std::uint32_t all_ = 0;
};

}  // namespace

// From the far end on: what is put down lies behind.
void SortedFragments::count_later(std::size_t pixel, std::uint32_t last) {
    if (later_.size() < words_.size()) later_.resize(words_.size());
    columns_[pixel].later_end = last;
    const std::span<const std::uint64_t> words = of(pixel).first(last);
    std::uint32_t* const later = later_.data() + columns_[pixel].begin;
    if (columns_[pixel].arrival != ColumnArrival::mixed) {
        const bool is_near_to_far = is_in_order(pixel);
        for (std::uint32_t k = 0; k < last; ++k) later[k] = is_near_to_far ? last - 1 - k : 0;
        return;
    }
    std::vector<std::uint32_t> places(words.begin(), words.end());
    std::ranges::sort(places);
    LaterCounts behind{places.size()};
    for (std::uint32_t k = last; k-- > 0;) {
        const auto place = static_cast<std::uint32_t>(words[k]);
        const auto rank = static_cast<std::size_t>(std::ranges::lower_bound(places, place) - places.begin());
        later[k] = behind.above(rank);
        behind.put(rank);
    }
}

}  // namespace strata::pipeline
