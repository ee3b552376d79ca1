// tools/oracle/emulations/of_fixed_passes.cpp - mistakes in the algorithms with a fixed number of passes: weights,
// moments, lists, tails, samples and buckets (peeling/reference/algorithms.md 18 to 24).
#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "peeling/programs/fixed_passes/weighted.h"
#include "tools/oracle/emulations/program_change.h"

namespace strata::oracle {

namespace {

using namespace pipeline;

// Programs of geometry passes read depth(d) in place of a window depth d; tests and stored depths are not changed.
bool with_depths(AlteredRun& e, float (*depth)(float)) {
    if (e.options.raster.depth_order == rasterizer::DepthOrder::greater) return false;
    e.alterations.push_back({.program = [depth](const ProgramCall& call, const std::function<void()>& run) {
        if (call.kind != pipeline::PassKind::geometry) return run();
        const Lanes<float> own = call.in.shader_z;
        for (std::size_t i = 0; i < lanes_of_call(call); ++i) call.in.shader_z[i] = depth(own[i]);
        run();
        call.in.shader_z = own;
    }});
    return true;
}

// Changes the value to which a target of this name is cleared.
bool with_clear(AlteredRun& e, const char* name, const Rgba& color) {
    e.alterations.push_back(
        {.clear = [names = e.names, name, color](Region&, pipeline::Target& target, ClearValue& value) {
            if (names->is(target, name)) value.color = color;
            return true;
        }});
    return true;
}

bool clears_revealage_to_0(AlteredRun& e) {
    return is_run_by(e, {"weighted_blended"}) && with_clear(e, "revealage", {0, 0, 0, 0});
}

bool adds_revealage(AlteredRun& e) {
    if (!is_run_by(e, {"weighted_blended"})) return false;
    e.alterations.push_back({.pass = [names = e.names](Region&, PassState& state, pipeline::PassKind kind) {
        if (kind == pipeline::PassKind::geometry && names->is(state.color[1], "revealage"))
            state.blend[1] = state.blend[0];
    }});
    return true;
}

bool weighs_without_alpha(AlteredRun& e) {
    const peeling::AlgorithmOptions& own = e.options.algorithm;
    if (!is_run_by(e, {"weighted_blended"}) || own.weight != peeling::Weight::eq10 || own.weight_formula) return false;
    const bool is_reversed = e.options.raster.depth_order == rasterizer::DepthOrder::greater;
    return behind_pass_of(e, pipeline::PassKind::geometry, "sums", [is_reversed](const ProgramCall& call) {
        for (std::size_t i = 0; i < lanes_of_call(call); ++i) {
            const float a = call.in.color[3][i];
            const float depth = peeling::depth_behind_near(is_reversed, call.in.shader_z[i]);
            const float weight = peeling::weight_at(peeling::Weight::eq10, depth);
            for (std::size_t c = 0; c < 3; ++c) call.out.color[0][c][i] = call.in.color[c][i] * a * weight;
            call.out.color[0][3][i] = a * weight;
        }
    });
}

float in_bytes(float value) { return std::floor(std::clamp(value, 0.0f, 1.0f) * 255.0f + 0.5f) / 255.0f; }

// Sums as codes from 0 to 255: every source is rounded before it is added, and a sum saturates at 255.
bool sums_in_bytes(AlteredRun& e) {
    if (!is_run_by(e, {"weighted_blended", "stochastic"})) return false;
    behind_pass_of(e, pipeline::PassKind::geometry, "sums", [](const ProgramCall& call) {
        for (auto& channel : call.out.color[0])
            for (std::size_t i = 0; i < lanes_of_call(call); ++i) channel[i] = in_bytes(channel[i]);
    });
    return behind_pass_of(e, pipeline::PassKind::full_screen, "result", [](const ProgramCall& call) {
        ColorLanes sums = call.loads.color(0);
        for (auto& channel : sums)
            for (std::size_t i = 0; i < lanes_of_call(call); ++i) channel[i] = in_bytes(channel[i]);
        peeling::resolve_weighted(sums, sums[3], call.loads.color(1)[0], call.loads.color(2), call.out.color[0],
                                  lanes_of_call(call));
    });
}

// Replaces the formula of the last quad, which computes each channel from its sum, the sum of alpha, the transmittance
// and the colour behind.
bool resolves_by(AlteredRun& e, float (*formula)(float sum, float alpha, float through, float behind)) {
    return behind_pass_of(e, pipeline::PassKind::full_screen, "result", [formula](const ProgramCall& call) {
        const ColorLanes &sums = call.loads.color(0), &behind = call.loads.color(2);
        for (std::size_t i = 0; i < lanes_of_call(call); ++i)
            if (sums[3][i] > 0)
                for (std::size_t c = 0; c < 3; ++c)
                    call.out.color[0][c][i] = formula(sums[c][i], sums[3][i], call.loads.color(1)[0][i], behind[c][i]);
    });
}

bool takes_absorbance_by_log2(AlteredRun& e) {
    return is_run_by(e, {"moments"}) &&
           behind_pass_of(e, pipeline::PassKind::geometry, "total", [](const ProgramCall& call) {
               constexpr float log2_of_e = 1.44269504f;
               for (std::size_t target = 0; target < 3; ++target)
                   for (auto& channel : call.out.color[target])
                       if (call.state.color[target].exists())
                           for (std::size_t i = 0; i < lanes_of_call(call); ++i) channel[i] *= log2_of_e;
           });
}

// Limits the list of a pixel to `most` nodes.
bool cuts_lists(AlteredRun& e, int most, peeling::Overflow rule) {
    peeling::AlgorithmOptions& options = e.options.algorithm;
    if (!is_run_by(e, {"linked_list"}) || (options.pixel_nodes > 0 && options.pixel_nodes <= most)) return false;
    options.pixel_nodes = most;
    options.overflow = rule;
    return true;
}

// The head of a list is read and written without an atomic, so that the second of two simultaneous fragments is lost.
bool loses_every_second(AlteredRun& e) {
    if (!is_run_by(e, {"linked_list"})) return false;
    const auto arrived = std::make_shared<std::unordered_map<std::uint32_t, std::uint32_t>>();
    e.alterations.push_back({.program = [arrived](const ProgramCall& call, const std::function<void()>& run) {
        if (call.kind == pipeline::PassKind::geometry)
            for (std::size_t i = 0; i < lanes_of_call(call); ++i)
                if (call.out.alive[i] != 0 && (*arrived)[call.in.pixel[i]]++ % 2 == 1) call.out.alive[i] = 0;
        run();
    }});
    return true;
}

bool has_one_node_less(AlteredRun& e) {
    if (!is_run_by(e, {"multi_layer", "adaptive", "atomic_loop", "hybrid_transparency"})) return false;
    return --e.options.algorithm.nodes > 0;
}

// Replaces the tail, blended or averaged, of the two algorithms with a core.
bool changes_tail(AlteredRun& e, peeling::Tail to) {
    if (!is_run_by(e, {"atomic_loop", "hybrid_transparency"})) return false;
    const peeling::Tail usual = is_run_by(e, {"atomic_loop"}) ? peeling::Tail::blend : peeling::Tail::average;
    if (e.options.algorithm.tail.value_or(usual) == to) return false;
    e.options.algorithm.tail = to;
    return true;
}

// Fragments with an entry in the core are also drawn into the tail.
bool draws_core_again(AlteredRun& e) {
    if (!is_run_by(e, {"atomic_loop", "hybrid_transparency"})) return false;
    e.alterations.push_back({.program = [names = e.names](const ProgramCall& call, const std::function<void()>& run) {
        const Lanes<std::uint32_t> before = call.out.alive;
        run();
        const bool is_tail = names->is(call.state.color[0], "tail") || names->is(call.state.color[0], "tail_sums");
        for (std::size_t i = 0; call.kind == pipeline::PassKind::geometry && is_tail && i < lanes_of_call(call); ++i)
            if (before[i] != 0 && call.in.code[i] < call.loads.depth(0)[i]) call.out.alive[i] = ~0u;
    }});
    return true;
}

// OVER twice equals OVER once with alpha 1 - (1 - a)^2.
bool blends_tail_twice(AlteredRun& e) {
    if (!is_run_by(e, {"atomic_loop", "hybrid_transparency"})) return false;
    return behind_pass_of(e, pipeline::PassKind::geometry, "tail", [](const ProgramCall& call) {
        auto& alpha = call.out.color[0][3];
        for (std::size_t i = 0; i < lanes_of_call(call); ++i) alpha[i] = 1.0f - (1.0f - alpha[i]) * (1.0f - alpha[i]);
    });
}

bool hashes_pixels_alone(AlteredRun& e) {
    if (!is_run_by(e, {"stochastic"})) return false;
    e.alterations.push_back({.program = [names = e.names](const ProgramCall& call, const std::function<void()>& run) {
        if (call.kind != pipeline::PassKind::geometry || !names->is(call.state.color[0], "samples")) return run();
        const Lanes<std::uint32_t> own = call.in.primitive;
        call.in.primitive.fill(0);
        run();
        call.in.primitive = own;
    }});
    return true;
}

const Mistake fixed_pass_mistakes[] = {
    {"weight_grows_with_depth", "weights that grow with the distance: the wrong sign of z", ChangedPart::programs,
     [](AlteredRun& e) {
         return is_run_by(e, {"weighted_blended", "weighted_blended_shared"}) &&
                with_depths(e, [](float depth) { return 1.0f - depth; });
     }},
    {"weight_without_alpha", "the weight of a depth alone, without its factor alpha", ChangedPart::programs,
     weighs_without_alpha},
    {"revealage_cleared_to_0", "the product of (1 - alpha) cleared to 0 instead of 1", ChangedPart::steps,
     clears_revealage_to_0},
    {"revealage_added", "the product of (1 - alpha) summed instead: one blend function for both targets",
     ChangedPart::steps, adds_revealage},
    {"sums_in_bytes", "sums of weighted colours in rgba8, where they stop at 1", ChangedPart::steps, sums_in_bytes},
    {"background_added_whole", "the background added without the transmittance of the average", ChangedPart::programs,
     [](AlteredRun& e) {
         return is_run_by(e, {"weighted_blended", "stochastic"}) &&
                resolves_by(e, [](float sum, float alpha, float through, float behind) {
                    return sum / alpha * (1.0f - through) + behind;
                });
     }},
    {"alpha_not_corrected", "sums composited as they are, not divided by their alpha and covering what all alphas say",
     ChangedPart::programs,
     [](AlteredRun& e) {
         return is_run_by(e, {"moments", "stochastic"}) &&
                resolves_by(e, [](float sum, float alpha, float, float behind) {
                    return sum + behind * (1.0f - std::min(alpha, 1.0f));
                });
     }},
    {"moments_without_bias", "moments without a bias: roundings make their matrix indefinite", ChangedPart::programs,
     [](AlteredRun& e) {
         e.options.algorithm.moment_bias = 0.0f;
         return is_run_by(e, {"moments"});
     }},
    {"moments_of_window_depth", "moments of depths from 0 to 1 instead of -1 to 1", ChangedPart::programs,
     [](AlteredRun& e) {
         return is_run_by(e, {"moments"}) && with_depths(e, [](float depth) { return (depth + 1.0f) / 2.0f; });
     }},
    {"absorbance_by_log2", "the absorbance by the logarithm to base 2, the transmittance by the natural exponential",
     ChangedPart::programs, takes_absorbance_by_log2},
    {"list_cut_at_4", "of a pixel's fragments the first 4 submitted kept", ChangedPart::device,
     [](AlteredRun& e) { return cuts_lists(e, 4, peeling::Overflow::drop_new); }},
    {"list_cut_at_8", "of a pixel's fragments the first 8 submitted kept", ChangedPart::device,
     [](AlteredRun& e) { return cuts_lists(e, 8, peeling::Overflow::drop_new); }},
    {"list_of_8_nearest", "of a pixel's fragments the nearest 8 kept", ChangedPart::device,
     [](AlteredRun& e) { return cuts_lists(e, 8, peeling::Overflow::drop_far); }},
    {"list_loses_every_second", "every second fragment of a list lost: its head read and written without an atomic",
     ChangedPart::steps, loses_every_second},
    {"one_node_too_few", "one node a pixel too few", ChangedPart::device, has_one_node_less},
    {"tail_lost", "what has no node is not shown", ChangedPart::steps,
     [](AlteredRun& e) { return changes_tail(e, peeling::Tail::none); }},
    {"tail_not_averaged", "what has no node blended in the order of submission instead of averaged", ChangedPart::steps,
     [](AlteredRun& e) { return is_run_by(e, {"hybrid_transparency"}) && changes_tail(e, peeling::Tail::blend); }},
    {"core_again_in_tail", "the nearest fragments drawn into the tail too", ChangedPart::programs, draws_core_again},
    {"tail_blended_twice", "what has no node blended twice", ChangedPart::programs, blends_tail_twice},
    {"one_mask_for_all", "all fragments of a pixel cover the same samples: a hash of the pixel alone",
     ChangedPart::programs, hashes_pixels_alone},
    {"buckets_of_whole_range", "buckets of the whole range of depths instead of the pixel's own", ChangedPart::steps,
     [](AlteredRun& e) {
         return is_run_by(e, {"bucket_peel"}) && with_clear(e, "bounds", {0, 1, 0, 0});
     }},
    {"bounds_cleared_to_0", "the bounds of a pixel's depths cleared to (0, 0)", ChangedPart::steps,
     [](AlteredRun& e) {
         return is_run_by(e, {"bucket_peel"}) && with_clear(e, "bounds", {0, 0, 0, 0});
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_fixed_passes() { return fixed_pass_mistakes; }

}  // namespace strata::oracle
