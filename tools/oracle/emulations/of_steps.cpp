// tools/oracle/emulations/of_steps.cpp - mistakes in the steps of an algorithm: clears, copies, queries and the state
// of its passes.
#include <algorithm>

#include "peeling/registry.h"
#include "pipeline/region/region_shortcuts.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

using namespace pipeline;
using RenderTarget = pipeline::Target;

// Calls change(state) for every geometry pass.
template <class Change>
bool in_geometry_passes(AlteredRun& e, Change change) {
    e.alterations.push_back({.pass = [names = e.names, change](Region&, PassState& state, pipeline::PassKind kind) {
        if (kind == pipeline::PassKind::geometry) change(*names, state);
    }});
    return true;
}

// Calls change(blend) for every target that blends, in all passes.
template <class Change>
bool in_blends(AlteredRun& e, Change change) {
    // An alteration may set different blends for two targets, so the device must support that.
    e.profile.has_independent_blend = e.profile.has_separate_alpha_blend = true;
    e.alterations.push_back({.pass = [change](Region&, PassState& state, pipeline::PassKind) {
        for (Blend& blend : state.blend)
            if (blend.enabled) change(blend);
    }});
    return true;
}

// Calls change(names, region, target, value) before every clear; if it returns false the clear is skipped.
template <class Change>
bool in_clears(AlteredRun& e, Change change) {
    e.alterations.push_back(
        {.clear = [names = e.names, change](Region& region, RenderTarget& target, ClearValue& value) {
            return change(*names, region, target, value);
        }});
    return true;
}

bool in_queries(AlteredRun& e, std::function<bool(std::uint64_t count, bool goes_on)> answer) {
    e.alterations.push_back({.query = std::move(answer)});
    return true;
}

// A layer of a single fragment is not composited either, because the query decides before that pass.
bool stops_at_one(AlteredRun& e) {
    const auto passed = std::make_shared<std::uint64_t>(0);  // of the last geometry pass
    e.alterations.push_back({.pass =
                                 [names = e.names, passed](Region&, PassState& state, pipeline::PassKind kind) {
                                     const bool composites =
                                         kind == pipeline::PassKind::full_screen && names->is(state.reads[0], "layer");
                                     if (!composites || *passed != 1) return;
                                     for (Blend& blend : state.blend) blend.write_mask = 0;
                                 },
                             .drawn =
                                 [passed](pipeline::PassKind kind, std::uint64_t count) {
                                     if (kind == pipeline::PassKind::geometry) *passed = count;
                                 },
                             .query = [](std::uint64_t count, bool goes_on) { return goes_on && count > 1; }});
    return true;
}

bool is_front(const Names& names, RenderTarget target) {
    return names.is(target, "accumulated") || names.is(target, "front");
}
bool is_layer(const Names& names, RenderTarget target) {
    return names.is(target, "layer") || names.is(target, "back_layer") || names.is(target, "color");
}

bool is(const Blend& blend, const Blend& mode) {
    return blend.enabled && blend.color == mode.color && blend.alpha == mode.alpha;
}

// Every stencil operation that saturates wraps instead.
void wrap(StencilFace& face) {
    for (StencilOp* const op : {&face.fail, &face.depth_fail, &face.pass})
        *op = *op == StencilOp::incr ? StencilOp::incr_wrap : *op == StencilOp::decr ? StencilOp::decr_wrap : *op;
}

// Pairs that an algorithm swaps keep the roles of its first iteration: in every second iteration the targets of a pair
// are exchanged.
class NoPingPong {
  public:
    explicit NoPingPong(std::shared_ptr<Names> names) : names_{std::move(names)} {}
    void ended() { swapped_ = !swapped_; }
    void turn(RenderTarget& target) const {
        if (!swapped_) return;
        for (const char* name : {"min_max", "front", "nearest"})
            if (names_->is(target, name)) target = names_->partner(target);
    }

  private:
    std::shared_ptr<Names> names_;
    bool swapped_ = false;
};

bool swaps_nothing(AlteredRun& e) {
    const auto pairs = std::make_shared<NoPingPong>(e.names);
    e.alterations.push_back({.clear =
                                 [pairs](Region&, RenderTarget& target, ClearValue&) {
                                     pairs->turn(target);
                                     return true;
                                 },
                             .copy =
                                 [pairs](Region&, RenderTarget& from, RenderTarget& to) {
                                     pairs->turn(from);
                                     pairs->turn(to);
                                     return true;
                                 },
                             .pass =
                                 [pairs](Region&, PassState& state, pipeline::PassKind) {
                                     pairs->turn(state.depth_target);
                                     for (RenderTarget& target : state.color) pairs->turn(target);
                                     for (RenderTarget& target : state.reads) pairs->turn(target);
                                 },
                             .query =
                                 [pairs](std::uint64_t, bool goes_on) {
                                     pairs->ended();
                                     return goes_on;
                                 }});
    return true;
}

// Clears the opaque depth to 1 before the first step of the algorithm.
bool loses_opaque_depth(AlteredRun& e) {
    const auto lose = [is_lost = false](Region& region) mutable {
        if (std::exchange(is_lost, true)) return;
        RegionShortcuts{region}.uncounted([&] { region.clear(region.opaque_depth(), {.depth = 1.0f}); });
    };
    const auto once = std::make_shared<std::function<void(Region&)>>(lose);
    e.alterations.push_back({.clear =
                                 [once](Region& region, RenderTarget&, ClearValue&) {
                                     (*once)(region);
                                     return true;
                                 },
                             .copy =
                                 [once](Region& region, RenderTarget&, RenderTarget&) {
                                     (*once)(region);
                                     return true;
                                 },
                             .pass = [once](Region& region, PassState&, pipeline::PassKind) { (*once)(region); }});
    return true;
}

// The port never reaches its algorithm: OVER in submission order.
bool sorts_nothing(AlteredRun& e) {
    const peeling::Algorithm* const unsorted = peeling::find_algorithm("unsorted");
    if (e.algorithm == unsorted) return false;
    e.algorithm = unsorted;
    return true;
}

bool writes_depth_of_blended(AlteredRun& e) {
    static_cast<void>(sorts_nothing(e));
    return in_geometry_passes(e, [](const Names&, PassState& state) { state.depth.write = true; });
}

const Mistake step_mistakes[] = {
    {"stencil_not_cleared", "the stencil not cleared between passes", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_clears(e, [](const Names& names, Region&, RenderTarget target, ClearValue&) {
             return !names.is(target, "stencil");
         });
     }},
    {"last_of_equals", "of equal depths the last fragment kept: LEQUAL for LESS", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) {
             if (state.depth.func == CompareFunc::less) state.depth.func = CompareFunc::lequal;
         });
     }},
    {"farthest_first", "the farthest fragment kept: GREATER for LESS", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) {
             if (state.depth.func == CompareFunc::less) state.depth.func = CompareFunc::greater;
         });
     }},
    {"depth_not_written", "depth writes left off", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) { state.depth.write = false; });
     }},
    {"depth_not_tested", "the depth test left off: every fragment passes", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) { state.depth.func = CompareFunc::always; });
     }},
    {"opaque_depth_lost", "transparent surfaces not hidden by opaque ones: their depth is lost", ChangedPart::steps,
     loses_opaque_depth},
    {"swapped_factors", "source and destination factors of blending exchanged", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_blends(e, [](Blend& blend) {
             std::swap(blend.color.src, blend.color.dst);
             std::swap(blend.alpha.src, blend.alpha.dst);
         });
     }},
    {"one_blend_function", "alpha blended by the factors of the colours: one blend function for both",
     ChangedPart::steps, [](AlteredRun& e) { return in_blends(e, [](Blend& blend) { blend.alpha = blend.color; }); }},
    {"blending_off", "blending never enabled", ChangedPart::steps,
     [](AlteredRun& e) { return in_blends(e, [](Blend& blend) { blend.enabled = false; }); }},
    {"under_without_transmittance", "layers added in front without the transmittance of the layers before them",
     ChangedPart::steps,
     [](AlteredRun& e) {
         return in_blends(e, [](Blend& blend) {
             if (is(blend, blend_mode::under)) blend.color.src = BlendFactor::one;
         });
     }},
    {"over_for_under", "layers blended OVER the layers before them instead of UNDER", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_blends(e, [](Blend& blend) {
             if (!is(blend, blend_mode::under)) return;
             blend.color = blend_mode::over.color;
             blend.alpha = blend_mode::over.alpha;
         });
     }},
    {"premultiplied_over_for_under",
     "premultiplied colours blended OVER the layers before them, by (ONE, 1 - alpha), instead of UNDER",
     ChangedPart::steps,
     [](AlteredRun& e) {
         return in_blends(e, [](Blend& blend) {
             if (!is(blend, blend_mode::under)) return;
             blend.color = {BlendEquation::add, BlendFactor::one, BlendFactor::one_minus_src_alpha};
         });
     }},
    {"min_for_max", "MIN blending for MAX", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_blends(e, [](Blend& blend) {
             if (is(blend, blend_mode::max)) blend.color.equation = blend.alpha.equation = BlendEquation::min;
         });
     }},
    {"add_for_max", "the equation of blending left at ADD where MAX is meant", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_blends(e, [](Blend& blend) {
             if (is(blend, blend_mode::max)) blend.color.equation = blend.alpha.equation = BlendEquation::add;
         });
     }},
    {"alpha_written", "alpha written where the write mask shall keep it", ChangedPart::steps,
     [](AlteredRun& e) {
         e.profile.has_independent_blend = true;
         e.alterations.push_back({.pass = [](Region&, PassState& state, pipeline::PassKind) {
             for (Blend& blend : state.blend) blend.write_mask = 0xf;
         }});
         return true;
     }},
    {"count_not_added", "fragments not counted: the count's target does not blend", ChangedPart::steps,
     [](AlteredRun& e) {
         e.profile.has_independent_blend = true;
         return in_geometry_passes(e, [](const Names& names, PassState& state) {
             if (names.is(state.color[1], "count")) state.blend[1] = blend_mode::replace;
         });
     }},
    {"front_cleared_wrong", "the front's alpha cleared to 0 instead of 1, or the other way round", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_clears(e, [](const Names& names, Region&, RenderTarget target, ClearValue& value) {
             if (is_front(names, target)) value.color[3] = 1 - value.color[3];
             return true;
         });
     }},
    {"layer_cleared_opaque", "layers cleared to alpha 1: black where a pixel has none", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_clears(e, [](const Names& names, Region&, RenderTarget target, ClearValue& value) {
             if (is_layer(names, target)) value.color[3] = 1;
             return true;
         });
     }},
    {"layer_not_cleared", "layers not cleared between passes", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_clears(
             e, [](const Names& names, Region&, RenderTarget target, ClearValue&) { return !is_layer(names, target); });
     }},
    {"min_max_cleared_to_0", "the min-max depth cleared to (0, 0) instead of (-1, -1)", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_clears(e, [](const Names& names, Region&, RenderTarget target, ClearValue& value) {
             if (names.is(target, "min_max")) value.color = {0, 0, 0, 0};
             return true;
         });
     }},
    {"min_max_cleared_to_0_1", "the min-max depth cleared to (0, 1): the whole range", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_clears(e, [](const Names& names, Region&, RenderTarget target, ClearValue& value) {
             if (names.is(target, "min_max")) value.color = {0, 1, 0, 0};
             return true;
         });
     }},
    {"ping_pong_not_swapped", "the two targets of a pair never swapped", ChangedPart::steps, swaps_nothing},
    {"query_above_one", "the peel ended by a query that counts one: > 1 for > 0", ChangedPart::steps, stops_at_one},
    {"query_half_of_first", "the peel ends when a query counts less than half of the first count", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_queries(e, [first = std::uint64_t{0}](std::uint64_t count, bool goes_on) mutable {
             if (first == 0) first = count;
             return goes_on && 2 * count >= first;
         });
     }},
    {"stencil_wraps", "stencil operations that wrap where they shall stop at the end of the range", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) {
             wrap(state.stencil.front);
             wrap(state.stencil.back);
         });
     }},
    {"stencil_off", "the stencil test never enabled", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) { state.stencil.enabled = false; });
     }},
    {"not_sorted", "layers blended in the order of submission: nothing is sorted", ChangedPart::steps, sorts_nothing},
    {"blended_writes_depth",
     "blended surfaces write depth, in the order of submission: layers behind an earlier drawn one are missing",
     ChangedPart::steps, writes_depth_of_blended},
    {"stencil_ref_off_by_one", "the stencil's reference is too great by 1", ChangedPart::steps,
     [](AlteredRun& e) {
         return in_geometry_passes(e, [](const Names&, PassState& state) { ++state.stencil.front.ref; });
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_steps() { return step_mistakes; }

}  // namespace strata::oracle
