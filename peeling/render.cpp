// peeling/render.cpp - renders a frame from options: check the options, prepare lists, check features, run, audit.
#include "peeling/render.h"

#include <algorithm>

#include "peeling/as_shown.h"
#include "peeling/audit/audit.h"
#include "peeling/audit/region_trace.h"
#include "peeling/check_options.h"
#include "peeling/pass_limit.h"
#include "peeling/prepared_lists.h"
#include "peeling/raster_state.h"
#include "peeling/registry.h"
#include "peeling/render_diagnostics.h"
#include "peeling/shadow_light.h"
#include "peeling/stopwatch.h"
#include "pipeline/fragments/tile_fragments.h"
#include "pipeline/frame/check_pass.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/executor.h"
#include "pipeline/region/region_shortcuts.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/parallel.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// Memory that sorting takes per recorded fragment in addition to its word (sorted_lists.h).
constexpr std::uint64_t sorted_bytes = 4;

}  // namespace

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

struct Renderer::State {
    DeviceProfile profile;
    RenderOptions options;
    rasterizer::DepthRequest depth{};
    Format color_format = Format::rgba8;
    bool is_perspective;  // of the view: w is not constant
    std::unique_ptr<const LightMap> light{};
    PreparedLists lists;
    std::optional<PreparedLists> quotient_lists{};  // with r and q of every vertex, for algorithms that take them
    std::optional<int> deepest{};                   // fragments of the deepest pixel, once computed
    bool was_invariant = true;                      // of the last frame that ran

    [[nodiscard]] Execution execution(const Algorithm& algorithm, const Instruments& instruments) const {
        // A tile that stops early does not know how many passes the others make in the loops that it left, unless every
        // answer depends on its own count; and a log of passes lists them all.
        const bool is_open =
            options.termination.rule == TerminationRule::ratio || options.termination.rule == TerminationRule::fixed;
        const bool counts_across =
            algorithm.runs_loops && ((limits_passes(options) && is_open) || instruments.log_passes);
        const bool counts_nodes = algorithm.shares_nodes && options.algorithm.frame_nodes > 0;
        const bool is_group = instruments.samples.group != nullptr;
        return algorithm.whole_frame || leaves_samples(options) || counts_across || counts_nodes || options.counters ||
                       is_group
                   ? Execution::literal
                   : options.execution;
    }

    // Adds reasons that the executor does not know. An algorithm of one pass gains nothing from a record.
    void note_path(const Algorithm& algorithm, const Instruments& instruments, Work& work) const {
        if (work.path == Path::tiled && !algorithm.draws_again()) work.why.clear();
        if (work.path != Path::literal) return;
        if (instruments.samples.group != nullptr)
            work.why = "loads of another sample, or instruments, need all samples step by step";
        else if (leaves_samples(options))
            work.why = "sample coverage and alpha to coverage are applied in every pass";
        else if (options.counters)
            work.why = "--counters counts in literal execution";
        else if (options.execution == Execution::literal)
            work.why = "--execution literal";
        else if (execution(algorithm, instruments) == Execution::replay)
            work.why = "a lookup, a depth or a cached block beyond a tile needs the whole frame";
        else
            work.why = algorithm.whole_frame    ? "queries nest, so that no tile may end by itself"
                       : algorithm.shares_nodes ? "a limit of nodes counts across the frame"
                                                : "a limit of passes counts across loops";
    }

    [[nodiscard]] std::uint64_t audit_memory() const { return std::max(options.fragment_memory, least_audit_memory); }

    // The depth paths that the algorithm stores and compares.
    [[nodiscard]] rasterizer::DepthRequest depth_of(const Algorithm& algorithm) const {
        rasterizer::DepthRequest request = depth;
        if (algorithm.stores) request.path = *algorithm.stores;
        if (!request.reference) request.reference = algorithm.compares;
        return request;
    }

    PreparedLists& lists_for(const Algorithm& algorithm) {
        const rasterizer::DepthRequest request = depth_of(algorithm);
        if (!takes_quotient(request) || takes_quotient(depth)) return lists;
        if (!quotient_lists) {
            PreparedLists::Settings settings = lists.settings();
            settings.depth = request;
            quotient_lists.emplace(std::move(settings));
        }
        return *quotient_lists;
    }

    // Simulating every effect requires rasterizing in every pass.
    [[nodiscard]] Replay replay(const Algorithm& algorithm, bool compares_apart) const {
        const bool replays = options.execution == Execution::replay && options.effects == Effects::needed;
        if (!replays || !algorithm.draws_again()) return {};
        rasterizer::FragmentNeeds needs = algorithm.recorded();
        needs.reference = compares_apart;
        return {.bytes = options.fragment_memory / static_cast<std::uint64_t>(thread_count(options.threads)),
                .needs = needs,
                .bytes_per_fragment = TileFragments::bytes_of(needs) + sorted_bytes};
    }

    [[nodiscard]] Frame frame(const Algorithm& algorithm, const Instruments& instruments = {}) {
        Frame f;
        f.profile = &profile;
        PreparedLists& own = lists_for(algorithm);
        f.opaque = own.opaque();
        f.transparent = &own.transparent(algorithm.order);
        f.second = own.second();
        own.bin(tile_size_of(options, algorithm));
        f.shadow = light ? &light->stage : nullptr;
        f.epsilon = options.compare_epsilon;
        f.quantize_reference = quantizes();
        // A depth unit compares the depth of the sample, however often programs run.
        f.compares_at_pixel = shades_pixels() && !needs(algorithm, Feature::sequential_depth_units);
        f.depth = depth_of(algorithm);
        if (algorithm.is_oracle) f.depth.path = rasterizer::DepthPath::exact;
        f.key = algorithm.key;
        f.color_format = color_format;
        if (options.result_format != color_format) f.published_format = options.result_format;
        if (options.back_format != color_format) f.back_format = options.back_format;
        f.background = options.background;
        f.termination = options.termination;
        f.formulation = options.formulation;
        f.effects = options.effects;
        f.replay = replay(algorithm, !f.depth_compare().is_plain());
        f.blank_tiles_are_equal = true;  // no program here reads x or y
        f.keep_layers = options.keep_layers;
        const AuditMemory memory{
            audit_memory() / static_cast<std::uint64_t>(instruments.samples.count),
            execution(algorithm, instruments) == Execution::literal ? 1 : thread_count(options.threads)};
        f.trace = options.audit && algorithm.ties != TiePolicy::none;
        f.trace_bytes = memory.trace_bytes();
        f.list_bytes = memory.bytes / static_cast<std::uint64_t>(memory.workers);
        f.checks_targets =
            algorithm.body || (algorithm.run_with != nullptr && needs(algorithm, Feature::float_targets));
        f.nearest_depth = options.nearest_depth;
        f.max_passes = pass_limit(algorithm, options, f, deepest);
        f.average_count = options.average_count;
        return f;
    }

    [[nodiscard]] Verdict refusal(const Algorithm& algorithm) const {
        if (algorithm.run == nullptr && algorithm.run_with == nullptr && !algorithm.body)
            throw InputError("algorithm '" + algorithm.name + "'", "run", "a function, or one in body", "neither");
        if (auto lacking = check_size(profile, options.width, options.height)) return lacking;
        if (auto lacking = check_depth(profile, depth_of(algorithm))) return lacking;
        const auto has_w = [&](rasterizer::DepthPath path) {
            return path == rasterizer::DepthPath::w_buffer && !is_perspective;
        };
        const rasterizer::DepthRequest request = depth_of(algorithm);
        if (has_w(request.path) || (request.reference && has_w(*request.reference)))
            return Refusal{"w buffer for a parallel projection, whose w is 1 everywhere", "",
                           "use depth path window_z, or a camera with perspective"};
        if (compares_w_with_depth(request))
            return Refusal{"comparison of w with a depth, of which one is stored and the other compared", "",
                           "use w_buffer for both: --depth-path w_buffer --reference-path w_buffer"};
        for (const auto& format : {std::optional(color_format), options.result_format, options.back_format})
            if (auto lacking = format ? check(profile, *format) : std::nullopt) return lacking;
        if (options.back_format && !algorithm.takes_both_ends)
            return Refusal{"back of its own in " + algorithm.name + ", which composites at one end", "",
                           "use dual or dual_independent"};
        if (auto lacking = check_order(options, depth.format, lists.settings().list.light.has_value())) return lacking;
        if (options.raster.depth_clamp)
            if (auto lacking = check(profile, Feature::depth_clamp)) return lacking;
        if (auto lacking = check_shading(profile, algorithm, request, options.raster.interpolation)) return lacking;
        if (options.keep_layers && !algorithm.makes_layers)
            return Refusal{"layers in " + algorithm.name + ", which composites on the fly", "",
                           "use dual or front_to_back"};
        if (algorithm.compares_own_codes && !is_invariant())
            return Refusal{"choice of the depth that " + algorithm.name + " compares", "",
                           "use depth_units, front_to_back, dual or dual_independent"};
        return peeling::refusal(algorithm, profile);
    }

    // True if a compared depth is rounded like a stored one.
    [[nodiscard]] bool quantizes() const {
        return options.quantize_reference && profile.raster.hypothesis.quantize_reference;
    }

    [[nodiscard]] bool shades_pixels() const noexcept {
        return options.raster.interpolation != rasterizer::Interpolation::sample;
    }

    [[nodiscard]] AsShown shown() const noexcept { return {options, profile}; }

    // The options imply that every pass of a peel sees the same fragments and compares the depth that it stores.
    [[nodiscard]] bool is_invariant() const {
        return lists.second() == nullptr && quantizes() && options.compare_epsilon == CompareEpsilon{} &&
               depth.reference.value_or(depth.path) == depth.path;
    }

    // Runs the frame; the audit examines regions as they end. If `traces` is set, it receives traces and no audit runs.
    void run_frame(const Algorithm& algorithm, const std::function<void(double)>& progress,
                   const Instruments& instruments, std::vector<RegionTrace>* traces, RenderResult& result) {
        Frame f = frame(algorithm, instruments);
        was_invariant = f.is_invariant();
        if (instruments.samples.loads_others() && !limits_passes(options))
            f.max_passes = std::max(f.max_passes, loads_limit(algorithm, f, deepest));
        if (traces != nullptr) {
            f.trace = true;
            f.trace_bytes = ~std::uint64_t{0};
        } else if (f.trace && instruments.samples.loads_others()) {
            f.trace_bytes = trace_bytes_of_sample(instruments.samples, *f.transparent, audit_memory());
        }
        const Body body =
            body_of(algorithm, {options.algorithm, eye_distance(lists.settings().view, lists.settings().raster)});
        std::optional<Audit> audit;
        if (options.audit && traces == nullptr)
            audit.emplace(f, body, algorithm, audit_memory(), options.threads, instruments.samples);
        const RegionCallbacks callbacks = traces != nullptr ? keep_traces(*traces)
                                          : audit           ? audit->callbacks()
                                                            : RegionCallbacks{};
        {
            const Stopwatch stopwatch{result.seconds.passes};
            result.frame =
                run(f, body, execution(algorithm, instruments), options.threads, progress, instruments, callbacks);
        }
        note_path(algorithm, instruments, result.frame.work);
        result.seconds.audit = result.frame.watched * result.seconds.passes;
        result.seconds.passes -= result.seconds.audit;
        if (!algorithm.compares_own_codes || may_stall(algorithm, profile, options))
            note_endless(algorithm, f, options, result.frame);
        if (!audit) return;
        const Stopwatch stopwatch{result.seconds.audit};
        result.audit = audit->finish(result.frame);
    }

    [[nodiscard]] RenderResult render(const Algorithm& algorithm, const std::function<void(double)>& progress,
                                      const Instruments& instruments, std::vector<RegionTrace>* traces) {
        RenderResult result;
        result.refusal = refusal(algorithm);
        if (!result.refusal) try {
                run_frame(algorithm, progress, instruments, traces, result);
            } catch (const Refused& refused) {
                result.refusal = refused.refusal;
            }
        result.seconds.geometry = lists.seconds() + (quotient_lists ? quotient_lists->seconds() : 0.0);
        if (result.refusal) {
            result.outcome = Outcome::refused;
            return result;
        }
        // Triangles are reported by their index in the list as given, which is prepared here if it was not drawn.
        if (lists_for(algorithm).transparent(algorithm.order).geometry.counters.non_finite > 0)
            note_set_up(lists.transparent(ListOrder::given).geometry.counters, result.frame.diagnostics);
        note_machine(algorithm, depth.format, quantizes(), result.frame.diagnostics);
        if (options.audit && traces == nullptr)
            add_audit_diagnostics(algorithm, options, {was_invariant, flushes_depths(profile, options.raster)},
                                  result.audit, result.frame.diagnostics);
        shown().turn(result.frame);
        shown().turn(result.audit);
        if (traces != nullptr) shown().turn(*traces);
        return result;
    }
};

Renderer::Renderer(const DrawList& list, const View& view, const DeviceProfile& profile, const RenderOptions& options) {
    check_options(options);
    const SimdScope kernels{options.simd};
    const bool is_exact = profile.raster.depth_path == rasterizer::DepthPath::exact;
    rasterizer::DepthRequest depth;
    depth.format = profile.depth_buffer(options.depth);
    depth.path = options.depth_path.value_or(profile.raster.depth_path);
    depth.reference = options.reference_path;
    View first = view;
    first.vertex_path = options.vertex_paths.first.value_or(view.vertex_path);
    const rasterizer::RasterState raster = raster_state(options, profile);
    auto light = light_map(list, profile, raster, options.threads);
    state_ = std::unique_ptr<State>(
        new State{.profile = profile,
                  .options = options,
                  .depth = depth,
                  .color_format = options.color_format.value_or(is_exact ? Format::rgba32f : Format::rgba8),
                  .is_perspective = has_perspective(first),
                  .light = nullptr,
                  .lists = PreparedLists{{.list = list,
                                          .view = first,
                                          .profile = profile,
                                          .options = options,
                                          .raster = raster,
                                          .depth = depth,
                                          .light = light.get()}}});
    state_->light = std::move(light);
}

Renderer::~Renderer() = default;

RenderResult Renderer::render(const Algorithm& algorithm, const std::function<void(double)>& progress,
                              const Instruments& instruments) {
    const SimdScope kernels{state_->options.simd};
    return state_->render(algorithm, progress, instruments, nullptr);
}

RenderResult Renderer::render_traced(const Algorithm& algorithm, std::vector<RegionTrace>& traces,
                                     const Instruments& instruments) {
    const SimdScope kernels{state_->options.simd};
    return state_->render(algorithm, {}, instruments, &traces);
}

RenderResult Renderer::depth_pass(const std::function<void(double)>& progress, const Instruments& instruments) {
    const SimdScope kernels{state_->options.simd};
    RenderResult result;
    result.refusal = check_size(state_->profile, state_->options.width, state_->options.height);
    if (!result.refusal) result.refusal = check_depth(state_->profile, state_->depth);
    if (!result.refusal) result.refusal = check(state_->profile, state_->color_format);
    const Algorithm& one_pass = *find_algorithm("unsorted");
    if (!result.refusal)
        result.refusal = check_shading(state_->profile, one_pass, state_->depth, state_->options.raster.interpolation);
    if (result.refusal) {
        result.outcome = Outcome::refused;
        return result;
    }
    Frame frame = state_->frame(one_pass);
    frame.nearest_depth = frame.trace = false;
    frame.published_format = target_format(frame.key_request().format);
    const Stopwatch watch{result.seconds.passes};
    result.frame = run(frame, draw_depth, state_->execution(one_pass, instruments), state_->options.threads, progress,
                       instruments);
    std::swap(result.frame.depth, result.frame.color);
    state_->shown().turn(result.frame);
    result.seconds.geometry = state_->lists.seconds();
    return result;
}

FrameFragments Renderer::fragments(const Algorithm& algorithm) {
    const SimdScope kernels{state_->options.simd};
    if (auto lacking = state_->refusal(algorithm)) throw Refused{state_->profile, *std::move(lacking)};
    const Frame frame = state_->frame(algorithm);
    const std::uint64_t fragments = fragment_count(*frame.transparent);
    const std::uint64_t bytes = FrameFragments::bytes_per_fragment * fragments;
    if (bytes > state_->audit_memory())
        throw InputError("strata", "--fragment-memory",
                         "at least " + std::to_string(bytes) + " bytes for the frame's " + std::to_string(fragments) +
                             " fragments all together",
                         std::to_string(state_->audit_memory()));
    FrameFragments found;
    const Body capture = [&](Region& region) {
        found.all = RegionShortcuts{region}.capture(Counting::counted);
        const std::uint32_t* opaque = region.storage(region.opaque_depth()).depth(0);
        found.opaque.assign(opaque, opaque + region.rect().area());
        region.publish(region.opaque_color());
    };
    static_cast<void>(run(frame, capture, Execution::literal, 1));
    state_->shown().turn(found);
    return found;
}

int Renderer::limiting_depth(const Algorithm& algorithm) {
    if (state_->refusal(algorithm)) return 0;
    return state_->frame(algorithm).max_passes == 0 ? 0 : state_->deepest.value_or(0);
}

void Renderer::set_limiting_depth(int deepest) { state_->deepest = deepest; }

DepthFormat Renderer::depth_format() const noexcept { return state_->depth.format; }
Format Renderer::color_format() const noexcept { return state_->color_format; }

}  // namespace strata::peeling
