// tools/request/sample_fields.cpp - the options of multisampling.
#include "tools/request/choices.h"
#include "tools/request/groups.h"
#include "tools/request/make_field.h"

namespace strata::tools {

namespace {

using peeling::Multisampling;
using peeling::RenderOptions;
using rasterizer::RasterState;
using rasterizer::SampleCoverage;

std::optional<std::uint8_t> to_mask(std::string_view text) {
    const auto number = to_count(text);
    return number && *number <= 255 ? std::optional{static_cast<std::uint8_t>(*number)} : std::nullopt;
}

// glSampleCoverage and what goes with it.
std::vector<OptionField> coverage_fields() {
    using enum OptionGroup;
    return {
        flag<&PictureRequest::render, &RenderOptions::raster, &RasterState::sample_coverage, &SampleCoverage::by_alpha>(
            samples, "alpha-to-coverage",
            "a fragment of a transparent pass covers the share of samples that its alpha is"),
        number<&PictureRequest::render, &RenderOptions::raster, &RasterState::sample_coverage, &SampleCoverage::value>(
            samples,
            {"sample-coverage", "SHARE", "transparent passes cover this share of the samples, as glSampleCoverage",
             "a number from 0 to 1"},
            to_share),
        flag<&PictureRequest::render, &RenderOptions::raster, &RasterState::sample_coverage,
             &SampleCoverage::is_inverted>(
            samples, "sample-coverage-invert",
            "cover the samples that --sample-coverage leaves out (GL_SAMPLE_COVERAGE_INVERT)"),
        number<&PictureRequest::render, &RenderOptions::raster, &RasterState::sample_coverage, &SampleCoverage::mask>(
            samples,
            {"sample-mask", "BITS", "the samples that transparent passes cover, bit s for sample s (default 255)",
             "a whole number from 0 to 255"},
            to_mask),
    };
}

}  // namespace

std::vector<OptionField> sample_fields() {
    using enum OptionGroup;
    std::vector<OptionField> all{
        usual(choice<&PictureRequest::sampling, &Multisampling::samples>(
            samples, "samples", sample_counts, "samples per pixel, where the profile has them (default 1)")),
        choice<&PictureRequest::shades_pixels>(
            shading, "shading", shadings,
            "per-sample or per-pixel evaluation of colours and programs; coverage and stored depth are always per "
            "sample (default sample)"),
        choice<&PictureRequest::interpolate>(
            shading, "interpolate", interpolations,
            "position of per-pixel shading: the pixel's centre, which may lie outside the triangle, or the centroid, "
            "the first covered sample of a partly covered pixel (default centre)"),
        choice<&PictureRequest::sampling, &Multisampling::loads>(
            samples, "load-sample", loaded_samples,
            "the sample that the programs of geometry passes load of earlier passes, as a peel loads depths: its own, "
            "sample 0, or all resolved (default own)"),
        choice<&PictureRequest::sampling, &Multisampling::composites>(
            samples, "composite-sample", loaded_samples,
            "the same of full-screen passes, as a composite loads layers (default own)"),
    };
    std::ranges::move(coverage_fields(), std::back_inserter(all));
    all.push_back(usual(choice<&PictureRequest::sampling, &Multisampling::resolve>(
        samples, "resolve", resolves, "the mean of a pixel's samples, or GeForce3's Quincunx of two (default box)")));
    all.push_back(usual(number<&PictureRequest::sample>(
        samples,
        {"sample", "N", "one of the samples alone, by its number from 0, instead of all of them resolved",
         "a whole number from 0"},
        to_count)));
    return all;
}

}  // namespace strata::tools
