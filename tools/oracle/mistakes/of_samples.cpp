// tools/oracle/mistakes/of_samples.cpp - mistakes with the samples of a pixel: which of them programs run for and load.
//
// Rule     None is applicable to a frame of one sample per pixel.
// Source   pipeline/reference/fragment-stages.md 13.5; tools/lab/multisampling/MULTISAMPLING.md counts what each loses.
#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/mistakes/catalogue.h"

namespace strata::oracle {

namespace {

using pipeline::LoadedSample;
using pipeline::ShareRounding;
using rasterizer::Interpolation;

// Programs that load another sample than their own.
bool loads(Experiment& e, LoadedSample in_peels, LoadedSample in_composites) {
    if (e.sampling.samples == 1 || (e.sampling.loads == in_peels && e.sampling.composites == in_composites))
        return false;
    e.sampling.loads = in_peels;
    e.sampling.composites = in_composites;
    return true;
}

bool shades_at(Experiment& e, Interpolation place) {
    if (e.sampling.samples == 1 || e.options.raster.interpolation == place) return false;
    e.options.raster.interpolation = place;
    return true;
}

bool shades_pixels_and_loads(Experiment& e, Interpolation place, LoadedSample in_peels) {
    return shades_at(e, place) && loads(e, in_peels, e.sampling.composites);
}

bool covers_by_alpha(Experiment& e) {
    if (e.sampling.samples == 1 || e.options.raster.sample_coverage.by_alpha) return false;
    return e.options.raster.sample_coverage.by_alpha = true;
}

// ARB_multisample leaves the number of samples to the device.
bool covers_by_alpha_rounded(Experiment& e, ShareRounding rounding) {
    if (e.profile.alpha_to_coverage == rounding || !covers_by_alpha(e)) return false;
    e.profile.alpha_to_coverage = rounding;
    return true;
}

// The mean of decoded sRGB values, encoded; alpha is linear.
pipeline::Image mean_of_decoded(const std::vector<pipeline::Image>& samples) {
    std::vector<Target> targets;
    for (const pipeline::Image& sample : samples) targets.push_back(as_target(sample, ""));
    pipeline::Image mean = samples[0];
    const auto channels = static_cast<std::size_t>(mean.channels());
    for (std::size_t i = 0; i < mean.codes.size(); ++i) {
        const bool is_alpha = i % channels == 3;
        const auto decoded = [&](const Target& target) {
            const double v = value(target.code, target.codes[i]);
            return is_alpha ? v : double{scenes::decode_srgb(static_cast<float>(v))};
        };
        double sum = 0;
        for (const Target& target : targets) sum += decoded(target);
        const double linear = sum / static_cast<double>(samples.size());
        mean.codes[i] =
            nearest(targets[0].code, is_alpha ? linear : double{scenes::encode_srgb(static_cast<float>(linear))});
    }
    return mean;
}

const Mistake sample_mistakes[] = {
    {"no_samples", "one sample per pixel: multisampling left off", ChangedPart::samples,
     [](Experiment& e) {
         if (e.sampling.samples == 1) return false;
         e.sampling.samples = 1;
         e.sampling.resolve = pipeline::Resolve::box;
         return true;
     }},
    {"resolve_before_compositing", "every layer resolved before it is composited", ChangedPart::samples,
     [](Experiment& e) { return loads(e, e.sampling.loads, LoadedSample::resolved); }},
    {"sample_0_for_all", "sample 0 loaded for all samples, in every program", ChangedPart::samples,
     [](Experiment& e) { return loads(e, LoadedSample::zero, LoadedSample::zero); }},
    {"peel_loads_sample_0", "sample 0's depth of the last layer compared with, for all samples", ChangedPart::samples,
     [](Experiment& e) { return loads(e, LoadedSample::zero, e.sampling.composites); }},
    {"peel_loads_resolved",
     "the resolved depth of the last layer compared with: fragments doubled wherever depth slopes",
     ChangedPart::samples, [](Experiment& e) { return loads(e, LoadedSample::resolved, e.sampling.composites); }},
    {"alpha_to_coverage_on", "alpha to coverage left on, so that alpha counts twice", ChangedPart::samples,
     covers_by_alpha},
    {"alpha_to_coverage_on_nearest",
     "alpha to coverage left on, of a device that rounds the number of samples to nearest", ChangedPart::samples,
     [](Experiment& e) { return covers_by_alpha_rounded(e, ShareRounding::nearest); }},
    {"alpha_to_coverage_on_up", "alpha to coverage left on, of a device that rounds the number of samples up",
     ChangedPart::samples, [](Experiment& e) { return covers_by_alpha_rounded(e, ShareRounding::up); }},
    {"alpha_to_coverage_on_down", "alpha to coverage left on, of a device that rounds the number of samples down",
     ChangedPart::samples, [](Experiment& e) { return covers_by_alpha_rounded(e, ShareRounding::down); }},
    {"pixel_shading", "programs run once a pixel, so that samples near an edge peel a layer twice or not at all",
     ChangedPart::samples, [](Experiment& e) { return shades_at(e, Interpolation::centre); }},
    {"pixel_shading_loads_sample_0",
     "programs run once a pixel, and sample 0's depth compared with: peeled from the front, edges darkened by doubled "
     "fragments",
     ChangedPart::samples,
     [](Experiment& e) { return shades_pixels_and_loads(e, Interpolation::centre, LoadedSample::zero); }},
    {"pixel_shading_loads_resolved", "programs run once a pixel, and the resolved depth compared with",
     ChangedPart::samples,
     [](Experiment& e) { return shades_pixels_and_loads(e, Interpolation::centre, LoadedSample::resolved); }},
    {"centroid_shading", "programs run once a pixel, at the centroid", ChangedPart::samples,
     [](Experiment& e) { return shades_at(e, Interpolation::centroid); }},
    {"centroid_shading_loads_sample_0",
     "programs run once a pixel, at the centroid, and sample 0's depth compared with", ChangedPart::samples,
     [](Experiment& e) { return shades_pixels_and_loads(e, Interpolation::centroid, LoadedSample::zero); }},
    {"sample_mask_left_set", "a sample mask left set, with the first half of the samples", ChangedPart::samples,
     [](Experiment& e) {
         std::uint8_t& mask = e.options.raster.sample_coverage.mask;
         const auto half = static_cast<std::uint8_t>((1 << (e.sampling.samples / 2)) - 1);
         if (e.sampling.samples == 1 || mask == half) return false;
         mask = half;
         return true;
     }},
    {"sample_0_shown", "sample 0 alone: the samples never resolved", ChangedPart::samples,
     [](Experiment& e) {
         if (e.sampling.samples == 1) return false;
         e.resolve = [](const std::vector<pipeline::Image>& samples) { return samples[0]; };
         return true;
     }},
    {"resolved_in_linear_light", "encoded samples resolved as if their values were linear: decoded, and encoded again",
     ChangedPart::samples,
     [](Experiment& e) {
         if (e.sampling.samples == 1) return false;
         e.resolve = mean_of_decoded;
         return true;
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_samples() { return sample_mistakes; }

}  // namespace strata::oracle
