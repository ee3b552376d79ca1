#include "tools/request/complete.h"

#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "scenes/numbers/srgb_encode.h"

namespace strata::tools {

namespace {

std::optional<OptionConflict> conflict_of_coverage(const PictureRequest& request) {
    const rasterizer::SampleCoverage& coverage = request.render.raster.sample_coverage;
    const bool is_of_pack = request.render.raster.sample.has_value();
    if (coverage != rasterizer::SampleCoverage{} && request.sampling.samples == 1 && !is_of_pack)
        return OptionConflict{
            "", "--alpha-to-coverage, --sample-coverage and --sample-mask are valid only with --samples 2, 4 or 8"};
    if (coverage.is_inverted && !coverage.value)
        return OptionConflict{"", "--sample-coverage-invert is valid only with --sample-coverage"};
    return std::nullopt;
}

// A frame of one sample at a place of its own keeps it.
void take_interpolation(PictureRequest& request) {
    using enum rasterizer::Interpolation;
    rasterizer::Interpolation& where = request.render.raster.interpolation;
    if (request.shades_pixels)
        where = request.interpolate.value_or(where == sample ? centre : where);
    else if (request.sampling.samples > 1 || !request.render.raster.sample)
        where = sample;
    request.interpolate.reset();
    if (request.shades_pixels && where == centroid) request.interpolate = centroid;
}

void take_clip_convention(PictureRequest& request, const pipeline::DeviceProfile& profile) {
    rasterizer::RasterState& raster = request.render.raster;
    raster.clip_depth = request.clip_depth.value_or(profile.clip_depth);
    raster.depth_order = request.depth_order.value_or(profile.depth_order);
}

void take_background(PictureRequest& request) {
    if (!request.background) return;
    const pipeline::Rgba c = scenes::from_encoded(*request.background, request.scene_options.color_space);
    request.render.background = {c[0] * c[3], c[1] * c[3], c[2] * c[3], c[3]};
}

// The frame of one sample alone is a frame of one sample, whose place the state has.
void take_samples(PictureRequest& request, const pipeline::DeviceProfile& profile) {
    request.render.sampling = request.sample ? peeling::Multisampling{} : request.sampling;
    if (!request.sample || request.sampling.samples == 1) return;
    if (const auto lacking = pipeline::check_multisampling(profile, request.sampling.samples))
        throw pipeline::Refused{profile, *lacking};
    pipeline::set_sample(request.render.raster, profile.sample_positions, request.sampling.samples,
                         static_cast<std::size_t>(*request.sample));
}

}  // namespace

std::optional<OptionConflict> option_conflict(const PictureRequest& request) {
    const peeling::Multisampling& sampling = request.sampling;
    if (request.sample && *request.sample > 0 && sampling.samples == 1)
        return OptionConflict{"", "--sample is valid only with --samples 2, 4 or 8"};
    if (request.sample && *request.sample >= sampling.samples)
        return OptionConflict{"--sample", "expected a number from 0 to " + std::to_string(sampling.samples - 1) +
                                              " with --samples " + std::to_string(sampling.samples) + ", found " +
                                              std::to_string(*request.sample)};
    const bool loads_others =
        sampling.loads != pipeline::LoadedSample::own || sampling.composites != pipeline::LoadedSample::own;
    if (loads_others && (sampling.samples == 1 || request.sample))
        return OptionConflict{
            "", "--load-sample and --composite-sample are valid only with --samples 2, 4 or 8 and without --sample"};
    if (const auto found = conflict_of_coverage(request)) return found;
    if (request.shades_pixels && sampling.samples == 1)
        return OptionConflict{"", "--shading pixel is valid only with --samples 2, 4 or 8"};
    if (request.interpolate && !request.shades_pixels)
        return OptionConflict{"", "--interpolate is valid only with --shading pixel"};
    if (sampling.resolve != pipeline::Resolve::box && request.sample)
        return OptionConflict{"", "--resolve is valid only without --sample: one sample is not resolved"};
    if (sampling.resolve == pipeline::Resolve::quincunx && sampling.samples == 1)
        return OptionConflict{"--resolve", "expected quincunx with --samples 2, found 1 sample per pixel"};
    if (request.orbit && !request.camera.empty()) return OptionConflict{"", "--orbit and --camera exclude each other"};
    return std::nullopt;
}

std::optional<std::string> light_conflict(const peeling::RenderOptions& options, pipeline::ColorSpace space) {
    const auto is_srgb = [](const std::optional<pipeline::Format>& format) {
        return format == pipeline::Format::srgb8_alpha8;
    };
    const bool encodes =
        is_srgb(options.color_format) || is_srgb(options.result_format) || is_srgb(options.back_format);
    if (!encodes || space == pipeline::ColorSpace::linear) return std::nullopt;
    return "expected linear with a target of srgb8_alpha8, which encodes what is blended, found encoded";
}

void complete(PictureRequest& request, const pipeline::DeviceProfile& profile) {
    take_clip_convention(request, profile);
    take_interpolation(request);
    take_samples(request, profile);
    take_background(request);
}

PictureRequest request_of(const peeling::RenderOptions& options) {
    const bool has_samples = options.sampling.samples > 1;
    return {.clip_depth = options.raster.clip_depth,
            .depth_order = options.raster.depth_order,
            .render = options,
            .sampling = options.sampling,
            .shades_pixels = has_samples && options.raster.interpolation != rasterizer::Interpolation::sample};
}

}  // namespace strata::tools
