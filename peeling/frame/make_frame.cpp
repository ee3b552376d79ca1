// peeling/frame/make_frame.cpp - fills a Frame: lists, depths, colours, memory (make_frame.h).
#include "peeling/frame/make_frame.h"

#include "peeling/audit/audit.h"
#include "peeling/frame/execution.h"
#include "peeling/frame/render_diagnostics.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

void set_lists(Frame& f, const Algorithm& algorithm, FrameSetup& setup) {
    PreparedLists& lists = setup.lists_for(algorithm);
    f.opaque = lists.opaque();
    f.transparent = &lists.transparent(algorithm.order);
    f.second = lists.second();
    lists.bin(tile_size_of(setup.options, algorithm));
    f.shadow = setup.light ? &setup.light->stage : nullptr;
    f.fog = setup.options.fog ? &*setup.options.fog : nullptr;
    f.blank_tiles_are_equal = true;  // no program here reads x or y
}

void set_depths(Frame& f, const Algorithm& algorithm, const FrameSetup& setup) {
    f.depth = setup.depth_of(algorithm);
    if (algorithm.is_oracle) f.depth.path = rasterizer::DepthPath::exact;
    f.key = algorithm.key;
    f.epsilon = setup.options.compare_epsilon;
    f.quantize_reference = setup.quantizes();
    // A depth unit compares the depth of the sample, however often programs run.
    f.compares_at_pixel = setup.shades_pixels() && !needs(algorithm, Feature::sequential_depth_units);
}

void set_colors(Frame& f, const FrameSetup& setup) {
    const RenderOptions& options = setup.options;
    f.color_format = setup.color_format;
    if (options.result_format != setup.color_format) f.published_format = options.result_format;
    if (options.back_format != setup.color_format) f.back_format = options.back_format;
    f.background = options.background;
    f.average_count = options.average_count;
}

// The audit needs the traces of all algorithms that composite fragments; each worker has an equal share of the memory.
void set_memory(Frame& f, const Algorithm& algorithm, const FrameSetup& setup, const Instruments& instruments) {
    const bool is_literal = execution_of(algorithm, setup.options, instruments) == Execution::literal;
    const AuditMemory memory{setup.audit_memory(), is_literal ? 1 : thread_count(setup.options.threads)};
    f.trace = setup.options.audit && algorithm.ties != TiePolicy::none;
    f.trace_bytes = memory.trace_bytes();
    f.list_bytes = memory.bytes / static_cast<std::uint64_t>(memory.workers);
    f.replay = replay_of(algorithm, setup.options, !f.depth_compare().is_plain());
}

}  // namespace

Frame make_frame(const Algorithm& algorithm, FrameSetup& setup, const Instruments& instruments) {
    const RenderOptions& options = setup.options;
    Frame f;
    f.profile = &setup.profile;
    set_lists(f, algorithm, setup);
    set_depths(f, algorithm, setup);
    set_colors(f, setup);
    set_memory(f, algorithm, setup, instruments);
    f.termination = options.termination;
    f.formulation = options.formulation;
    f.effects = options.effects;
    f.keep_layers = options.keep_layers;
    f.nearest_depth = options.nearest_depth;
    f.loads = options.sampling.loads;
    f.composites = options.sampling.composites;
    f.resolve = options.sampling.resolve;
    f.keep_samples = options.keep_samples || options.audit;  // the audit compares the picture of each sample
    f.checks_targets = algorithm.body || (algorithm.run_with != nullptr && needs(algorithm, Feature::float_targets));
    return f;
}

}  // namespace strata::peeling
