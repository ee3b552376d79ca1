// tools/strata/options/canonical_command.cpp - the command that renders a picture again, with every option whose value
// is not the default, in a fixed order; stored in picture files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scenes/packs/pack_scene.h"
#include "tools/strata/options/algorithm_options.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/option_readers.h"
#include "tools/strata/options/options.h"
#include "tools/strata/options/shell_words.h"

namespace strata::tools {

namespace {

using Words = std::vector<std::string>;

// Appends an option and its value.
void add(Words& words, const std::string& option, const std::string& value) {
    words.push_back(option);
    words.push_back(value);
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string to_text(const pipeline::Termination& termination) {
    switch (termination.rule) {
        case pipeline::TerminationRule::exact: return "exact";
        case pipeline::TerminationRule::paper: return "paper";
        case pipeline::TerminationRule::any: return "any";
        case pipeline::TerminationRule::ratio: return fmt::format("ratio:{}", termination.ratio);
        case pipeline::TerminationRule::fixed: break;
    }
    return fmt::format("fixed:{}", termination.passes);
}

std::string to_text(const peeling::Sort& sort) {
    switch (sort.rule) {
        case peeling::SortRule::none: return "none";
        case peeling::SortRule::exact: return "exact";
        case peeling::SortRule::reverse: return "reverse";
        case peeling::SortRule::bucket: return fmt::format("bucket:{}", sort.buckets);
        case peeling::SortRule::shuffle: break;
    }
    return fmt::format("shuffle:{},{}", sort.fraction, sort.seed);
}

std::string to_text(const pipeline::Rgba& b) {
    if (b == pipeline::Rgba{}) return "none";
    const std::string rgb = fmt::format("{},{},{}", b[0], b[1], b[2]);
    return b[3] == 1.0f ? rgb : fmt::format("{},{}", rgb, b[3]);
}

// Each of these functions appends the options of one group that differ from their defaults, in the order of
// scenes/reference/reports.md 7.
void add_scene(Words& words, const RunOptions& options) {
    const scenes::SceneOptions& scene = options.scene_options;
    if (scene.scene) add(words, "--scene", fmt::format("{}", *scene.scene));
    if (scene.color_space != pipeline::ColorSpace::encoded)
        add(words, "--color-space", name_of(color_spaces, scene.color_space));
    if (!scene.light) words.emplace_back("--no-light");
}

void add_view(Words& words, const RunOptions& options) {
    const peeling::RenderOptions& render = options.render;
    add(words, "--size", fmt::format("{}x{}", render.width, render.height));
    // The view is always written, even if it is the default, unless the scene contains it.
    const Orbit orbit = options.orbit.value_or(Orbit{});
    if (!options.camera.empty())
        add(words, "--camera", options.names_camera_of_scene ? options.camera : file_name(options.camera));
    else if (!options.takes_own_view)
        add(words, "--orbit", fmt::format("{},{}", orbit.azimuth, orbit.elevation));
    if (render.alpha) add(words, "--alpha", fmt::format("{}", *render.alpha));
    std::string alphas;
    for (const scenes::MaterialAlpha& one : options.scene_options.alpha)
        alphas += fmt::format("{}{}={}", alphas.empty() ? "" : ",", one.material, one.alpha);
    if (!alphas.empty()) add(words, "--alpha", alphas);
    // A pack has its own background, so black is written, too, if it replaces that.
    if (const auto& b = options.background; b && (*b != pipeline::Rgba{0, 0, 0, 1} || scenes::is_pack(options.scene)))
        add(words, "--background", to_text(*b));
}

void add_comparison(Words& words, const peeling::RenderOptions& render) {
    if (render.reference_path) add(words, "--reference-path", name_of(depth_paths(), *render.reference_path));
    const pipeline::CompareEpsilon& epsilon = render.compare_epsilon;
    if (epsilon.ulps != 0) add(words, "--compare-epsilon", fmt::format("{}ulp", epsilon.ulps));
    if (epsilon.absolute != 0) add(words, "--compare-epsilon", fmt::format("{}", epsilon.absolute));
    if (!render.quantize_reference) words.emplace_back("--no-quantize-reference");
    if (render.vertex_paths.first) {
        std::string paths = name_of(vertex_paths(), *render.vertex_paths.first);
        if (render.vertex_paths.second) paths += "," + name_of(vertex_paths(), *render.vertex_paths.second);
        add(words, "--vertex-path", paths);
    }
    const rasterizer::PolygonOffset& offset = render.raster.polygon_offset;
    if (offset.enabled) add(words, "--polygon-offset", fmt::format("{},{}", offset.factor, offset.units));
}

using Algorithms = std::vector<const peeling::Algorithm*>;

// Options that no algorithm of the command reads are left out: the command would be refused with them.
bool is_read(const char* option, const RunOptions& options, const Algorithms& algorithms) {
    return std::ranges::any_of(algorithms, [&](const peeling::Algorithm* algorithm) {
        return reads(*algorithm, option, options.render.algorithm);
    });
}

void add_device(Words& words, const RunOptions& options, const Algorithms& algorithms) {
    const peeling::RenderOptions& render = options.render;
    if (render.depth) add(words, "--depth-format", name_of(depth_formats, *render.depth));
    if (render.depth_path) add(words, "--depth-path", name_of(depth_paths(), *render.depth_path));
    add_comparison(words, render);
    if (options.depth_order) add(words, "--depth-order", name_of(depth_orders, *options.depth_order));
    if (options.clip_depth) add(words, "--clip-depth", name_of(clip_depths, *options.clip_depth));
    const rasterizer::RasterState& raster = render.raster;
    if (raster.depth_near != 0 || raster.depth_far != 1)
        add(words, "--depth-range", fmt::format("{},{}", raster.depth_near, raster.depth_far));
    if (raster.scissor)
        add(words, "--scissor",
            fmt::format("{},{},{},{}", raster.scissor->x0, raster.scissor->y0, raster.scissor->width(),
                        raster.scissor->height()));
    if (render.color_format) add(words, "--color-format", name_of(color_formats, *render.color_format));
    if (render.result_format) add(words, "--result-format", name_of(color_formats, *render.result_format));
    if (render.back_format) add(words, "--back-format", name_of(color_formats, *render.back_format));
    if (render.average_count != pipeline::Format::r16f && is_read("--average-count", options, algorithms))
        add(words, "--average-count", name_of(count_formats, render.average_count));
    if (render.termination != pipeline::Termination{}) add(words, "--termination", to_text(render.termination));
    if (render.max_passes != 0) add(words, "--max-passes", fmt::format("{}", render.max_passes));
    const Words of_algorithms = words_of(render.algorithm);
    for (std::size_t i = 0; i < of_algorithms.size(); i += 2)
        if (is_read(of_algorithms[i].c_str(), options, algorithms)) add(words, of_algorithms[i], of_algorithms[i + 1]);
}

void add_order(Words& words, const RunOptions& options, const Algorithms& algorithms) {
    const peeling::RenderOptions& render = options.render;
    if (render.formulation != pipeline::Formulation::resolved && is_read("--formulation", options, algorithms))
        add(words, "--formulation", name_of(formulations, render.formulation));
    if (!render.sorted.empty() && is_read("--sorted", options, algorithms))
        add(words, "--sorted", fmt::format("{}", fmt::join(render.sorted, ",")));
    if (render.sort.rule != peeling::SortRule::none) add(words, "--sort", to_text(render.sort));
}

}  // namespace

std::string canonical_command(const std::string& verb, const RunOptions& options, const peeling::Algorithm& algorithm) {
    return canonical_command(verb, options, std::vector{&algorithm});
}

std::string canonical_command(const std::string& verb, const RunOptions& options, const Algorithms& algorithms) {
    const bool is_procedural = scenes::is_procedural(options.scene);
    Words words{"strata", verb, is_procedural ? options.scene : file_name(scenes::pack_folder(options.scene))};
    std::string names;
    for (const peeling::Algorithm* algorithm : algorithms) names += (names.empty() ? "" : ",") + algorithm->name;
    add(words, "--algorithm", names);
    // A pack contains its own profile and, unless an option names another one, its background.
    if (options.profile != scenes::pack_folder(options.scene) + "/profile.json")
        add(words, "--profile", file_name(options.profile));
    if (options.origin) add(words, "--origin", name_of(origins, *options.origin));
    add_scene(words, options);
    add_view(words, options);
    add_device(words, options, algorithms);
    if (options.samples != 1) add(words, "--samples", fmt::format("{}", options.samples));
    if (options.shades_pixels) add(words, "--shading", "pixel");
    if (options.shades_pixels && options.render.raster.interpolation == rasterizer::Interpolation::centroid)
        add(words, "--interpolate", "centroid");
    if (options.load_sample != pipeline::LoadedSample::own)
        add(words, "--load-sample", name_of(loaded_samples, options.load_sample));
    if (options.composite_sample != pipeline::LoadedSample::own)
        add(words, "--composite-sample", name_of(loaded_samples, options.composite_sample));
    const rasterizer::SampleCoverage& coverage = options.render.raster.sample_coverage;
    if (coverage.by_alpha) words.emplace_back("--alpha-to-coverage");
    if (coverage.value) add(words, "--sample-coverage", fmt::format("{}", *coverage.value));
    if (coverage.is_inverted) words.emplace_back("--sample-coverage-invert");
    if (coverage.mask != 0xff) add(words, "--sample-mask", fmt::format("{}", coverage.mask));
    if (options.resolve != pipeline::Resolve::box) add(words, "--resolve", name_of(resolves, options.resolve));
    if (options.sample) add(words, "--sample", fmt::format("{}", *options.sample));
    add_order(words, options, algorithms);
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

}  // namespace strata::tools
