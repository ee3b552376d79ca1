// tools/oracle/emulations/of_reported_ports.cpp - mistakes that public reports of ports describe, most of them in the
// algorithms with a fixed number of passes; the report is named beside each that has one.
#include <algorithm>
#include <array>
#include <memory>
#include <unordered_set>

#include "peeling/programs/depth_float.h"
#include "peeling/programs/fixed_passes/node_depths.h"
#include "tools/oracle/emulations/program_change.h"

namespace strata::oracle {

namespace {

using namespace pipeline;

rasterizer::DepthFormat depth_format_of(const AlteredRun& e) { return e.profile.depth_buffer(e.options.depth); }

// peridyno #93: the list is cut from its head, where the last submitted fragment is.
bool keeps_last_8(AlteredRun& e) {
    peeling::AlgorithmOptions& options = e.options.algorithm;
    if (!is_run_by(e, {"linked_list"}) || (options.pixel_nodes > 0 && options.pixel_nodes <= 8)) return false;
    options.pixel_nodes = 8;
    options.overflow = peeling::Overflow::drop_new;
    return find_mistake("order_reversed")->make(e);
}

// peridyno #93: `if (depth == previous) continue;` in the loop that composites the sorted list.
bool skips_equal_depths(AlteredRun& e) {
    if (!is_run_by(e, {"linked_list"})) return false;
    const auto seen = std::make_shared<std::unordered_set<std::uint64_t>>();
    e.alterations.push_back({.program = [seen](const ProgramCall& call, const std::function<void()>& run) {
        if (call.kind == pipeline::PassKind::geometry)
            for (std::size_t i = 0; i < lanes_of_call(call); ++i)
                if (call.out.alive[i] != 0 &&
                    !seen->insert(std::uint64_t{call.in.pixel[i]} << 32 | call.in.code[i]).second)
                    call.out.alive[i] = 0;
        run();
    }});
    return true;
}

// Cesium #2441 and others: colours that are not multiplied by alpha before they are weighted.
bool sums_straight_colors(AlteredRun& e) {
    if (!is_run_by(e, {"weighted_blended"})) return false;
    return behind_pass_of(e, pipeline::PassKind::geometry, "sums", [](const ProgramCall& call) {
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < lanes_of_call(call); ++i)
                if (call.in.color[3][i] > 0) call.out.color[0][c][i] /= call.in.color[3][i];
    });
}

// WebGL without OES_draw_buffers_indexed: blending is enabled for the first target alone.
bool replaces_revealage(AlteredRun& e) {
    if (!is_run_by(e, {"weighted_blended"})) return false;
    e.alterations.push_back({.pass = [names = e.names](Region&, PassState& state, pipeline::PassKind kind) {
        if (kind == pipeline::PassKind::geometry && names->is(state.color[1], "revealage")) state.blend[1] = Blend{};
    }});
    return true;
}

// candlewick, pull request 110: the weight is missing in the sum of alphas, which then does not divide it out.
bool sums_plain_alphas(AlteredRun& e) {
    if (!is_run_by(e, {"weighted_blended"})) return false;
    return behind_pass_of(e, pipeline::PassKind::geometry, "sums",
                          [](const ProgramCall& call) { call.out.color[0][3] = call.in.color[3]; });
}

// The weighted alpha is written to both targets.
bool weighs_revealage(AlteredRun& e) {
    if (!is_run_by(e, {"weighted_blended"})) return false;
    return behind_pass_of(e, pipeline::PassKind::geometry, "sums", [](const ProgramCall& call) {
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < lanes_of_call(call); ++i)
                call.out.color[1][c][i] = std::min(call.out.color[0][3][i], 1.0f);
    });
}

// Moments are built from depths from -1 to 1 and read at depths from 0 to 1.
bool reads_moments_at_window_depth(AlteredRun& e) {
    if (!is_run_by(e, {"moments"}) || e.options.raster.depth_order == rasterizer::DepthOrder::greater) return false;
    e.alterations.push_back({.program = [names = e.names](const ProgramCall& call, const std::function<void()>& run) {
        if (call.kind != pipeline::PassKind::geometry || !names->is(call.state.color[0], "sums")) return run();
        const Lanes<float> own = call.in.shader_z;
        for (std::size_t i = 0; i < lanes_of_call(call); ++i) call.in.shader_z[i] = (own[i] + 1.0f) / 2.0f;
        run();
        call.in.shader_z = own;
    }});
    return true;
}

// The last quad blends the front, which is premultiplied, by its coverage.
bool multiplies_front_again(AlteredRun& e) {
    const bool covers = is_run_by(e, {"dual"});
    if (!covers && !is_run_by(e, {"front_to_back"})) return false;
    e.alterations.push_back(
        {.program = [names = e.names, covers](const ProgramCall& call, const std::function<void()>& run) {
            run();
            if (call.kind != pipeline::PassKind::full_screen || !names->is(call.state.color[0], "result")) return;
            const ColorLanes& front = call.loads.color(0);
            for (std::size_t i = 0; i < lanes_of_call(call); ++i) {
                const float through = covers ? 1.0f - front[3][i] : front[3][i];
                for (std::size_t c = 0; c < 3; ++c) call.out.color[0][c][i] -= front[c][i] * through;
            }
        }});
    return true;
}

// Alpha to coverage in place of a mask by chance: fragments of one alpha cover the same samples (Enderton et al. 2010,
// section 3).
bool masks_by_alpha(AlteredRun& e) {
    if (!is_run_by(e, {"stochastic"})) return false;
    const int samples = e.options.algorithm.stochastic_samples;
    return behind_pass_of(
        e, pipeline::PassKind::geometry, "samples", [samples, format = depth_format_of(e)](const ProgramCall& call) {
            for (std::size_t i = 0; i < lanes_of_call(call); ++i) {
                const int covered = static_cast<int>(call.in.color[3][i] * static_cast<float>(samples) + 0.5f);
                for (std::size_t s = 0; s < static_cast<std::size_t>(samples); ++s)
                    call.out.color[s / 4][s % 4][i] = static_cast<int>(s) < covered
                                                          ? 0.0f - peeling::depth_as_float(call.in.code[i], format)
                                                          : -peeling::no_node;
            }
        });
}

// vkQuake #925: a fragment is seen through all of its own absorbance, or through none.
bool overestimates(AlteredRun& e, float share) {
    if (!is_run_by(e, {"moments"}) || e.options.algorithm.overestimation == share) return false;
    e.options.algorithm.overestimation = share;
    return true;
}

struct MergedNode {
    float depth = peeling::no_node;
    std::array<float, 4> layer{0, 0, 0, 1};
};

// skyrim-community-shaders #2564: what no longer fits is lost instead of merged into the last layer.
void insert_without_merging(const ProgramCall& call, std::size_t count, rasterizer::DepthFormat format, std::size_t i) {
    std::array<MergedNode, peeling::most_nodes> nodes;
    const std::size_t first = (count + 3) / 4;
    for (std::size_t e = 0; e < count; ++e) {
        nodes[e].depth = peeling::depth_of_node(call.loads, e, i);
        for (std::size_t c = 0; c < 4; ++c) nodes[e].layer[c] = call.loads.color(static_cast<int>(first + e))[c][i];
    }
    const float a = call.in.color[3][i];
    MergedNode node{peeling::depth_as_float(call.in.code[i], format),
                    {call.in.color[0][i] * a, call.in.color[1][i] * a, call.in.color[2][i] * a, 1.0f - a}};
    for (std::size_t e = 0; e < count; ++e)
        if (node.depth <= nodes[e].depth) std::swap(node, nodes[e]);
    for (std::size_t e = 0; e < count; ++e) {
        call.out.color[e / 4][e % 4][i] = nodes[e].depth;
        for (std::size_t c = 0; c < 4; ++c) call.out.color[first + e][c][i] = nodes[e].layer[c];
    }
}

bool drops_what_does_not_fit(AlteredRun& e) {
    if (!is_run_by(e, {"multi_layer"})) return false;
    const auto count = static_cast<std::size_t>(e.options.algorithm.nodes);
    return behind_pass_of(e, pipeline::PassKind::geometry, "depths",
                          [count, format = depth_format_of(e)](const ProgramCall& call) {
                              for (std::size_t i = 0; i < lanes_of_call(call); ++i)
                                  insert_without_merging(call, count, format, i);
                          });
}

// A bucket's second layer, its far end, is not composited: the loop over layers steps by two.
bool loses_far_ends(AlteredRun& e) {
    if (!is_run_by(e, {"bucket_peel"})) return false;
    const auto number = std::make_shared<std::uint64_t>(0);
    e.alterations.push_back({.pass = [names = e.names, number](Region&, PassState& state, pipeline::PassKind kind) {
        if (kind == pipeline::PassKind::full_screen && names->is(state.reads[0], "layer") && (*number)++ % 2 == 1)
            state.blend[0].write_mask = 0;
    }});
    return true;
}

const Mistake reported_mistakes[] = {
    {"list_of_8_last", "of a pixel's fragments the last 8 submitted kept: the list cut from its head",
     ChangedPart::device, keeps_last_8},
    {"list_skips_equal_depths", "fragments at the depth of the one before skipped as the list is composited",
     ChangedPart::programs, skips_equal_depths},
    {"sums_not_premultiplied", "colours weighted but not multiplied by their alpha", ChangedPart::programs,
     sums_straight_colors},
    {"revealage_replaced", "the product of (1 - alpha) not blended: the last fragment's stays", ChangedPart::steps,
     replaces_revealage},
    {"alphas_not_weighted", "the weight missing in the sum of alphas that the colours are divided by",
     ChangedPart::programs, sums_plain_alphas},
    {"revealage_weighted", "alpha times the weight in the product of (1 - alpha) too", ChangedPart::programs,
     weighs_revealage},
    {"moments_of_two_ranges", "moments built from depths from -1 to 1 and read at depths from 0 to 1",
     ChangedPart::programs, reads_moments_at_window_depth},
    {"front_multiplied_again", "the front multiplied by its coverage again as it is laid over the back",
     ChangedPart::programs, multiplies_front_again},
    {"mask_by_alpha_alone", "samples masked by alpha to coverage: fragments of one alpha cover the same samples",
     ChangedPart::programs, masks_by_alpha},
    {"absorbance_all_its_own", "fragments seen through all of their own absorbance", ChangedPart::programs,
     [](AlteredRun& e) { return overestimates(e, 1); }},
    {"absorbance_none_its_own", "fragments seen through none of their own absorbance", ChangedPart::programs,
     [](AlteredRun& e) { return overestimates(e, 0); }},
    {"overflow_not_merged", "what no longer fits into a pixel's layers lost instead of merged into the last",
     ChangedPart::programs, drops_what_does_not_fit},
    {"far_ends_lost", "of each bucket the nearest fragment alone", ChangedPart::steps, loses_far_ends},
};

}  // namespace

std::span<const Mistake> mistakes_of_reported_ports() { return reported_mistakes; }

}  // namespace strata::oracle
