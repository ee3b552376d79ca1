// pipeline/fragments/selected_fragments.h - the fragments that a selection keeps of one pass, on their way to the program, and the counts of
// the others.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/fragments/layer_lists.h"
#include "rasterizer/base/uninitialized.h"

namespace strata::pipeline {

// The windows of columns: keys in [low, high).
struct WindowEnds {
    std::vector<std::uint64_t> low, high;  // no `high`: up to the end
    std::vector<std::uint64_t> surface;    // what a depth test LESS compares with
};

// Several fragments of a pixel follow each other in the order of arrival, and a batch holds no pixel twice: so the
// first ones of all pixels go ahead, then all second ones.
struct SelectedFragments {
    // The arrays of a rank that is being filled, for a loop that keeps them in registers.
    struct Filling {
        std::uint32_t *key, *place, *pixel;
        std::size_t count;
        // A word of SortedFragments.
        [[gnu::always_inline]] inline void add(std::uint32_t at_pixel, std::uint64_t word) noexcept {
            add_if(true, at_pixel, word);
        }
        // There is room for it in any case.
        [[gnu::always_inline]] inline void add_if(bool is_kept, std::uint32_t at_pixel, std::uint64_t word) noexcept {
            key[count] = static_cast<std::uint32_t>(word >> 32);
            place[count] = static_cast<std::uint32_t>(word);
            pixel[count] = at_pixel;
            count += is_kept ? 1 : 0;
        }
    };
    // Pixels rise. Room for one fragment of every pixel that has any, so that nothing asks for it while they are added.
    struct Rank {
        UninitializedVector<std::uint32_t> key, place, pixel;
        std::size_t count = 0;
        LayerLists::Layer lent;  // instead, if it has any
        void reserve(std::size_t most) {
            count = 0;
            lent = {};
            if (key.size() >= most) return;
            for (auto* const array : {&key, &place, &pixel}) array->resize(most);
        }
        [[nodiscard]] Filling filling() noexcept { return {key.data(), place.data(), pixel.data(), count}; }
        // Fragments from number `first` on.
        [[nodiscard]] LayerLists::Layer part(std::size_t first, std::size_t fragments) const noexcept {
            const auto of = [=](std::span<const std::uint32_t> all) { return all.subspan(first, fragments); };
            if (!lent.pixel.empty()) return {of(lent.key), of(lent.place), of(lent.pixel)};
            return {of(key), of(place), of(pixel)};
        }
    };
    std::vector<Rank> of_rank;
    std::size_t columns = 0;                    // pixels with fragments
    std::size_t ranks = 0, rank = 0, next = 0;  // in use; of the next batch, and its first fragment there
    WindowEnds windows;                         // of the occupied pixels
    bool is_routed = false;                     // of Keeps::arrivals: sample s takes what has rank s
    bool is_ready = false;                      // chosen for the present pass
    bool is_remembered = false;                 // what the pass left of them: repeated_pass.h
    std::uint64_t inside = 0;                   // of Keeps::window: fragments in their pixel's window
    std::uint64_t done = 0;                     // what passes and is done without a visit

    void start(std::size_t pixels_with_fragments) {
        columns = pixels_with_fragments;
        ranks = rank = next = 0;
        inside = done = 0;
        is_routed = is_remembered = false;
    }
    void open(std::size_t last_rank) {
        if (of_rank.size() <= last_rank) of_rank.resize(last_rank + 1);
        for (; ranks <= last_rank; ++ranks) of_rank[ranks].reserve(columns);
    }
    // The ranks of Keeps::ends are places in the window: nearest, the next two inwards from either end, farthest. What is tied with an
    // end has ranks behind them. So a batch of the inner ones holds nothing else.
    static constexpr std::size_t end_ranks = 4;
    using Ends = std::array<Filling, end_ranks>;
    [[nodiscard]] static constexpr bool is_inner_end(std::size_t number) noexcept { return number == 1 || number == 2; }
    // The ranks of the ends, empty, to be filled in a loop.
    [[nodiscard]] Ends begin_ends() {
        if (ranks < end_ranks) open(end_ranks - 1);
        Ends begun;
        for (std::size_t r = 0; r < end_ranks; ++r) begun[r] = of_rank[r].filling();
        return begun;
    }
    void finish_ends(const Ends& filled) noexcept {
        for (std::size_t r = 0; r < end_ranks; ++r) of_rank[r].count = filled[r].count;
    }
    // The first rank is this layer, which outlives the pass.
    void lend(const LayerLists::Layer& layer) {
        open(0);
        of_rank[0].lent = layer;
        of_rank[0].count = layer.pixel.size();
    }
    // The pixels of the first rank.
    [[nodiscard]] std::span<const std::uint32_t> kept() const noexcept {
        return ranks == 0 ? std::span<const std::uint32_t>{} : of_rank[0].part(0, of_rank[0].count).pixel;
    }
    // A pixel has at most one of a rank.
    [[gnu::always_inline]] inline void add(std::size_t pixel, std::uint64_t word, std::size_t at_rank) {
        if (at_rank >= ranks) [[unlikely]]
            open(at_rank);
        Rank& to = of_rank[at_rank];
        to.filling().add(static_cast<std::uint32_t>(pixel), word);
        ++to.count;
    }
};

}  // namespace strata::pipeline
