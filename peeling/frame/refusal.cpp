// peeling/frame/refusal.cpp - the checks of refusal.h in their order.
#include "peeling/frame/refusal.h"

#include <algorithm>

#include "peeling/frame/check_options.h"
#include "peeling/registry.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/input_error.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

std::optional<Refusal> check_w_buffer(const rasterizer::DepthRequest& request, bool is_perspective) {
    constexpr auto w = rasterizer::DepthPath::w_buffer;
    if (!is_perspective && (request.path == w || request.reference == w))
        return Refusal{"w buffer for a parallel projection, whose w is 1 everywhere", "",
                       "use depth path window_z, or a camera with perspective"};
    if (!compares_w_with_depth(request)) return std::nullopt;
    if (request.path == w || request.reference == w)
        return Refusal{"comparison of w with a depth", "",
                       "use w_buffer for both: --depth-path w_buffer --reference-path w_buffer"};
    return Refusal{"comparison of a logarithm with a depth", "",
                   "use logarithmic for both: --depth-path logarithmic --reference-path logarithmic"};
}

std::optional<Refusal> check_logarithm(const rasterizer::DepthRequest& request, const View& view) {
    constexpr auto log = rasterizer::DepthPath::logarithmic;
    if (request.path != log && request.reference != log) return std::nullopt;
    if (!has_perspective(view))
        return Refusal{"logarithmic depth for a parallel projection, whose w is 1 everywhere", "",
                       "use depth path float32, or a camera with perspective"};
    if (log_scale_of(view) == 0)
        return Refusal{"logarithmic depth for a projection without a far plane", "",
                       "use depth path float32, or a camera with a far plane"};
    return std::nullopt;
}

// float32_plane divides by the area of three corners, which a line and a point do not have.
std::optional<Refusal> check_plane(const rasterizer::DepthRequest& request, const pipeline::DrawList& list) {
    constexpr auto plane = rasterizer::DepthPath::float32_plane;
    if (request.path != plane && request.reference != plane) return std::nullopt;
    const auto has_area = [&](const Instance& instance) {
        return list.meshes[instance.mesh].primitive == Primitive::triangles;
    };
    if (std::ranges::all_of(list.instances, has_area)) return std::nullopt;
    return Refusal{"float32_plane for lines and points, which have no area", "", "use depth path float32"};
}

std::optional<Refusal> check_formats(const Algorithm& algorithm, const FrameSetup& setup) {
    const RenderOptions& options = setup.options;
    for (const auto& format : {std::optional(setup.color_format), options.result_format, options.back_format})
        if (auto lacking = format ? check(setup.profile, *format) : std::nullopt) return lacking;
    if (options.back_format && !algorithm.takes_both_ends)
        return Refusal{"separate back format, because it composites from one end only", "",
                       "use dual or dual_independent", algorithm.name};
    // A user's algorithm says itself what it keeps in its targets.
    const bool keeps_alpha = !algorithm.blends_in_picture && !algorithm.body;
    if (keeps_alpha && (setup.color_format == Format::r11g11b10f || options.back_format == Format::r11g11b10f))
        return Refusal{"layers in r11g11b10f, which has no alpha", "",
                       "use --result-format r11g11b10f, or painter, which blends into the picture", algorithm.name};
    return std::nullopt;
}

std::optional<Refusal> check_results(const Algorithm& algorithm, const FrameSetup& setup) {
    if (setup.options.keep_layers && !algorithm.makes_layers)
        return Refusal{"saved layers", "", "use dual or front_to_back", algorithm.name};
    if (algorithm.compares_own_codes && !setup.is_invariant())
        return Refusal{"other compared depth", "", "use depth_units, front_to_back, dual or dual_independent",
                       algorithm.name};
    return std::nullopt;
}

std::optional<Refusal> check_samples_of(const Algorithm& algorithm, const FrameSetup& setup) {
    const Multisampling& sampling = setup.options.sampling;
    if (auto lacking = check_multisampling(setup.profile, sampling.samples)) return lacking;
    if (sampling.resolve == Resolve::quincunx &&
        (sampling.samples != 2 || setup.profile.sample_positions != SamplePositions::nv20))
        return Refusal{"Quincunx filter of " + std::to_string(sampling.samples) + " samples",
                       "NV_multisample_filter_hint", "use --profile geforce3 with --samples 2"};
    if (sampling.samples > 1 && algorithm.samples > 1)
        return Refusal{"multisampling, because it stores fragments in the samples", "", "use --samples 1, or k_buffer",
                       algorithm.name};
    return std::nullopt;
}

}  // namespace

std::optional<Refusal> refusal_of(const Algorithm& algorithm, const FrameSetup& setup) {
    if (algorithm.run == nullptr && algorithm.run_with == nullptr && !algorithm.body)
        throw InputError("algorithm '" + algorithm.name + "'", "run", "a function, or one in body", "neither");
    const RenderOptions& options = setup.options;
    const DeviceProfile& profile = setup.profile;
    const rasterizer::DepthRequest request = setup.depth_of(algorithm);
    const bool casts_shadows = setup.lists.settings().list.light.has_value();
    if (auto lacking = check_samples_of(algorithm, setup)) return lacking;
    if (auto lacking = setup.lists.undrawable()) return lacking;
    if (auto lacking = check_size(profile, options.width, options.height)) return lacking;
    if (auto lacking = check_depth(profile, request)) return lacking;
    if (auto lacking = check_w_buffer(request, setup.is_perspective)) return lacking;
    if (auto lacking = check_plane(request, setup.lists.settings().list)) return lacking;
    if (auto lacking = check_logarithm(request, setup.lists.settings().view)) return lacking;
    if (auto lacking = check_formats(algorithm, setup)) return lacking;
    if (auto lacking = check_order(options, setup.depth.format, casts_shadows)) return lacking;
    if (options.raster.depth_clamp)
        if (auto lacking = check(profile, Feature::depth_clamp)) return lacking;
    if (auto lacking = check_shading(profile, algorithm, request, options)) return lacking;
    if (auto lacking = check_results(algorithm, setup)) return lacking;
    return refusal(algorithm, profile);
}

std::optional<Refusal> refusal_of_depth_pass(const Algorithm& one_pass, const FrameSetup& setup) {
    const RenderOptions& options = setup.options;
    if (auto lacking = check_samples_of(one_pass, setup)) return lacking;
    if (auto lacking = setup.lists.undrawable()) return lacking;
    if (auto lacking = check_size(setup.profile, options.width, options.height)) return lacking;
    if (auto lacking = check_depth(setup.profile, setup.depth)) return lacking;
    if (auto lacking = check_plane(setup.depth, setup.lists.settings().list)) return lacking;
    if (auto lacking = check(setup.profile, setup.color_format)) return lacking;
    return check_shading(setup.profile, one_pass, setup.depth, options);
}

}  // namespace strata::peeling
