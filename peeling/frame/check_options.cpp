// peeling/frame/check_options.cpp - the checks of check_options.h, field by field.
#include "peeling/frame/check_options.h"

#include <algorithm>
#include <iterator>

#include "peeling/algorithms/algorithm.h"
#include "rasterizer/base/require.h"

namespace strata::peeling {

using namespace pipeline;

namespace {

void check_algorithm_options(const Requirements& its, const AlgorithmOptions& o) {
    its.listed("algorithm.weight", o.weight);
    if (o.weight_formula && !is_complete(*o.weight_formula))
        its.fail(FieldName{"algorithm.weight_formula"}, "steps that find their operands and leave one value",
                 static_cast<int>(o.weight_formula->steps.size()));
    its.listed("algorithm.overflow", o.overflow);
    if (o.tail) its.listed("algorithm.tail", *o.tail);
    its.listed("algorithm.list_granularity", o.list_granularity);
    its.within("algorithm.nodes", o.nodes, 1, most_nodes);
    its.within("algorithm.pixel_nodes", o.pixel_nodes, 0, INT32_MAX);
    its.within("algorithm.frame_nodes", o.frame_nodes, 0, INT32_MAX);
    its.within("algorithm.stochastic_samples", o.stochastic_samples, 1, most_stochastic_samples);
    if (o.moments != 4 && o.moments != 6 && o.moments != 8)
        its.fail(FieldName{"algorithm.moments"}, "4, 6 or 8", o.moments);
    const auto share = [&](const char* name, float value) {
        if (!(value >= 0 && value <= 1)) its.fail(FieldName{name}, "a number from 0 to 1", value);
    };
    if (o.moment_bias) share("algorithm.moment_bias", *o.moment_bias);
    share("algorithm.overestimation", o.overestimation);
}

}  // namespace

void check_options(const RenderOptions& o) {
    const Requirements its{"render options"};
    its.within("width", o.width, 1, 16384);
    its.within("height", o.height, 1, 16384);
    if (o.tile_size && std::find(std::begin(tile_sizes), std::end(tile_sizes), *o.tile_size) == std::end(tile_sizes))
        its.fail(FieldName{"tile_size"}, "8, 16, 32, 64 or 128", *o.tile_size);
    its.within("threads", o.threads, 0, 1024);
    its.within("window_origin[0]", o.window_origin[0], 0, 32768 - o.width);
    its.within("window_origin[1]", o.window_origin[1], 0, 32768 - o.height);
    its.within("compare_epsilon.ulps", o.compare_epsilon.ulps, 0, 1 << 24);
    if (!(o.compare_epsilon.absolute >= 0 && o.compare_epsilon.absolute <= 1))
        its.fail(FieldName{"compare_epsilon.absolute"}, "a number from 0 to 1", o.compare_epsilon.absolute);
    if (!has_simd(o.simd))
        its.fail(FieldName{"simd"}, "an instruction set that this processor has", static_cast<int>(o.simd));
    if (const int samples = o.sampling.samples; samples != 1 && samples != 2 && samples != 4 && samples != 8)
        its.fail(FieldName{"samples"}, "1, 2, 4 or 8", samples);
    its.within("max_passes", o.max_passes, 0, 1000000);
    its.listed("termination.rule", o.termination.rule);
    if (o.termination.rule == TerminationRule::fixed)
        its.within("termination.passes", o.termination.passes, 1, 1000000);
    if (o.termination.rule == TerminationRule::ratio && !(o.termination.ratio >= 0))
        its.fail(FieldName{"termination.ratio"}, "a number of at least 0", o.termination.ratio);
    check_algorithm_options(its, o.algorithm);
    if (o.fog) its.listed("fog.mode", o.fog->mode);
    if (const auto fault = o.fog ? fault_of(*o.fog) : std::nullopt)
        its.fail(std::string{"fog."} + fault->field, fault->expected, fault->found);
    if (const auto fault = o.lights ? fault_of(*o.lights) : std::nullopt)
        throw InputError("render options", fault->field, fault->expected, fault->found);
    if (const auto fault = fault_of(o.light_model))
        throw InputError("render options", "light_model." + fault->field, fault->expected, fault->found);
    if (o.alpha) its.finite("alpha", *o.alpha);
    if (o.depth) its.listed("depth", *o.depth);
    if (o.depth_path) its.listed("depth_path", *o.depth_path);
    if (o.reference_path) its.listed("reference_path", *o.reference_path);
    const auto of_color = [&](const char* name, const std::optional<pipeline::Format>& format) {
        if (format && (!is_listed(*format) || !is_color(*format)))
            its.fail(FieldName{name}, "a colour format", static_cast<int>(*format));
    };
    of_color("color_format", o.color_format);
    of_color("result_format", o.result_format);
    of_color("back_format", o.back_format);
}

std::optional<Refusal> check_depth(const DeviceProfile& profile, const rasterizer::DepthRequest& depth) {
    using rasterizer::DepthPath;
    if (auto lacking = check(profile, depth.format)) return lacking;
    const bool has_chip_rule =
        profile.raster.window_z == rasterizer::WindowZ::buffer_units && depth.format != DepthFormat::d32f;
    const auto uses = [&](DepthPath path) { return depth.path == path || depth.reference == path; };
    if (uses(DepthPath::window_z) && !has_chip_rule)
        return Refusal{"GeForce3's depth interpolator window_z", "",
                       "use --profile geforce3 with --depth-format d16 or d24"};
    if (uses(DepthPath::w_buffer) && !has_chip_rule)
        return Refusal{"w buffer", "", "use --profile geforce3 with --depth-format d16, d24, d16f or d24f"};
    if (depth.reference)
        if (auto lacking = check_reference(profile, *depth.reference)) return lacking;
    return check(profile, depth.path);
}

std::optional<Refusal> check_order(const RenderOptions& options, DepthFormat format, bool casts_shadows) {
    if (options.raster.depth_order == rasterizer::DepthOrder::less) {
        if (options.raster.depth_near > options.raster.depth_far)
            return Refusal{"peeling with LESS over a reversed depth range", "",
                           "use a depth range with near below far, or --depth-order greater beside this one"};
        return std::nullopt;
    }
    if (format == DepthFormat::d16f || format == DepthFormat::d24f)
        return Refusal{"peeling with GREATER over float depth of 16 or 24 bits", "", "use --depth-format d24 or d32f"};
    if (options.depth_path == rasterizer::DepthPath::w_buffer)
        return Refusal{"w buffer with GREATER, because w grows with the distance", "", "use --depth-order less"};
    if (options.compare_epsilon.absolute != 0 || !options.quantize_reference)
        return Refusal{"reversed depth with an absolute compare epsilon or an unrounded compared depth", "",
                       "use --compare-epsilon Nulp"};
    if (options.depth_path == rasterizer::DepthPath::logarithmic)
        return Refusal{"logarithmic depth with GREATER, because it grows with the distance", "",
                       "use --depth-order less"};
    if (casts_shadows)
        return Refusal{"reversed depth together with a light that casts shadows", "", "use --depth-order less"};
    return std::nullopt;
}

std::optional<Refusal> check_shading(const DeviceProfile& profile, const Algorithm& algorithm,
                                     const rasterizer::DepthRequest& depth, const RenderOptions& options) {
    const rasterizer::Interpolation interpolation = options.raster.interpolation;
    const bool lists_pixels = has_pixel_lists(algorithm, options);
    if (interpolation == rasterizer::Interpolation::sample)
        return !lists_pixels
                   ? std::nullopt
                   : std::optional<Refusal>{{"lists of pixels with per-sample shading, because a node has one colour "
                                             "for all of its samples",
                                             "", "use --shading pixel, or --list-granularity sample", algorithm.name}};
    if (lists_pixels && options.raster.sample_coverage != rasterizer::SampleCoverage{})
        return Refusal{"lists of pixels with samples that are dropped after the program", "",
                       "use --list-granularity sample, or neither alpha to coverage, sample coverage nor a sample mask",
                       algorithm.name};
    if (auto lacking = check_interpolation(profile, interpolation)) return lacking;
    if (depth.path == rasterizer::DepthPath::depth_replace || rasterizer::is_written_by_program(depth.path))
        return Refusal{"per-pixel shading with replaced depth", "", "use --shading sample"};
    if (algorithm.compares_own_codes && !lists_pixels)
        return Refusal{"per-pixel shading, because it compares its own stored depths", "",
                       algorithm.has_lists
                           ? "use --list-granularity pixel, or --shading sample"
                           : "use --shading sample, or front_to_back, dual, dual_independent or depth_units",
                       algorithm.name};
    return std::nullopt;
}

bool compares_w_with_depth(const rasterizer::DepthRequest& depth) noexcept {
    const auto differ = [&](rasterizer::DepthPath w) {
        return depth.reference && (depth.path == w) != (*depth.reference == w);
    };
    return differ(rasterizer::DepthPath::w_buffer) || differ(rasterizer::DepthPath::logarithmic);
}

}  // namespace strata::peeling
