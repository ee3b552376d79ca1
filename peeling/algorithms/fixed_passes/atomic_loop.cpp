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
#include "peeling/algorithms/entry.h"
#include "peeling/programs/depth_range.h"
#include "peeling/programs/fixed_passes/atomic_entries.h"
#include "peeling/programs/fixed_passes/tail.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling::listing::atomic_loop {

using namespace pipeline;

namespace {

void find_depths(Region& region, AtomicEntries& entries) {
    PassState state;
    state.needs = code_only;
    state.reads[0] = region.opaque_depth();
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        keep_before(in, loads.depth(0), out);
        for (std::size_t i = 0; i < lanes(in); ++i)
            if (out.alive[i] != 0) entries.add_code(in.pixel[i], in.code[i]);
    }));
}

// Pass 2: stores the colour of each fragment that has an entry, and adds the others to the tail.
void find_colors(Region& region, AtomicEntries& entries, const TailTargets& tail) {
    PixelSet overflow{region};
    PassState state = tail.state();
    state.reads[0] = region.opaque_depth();
    static_cast<void>(region.draw(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        keep_before(in, loads.depth(0), out);
        for (std::size_t i = 0; i < lanes(in); ++i) {
            if (out.alive[i] == 0) continue;
            const Rgba color{in.color[0][i], in.color[1][i], in.color[2][i], in.color[3][i]};
            if (entries.add_color(in.pixel[i], in.code[i], color))
                out.discard(static_cast<int>(i));
            else
                overflow.add(in.pixel[i]);
        }
        tail.write(in, out);
    }));
    overflow.report(region, Fault::buffer_overflow, "more fragments than entries: the rest is the tail");
}

void composite(Region& region, const AtomicEntries& entries, Target behind) {
    const Target result = region.make(region.frame().picture_format());
    region.set_name(result, "result");
    PassState state;
    state.color[0] = result;
    state.reads[0] = behind;
    static_cast<void>(region.full_screen(state, [&](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        for (std::size_t i = 0; i < lanes(in); ++i) {
            const Rgba all = entries.composite(in.pixel[i]);
            for (std::size_t c = 0; c < 3; ++c)
                out.color[0][c][i] = scalar::composited(all[static_cast<int>(c)], all[3], loads.color(0)[c][i]);
            out.color[0][3][i] = scalar::alpha_over(all[3], loads.color(0)[3][i]);
        }
    }));
    region.publish(result);
}

template <EqualCodes equal, Tail usual>
void run(Region& region, const ListingInputs& inputs) {
    AtomicEntries entries{region, inputs.options.nodes, equal};
    TailTargets tail{region, inputs.options.tail.value_or(usual), inputs};
    region.begin_iteration();
    find_depths(region, entries);
    find_colors(region, entries, tail);
    composite(region, entries, tail.resolve());
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
                  .compares_own_codes = true,
                  .geometry_passes = two_passes,
                  .run_with = run<EqualCodes::apart, Tail::average>,
                  .features = {unordered_access, float_targets, fragment_programs},
                  .render_targets = 2}};
}

}  // namespace strata::peeling::listing::atomic_loop
