// tools/library/render.cpp - renders a scene with an algorithm, in one call.
#include "strata/render.h"

#include <algorithm>

#include "rasterizer/base/input_error.h"
#include "tools/library/check_light.h"

namespace strata {
inline namespace v0_1 {

namespace {

// The renderer refers to the draw list of the scene, which must outlive it.
peeling::Renderer renderer_of(const Scene& scene, const DeviceProfile& profile, const RenderOptions& options) {
    check_light(scene, options);
    return {scene.list(), scene.view(options.width, options.height, options.raster), profile, options};
}

void check_pixel(int x, int y, const RenderOptions& options) {
    const auto within = [](const char* place, int at, int size) {
        if (at < 0 || at >= size)
            throw InputError("pixel", place, "0 to " + std::to_string(size - 1), std::to_string(at));
    };
    within("x", x, options.width);
    within("y", y, options.height);
}

peeling::FrameRequest input_of(const Scene& scene, const View& view, const DeviceProfile& profile,
                               const RenderOptions& options) {
    check_light(scene, options);
    return {scene.list(), view, profile, options, scene.space()};
}

}  // namespace

Rendering::Rendering(const DeviceProfile& profile, peeling::RenderResult&& result) : result_{std::move(result)} {
    if (result_.refusal) refused_ = std::make_shared<const Refused>(profile, *result_.refusal);
}

std::string Rendering::refusal() const { return refused_ ? refused_->what() : ""; }

const peeling::RenderResult& Rendering::drawn() const {
    if (refused_) throw Refused{*refused_};
    return result_;
}

Picture Rendering::picture() const {
    const pipeline::FrameResult& frame = drawn().frame;
    return frame.depth.codes.empty() ? picture_of(frame.color) : picture_of(frame.color, frame.depth);
}

Rendering render(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                 const RenderOptions& options) {
    return {profile, renderer_of(scene, profile, options).render(algorithm)};
}

std::vector<Layer> layers(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                          const RenderOptions& options) {
    RenderOptions kept = options;
    kept.keep_layers = true;
    peeling::RenderResult result = renderer_of(scene, profile, kept).render(algorithm);
    if (result.refusal) throw Refused{profile, *std::move(result.refusal)};
    std::vector<Layer> near_to_far, from_behind;
    for (pipeline::PeeledLayer& kept_layer : result.frame.layers) {
        const bool is_back = kept_layer.side == pipeline::Side::back;
        // A peel from both ends may have an empty last layer.
        if (algorithm.takes_both_ends &&
            std::ranges::all_of(kept_layer.color.codes, [](auto code) { return code == 0; }))
            continue;
        (is_back ? from_behind : near_to_far)
            .push_back({std::move(kept_layer.color), std::move(kept_layer.depth), is_back});
    }
    std::move(from_behind.rbegin(), from_behind.rend(), std::back_inserter(near_to_far));
    return near_to_far;
}

std::vector<CapturedFragment> fragments(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                                        const RenderOptions& options) {
    return renderer_of(scene, profile, options).fragments(algorithm).all;
}

std::vector<oracle::PassReport> passes(const Scene& scene, const Algorithm& algorithm, const DeviceProfile& profile,
                                       const RenderOptions& options) {
    std::vector<oracle::PassReport> shown;
    const View view = scene.view(options.width, options.height, options.raster);
    oracle::passes(input_of(scene, view, profile, options), algorithm,
                   [&](oracle::PassReport&& pass) { shown.push_back(std::move(pass)); });
    return shown;
}

oracle::History explain(const Scene& scene, int x, int y, const Algorithm& algorithm, const DeviceProfile& profile,
                        const RenderOptions& options) {
    check_pixel(x, y, options);
    const View view = scene.view(options.width, options.height, options.raster);
    return oracle::explain(input_of(scene, view, profile, options), algorithm, {x, y, x + 1, y + 1}).at(0);
}

oracle::SampledHistory explain_samples(const Scene& scene, int x, int y, const Algorithm& algorithm,
                                       const DeviceProfile& profile, const RenderOptions& options) {
    check_pixel(x, y, options);
    const View view = scene.view(options.width, options.height, options.raster);
    return oracle::explain_samples(input_of(scene, view, profile, options), algorithm, x, y);
}

Algorithm own_algorithm(std::string name, std::function<void(pipeline::Region&)> body, bool whole_frame) {
    if (!body) throw InputError("algorithm '" + name + "'", "body", "a function", "none");
    Algorithm own;
    own.name = std::move(name);
    own.body = std::move(body);
    own.whole_frame = whole_frame;
    return own;
}

}  // namespace v0_1
}  // namespace strata
