// peeling/frame/setup.cpp - resolves the defaults of options and prepares lists and light (setup.h).
#include "peeling/frame/setup.h"

#include <algorithm>

#include "peeling/frame/check_options.h"
#include "peeling/raster_state.h"
#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "rasterizer/base/simd.h"

namespace strata::peeling {

using namespace pipeline;

rasterizer::DepthRequest FrameSetup::depth_of(const Algorithm& algorithm) const {
    rasterizer::DepthRequest request = depth;
    if (algorithm.stores) request.path = *algorithm.stores;
    if (!request.reference) request.reference = algorithm.compares;
    return request;
}

PreparedLists& FrameSetup::lists_for(const Algorithm& algorithm) {
    const rasterizer::DepthRequest request = depth_of(algorithm);
    if (!takes_quotient(request) || takes_quotient(depth)) return lists;
    if (!quotient_lists) {
        PreparedLists::Settings settings = lists.settings();
        settings.depth = request;
        quotient_lists.emplace(std::move(settings));
    }
    return *quotient_lists;
}

std::uint64_t FrameSetup::audit_memory() const noexcept {
    return std::max(options.fragment_memory, least_audit_memory);
}

bool FrameSetup::quantizes() const noexcept {
    return options.quantize_reference && profile.raster.hypothesis.quantize_reference;
}

bool FrameSetup::shades_pixels() const noexcept {
    return options.raster.interpolation != rasterizer::Interpolation::sample;
}

bool FrameSetup::is_invariant() const noexcept {
    return lists.second() == nullptr && quantizes() && options.compare_epsilon == CompareEpsilon{} &&
           depth.reference.value_or(depth.path) == depth.path;
}

double FrameSetup::seconds_of(const Algorithm& algorithm) { return lists_for(algorithm).seconds(algorithm.order); }

namespace {

// The state of sample 0, for a device that has so many samples; a frame without samples has one program per pixel, and
// its fragments cover it.
RenderOptions with_samples(RenderOptions options, const DeviceProfile& profile) {
    const int samples = options.sampling.samples;
    if (samples > 1 && !check_multisampling(profile, samples))
        set_sample(options.raster, profile.sample_positions, samples, 0);
    else if (!options.raster.sample)
        options.raster.interpolation = rasterizer::Interpolation::sample, options.raster.sample_coverage = {};
    return options;
}

}  // namespace

FrameSetup set_up_frames(const DrawList& list, const View& view, const DeviceProfile& profile,
                         const RenderOptions& given) {
    check_options(given);  // before the scope, which takes an instruction set that the processor has
    const RenderOptions options = with_samples(given, profile);
    const SimdScope kernels{options.simd};
    const bool is_exact = profile.raster.depth_path == rasterizer::DepthPath::exact;
    const rasterizer::DepthRequest depth{.path = options.depth_path.value_or(profile.raster.depth_path),
                                         .format = profile.depth_buffer(options.depth),
                                         .reference = options.reference_path};
    View first = view;
    first.vertex_path = options.vertex_paths.first.value_or(view.vertex_path);
    const rasterizer::RasterState raster = raster_state(options, profile);
    std::unique_ptr<const LightMap> light = light_map(list, profile, raster, options.threads);
    const LightMap* const map = light.get();
    return {.profile = profile,
            .options = options,
            .depth = depth,
            .color_format = options.color_format.value_or(is_exact ? Format::rgba32f : Format::rgba8),
            .is_perspective = has_perspective(first),
            .light = std::move(light),
            .lists = PreparedLists{{.list = list,
                                    .view = first,
                                    .profile = profile,
                                    .options = options,
                                    .raster = raster,
                                    .depth = depth,
                                    .light = map}}};
}

}  // namespace strata::peeling
