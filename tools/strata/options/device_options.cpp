// tools/strata/options/device_options.cpp - the options of the device, its state and the order of triangles. Result
// bits depend on them.
#include <algorithm>
#include <array>
#include <cmath>

#include "tools/strata/options/algorithm_options.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/names.h"
#include "tools/strata/options/options.h"
#include "tools/strata/options/parse.h"

namespace strata::tools {

namespace {

// Parses a termination rule of peeling/reference/keys-and-counts.md 3.1, with its ratio or number of passes.
std::optional<pipeline::Termination> to_termination(std::string_view text) {
    using enum pipeline::TerminationRule;
    if (text == "exact") return pipeline::Termination{.rule = exact};
    if (text == "paper") return pipeline::Termination{.rule = paper};
    if (text == "any") return pipeline::Termination{.rule = any};
    if (text.starts_with("ratio:")) {
        const auto value = to_number<double>(text.substr(6));
        if (value && *value >= 0 && *value <= 1) return pipeline::Termination{.rule = ratio, .ratio = *value};
    }
    if (text.starts_with("fixed:")) {
        const auto value = to_int(text.substr(6));
        if (value && *value >= 1) return pipeline::Termination{.rule = fixed, .passes = *value};
    }
    return std::nullopt;
}

// Parses a sort order of peeling/reference/keys-and-counts.md 5. A seed is any 64-bit number.
std::optional<peeling::Sort> to_sort(std::string_view text) {
    using enum peeling::SortRule;
    if (text == "none") return peeling::Sort{.rule = none};
    if (text == "exact") return peeling::Sort{.rule = exact};
    if (text == "reverse") return peeling::Sort{.rule = reverse};
    if (text.starts_with("bucket:")) {
        const auto buckets = to_int(text.substr(7));
        if (buckets && *buckets >= 1) return peeling::Sort{.rule = bucket, .buckets = *buckets};
    }
    if (text.starts_with("shuffle:")) {
        const auto parts = split(text.substr(8), ',');
        if (parts.size() != 2) return std::nullopt;
        const auto fraction = to_number<double>(parts[0]);
        const auto seed = to_int<std::uint64_t>(parts[1]);
        if (fraction && seed && *fraction >= 0 && *fraction <= 1)
            return peeling::Sort{.rule = shuffle, .fraction = *fraction, .seed = *seed};
    }
    return std::nullopt;
}

// Parses FACTOR,UNITS. The offset is enabled even if both are zero. 2^24 units are the whole range of a D24 buffer.
std::optional<rasterizer::PolygonOffset> to_polygon_offset(std::string_view text) {
    const auto values = to_numbers<float>(text, 2);
    if (!values || std::fabs((*values)[0]) > 0x1p24f || std::fabs((*values)[1]) > 0x1p24f) return std::nullopt;
    return rasterizer::PolygonOffset{true, (*values)[0], (*values)[1]};
}

// Parses NEAR,FAR of glDepthRange, which OpenGL clamps to [0, 1].
std::optional<std::array<float, 2>> to_depth_range(std::string_view text) {
    const auto values = to_numbers<float>(text, 2);
    if (!values || !((*values)[0] >= 0 && (*values)[0] <= 1 && (*values)[1] >= 0 && (*values)[1] <= 1))
        return std::nullopt;
    return std::array{(*values)[0], (*values)[1]};
}

void add_depth_range(CLI::App& app, rasterizer::RasterState& raster) {
    const auto fill = [&raster](const std::string& text) {
        const auto range = to_depth_range(text);
        if (!range)
            throw CLI::ValidationError("--depth-range",
                                       "expected two numbers from 0 to 1 such as 0,0.5, found '" + text + "'");
        raster.depth_near = (*range)[0];
        raster.depth_far = (*range)[1];
    };
    app.add_option_function<std::string>("--depth-range", fill,
                                         "glDepthRange: the depths of the near and of the far plane (default 0,1)")
        ->type_name("NEAR,FAR");
}

}  // namespace

void add_profile_option(CLI::App& app, std::string& profile) {
    add_path(app, profile,
             {"--profile", "NAME|FILE", "a built-in profile, or a JSON file with one (default geforce8)",
              "a profile's name or file"});
}

void add_origin_option(CLI::App& app, std::optional<pipeline::Origin>& origin) {
    add_choice(app, origin, "--origin", origins,
               "the corner at which the device's memory begins; lower-left: OpenGL without glClipControl (default: the "
               "profile's own)");
}

// The options are declared in the order of --help.
void add_device_options(CLI::App& app, RunOptions& run) {
    peeling::RenderOptions& options = run.render;
    add_choice(app, options.depth, "--depth-format", depth_formats,
               "depth buffer (default d32f, or d24 where that is missing)");
    add_choice(app, options.depth_path, "--depth-path", depth_paths(),
               "how depth is computed (default: the profile's own)");
    add_choice(app, options.reference_path, "--reference-path", depth_paths(),
               "the depth that a peel compares with what it stored (default: the one that it stores)");
    add_option(app, options.compare_epsilon,
               {"--compare-epsilon", "E|Nulp", "added to a stored depth before a program compares it (default 0)",
                "a part of the depth range from 0 to 1 such as 1e-7, or units in the last place such as 2ulp"},
               to_epsilon);
    app.add_flag_callback(
        "--no-quantize-reference", [&options] { options.quantize_reference = false; },
        "compare a depth that is not rounded like the stored one");
    add_option(app, options.vertex_paths,
               {"--vertex-path", "A[,B]",
                "how positions are computed, in the first pass and in further ones (default separate): " +
                    one_of(names_of(vertex_paths())),
                "one or two of " + one_of(names_of(vertex_paths()))},
               [](std::string_view text) { return to_vertex_paths(text, ','); });
    add_option(app, options.raster.polygon_offset,
               {"--polygon-offset", "FACTOR,UNITS", "glPolygonOffset of everything that is drawn (default: off)",
                "two numbers such as 1,1, each from -16777216 to 16777216"},
               to_polygon_offset);
    add_choice(app, run.depth_order, "--depth-order", depth_orders,
               "the depth test that keeps the nearer fragment; greater: reversed depth, near at 1 (default: the "
               "profile's own)");
    add_choice(app, run.clip_depth, "--clip-depth", clip_depths,
               "where z of clip space begins; zero-to-one: glClipControl, Direct3D (default: the profile's own)");
    add_depth_range(app, options.raster);
    add_option(
        app, options.raster.scissor,
        {"--scissor", "X,Y,W,H", "glScissor: draw these pixels of the picture alone, counted from its top left corner",
         "four whole numbers such as 240,180,160,120, the last two above 0"},
        [](std::string_view text) { return to_region(text); });
    add_choice(app, options.color_format, "--color-format", color_formats,
               "colour target (default rgba8; rgba32f on ideal)");
    add_choice(app, options.result_format, "--result-format", color_formats,
               "the picture, where it is not kept as colours are that are composited (default: as --color-format)");
    add_choice(app, options.back_format, "--back-format", color_formats,
               "the back of dual and dual_independent (default: as --color-format, which is then that of the front)");
    add_choice(app, options.average_count, "--average-count", count_formats,
               "fragment count of weighted_average (default r16f, as in the paper)");
    add_option(app, options.termination,
               {"--termination", "exact|paper|any|ratio:R|fixed:N", "what ends a peel (default exact)",
                "exact, paper, any, ratio:R with R from 0 to 1, or fixed:N with N from 1"},
               to_termination);
    add_option(
        app, options.max_passes,
        {"--max-passes", "N", "geometry passes at most (default 0: as many as it takes)", "a whole number from 0"},
        to_count);
    add_algorithm_options(app, options.algorithm);
}

void add_order_options(CLI::App& app, peeling::RenderOptions& options) {
    add_choice(app, options.formulation, "--formulation", formulations,
               "the listings of Carr et al. repaired, or as printed, with what they lose (default resolved)");
    app.add_option_function<std::string>(
           "--sorted", [&options](const std::string& text) { options.sorted = split(text, ','); },
           "meshes or materials that arrive front to back, for hybrid (default: those that the scene names)")
        ->type_name("NAME[,NAME...]");
    add_option(app, options.sort,
               {"--sort", "bucket:N|exact|none|reverse|shuffle:F,SEED",
                "order of triangles, by centroid (default none: as listed)",
                "bucket:N with N from 1, exact, none, reverse, or shuffle:FRACTION,SEED with a fraction from 0 to 1"},
               to_sort);
}

}  // namespace strata::tools
