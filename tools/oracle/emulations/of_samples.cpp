// tools/oracle/emulations/of_samples.cpp - mistakes with the samples of a pixel: which of them programs run for and
// load.
//
// Rule     MistakeRenderer makes none of them in a frame of one sample per pixel.
// Source   pipeline/reference/fragment-stages.md 13.5; tools/lab/multisampling/MULTISAMPLING.md counts what each loses.
#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

using pipeline::LoadedSample;
using pipeline::ShareRounding;
using rasterizer::Interpolation;

// Programs that load another sample than their own.
bool loads(AlteredRun& e, LoadedSample in_peels, LoadedSample in_composites) {
    if (e.options.sampling.loads == in_peels && e.options.sampling.composites == in_composites) return false;
    e.options.sampling.loads = in_peels;
    e.options.sampling.composites = in_composites;
    return true;
}

bool shades_at(AlteredRun& e, Interpolation place) {
    if (e.options.raster.interpolation == place) return false;
    e.options.raster.interpolation = place;
    return true;
}

bool shades_pixels_and_loads(AlteredRun& e, Interpolation place, LoadedSample in_peels) {
    return shades_at(e, place) && loads(e, in_peels, e.options.sampling.composites);
}

bool covers_by_alpha(AlteredRun& e) {
    if (e.options.raster.sample_coverage.by_alpha) return false;
    return e.options.raster.sample_coverage.by_alpha = true;
}

// ARB_multisample leaves the number of samples to the device.
bool covers_by_alpha_rounded(AlteredRun& e, ShareRounding rounding) {
    if (e.profile.alpha_to_coverage == rounding || !covers_by_alpha(e)) return false;
    e.profile.alpha_to_coverage = rounding;
    return true;
}

// The mean of decoded sRGB values, encoded; alpha is linear.
pipeline::Image mean_of_decoded(const std::vector<pipeline::Image>& samples) {
    std::vector<TargetImage> targets;
    for (const pipeline::Image& sample : samples) targets.push_back(as_target(sample, ""));
    pipeline::Image mean = samples[0];
    const auto channels = static_cast<std::size_t>(mean.channels());
    for (std::size_t i = 0; i < mean.codes.size(); ++i) {
        const bool is_alpha = i % channels == 3;
        const auto decoded = [&](const TargetImage& target) {
            const double v = value(target.code, target.codes[i]);
            return is_alpha ? v : double{scenes::decode_srgb(static_cast<float>(v))};
        };
        double sum = 0;
        for (const TargetImage& target : targets) sum += decoded(target);
        const double linear = sum / static_cast<double>(samples.size());
        mean.codes[i] =
            nearest(targets[0].code, is_alpha ? linear : double{scenes::encode_srgb(static_cast<float>(linear))});
    }
    return mean;
}

const Mistake sample_mistakes[] = {
    {"no_samples", "one sample per pixel: multisampling is off", ChangedPart::samples,
     [](AlteredRun& e) {
         e.options.sampling.samples = 1;
         e.options.sampling.resolve = pipeline::Resolve::box;
         return true;
     }},
    {"resolve_before_compositing", "every layer resolved before it is composited", ChangedPart::samples,
     [](AlteredRun& e) { return loads(e, e.options.sampling.loads, LoadedSample::resolved); }},
    {"sample_0_for_all", "every program loads sample 0 for all samples", ChangedPart::samples,
     [](AlteredRun& e) { return loads(e, LoadedSample::zero, LoadedSample::zero); }},
    {"peel_loads_sample_0", "all samples are compared with sample 0's depth of the previous layer",
     ChangedPart::samples, [](AlteredRun& e) { return loads(e, LoadedSample::zero, e.options.sampling.composites); }},
    {"peel_loads_resolved",
     "all samples are compared with the resolved depth of the previous layer: fragments are doubled on slopes",
     ChangedPart::samples,
     [](AlteredRun& e) { return loads(e, LoadedSample::resolved, e.options.sampling.composites); }},
    {"alpha_to_coverage_on", "alpha to coverage left on: alpha is applied twice", ChangedPart::samples,
     covers_by_alpha},
    {"alpha_to_coverage_on_nearest",
     "alpha to coverage left on, of a device that rounds the number of samples to nearest", ChangedPart::samples,
     [](AlteredRun& e) { return covers_by_alpha_rounded(e, ShareRounding::nearest); }},
    {"alpha_to_coverage_on_up", "alpha to coverage left on, of a device that rounds the number of samples up",
     ChangedPart::samples, [](AlteredRun& e) { return covers_by_alpha_rounded(e, ShareRounding::up); }},
    {"alpha_to_coverage_on_down", "alpha to coverage left on, of a device that rounds the number of samples down",
     ChangedPart::samples, [](AlteredRun& e) { return covers_by_alpha_rounded(e, ShareRounding::down); }},
    {"pixel_shading", "the fragment program runs once per pixel: near edges, samples peel a layer twice or not at all",
     ChangedPart::samples, [](AlteredRun& e) { return shades_at(e, Interpolation::centre); }},
    {"pixel_shading_loads_sample_0",
     "the fragment program runs once per pixel and compares with sample 0's depth: front peels composite edge "
     "fragments twice",
     ChangedPart::samples,
     [](AlteredRun& e) { return shades_pixels_and_loads(e, Interpolation::centre, LoadedSample::zero); }},
    {"pixel_shading_loads_resolved", "the fragment program runs once per pixel and compares with the resolved depth",
     ChangedPart::samples,
     [](AlteredRun& e) { return shades_pixels_and_loads(e, Interpolation::centre, LoadedSample::resolved); }},
    {"centroid_shading", "the fragment program runs once per pixel, at the centroid", ChangedPart::samples,
     [](AlteredRun& e) { return shades_at(e, Interpolation::centroid); }},
    {"centroid_shading_loads_sample_0",
     "the fragment program runs once per pixel, at the centroid, and compares with sample 0's depth",
     ChangedPart::samples,
     [](AlteredRun& e) { return shades_pixels_and_loads(e, Interpolation::centroid, LoadedSample::zero); }},
    {"sample_mask_left_set", "a sample mask of an earlier pass left on, with the first half of the samples",
     ChangedPart::samples,
     [](AlteredRun& e) {
         std::uint8_t& mask = e.options.raster.sample_coverage.mask;
         const auto half = static_cast<std::uint8_t>((1 << (e.options.sampling.samples / 2)) - 1);
         if (mask == half) return false;
         mask = half;
         return true;
     }},
    {"sample_0_shown", "sample 0 is shown: the samples are never resolved", ChangedPart::samples,
     [](AlteredRun& e) {
         e.resolve = [](const std::vector<pipeline::Image>& samples) { return samples[0]; };
         return true;
     }},
    {"resolved_in_linear_light", "encoded samples resolved as if their values were linear: decoded, and encoded again",
     ChangedPart::samples,
     [](AlteredRun& e) {
         e.resolve = mean_of_decoded;
         return true;
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_samples() { return sample_mistakes; }

}  // namespace strata::oracle
