// peeling/sampled_renderer.cpp - renders every sample as a frame of its own and resolves the frames
// (sampled_renderer.h).
#include "peeling/sampled_renderer.h"

#include <algorithm>
#include <string>
#include <utility>

#include "peeling/audit/pixel_audit.h"
#include "pipeline/device/sample_points.h"
#include "pipeline/formats/resolve.h"
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
        color_.add(one.frame.color);
        add_nearest(one.frame.depth, greater_is_nearer_, sum_.frame.depth);
        add_layers(one.frame.layers);
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
    void add_layers(const std::vector<KeptLayer>& layers) {
        for (const Side side : {Side::none, Side::front, Side::back}) {
            auto next = layers_.begin();
            for (const KeptLayer& layer : layers) {
                if (layer.side != side) continue;
                next = std::find_if(next, layers_.end(), [&](const Layer& l) { return l.side == side; });
                if (next == layers_.end()) next = layers_.insert(next, {new_resolve(), {}, side});
                next->color.add(layer.color);
                if (!layer.depth.codes.empty()) add_nearest(layer.depth, greater_is_nearer_, next->depth);
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

struct SampledRenderer::State {
    const DrawList& list;
    View view;
    DeviceProfile profile;
    RenderOptions options;
    int samples;
    Resolve resolve = Resolve::box;
    std::vector<std::unique_ptr<Renderer>> renderers{};

    [[nodiscard]] Verdict refusal(const Algorithm& algorithm) const {
        if (auto lacking = check_multisampling(profile, samples)) return lacking;
        if (resolve == Resolve::quincunx && (samples != 2 || profile.sample_positions != SamplePositions::nv20))
            return Refusal{"Quincunx filter of " + std::to_string(samples) + " samples", "NV_multisample_filter_hint",
                           "use --profile geforce3 with --samples 2"};
        if (samples > 1 && algorithm.samples > 1)
            return Refusal{"samples to spare for " + algorithm.name + ", which stores fragments in them", "",
                           "use --samples 1, or k_buffer"};
        return std::nullopt;
    }

    Renderer& renderer(std::size_t number) {
        auto& renderer = renderers[number];
        if (renderer) return *renderer;
        RenderOptions own = options;
        if (samples > 1) own.raster.sample = sample_points(profile.sample_positions, samples)[number];
        renderer = std::make_unique<Renderer>(list, view, profile, own);
        return *renderer;
    }
};

SampledRenderer::SampledRenderer(const DrawList& list, const View& view, const DeviceProfile& profile,
                                 const RenderOptions& options, int samples, Resolve resolve)
    : state_{new State{list, view, profile, options, samples, resolve}} {
    if (samples != 1 && samples != 2 && samples != 4 && samples != 8)
        Requirements{"render options"}.fail(FieldName{"samples"}, "1, 2, 4 or 8", samples);
    state_->renderers.resize(static_cast<std::size_t>(samples));
    // Throws InputError now for options that are invalid on every profile.
    if (!check_multisampling(profile, samples)) static_cast<void>(state_->renderer(0));
}

SampledRenderer::~SampledRenderer() = default;

Renderer& SampledRenderer::sample(std::size_t number) { return state_->renderer(number); }

RenderResult SampledRenderer::render(const Algorithm& algorithm, const std::function<void(double)>& progress,
                                     std::vector<Image>* own_colors) {
    State& s = *state_;
    if (auto lacking = s.refusal(algorithm)) {
        RenderResult refused;
        refused.outcome = Outcome::refused;
        refused.refusal = std::move(lacking);
        return refused;
    }
    if (s.samples == 1) return s.renderer(0).render(algorithm, progress);
    std::vector<Image> colors;
    SampleSum sum{s.samples, s.profile, s.options.raster.depth_order == rasterizer::DepthOrder::greater};
    for (std::size_t number = 0; number < s.renderers.size(); ++number) {
        const auto share = [&](double own) { progress((static_cast<double>(number) + own) / s.samples); };
        RenderResult one =
            s.renderer(number).render(algorithm, progress ? std::function<void(double)>{share} : nullptr);
        if (one.outcome == Outcome::refused) return one;
        if (own_colors != nullptr || s.resolve == Resolve::quincunx) colors.push_back(one.frame.color);
        sum.add(std::move(one));
    }
    RenderResult result = std::move(sum).result();
    const bool is_turned = s.profile.origin == Origin::lower_left;
    if (s.resolve == Resolve::quincunx) result.frame.color = quincunx(colors[0], colors[1], is_turned);
    if (own_colors != nullptr) *own_colors = std::move(colors);
    return result;
}

}  // namespace strata::peeling
