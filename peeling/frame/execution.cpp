// peeling/frame/execution.cpp - the conditions of literal execution, tile sizes and records (execution.h).
#include "peeling/frame/execution.h"

#include "peeling/frame/pass_limit.h"
#include "pipeline/fragments/tile_fragments.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// Memory that sorting takes per recorded fragment in addition to its word (sorted_lists.h).
constexpr std::uint64_t sorted_bytes = 4;

// A tile that stops early does not know how many passes the others make in the loops that it left, unless every answer
// depends on its own count; and a log of passes lists them all.
bool counts_passes_across_tiles(const Algorithm& algorithm, const RenderOptions& options,
                                const Instruments& instruments) {
    const bool is_open =
        options.termination.rule == TerminationRule::ratio || options.termination.rule == TerminationRule::fixed;
    return algorithm.runs_loops && ((limits_passes(options) && is_open) || instruments.log_passes);
}

}  // namespace

bool has_pixel_lists(const Algorithm& algorithm, const RenderOptions& options) noexcept {
    return algorithm.has_lists && options.algorithm.list_granularity == ListGranularity::pixel &&
           options.sampling.samples > 1;
}

bool is_closed(const RenderOptions& options, const Algorithm& algorithm) noexcept {
    const bool has_tail = options.algorithm.tail.value_or(Tail::none) != Tail::none;
    return algorithm.resolve_loop != nullptr && !has_tail && !options.keep_layers && options.background[3] == 1.0f;
}

int tile_size_of(const RenderOptions& options, const Algorithm& algorithm) noexcept {
    constexpr std::int64_t large = 128, many = 32;
    const bool has_many = std::int64_t{options.width} * options.height >= many * large * large;
    if (!algorithm.draws_again()) return options.tile_size.value_or(has_many ? large : 64);
    // Passes read the same fragments repeatedly: those of a small tile stay in the cache. A resolve reads them once.
    return options.tile_size.value_or(is_closed(options, algorithm) ? 64 : 32);
}

Execution execution_of(const Algorithm& algorithm, const RenderOptions& options, const Instruments& instruments) {
    const bool counts_nodes = algorithm.shares_nodes && options.algorithm.frame_nodes > 0;
    const bool is_literal = algorithm.whole_frame || leaves_samples(options) ||
                            counts_passes_across_tiles(algorithm, options, instruments) || counts_nodes ||
                            options.counters;
    return is_literal ? Execution::literal : options.execution;
}

// An algorithm of one pass gains nothing from a record.
std::string reason_for(const Work& work, const Algorithm& algorithm, const RenderOptions& options,
                       const Instruments& instruments) {
    if (work.path == Path::tiled && !algorithm.draws_again()) return "";
    if (work.path != Path::literal) return work.why;
    if (leaves_samples(options)) return "sample coverage and alpha to coverage are applied in every pass";
    if (options.counters) return "--counters counts in literal execution";
    if (options.execution == Execution::literal) return "--execution literal";
    if (execution_of(algorithm, options, instruments) == Execution::replay)
        return "a lookup, a depth or a cached block beyond a tile needs the whole frame";
    if (algorithm.whole_frame) return "queries nest, so that no tile may end by itself";
    return algorithm.shares_nodes ? "a limit of nodes counts across the frame"
                                  : "a limit of passes counts across loops";
}

// Simulating every effect requires rasterizing in every pass.
Replay replay_of(const Algorithm& algorithm, const RenderOptions& options, bool compares_apart) {
    const bool replays = options.execution == Execution::replay && options.effects == Effects::needed;
    if (!replays || !algorithm.draws_again()) return {};
    rasterizer::FragmentNeeds needs = algorithm.recorded();
    needs.reference = compares_apart;
    return {.bytes = options.fragment_memory / static_cast<std::uint64_t>(thread_count(options.threads)),
            .needs = needs,
            .bytes_per_fragment = TileFragments::bytes_of(needs) + sorted_bytes};
}

}  // namespace strata::peeling
