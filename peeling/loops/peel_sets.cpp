// peeling/loops/peel_sets.cpp - the loop of Algorithm 1 and its three passes (peeling/reference/algorithms.md 9).
//
// Needs      fragment programs with discard, separate alpha blending.
// Passes     3 per iteration with an ordered set, else 2; the first iteration has no layer to composite.
// Invariant  before an iteration everything up to `peeled` is composited; `layer` is found, and the iteration
//            composites it.
#include "peeling/loops/peel_sets.h"

#include <utility>

#include "peeling/programs/depth_range.h"
#include "peeling/programs/region_programs.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// An empty span means the whole list (PassState::primitives).
std::span<const PrimitiveRange> as_span(const std::optional<PrimitiveRange>& range) {
    if (!range) return {};
    return {&*range, 1};
}

class SetsPeel {
  public:
    SetsPeel(Region& region, const PeelSets& sets)
        : region_{region},
          sets_{sets},
          ties_{region},
          published_{region.frame().formulation == Formulation::published} {
        region_.set_name(accumulated_, "accumulated");
        region_.set_name(peeled_, "layer");
        region_.set_name(layer_, "layer");
        region_.clear(accumulated_, {.color = {0, 0, 0, 1}});
        region_.clear(peeled_, {.depth = 0.0f});  // as published: strict comparisons lose depth 0 (E23)
        from_the_start_ = !published_;
    }

    // A limit is checked for all passes of the next iteration together, so that an iteration is never left incomplete.
    void run() {
        bool more = true, has_layer = false;
        while (!region_.limit_reached(passes(has_layer))) {
            region_.begin_iteration();
            if (has_layer) composite_layer();
            const DrawCounts found = find_layer();
            if (sets_.ordered) composite_ordered();
            has_layer = true;
            if (!(more = region_.any(found.passed, idle()))) break;
        }
        if (more && has_layer && !region_.limit_reached()) composite_layer();  // a limit that still allows this pass
        ties_.report(region_);
        publish_over_background(region_, accumulated_, region_.opaque_color());
    }

  private:
    // Geometry passes of an iteration.
    [[nodiscard]] int passes(bool has_layer) const { return (has_layer ? 1 : 0) + 1 + (sets_.ordered ? 1 : 0); }

    // As published, finished pixels change while others are peeled. After the last iteration that a limit allows there
    // may be one more pass, and a region counts it even if it has nothing left.
    [[nodiscard]] Idle idle() const { return published_ || region_.limit_reached(passes(true)) ? Idle::no : Idle::yes; }

    // Finds the nearest unordered fragment strictly behind `peeled` and before the opaque surface.
    DrawCounts find_layer() {
        region_.copy(region_.opaque_depth(), layer_);
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = layer_;
        state.reads[0] = peeled_;
        state.needs = code_only;
        state.primitives = as_span(sets_.unordered);
        state.selection = {.keeps = KeptFragments::nearest};
        if (!from_the_start_) state.selection.near = KeyBound::beyond(peeled_);
        return region_.draw(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            if (!from_the_start_) keep_behind(in, loads.depth(0), out);
        });
    }

    // Composites the ordered fragments behind `peeled` up to and including the layer's depth, in submission order: at
    // equal depth they are in front of the layer.
    void composite_ordered() {
        PassState state = composite_state(accumulated_);
        state.reads = {peeled_, layer_, region_.opaque_depth()};
        state.primitives = as_span(sets_.ordered);
        state.selection = {.keeps = KeptFragments::interval, .far = {KeyBound::at(layer_)}};
        if (!from_the_start_) state.selection.near = KeyBound::beyond(peeled_);
        static_cast<void>(region_.draw(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            if (!from_the_start_) keep_behind(in, loads.depth(0), out);
            if (published_)
                keep_before(in, loads.depth(1), out);  // as published: loses fragments at the layer's depth (E24)
            else
                keep_up_to(in, loads.depth(1), out);
            keep_before(in, loads.depth(2), out);
            composite_under(in, out);
        }));
    }

    // Composites the layer, which becomes `peeled` of the next iteration.
    void composite_layer() {
        PassState state = composite_state(accumulated_);
        state.reads = {layer_, region_.opaque_depth()};
        state.primitives = as_span(sets_.unordered);
        state.selection = {
            .keeps = KeptFragments::interval, .near = KeyBound::at(layer_), .far = {KeyBound::at(layer_)}};
        ties_.start();
        static_cast<void>(region_.draw(state, [this](const FragmentBatch& in, const Loads& loads, Outputs& out) {
            keep_at(in, loads.depth(0), out);
            if (!published_)
                keep_before(in, loads.depth(1), out);  // a finished pixel's layer is the opaque surface (E24)
            composite_under(in, out);
            ties_.add(in, out);
        }));
        std::swap(peeled_, layer_);
        from_the_start_ = false;
    }

    Region& region_;
    const PeelSets& sets_;
    BoundTies ties_;
    bool published_, from_the_start_ = true;
    Target accumulated_ = region_.make_color(), peeled_ = region_.make_depth(), layer_ = region_.make_depth();
};

}  // namespace

void peel_sets(Region& region, const PeelSets& sets) { SetsPeel{region, sets}.run(); }

}  // namespace strata::peeling
