#include "pipeline/fragments/layer_lists.h"

#include <numeric>
#include <tuple>

namespace strata::pipeline {

namespace {

[[nodiscard]] std::uint32_t key_of(std::uint64_t word) noexcept { return static_cast<std::uint32_t>(word >> 32); }
[[nodiscard]] std::uint32_t place_of(std::uint64_t word) noexcept { return static_cast<std::uint32_t>(word); }

// How many of the words, which rise, have keys below `key`.
[[nodiscard]] std::uint32_t number_below(std::span<const std::uint64_t> words, std::uint64_t key) noexcept {
    if (key > 0xffffffff) return static_cast<std::uint32_t>(words.size());
    return static_cast<std::uint32_t>(std::ranges::lower_bound(words, key << 32) - words.begin());
}

}  // namespace

bool LayerLists::begin(SortedFragments& sorted, const Peel& peel, std::uint64_t limit) {
    if (!is_of(peel)) {
        is_built_ = false;
        if (bytes_of(sorted.size(), sorted.pixels()) > limit) return false;
        surface_.assign(peel.surface, peel.surface + sorted.pixels());
        std::tie(least_, end_, is_float_) = std::tie(peel.least, peel.end, peel.is_float);
        count_layers(sorted);
        place_layers(sorted);
        is_built_ = true;
    }
    left_ = surface_;
    next_ = 0;
    return true;
}

// A stored binary32 that is negative or NaN has nothing before it.
LayerLists::Part LayerLists::part(std::span<const std::uint64_t> words, std::uint32_t surface) const noexcept {
    const std::uint32_t first = number_below(words, least_), end = std::max(first, number_below(words, end_));
    const std::uint32_t before = number_below(words, is_float_ && surface > 0x7f800000u ? 0 : surface);
    return {first, std::clamp(before, first, end), end};
}

// Columns by their heights in layers, and from these how many a layer has.
void LayerLists::count_layers(const SortedFragments& sorted) {
    const auto occupied = sorted.occupied();
    std::vector<std::uint32_t> heights(occupied.size());
    parts_.resize(occupied.size());
    std::uint32_t tallest = 0;
    for (std::size_t n = 0; n < occupied.size(); ++n) {
        const auto words = sorted.column(n);
        const Part own = parts_[n] = part(words, surface_[occupied[n]]);
        for (std::uint32_t k = own.first; k < own.tested; ++k)
            heights[n] += k == own.first || key_of(words[k]) != key_of(words[k - 1]) ? 1 : 0;
        tallest = std::max(tallest, heights[n]);
    }
    ended_begin_.assign(tallest + 2, 0);
    for (const std::uint32_t height : heights) ++ended_begin_[height + 1];
    std::partial_sum(ended_begin_.begin(), ended_begin_.end(), ended_begin_.begin());
    begin_.assign(1, 0);
    for (std::uint32_t layer = 0; layer < tallest; ++layer)
        begin_.push_back(begin_.back() + static_cast<std::uint32_t>(occupied.size()) - ended_begin_[layer + 1]);
    ended_.resize(occupied.size());
    std::vector<std::uint32_t> next = ended_begin_;
    for (std::size_t n = 0; n < occupied.size(); ++n) ended_[next[heights[n]]++] = occupied[n];
}

// Columns that go down layer by layer together, for then neighbours of a layer are written together.
struct LayerLists::Descent {
    struct Column {
        std::span<const std::uint64_t> words;
        std::uint32_t pixel, at, tested, end;
        SortedFragments::Updates updates;
    };
    std::vector<Column> columns;
    std::vector<std::uint32_t> next;  // by layer: where its next fragment goes
    std::vector<std::uint64_t> rest;  // by pass: what lies in windows from there on, whose bound is the surface
};

void LayerLists::place_layers(SortedFragments& sorted) {
    constexpr std::size_t together = 16;
    for (auto* const list : {&key_, &place_, &pixel_}) list->resize(begin_.back());
    tied_.clear();
    has_any_at_surface_ = false;
    inside_.assign(layers() + 2, 0);
    passed_.assign(layers() + 2, 0);
    Descent descent{{}, begin_, std::vector<std::uint64_t>(inside_.size())};
    const auto occupied = sorted.occupied();
    for (std::size_t from = 0; from < occupied.size(); from += together) {
        for (std::size_t n = from; n < std::min(from + together, occupied.size()); ++n) {
            const auto [first, tested, end] = parts_[n];
            const auto updates = sorted.updates(occupied[n], first, tested);
            descent.columns.push_back({sorted.column(n), occupied[n], first, tested, end, updates});
        }
        for (std::uint32_t layer = 0; leave_ended(descent, layer); ++layer) place_layer(descent, layer);
    }
    std::partial_sum(descent.rest.begin(), descent.rest.end(), descent.rest.begin());
    for (std::size_t pass = 0; pass < inside_.size(); ++pass) inside_[pass] += descent.rest[pass];
    std::ranges::stable_sort(tied_, {}, &Tied::layer);
}

// One fragment of each column.
void LayerLists::place_layer(Descent& descent, std::uint32_t layer) {
    std::uint32_t *const key = key_.data(), *const place = place_.data(), *const pixel = pixel_.data();
    std::uint64_t inside = 0, passed = 0;
    std::uint32_t at = descent.next[layer];
    for (auto& column : descent.columns) {
        const std::uint64_t word = column.words[column.at];
        inside += column.end - column.at;
        passed += column.updates.of(column.at);
        key[at] = key_of(word);
        place[at] = place_of(word);
        pixel[at++] = column.pixel;
        for (std::uint32_t rank = 1; ++column.at < column.tested; ++rank) {
            if (key_of(column.words[column.at]) != key_of(word)) break;
            tied_.push_back({layer, column.pixel, rank, column.words[column.at]});
        }
    }
    descent.next[layer] = at;
    inside_[layer] += inside;
    passed_[layer] += passed;
}

// Leaves out the columns that have no layer of this number: in its pass the bound is their last layer, in further ones their surface.
// False if none is left.
bool LayerLists::leave_ended(Descent& descent, std::uint32_t layer) {
    std::erase_if(descent.columns, [&](const Descent::Column& column) {
        if (column.at < column.tested) return false;
        inside_[layer] += column.end - column.tested;
        const std::uint64_t surface = surface_[column.pixel];
        const std::uint32_t behind = number_below(column.words, surface + 1);
        has_any_at_surface_ |= number_below(column.words, surface) < behind;  // outside of the range, too
        descent.rest[layer + 1] += column.end - std::clamp(behind, column.tested, column.end);
        return true;
    });
    return !descent.columns.empty();
}

LayerLists::Layer LayerLists::layer() const noexcept {
    if (next_ > layers()) return {};
    const std::size_t first = begin_[next_ - 1], count = begin_[next_] - first;
    const auto part = [&](const auto& list) { return std::span{list}.subspan(first, count); };
    return {part(key_), part(place_), part(pixel_)};
}

std::span<const LayerLists::Tied> LayerLists::tied() const noexcept {
    const auto before = [&](std::size_t layer) {
        return static_cast<std::size_t>(std::ranges::lower_bound(tied_, layer, {}, &Tied::layer) - tied_.begin());
    };
    const std::size_t first = before(next_ - 1);
    return std::span{tied_}.subspan(first, before(next_) - first);
}

// A pixel behind its last layer has the surface's depth again.
void LayerLists::advance(std::uint32_t* depths) {
    ++next_;
    const auto [key, place, pixel] = layer();
    for (std::size_t k = 0; k < pixel.size(); ++k) left_[pixel[k]] = depths[pixel[k]] = key[k];
    if (next_ - 1 >= ended_begin_.size() - 1) return;
    for (std::uint32_t k = ended_begin_[next_ - 1]; k < ended_begin_[next_]; ++k)
        left_[ended_[k]] = surface_[ended_[k]];
}

}  // namespace strata::pipeline
