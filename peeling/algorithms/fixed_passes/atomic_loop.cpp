// peeling/algorithms/fixed_passes/atomic_loop.cpp - pass 1 finds the k nearest depths of every pixel by atomic minimum,
// pass 2 stores the colours of the fragments with these depths; all other fragments form the tail. Kubisch 2014
// (atomic_loop); Maule et al. 2013 (hybrid_transparency: a core of k, the rest averaged);
// peeling/reference/algorithms.md 21.
//
// Needs      unordered access with atomics; float targets that blend for the tails that are sums.
// Passes     2. Exact if no pixel has more than k visible fragments. Fragments of equal depth share an entry, which
//            shows the last submitted (atomic_loop), or have an entry each, the first submitted in front
//            (hybrid_transparency).
// Invariant  after pass 1 a pixel's entries are its k least codes in order; after pass 2 each has the colour of a
//            fragment of its code.
#include <algorithm>
#include <utility>
#include <vector>

#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/pixel_lists.h"
#include "peeling/programs/fixed_passes/tail.h"
#include "peeling/programs/programs.h"
#include "peeling/programs/region_programs.h"
#include "pipeline/region/region.h"

namespace strata::peeling::listing::atomic_loop {

namespace {

enum class EqualCodes : std::uint8_t { share, apart };

// Arrays in which fragment programs collect the k nearest fragments by atomic minimum. Fragments of equal codes share
// an entry, which keeps the colour of the last one submitted, or take an entry each, in submission order. The entries
// of all pixels of a region: k codes, k colours and k masks per pixel. `pixel` is the index of a list.
class AtomicEntries {
  public:
    AtomicEntries(const ListElements& lists, int k, EqualCodes equal)
        : k_{static_cast<std::size_t>(k)},
          equal_{equal},
          codes_(lists.count() * k_, empty),
          colors_(codes_.size()),
          samples_(codes_.size()) {}

    // The loop of atomicMin in the program of the first pass: a code replaces the first greater one, and the replaced
    // code moves on to the next entry.
    void add_code(std::uint32_t pixel, std::uint32_t code) {
        for (std::size_t e = pixel * k_; e < (pixel + 1) * k_; ++e) {
            const std::uint32_t before = std::exchange(codes_[e], std::min(codes_[e], code));
            if (before == empty || (before == code && equal_ == EqualCodes::share)) return;
            code = std::max(before, code);
        }
    }
    // Stores the colour in the entry of the fragment's code. Returns false if there is none: the fragment belongs to
    // the tail (tail.h).
    bool add_color(std::uint32_t pixel, std::uint32_t code, const pipeline::Rgba& color, std::uint8_t samples) {
        for (std::size_t e = pixel * k_; e < (pixel + 1) * k_ && codes_[e] <= code; ++e) {
            const bool is_taken = samples_[e] != 0;
            if (codes_[e] != code || (equal_ == EqualCodes::apart && is_taken)) continue;
            samples_[e] = samples;
            colors_[e] = color;
            return true;
        }
        return false;
    }
    // Composites the entries that have the sample `bit` from the nearest on, in binary32: C += T (a c), T *= 1 - a,
    // where T is the transmittance. Returns (C, T).
    [[nodiscard]] pipeline::Rgba composite(std::uint32_t pixel, std::uint8_t bit) const {
        pipeline::Rgba all{0, 0, 0, 1};
        for (std::size_t e = pixel * k_; e < (pixel + 1) * k_ && codes_[e] != empty; ++e) {
            if ((samples_[e] & bit) == 0) continue;
            const float a = colors_[e][3];
            for (pipeline::Rgba::length_type c = 0; c < 3; ++c) all[c] = all[c] + all[3] * (colors_[e][c] * a);
            all[3] = all[3] * (1.0f - a);
        }
        return all;
    }

  private:
    static constexpr std::uint32_t empty = ~0u;  // above every code

    std::size_t k_;
    EqualCodes equal_;
    std::vector<std::uint32_t> codes_;
    std::vector<pipeline::Rgba> colors_;
    std::vector<std::uint8_t> samples_;  // 0: no colour yet
};

}  // namespace

using namespace pipeline;

namespace {

void find_depths(Region& region, const ListElements& lists, AtomicEntries& entries) {
    PassState state;
    state.needs = code_only;
    lists.see_visible(state);
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        lists.keep_visible(in, loads, out);
        for (std::size_t i = 0; i < lanes(in); ++i)
            if (out.alive[i] != 0) entries.add_code(in.pixel[i], in.code[i]);
    }));
}

// Pass 2: stores the colour of each fragment that has an entry, and adds the others to the tail.
void find_colors(Region& region, const ListElements& lists, AtomicEntries& entries, const TailTargets& tail) {
    PixelSet overflow{region};
    PassState state = tail.state();
    lists.see_visible(state);
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        lists.keep_visible(in, loads, out);
        for (std::size_t i = 0; i < lanes(in); ++i) {
            if (out.alive[i] == 0) continue;
            const Rgba color{in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]};
            if (entries.add_color(in.pixel[i], in.code[i], color, lists.samples_of(out, i)))
                out.discard(static_cast<int>(i));
            else
                overflow.add(in.pixel[i]);
        }
        tail.write(in, out);
    }));
    overflow.report(region, Fault::buffer_overflow, "more fragments than entries: the rest is the tail");
}

void composite(Region& region, const ListElements& lists, const AtomicEntries& entries, Target behind) {
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    PassState state;
    state.color[0] = result;
    state.reads[0] = behind;
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const Rgba all = entries.composite(lists.list_of(in.pixel[i]), lists.bit_of(in.pixel[i]));
            for (std::size_t c = 0; c < 3; ++c)
                out.color[0][c][i] = scalar::composited(all[static_cast<int>(c)], all[3], loads.color(0)[c][i]);
            out.color[0][3][i] = scalar::alpha_over(all[3], loads.color(0)[3][i]);
        }
    }));
    region.publish(result);
}

template <EqualCodes equal, Tail usual>
void run(Region& region, const ListingInputs& inputs) {
    const ListElements lists{region, inputs.options.list_granularity};
    AtomicEntries entries{lists, inputs.options.nodes, equal};
    TailTargets tail{region, inputs.options.tail.value_or(usual), inputs};
    region.begin_iteration();
    find_depths(region, lists, entries);
    find_colors(region, lists, entries, tail);
    composite(region, lists, entries, tail.resolve());
}

}  // namespace

std::vector<Algorithm> entries() {
    return {
        Algorithm{
            .name = "atomic_loop",
            .listed = 210,
            .paper = "Kubisch 2014",
            .section = "two passes",
            .summary = "the k nearest depths of a pixel by atomic minimum, then their colours; the rest blended behind",
            .pass_formula = "2",
            .ties = TiePolicy::none,
            .has_lists = true,
            .compares_own_codes = true,
            .geometry_passes = two_passes,
            .run_with = run<EqualCodes::share, Tail::blend>,
            .features = {unordered_access, fragment_programs}},
        Algorithm{.name = "hybrid_transparency",
                  .listed = 211,
                  .paper = "Maule et al. 2013",
                  .section = "Hybrid Transparency",
                  .summary = "the k nearest fragments composited in order, over the average of the rest",
                  .pass_formula = "2",
                  .ties = TiePolicy::none,
                  .has_lists = true,
                  .compares_own_codes = true,
                  .geometry_passes = two_passes,
                  .run_with = run<EqualCodes::apart, Tail::average>,
                  .features = {unordered_access, float_targets, fragment_programs},
                  .render_targets = 2}};
}

}  // namespace strata::peeling::listing::atomic_loop
