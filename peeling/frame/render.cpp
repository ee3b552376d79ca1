// peeling/frame/render.cpp - a frame in steps: refuse, make the frame, run it with its audit, diagnose, turn as shown.
// Each step is a function of its own (peeling/frame/).
#include "peeling/render.h"

#include <algorithm>

#include "peeling/audit/audit.h"
#include "peeling/audit/region_trace.h"
#include "peeling/frame/execution.h"
#include "peeling/frame/make_frame.h"
#include "peeling/frame/pass_limit.h"
#include "peeling/frame/refusal.h"
#include "peeling/frame/render_diagnostics.h"
#include "peeling/frame/setup.h"
#include "peeling/frame/stopwatch.h"
#include "peeling/raster_state.h"
#include "peeling/registry.h"
#include "pipeline/frame/check_pass.h"
#include "pipeline/frame/effects.h"
#include "pipeline/region/executor.h"
#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/base/input_error.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

// The arguments of one call.
struct RenderCall {
    const std::function<void(double)>& progress;
    const Instruments& instruments;
    std::vector<RegionTrace>* traces;  // null: the frame is audited, if the options say so
};

RenderResult refused(Refusal refusal) {
    RenderResult result;
    result.outcome = Outcome::refused;
    result.refusal = std::move(refusal);
    return result;
}

// Runs the passes; the audit, if there is one, examines regions as they end.
RenderResult run_passes(const Frame& frame, const Body& body, const FrameSetup& setup, const Algorithm& algorithm,
                        const RenderCall& call) {
    const Instruments& instruments = call.instruments;
    const int threads = setup.options.threads;
    std::optional<Audit> audit;
    if (setup.options.audit && call.traces == nullptr)
        audit.emplace(frame, body, algorithm, setup.audit_memory(), threads);
    const RegionCallbacks callbacks = call.traces != nullptr ? keep_traces(*call.traces)
                                      : audit                ? audit->callbacks()
                                                             : RegionCallbacks{};
    RenderResult result;
    {
        const Stopwatch stopwatch{result.seconds.passes};
        const Execution execution = execution_of(algorithm, setup.options, instruments);
        result.frame = run(frame, body, execution, threads, call.progress, instruments, callbacks);
    }
    result.frame.work.why = reason_for(result.frame.work, algorithm, setup.options, instruments);
    result.seconds.audit = result.frame.watched * result.seconds.passes;
    result.seconds.passes -= result.seconds.audit;
    if (!audit) return result;
    const Stopwatch stopwatch{result.seconds.audit};
    result.audit = audit->finish(result.frame);
    return result;
}

void add_diagnostics(const Frame& frame, FrameSetup& setup, const Algorithm& algorithm, bool is_audited,
                     RenderResult& result) {
    const RenderOptions& options = setup.options;
    std::vector<Diagnostic>& all = result.frame.diagnostics;
    if (!algorithm.compares_own_codes || may_stall(algorithm, setup.profile, options) || frame.loads_others())
        note_endless(algorithm, frame, options, result.frame);
    // Triangles are reported by their index in the list as given, which is prepared here if it was not drawn.
    if (frame.transparent->geometry.counters.non_finite > 0)
        note_set_up(setup.lists.transparent(ListOrder::given).geometry.counters, all);
    note_extensions(algorithm, setup.depth.format, setup.quantizes(), all);
    if (is_audited)
        add_audit_diagnostics(algorithm, options, {frame.is_invariant(), flushes_depths(setup.profile, options.raster)},
                              result.audit, all);
}

void turn_as_shown(const AsShown& shown, RenderResult& result, std::vector<RegionTrace>* traces) {
    shown.turn(result.frame);
    shown.turn(result.audit);
    if (traces != nullptr) shown.turn(*traces);
}

}  // namespace

struct Renderer::State {
    FrameSetup setup;
    std::optional<int> deepest{};  // fragments of the deepest pixel, once computed

    [[nodiscard]] int passes_of(const PassLimit& limit, const Frame& frame) {
        if (limit.per_fragment == 0) return limit.constant;
        if (!deepest) deepest = static_cast<int>(deepest_pixel(*frame.transparent));
        return limit.constant + limit.per_fragment * *deepest;
    }

    [[nodiscard]] Frame frame(const Algorithm& algorithm, const Instruments& instruments) {
        Frame f = make_frame(algorithm, setup, instruments);
        f.max_passes = passes_of(pass_limit(algorithm, setup.options, f), f);
        if (f.loads_others() && !limits_passes(setup.options))
            f.max_passes = std::max(f.max_passes, passes_of(loads_limit(algorithm), f));
        return f;
    }

    // Traces that are kept have no limit.
    static void set_trace(const RenderCall& call, Frame& f) {
        if (call.traces == nullptr) return;
        f.trace = true;
        f.trace_bytes = ~std::uint64_t{0};
    }

    [[nodiscard]] Body body(const Algorithm& algorithm) const {
        const PreparedLists::Settings& settings = setup.lists.settings();
        return body_of(algorithm, {setup.options.algorithm, eye_distance(settings.view, settings.raster)});
    }

    // The order of a pixel's nodes is not that of a sample's fragments, so it has no errors that could be counted.
    [[nodiscard]] RenderResult render(const Algorithm& given, const RenderCall& call) {
        const SimdScope kernels{setup.options.simd};
        Algorithm algorithm = given;
        if (has_pixel_lists(given, setup.options)) algorithm.ties = TiePolicy::none;
        if (auto lacking = refusal_of(algorithm, setup)) return refused(*std::move(lacking));
        try {
            Frame f = frame(algorithm, call.instruments);
            set_trace(call, f);
            RenderResult result = run_passes(f, body(algorithm), setup, algorithm, call);
            result.seconds.geometry = setup.seconds_of(algorithm);
            add_diagnostics(f, setup, algorithm, setup.options.audit && call.traces == nullptr, result);
            turn_as_shown(setup.shown(), result, call.traces);
            if (!setup.options.keep_samples) result.frame.samples.clear();
            return result;
        } catch (const Refused& lacking) {
            return refused(lacking.refusal);
        }
    }
};

Renderer::Renderer(const FrameRequest& request) {
    state_ =
        std::unique_ptr<State>(new State{set_up_frames(request.list, request.view, request.profile, request.options)});
}

Renderer::~Renderer() = default;

RenderResult Renderer::render(const Algorithm& algorithm, const std::function<void(double)>& progress,
                              const Instruments& instruments) {
    return state_->render(algorithm, {progress, instruments, nullptr});
}

RenderResult Renderer::render_traced(const Algorithm& algorithm, std::vector<RegionTrace>& traces,
                                     const Instruments& instruments) {
    const std::function<void(double)> no_progress;
    return state_->render(algorithm, {no_progress, instruments, &traces});
}

RenderResult Renderer::depth_pass(const std::function<void(double)>& progress, const Instruments& instruments) {
    FrameSetup& setup = state_->setup;
    const SimdScope kernels{setup.options.simd};
    const Algorithm& one_pass = *find_algorithm("unsorted");
    if (auto lacking = refusal_of_depth_pass(one_pass, setup)) return refused(*std::move(lacking));
    Frame frame = state_->frame(one_pass, {});
    frame.nearest_depth = frame.trace = false;
    frame.published_format = target_format(frame.key_request().format);
    RenderResult result;
    {
        const Stopwatch watch{result.seconds.passes};
        const Execution execution = execution_of(one_pass, setup.options, instruments);
        result.frame = run(frame, draw_depth, execution, setup.options.threads, progress, instruments);
    }
    std::swap(result.frame.depth, result.frame.color);
    setup.shown().turn(result.frame);
    result.seconds.geometry = setup.seconds_of(one_pass);
    return result;
}

FrameFragments FrameFragments::of_sample(std::size_t sample) const {
    FrameFragments own;
    for (const CapturedFragment& fragment : all)
        if (fragment.sample == sample) own.all.push_back(fragment);
    const std::size_t pixels = opaque.size() / samples;
    const auto first = opaque.begin() + static_cast<std::ptrdiff_t>(sample * pixels);
    own.opaque.assign(first, first + static_cast<std::ptrdiff_t>(pixels));
    return own;
}

FrameFragments Renderer::fragments(const Algorithm& algorithm) {
    FrameSetup& setup = state_->setup;
    const SimdScope kernels{setup.options.simd};
    if (auto lacking = refusal_of(algorithm, setup)) throw Refused{setup.profile, *std::move(lacking)};
    const Frame frame = state_->frame(algorithm, {});
    const std::uint64_t fragments = fragment_count(*frame.transparent);
    const std::uint64_t bytes = FrameFragments::bytes_per_fragment * fragments;
    if (bytes > setup.audit_memory())
        throw InputError("audit", "--fragment-memory",
                         "at least " + std::to_string(bytes) + " bytes for the frame's " + std::to_string(fragments) +
                             " fragments in total",
                         std::to_string(setup.audit_memory()));
    FrameFragments found;
    const Body capture = [&](Region& region) {
        found.all = RegionShortcuts{region}.capture(Counting::counted);
        found.samples = region.elements() / region.rect().area();
        const std::uint32_t* opaque = region.storage(region.opaque_depth()).depth(0);
        found.opaque.assign(opaque, opaque + region.elements());
        region.publish(region.opaque_color());
    };
    static_cast<void>(run(frame, capture, Execution::literal, 1));
    setup.shown().turn(found);
    return found;
}

DepthFormat Renderer::depth_format() const noexcept { return state_->setup.depth.format; }
Format Renderer::color_format() const noexcept { return state_->setup.color_format; }

}  // namespace strata::peeling
