// tools/lab/cost/cost_run.cpp - renders one choice, compares its picture with the exact one, counts its work, and times
// it in turn with the defaults (cost_run.h).
#include "tools/lab/cost/cost_run.h"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "peeling/render.h"
#include "peeling/truth/truth.h"
#include "pipeline/frame/alteration.h"
#include "pipeline/region/region.h"

namespace strata::tools {

namespace {

using peeling::RenderResult;

[[nodiscard]] RenderResult rendered(const Session& session, const CostCell& cell, const peeling::RenderOptions& options,
                                    const pipeline::Instruments& instruments = {}) {
    return peeling::Renderer(session.request(options).on(cell.profile, options))
        .render(*cell.algorithm, {}, instruments);
}

[[nodiscard]] CostCell default_cell(const CostBase& base) { return cost_cells(base, {}).front(); }

[[nodiscard]] peeling::RealImage chain_picture(const CostScene& scene, const CostCell& cell) {
    return peeling::render_chain({scene.session.scene.list, scene.session.view, cell.profile, cell.options},
                                 *cell.chain);
}

[[nodiscard]] std::optional<peeling::RealImage> sorted_picture(const CostScene& scene, const CostCell& cell) {
    CostCell sorted = cell;
    sorted.algorithm = peeling::find_algorithm("a_buffer");
    sorted.options.termination = scene.base.options.termination;
    sorted.options.max_passes = scene.base.options.max_passes;
    sorted.options.audit = false;
    const RenderResult result = rendered(scene.session, sorted, sorted.options);
    if (result.refusal) return std::nullopt;
    return peeling::real_image(result.frame.color);
}

// A full-screen pass has one fragment per pixel.
[[nodiscard]] CardWork work_of(const CostScene& scene, const CostCell& cell, const RenderResult& result) {
    const auto& passes = result.frame.passes;
    const pipeline::Counters counters = result.frame.counters.value_or(pipeline::Counters{});
    const auto pixels =
        static_cast<std::uint64_t>(cell.options.width) * static_cast<std::uint64_t>(cell.options.height);
    return {scene.vertices * static_cast<std::uint64_t>(passes.geometry),
            counters.fragments_rasterized + pixels * static_cast<std::uint64_t>(passes.full_screen),
            counters.bytes_read + counters.bytes_written};
}

// Of what the algorithm makes beside the two targets of the opaque scene.
[[nodiscard]] int target_bytes(const pipeline::Region& region) {
    int bytes = 0;
    for (int id = 2; id < region.targets().count(); ++id) {
        const pipeline::TargetStorage& storage = region.storage({id});
        bytes += pipeline::info(storage.format()).bytes_per_pixel * storage.samples();
    }
    return bytes;
}

// Of buffers in the memory of a device: a head of 4 bytes a pixel and 24 a node (linked_list), or a code and a colour
// of 16 bytes an entry (algorithms.md 20 and 21).
[[nodiscard]] double buffer_bytes(const CostCell& cell, const RenderResult& result) {
    const auto pixels = static_cast<double>(cell.options.width) * cell.options.height;
    const std::string& name = cell.algorithm->name;
    const double nodes = static_cast<double>(result.frame.counters.value_or(pipeline::Counters{}).fragments_rasterized);
    const int most = cell.options.algorithm.pixel_nodes;
    if (name == "linked_list") return 4 + 24 * (most > 0 ? std::min(double(most), nodes / pixels) : nodes / pixels);
    const bool has_entries = name == "atomic_loop" || name == "hybrid_transparency";
    return has_entries ? 20.0 * cell.options.algorithm.nodes : 0;
}

// Set-up and passes are timed; loading, truth and audit (unless the audit is timed) are not.
[[nodiscard]] double seconds_of(const Session& session, const CostCell& cell, pipeline::Execution execution,
                                CostClock clock) {
    peeling::RenderOptions options = cell.options;
    options.execution = execution;
    options.nearest_depth = false;
    options.audit = cell.is_timed_with_audit;
    const double start = seconds_on(clock);
    static_cast<void>(rendered(session, cell, options));
    return seconds_on(clock) - start;
}

}  // namespace

int layers_of(const Session& session, const CostBase& base) {
    const CostCell cell = default_cell(base);
    return rendered(session, cell, cell.options).audit.layers_max;
}

void complete(CostScene& scene) {
    const CostCell cell = default_cell(scene.base);
    scene.truth = peeling::render_chain({scene.session.scene.list, scene.session.view, cell.profile, cell.options},
                                        peeling::exact_chain);
    const RenderResult result = rendered(scene.session, cell, cell.options);
    if (result.refusal) throw pipeline::Refused{cell.profile, *result.refusal};
    scene.pictured = peeling::real_image(result.frame.color);
}

CostResult run_cell(const CostScene& scene, const CostCell& cell) {
    CostResult found;
    if (cell.chain) {
        const peeling::RealImage picture = chain_picture(scene, cell);
        found.error = peeling::real_error(picture, scene.truth);
        found.from_default = peeling::real_error(picture, scene.pictured).pixels;
        return found;
    }
    peeling::RenderOptions counted = cell.options;
    counted.counters = true;
    int bytes = 0;
    const pipeline::Alteration look{.pass = [&](pipeline::Region& region, pipeline::PassState&, pipeline::PassKind) {
        bytes = std::max(bytes, target_bytes(region));
    }};
    const RenderResult result = rendered(scene.session, cell, counted, {.alteration = &look});
    if (result.refusal) {
        found.refusal = result.refusal->message(cell.profile);
        return found;
    }
    const peeling::RealImage picture = peeling::real_image(result.frame.color);
    found.error = peeling::real_error(picture, scene.truth);
    if (const auto sorted = sorted_picture(scene, cell)) found.sorted_rmse = peeling::real_error(picture, *sorted).rmse;
    found.from_default = peeling::real_error(picture, scene.pictured).pixels;
    found.order_errors = result.audit.order_errors;
    found.layers = result.audit.layers_max;
    found.passes = result.frame.passes;
    found.work = work_of(scene, cell, result);
    found.bytes_per_pixel = bytes + buffer_bytes(cell, result);
    found.modelled = modelled_seconds(card_of(scene.base.profile.has_fragment_programs), found.work);
    return found;
}

double seconds_on(CostClock clock) {
    if (clock == CostClock::processor) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

CostTimes time_cell(const CostScene& scene, const CostCell& cell, const CostTiming& timing) {
    CostTimes times;
    const CostCell reference = default_cell(scene.base);
    const auto seconds = [&](const CostCell& timed, pipeline::Execution execution) {
        return seconds_of(scene.session, timed, execution, timing.clock);
    };
    const auto literal_seconds = [&] { return seconds(cell, pipeline::Execution::literal); };
    const auto reference_seconds = [&] { return seconds(reference, reference.options.execution); };
    constexpr double long_run = 2;
    // The runs before the first round warm up, and determine whether literal execution is run in each round.
    static_cast<void>(reference_seconds());
    static_cast<void>(seconds(cell, cell.options.execution));
    const double first_literal = literal_seconds();
    const bool is_long = first_literal > long_run;
    double all = 0;
    for (int round = 0; wants_round(round, all, timing.rounds); ++round) {
        const double with = reference_seconds();
        const double taken = seconds(cell, cell.options.execution);
        const double literal = is_long ? first_literal : literal_seconds();
        all += with + taken + (is_long ? 0 : literal);
        times.seconds.push_back(taken);
        times.ratios.push_back(taken / with);
        times.literal.push_back(literal / with);
    }
    return times;
}

}  // namespace strata::tools
