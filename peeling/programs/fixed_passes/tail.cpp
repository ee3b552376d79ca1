// peeling/programs/fixed_passes/tail.cpp - the targets, passes and resolves of tail.h.
#include "peeling/programs/fixed_passes/tail.h"

#include "peeling/programs/average.h"
#include "peeling/programs/fixed_passes/weighted.h"
#include "peeling/programs/region_programs.h"
#include "peeling/programs/sums.h"

namespace strata::peeling {

using namespace pipeline;

TailTargets::TailTargets(Region& region, Tail tail, const ListingInputs& inputs, Target behind)
    : region_{region},
      tail_{tail},
      inputs_{inputs},
      behind_{behind.exists() ? behind : region.opaque_color()},
      color_{region.make_color()} {
    region.set_name(color_, "tail");
    copy_color(region, behind_, color_);
    if (tail == Tail::none || tail == Tail::blend) return;
    sums_ = make_sums(region);
    other_ = make_sum(region);
    region.set_name(sums_, "tail_sums");
    region.set_name(other_, tail == Tail::average ? "tail_count" : "tail_revealage");
    region.clear(sums_, {});
    region.clear(other_, {.color = Rgba(tail == Tail::average ? 0.0f : 1.0f)});
}

PassState TailTargets::state() const {
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::less, .write = false};
    state.depth_target = region_.opaque_depth();
    if (tail_ == Tail::none || tail_ == Tail::blend) {
        state.color[0] = color_;
        state.blend[0] = over_background(region_.frame());
        return state;
    }
    constexpr BlendTerm product{BlendEquation::add, BlendFactor::zero, BlendFactor::one_minus_src_color};
    state.color = {sums_, other_};
    state.blend = {blend_mode::sum, tail_ == Tail::average
                                        ? blend_mode::sum
                                        : Blend{.enabled = true, .color = product, .alpha = product}};
    return state;
}

void TailTargets::write(const FragmentBatch& in, Outputs& out) const {
    if (tail_ == Tail::blend) {
        out.color[0] = in.color;
        return;
    }
    Lanes<float> weights;
    if (tail_ == Tail::weighted)
        weigh(inputs_, region_.frame(), in, weights);
    else
        weights.fill(1.0f);
    for (std::size_t i = 0; i < lanes(in); ++i) {
        const float a = in.color[3][i];
        for (std::size_t c = 0; c < 3; ++c) out.color[0][c][i] = in.color[c][i] * a * weights[i];
        out.color[0][3][i] = a * weights[i];
        for (std::size_t c = 0; c < 4; ++c) out.color[1][c][i] = tail_ == Tail::average ? 1.0f : a;
        if (tail_ == Tail::none) out.alive[i] = 0;
    }
}

Target TailTargets::resolve() {
    if (tail_ == Tail::none || tail_ == Tail::blend) return color_;
    PassState state;
    state.color[0] = color_;
    state.reads = {sums_, other_, behind_};
    static_cast<void>(region_.full_screen(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        const ColorLanes& sums = loads.color(0);
        if (tail_ == Tail::average)
            resolve_average(sums, loads.color(1)[0], loads.color(2), out.color[0], lanes(in));
        else
            resolve_weighted(sums, sums[3], loads.color(1)[0], loads.color(2), out.color[0], lanes(in));
    }));
    return color_;
}

}  // namespace strata::peeling
