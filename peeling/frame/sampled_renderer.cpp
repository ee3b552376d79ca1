// peeling/frame/sampled_renderer.cpp - renders every sample as a frame of its own and resolves the frames
// (sampled_renderer.h).
#include "peeling/sampled_renderer.h"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "peeling/audit/pixel_audit.h"
#include "peeling/audit/region_trace.h"
#include "peeling/frame/pass_limit.h"
#include "pipeline/device/sample_points.h"
#include "pipeline/formats/resolve.h"
#include "pipeline/frame/observer.h"
#include "pipeline/frame/sample_group.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/base/require.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

void add_sample(const Seconds& one, Seconds& sum) {
    sum.geometry += one.geometry;
    sum.passes += one.passes;
    sum.audit += one.audit;
}

void add_sample(Work one, Work& sum) {
    one.fragments += sum.fragments;
    one.visited += sum.visited;
    one.regions += sum.regions;
    one.reruns += sum.reruns;
    if (sum.path < one.path) one.path = sum.path, one.why = sum.why;
    sum = std::move(one);
}

void add_sample(const PassCount& one, PassCount& most) {
    most.geometry = std::max(most.geometry, one.geometry);
    most.full_screen = std::max(most.full_screen, one.full_screen);
    most.copies = std::max(most.copies, one.copies);
}

// Combines the frames of the samples: images are resolved; counts are added, or their maximum is taken.
class SampleSum {
  public:
    SampleSum(int samples, const DeviceProfile& profile, bool greater_is_nearer)
        : samples_{samples}, profile_{profile}, greater_is_nearer_{greater_is_nearer}, color_{new_resolve()} {}

    void add(RenderResult&& one) {
        color_.add(std::move(one.frame.color));
        add_nearest(std::move(one.frame.depth), greater_is_nearer_, sum_.frame.depth);
        add_layers(std::move(one.frame.layers));
        FrameResult& frame = sum_.frame;
        frame.iterations = std::max(frame.iterations, one.frame.iterations);
        add_sample(one.frame.passes, frame.passes);
        if (one.frame.counters) frame.counters = frame.counters.value_or(Counters{}) + *one.frame.counters;
        is_first_ ? void(frame.work = one.frame.work) : add_sample(std::move(one.frame.work), frame.work);
        for (const Diagnostic& diagnostic : one.frame.diagnostics) merge(frame.diagnostics, diagnostic);
        merge(sum_.audit, one.audit);
        add_sample(one.seconds, sum_.seconds);
        is_first_ = false;
    }

    [[nodiscard]] RenderResult result() && {
        sum_.frame.color = std::move(color_).picture();
        for (Layer& layer : layers_)
            sum_.frame.layers.push_back({std::move(layer.color).picture(), std::move(layer.depth), layer.side});
        return std::move(sum_);
    }

  private:
    struct Layer {
        ColorResolve color;
        Image depth;
        Side side{};
    };

    [[nodiscard]] ColorResolve new_resolve() const { return {samples_, profile_.resolve, profile_.color_rounding()}; }

    // Adds layer k of a sample, counted from one end, to layer k of the frame from the same end.
    void add_layers(std::vector<PeeledLayer> layers) {
        for (const Side side : {Side::none, Side::front, Side::back}) {
            auto next = layers_.begin();
            for (PeeledLayer& layer : layers) {
                if (layer.side != side) continue;
                next = std::find_if(next, layers_.end(), [&](const Layer& l) { return l.side == side; });
                if (next == layers_.end()) next = layers_.insert(next, {new_resolve(), {}, side});
                next->color.add(std::move(layer.color));
                if (!layer.depth.codes.empty()) add_nearest(std::move(layer.depth), greater_is_nearer_, next->depth);
                ++next;
            }
        }
    }

    int samples_;
    const DeviceProfile& profile_;
    bool greater_is_nearer_, is_first_ = true;
    ColorResolve color_;
    std::vector<Layer> layers_;
    RenderResult sum_;
};

}  // namespace

bool is_joint(const Algorithm& algorithm, const RenderOptions& options, const Multisampling& sampling) noexcept {
    const bool counts_loops = (algorithm.runs_loops || algorithm.whole_frame) && limits_passes(options);
    const bool counts_all = options.termination.rule == TerminationRule::ratio || counts_loops;
    return sampling.is_joint() || (sampling.samples > 1 && counts_all);
}

struct SampledRenderer::State {
    const DrawList& list;
    View view;
    DeviceProfile profile;
    RenderOptions options;
    Multisampling sampling;
    std::vector<std::unique_ptr<Renderer>> renderers{};

    [[nodiscard]] std::optional<Refusal> refusal(const Algorithm& algorithm) const {
        const int samples = sampling.samples;
        if (auto lacking = check_multisampling(profile, samples)) return lacking;
        if (sampling.resolve == Resolve::quincunx &&
            (samples != 2 || profile.sample_positions != SamplePositions::nv20))
            return Refusal{"Quincunx filter of " + std::to_string(samples) + " samples", "NV_multisample_filter_hint",
                           "use --profile geforce3 with --samples 2"};
        if (samples > 1 && algorithm.samples > 1)
            return Refusal{"multisampling in " + algorithm.name + ", which stores fragments in the samples", "",
                           "use --samples 1, or k_buffer"};
        return std::nullopt;
    }

    // Calls `run` for each sample: one after the other, or, if the frames depend on one another or have instruments,
    // all at once. Calls `take` with the results in the order of the samples, until it returns false.
    template <class Run, class Take>
    void each(const Algorithm& algorithm, std::span<const Instruments> instruments, const Run& run, const Take& take) {
        share_limit(algorithm);
        std::vector<RenderResult> results;
        if (is_joint(algorithm, options, sampling) || !instruments.empty()) results = run_jointly(instruments, run);
        for (std::size_t number = 0; number < renderers.size(); ++number)
            if (!take(results.empty() ? run(renderer(number), number, Instruments{}) : std::move(results[number])))
                return;
    }

    // A peel that may never end has the same limit of passes in the frame of each sample.
    void share_limit(const Algorithm& algorithm) {
        if (sampling.samples == 1 || limits_passes(options)) return;
        int deepest = 0;
        for (std::size_t number = 0; number < renderers.size(); ++number)
            deepest = std::max(deepest, renderer(number).limiting_depth(algorithm));
        for (std::size_t number = 0; deepest > 0 && number < renderers.size(); ++number)
            renderer(number).set_limiting_depth(deepest);
    }

    template <class Run>
    [[nodiscard]] std::vector<RenderResult> run_jointly(std::span<const Instruments> instruments, const Run& run) {
        const auto is_observed = [](const Instruments& own) { return own.observer != nullptr && own.observer->step; };
        if (std::ranges::any_of(instruments, is_observed) && !std::ranges::all_of(instruments, is_observed))
            throw std::invalid_argument("observers of some samples only: their frames would wait for the others");
        std::vector<RenderResult> results(renderers.size());
        for (std::size_t number = 0; number < results.size(); ++number) static_cast<void>(renderer(number));
        SampleGroup group{sampling.samples};
        std::vector<std::exception_ptr> errors(results.size());
        const auto run_sample = [&](std::size_t number) {
            Instruments joint = instruments.empty() ? Instruments{} : instruments[number];
            joint.samples = {&group, static_cast<int>(number), sampling.samples, sampling.loads, sampling.composites};
            try {
                results[number] = run(*renderers[number], number, joint);
                if (results[number].outcome == Outcome::refused) group.abandon();
            } catch (const SampleGroup::Abandoned&) {
            } catch (...) {
                errors[number] = std::current_exception();
                group.abandon();
            }
        };
        std::vector<std::thread> threads;
        std::string shortage;
        try {
            for (std::size_t number = 0; number < results.size(); ++number) threads.emplace_back(run_sample, number);
        } catch (const std::exception& error) {  // the system refuses a thread: those that wait for it must end
            shortage = error.what();
            group.abandon();
        }
        for (std::thread& thread : threads) thread.join();
        if (!shortage.empty())
            throw std::runtime_error("samples that load one another need " + std::to_string(results.size()) +
                                     " threads at once: " + shortage);
        for (const std::exception_ptr& error : errors)
            if (error) std::rethrow_exception(error);
        return results;
    }

    Renderer& renderer(std::size_t number) {
        auto& renderer = renderers[number];
        if (renderer) return *renderer;
        RenderOptions own = options;
        if (sampling.samples > 1)
            set_sample(own.raster, profile.sample_positions, sampling.samples, number);
        else if (!own.raster.sample)
            own.raster.interpolation = rasterizer::Interpolation::sample, own.raster.sample_coverage = {};
        if (sampling.is_joint()) own.threads = 1;
        renderer = std::make_unique<Renderer>(list, view, profile, own);
        return *renderer;
    }
};

SampledRenderer::SampledRenderer(const DrawList& list, const View& view, const DeviceProfile& profile,
                                 const RenderOptions& options, const Multisampling& multisampling)
    : state_{new State{list, view, profile, options, multisampling}} {
    const int samples = multisampling.samples;
    if (samples != 1 && samples != 2 && samples != 4 && samples != 8)
        Requirements{"render options"}.fail(FieldName{"samples"}, "1, 2, 4 or 8", samples);
    state_->renderers.resize(static_cast<std::size_t>(samples));
    // Throws InputError now for options that are invalid on every profile.
    if (!check_multisampling(profile, samples)) static_cast<void>(state_->renderer(0));
}

SampledRenderer::~SampledRenderer() = default;

Renderer& SampledRenderer::sample(std::size_t number) { return state_->renderer(number); }

std::vector<RenderResult> SampledRenderer::render_traced(const Algorithm& algorithm,
                                                         std::vector<std::vector<RegionTrace>>& traces) {
    State& s = *state_;
    if (auto lacking = s.refusal(algorithm)) {
        std::vector<RenderResult> refused(1);
        refused[0].outcome = Outcome::refused;
        refused[0].refusal = std::move(lacking);
        return refused;
    }
    traces.assign(s.renderers.size(), {});
    std::vector<RenderResult> results;
    s.each(
        algorithm, {},
        [&](Renderer& renderer, std::size_t number, const Instruments& joint) {
            return renderer.render_traced(algorithm, traces[number], joint);
        },
        [&](RenderResult&& one) {
            results.push_back(std::move(one));
            return true;
        });
    return results;
}

RenderResult SampledRenderer::render(const Algorithm& algorithm, const std::function<void(double)>& progress,
                                     std::vector<Image>* own_colors, std::span<const Instruments> instruments) {
    State& s = *state_;
    if (auto lacking = s.refusal(algorithm)) {
        RenderResult refused;
        refused.outcome = Outcome::refused;
        refused.refusal = std::move(lacking);
        return refused;
    }
    const int samples = s.sampling.samples;
    if (samples == 1)
        return s.renderer(0).render(algorithm, progress, instruments.empty() ? Instruments{} : instruments[0]);
    std::vector<Image> colors;
    SampleSum sum{samples, s.profile, s.options.raster.depth_order == rasterizer::DepthOrder::greater};
    RenderResult refused;
    const bool keeps_colors = own_colors != nullptr || s.sampling.resolve == Resolve::quincunx;
    const auto run = [&](Renderer& renderer, std::size_t number, const Instruments& joint) {
        const auto share = [&](double own) { progress((static_cast<double>(number) + own) / samples); };
        const bool shows = progress && !is_joint(algorithm, s.options, s.sampling) && instruments.empty();
        return renderer.render(algorithm, shows ? std::function<void(double)>{share} : nullptr, joint);
    };
    s.each(algorithm, instruments, run, [&](RenderResult&& one) {
        if (one.outcome == Outcome::refused) {
            refused = std::move(one);
            return false;
        }
        if (keeps_colors) colors.push_back(one.frame.color);
        sum.add(std::move(one));
        return true;
    });
    if (refused.outcome == Outcome::refused) return refused;
    RenderResult result = std::move(sum).result();
    const bool is_turned = s.profile.origin == Origin::lower_left;
    if (s.sampling.resolve == Resolve::quincunx) result.frame.color = quincunx(colors[0], colors[1], is_turned);
    if (own_colors != nullptr) *own_colors = std::move(colors);
    return result;
}

}  // namespace strata::peeling
