// tools/strata/options/options.cpp - declares the options of scene, view, algorithm and sampling, and completes what
// the user left out (options.h).
#include "tools/strata/options/options.h"

#include <algorithm>

#include "peeling/registry.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/names.h"
#include "tools/strata/options/option_readers.h"
#include "tools/strata/options/pack_options.h"
#include "tools/strata/options/parse.h"

namespace strata::tools {

namespace {

struct Alphas {
    std::optional<float> everything{};
    std::vector<scenes::MaterialAlpha> materials{};
};

// Parses "0.5" or "glass=0.3,water=0.5".
std::optional<Alphas> to_alphas(std::string_view text) {
    Alphas alphas;
    if (text.find('=') == text.npos) {
        alphas.everything = to_share(text);
        return alphas.everything ? std::optional(alphas) : std::nullopt;
    }
    for (const std::string& part : split(text, ',')) {
        const std::size_t is = part.rfind('=');
        const auto alpha = is == std::string::npos ? std::nullopt : to_share(std::string_view(part).substr(is + 1));
        if (!alpha || is == 0) return std::nullopt;
        alphas.materials.push_back({part.substr(0, is), *alpha});
    }
    return alphas;
}

// The algorithms of a list of names, in the order of the list, without repetition; `all` means every algorithm of the
// registry. Throws CLI::ValidationError for an unknown name.
std::vector<const peeling::Algorithm*> to_algorithms(const std::string& text) {
    std::vector<const peeling::Algorithm*> chosen;
    const auto add = [&](const peeling::Algorithm& algorithm) {
        if (std::find(chosen.begin(), chosen.end(), &algorithm) == chosen.end()) chosen.push_back(&algorithm);
    };
    for (const std::string& name : split(text, ',')) {
        if (name == "all") {
            for (const peeling::Algorithm& algorithm : peeling::algorithms()) add(algorithm);
            continue;
        }
        const peeling::Algorithm* algorithm = peeling::find_algorithm(name);
        if (algorithm == nullptr) {
            auto names = algorithm_names();
            names.emplace_back("all");
            throw CLI::ValidationError(
                "--algorithm", "expected names of algorithms (strata list algorithms shows them) or all, found " +
                                   found_but_near(name, names));
        }
        add(*algorithm);
    }
    return chosen;
}

void add_algorithm_option(CLI::App& app, RunOptions& options) {
    app.add_option_function<std::string>(
           "--algorithm", [&options](const std::string& text) { options.algorithms = to_algorithms(text); },
           (options.takes_one_algorithm ? "an algorithm (default "
                                        : "algorithms with commas between, or all (default ") +
               options.default_algorithm + ")")
        ->type_name(options.takes_one_algorithm ? "NAME" : "NAME[,NAME...]|all");
}

std::optional<std::uint8_t> to_mask(std::string_view text) {
    const auto number = to_count(text);
    return number && *number <= 255 ? std::optional{static_cast<std::uint8_t>(*number)} : std::nullopt;
}

}  // namespace

void add_shading_options(CLI::App& app, RunOptions& options) {
    add_choice(
        app, options.shades_pixels, "--shading", shadings,
        "per-sample or per-pixel evaluation of colours and programs; coverage and stored depth are always per sample "
        "(default sample)");
    add_choice(
        app, options.interpolate, "--interpolate", interpolations,
        "position of per-pixel shading: the pixel's centre, which may lie outside the triangle, or the centroid, "
        "the first covered sample of a partly covered pixel (default centre)");
}

namespace {

void add_sample_options(CLI::App& app, RunOptions& options) {
    add_choice(app, options.samples, "--samples", sample_counts,
               "samples per pixel, where the profile has them (default 1)");
    add_shading_options(app, options);
    add_option(app, options.sample,
               {"--sample", "N", "one of the samples alone, by its number from 0, instead of all of them resolved",
                "a whole number from 0"},
               to_count);
    add_choice(
        app, options.load_sample, "--load-sample", loaded_samples,
        "the sample that the programs of geometry passes load of earlier passes, as a peel loads depths: its own, "
        "sample 0, or all resolved (default own)");
    add_choice(app, options.composite_sample, "--composite-sample", loaded_samples,
               "the same of full-screen passes, as a composite loads layers (default own)");
    app.add_flag("--alpha-to-coverage", options.render.raster.sample_coverage.by_alpha,
                 "a fragment of a transparent pass covers the share of samples that its alpha is");
    add_option(app, options.render.raster.sample_coverage.value,
               {"--sample-coverage", "SHARE", "transparent passes cover this share of the samples, as glSampleCoverage",
                "a number from 0 to 1"},
               to_share);
    app.add_flag("--sample-coverage-invert", options.render.raster.sample_coverage.is_inverted,
                 "cover the samples that --sample-coverage leaves out (GL_SAMPLE_COVERAGE_INVERT)");
    add_option(app, options.render.raster.sample_coverage.mask,
               {"--sample-mask", "BITS", "the samples that transparent passes cover, bit s for sample s (default 255)",
                "a whole number from 0 to 255"},
               to_mask);
    add_choice(app, options.resolve, "--resolve", resolves,
               "the mean of a pixel's samples, or GeForce3's Quincunx of two (default box)");
}

void check_samples(const RunOptions& options) {
    const std::string last = std::to_string(options.samples - 1);
    if (options.sample && *options.sample >= options.samples)
        throw CLI::ValidationError("--sample", "expected a number from 0 to " + last + " with --samples " +
                                                   std::to_string(options.samples) + ", found " +
                                                   std::to_string(*options.sample));
    const bool loads_others =
        options.load_sample != pipeline::LoadedSample::own || options.composite_sample != pipeline::LoadedSample::own;
    if (loads_others && (options.samples == 1 || options.sample))
        throw CLI::ValidationError(
            "--load-sample and --composite-sample are valid only with --samples 2, 4 or 8 and without --sample");
    const rasterizer::SampleCoverage& coverage = options.render.raster.sample_coverage;
    const bool is_of_pack = options.render.raster.sample.has_value();
    if (coverage != rasterizer::SampleCoverage{} && options.samples == 1 && !is_of_pack)
        throw CLI::ValidationError(
            "--alpha-to-coverage, --sample-coverage and --sample-mask are valid only with --samples 2, 4 or 8");
    if (coverage.is_inverted && !coverage.value)
        throw CLI::ValidationError("--sample-coverage-invert is valid only with --sample-coverage");
    if (options.shades_pixels && options.samples == 1)
        throw CLI::ValidationError("--shading pixel is valid only with --samples 2, 4 or 8");
    if (options.interpolate && !options.shades_pixels)
        throw CLI::ValidationError("--interpolate is valid only with --shading pixel");
    if (options.resolve != pipeline::Resolve::box && options.sample)
        throw CLI::ValidationError("--resolve is valid only without --sample: one sample is not resolved");
}

// A pack of one sample keeps its own.
void take_interpolation(RunOptions& options) {
    using enum rasterizer::Interpolation;
    rasterizer::Interpolation& where = options.render.raster.interpolation;
    if (options.shades_pixels)
        where = options.interpolate.value_or(where == sample ? centre : where);
    else if (options.samples > 1)
        where = sample;
}

void add_scene(CLI::App& app, const std::function<void(const std::string&)>& take) {
    app.add_option_function<std::string>("SCENE", take,
                                         "a .gltf, .glb, .obj, .ply, .stl or .off file, - for a glTF file from "
                                         "standard input, a pack, or a built-in scene (strata list scenes)")
        ->required()
        ->type_name("");
}

}  // namespace

std::vector<std::string> algorithm_names() {
    std::vector<std::string> names;
    for (const peeling::Algorithm& algorithm : peeling::algorithms()) names.push_back(algorithm.name);
    return names;
}

void add_scene_options(CLI::App& app, std::string& scene, scenes::SceneOptions& options) {
    add_scene(app, [&scene](const std::string& given) { scene = given; });
    add_reading_options(app, options);
}

void add_reading_options(CLI::App& app, scenes::SceneOptions& options) {
    add_option(app, options.scene,
               {"--scene", "N", "which scene of a glTF file (default: the file's own)", "a whole number from 0"},
               to_count);
    add_choice(app, options.color_space, "--color-space", color_spaces,
               "blend sRGB values as they are, or decoded to linear light (default encoded)");
    app.add_flag_callback(
        "--no-light", [&options] { options.light = false; }, "draw every material unlit");
}

void take_scene(RunOptions& options, const std::string& scene) {
    options.scene = scene;
    take_pack_state(options, scene);
}

const peeling::Algorithm* to_algorithm(const std::string& name) {
    const auto chosen = to_algorithms(name);
    if (chosen.size() != 1)
        throw CLI::ValidationError("--algorithm",
                                   "expected one algorithm, found " + std::to_string(chosen.size()) + " of them");
    return chosen[0];
}

void add_picture_options(CLI::App& app, RunOptions& options) {
    // Options take effect in the order in which they are added: SCENE is first, so that other options override the
    // state of a pack.
    options.app = &app;
    add_scene(app, [&options](const std::string& scene) { take_scene(options, scene); });
    add_reading_options(app, options.scene_options);
    add_algorithm_option(app, options);
    add_profile_option(app, options.profile);
    add_origin_option(app, options.origin);
    add_device_options(app, options);
    add_sample_options(app, options);
    add_order_options(app, options.render);
    add_view_options(app, options);
}

void add_view_options(CLI::App& app, RunOptions& options) {
    // One option fills two fields: the width is its value, and the height is set separately.
    const auto set_size = [&options](std::string_view text) {
        const auto size = to_size(text);
        if (size) options.render.height = size->height;
        options.states_size = true;
        return size ? std::optional(size->width) : std::nullopt;
    };
    add_option(app, options.render.width,
               {"--size", "WIDTHxHEIGHT",
                options.takes_size_of_picture ? "the size in pixels that the picture must have (default: the picture's)"
                                              : "pixels (default 1024x1024)",
                "WIDTHxHEIGHT such as 640x480, each from 1 to 16384"},
               set_size);
    add_path(app, options.camera,
             {"--camera", "NAME|FILE", "a camera of the scene, or a JSON file with one", "a camera's name or file"});
    add_option(app, options.orbit,
               {"--orbit", "AZ,EL", "look at the scene's bounds from these degrees (default 30,20)",
                "azimuth and elevation in degrees such as 30,20"},
               to_orbit);
    app.add_option_function<std::string>(
           "--alpha",
           [&options](const std::string& given) {
               auto alphas = to_alphas(given);
               if (!alphas)
                   throw CLI::ValidationError("--alpha",
                                              "expected a number from 0 to 1, or MATERIAL=A with commas "
                                              "between, found '" +
                                                  given + "'");
               options.render.alpha = alphas->everything;
               options.scene_options.alpha = std::move(alphas->materials);
           },
           "draw everything as transparent, its own alpha times A, or these materials alone")
        ->type_name("A|MATERIAL=A[,...]");
    add_option(app, options.background,
               {"--background", "R,G,B[,A]|none",
                "sRGB values from 0 to 1, and alpha; none is 0,0,0,0 (default 0,0,0,1)", background_expected},
               to_background);
}

peeling::Multisampling sampling(const RunOptions& options) noexcept {
    return {.samples = options.sample ? 1 : options.samples,
            .resolve = options.resolve,
            .loads = options.load_sample,
            .composites = options.composite_sample};
}

void complete(RunOptions& options) {
    const bool is_piped = scenes::is_standard_output(options.output);
    if (options.format && !is_piped)
        throw CLI::ValidationError("--format is valid only with -o -; the name '" + options.output +
                                   "' determines the format");
    if (is_piped && scenes::is_standard_output(options.stats))
        throw CLI::ValidationError("with -o -, --stats must name a file");
    if (options.algorithms.empty()) options.algorithms = to_algorithms(options.default_algorithm);
    if (options.app != nullptr) refuse_unread(*options.app, options.algorithms, options.render.algorithm);
    check_samples(options);
    take_interpolation(options);
    if (options.orbit && !options.camera.empty()) {
        throw CLI::ValidationError("--orbit and --camera exclude each other");
    }
    if (is_piped && options.algorithms.size() > 1)
        throw CLI::ValidationError("-o", "standard output takes one picture, not those of " +
                                             std::to_string(options.algorithms.size()) +
                                             " algorithms; name a file instead");
}

}  // namespace strata::tools
