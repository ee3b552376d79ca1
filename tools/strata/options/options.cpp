#include "tools/strata/options/options.h"

#include <algorithm>
#include <array>

#include "peeling/registry.h"
#include "scenes/files/atomic_file.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/choices.h"
#include "tools/strata/options/names.h"
#include "tools/strata/options/pack_options.h"
#include "tools/strata/options/parse.h"

namespace strata::tools {

namespace {

struct Alphas {
    std::optional<float> everything{};
    std::vector<scenes::MaterialAlpha> materials{};
};

// "0.5", or "glass=0.3,water=0.5".
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

// One of the words of keys-and-counts.md 3.1, with its share or number of passes.
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

// One of the orders of keys-and-counts.md 5. A seed is any number of 64 bits.
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

// Bytes, or K, M and G of them.
std::optional<std::uint64_t> to_bytes(std::string_view text) {
    constexpr std::string_view suffixes = "KMG";
    const std::size_t suffix = text.empty() ? suffixes.npos : suffixes.find(text.back());
    const unsigned shift = suffix == suffixes.npos ? 0 : 10 * (static_cast<unsigned>(suffix) + 1);
    if (shift > 0) text.remove_suffix(1);
    const auto count = to_int<std::uint64_t>(text);
    // More than 2^64 - 1 bytes is no size: the shift would lose the upper bits.
    if (!count || *count > ~std::uint64_t{0} >> shift) return std::nullopt;
    return *count << shift;
}

// FACTOR,UNITS: an offset that is given is on, even with two zeros. 2^24 units are the whole range of a D24 buffer.
std::optional<rasterizer::PolygonOffset> to_polygon_offset(std::string_view text) {
    const auto values = to_numbers<float>(text, 2);
    if (!values || std::fabs((*values)[0]) > 0x1p24f || std::fabs((*values)[1]) > 0x1p24f) return std::nullopt;
    return rasterizer::PolygonOffset{true, (*values)[0], (*values)[1]};
}

// NEAR,FAR of glDepthRange, which OpenGL clamps to 0 and 1.
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

// As many as a renderer takes.
std::optional<int> to_threads(std::string_view text) {
    const auto value = to_count(text);
    return value && *value <= 1024 ? value : std::nullopt;
}

// The algorithms of a list of names, in its order, none twice; `all` stands for every algorithm of
// the registry. Throws CLI::ValidationError for any other name.
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
           "algorithms with commas between, or all (default " + options.default_algorithm + ")")
        ->type_name("NAME[,NAME...]|all");
}

void add_scene(CLI::App& app, const std::function<void(const std::string&)>& take) {
    app.add_option_function<std::string>("SCENE", take,
                                         "a .gltf, .glb, .obj, .ply, .stl or .off file, - for a glTF file from "
                                         "standard input, a pack, or a built-in scene (strata list scenes)")
        ->required()
        ->type_name("");
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

// Options are declared in the order in which --help shows them.
void add_machine_options(CLI::App& app, peeling::RenderOptions& options) {
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
    add_choice(app, options.raster.depth_order, "--depth-order", depth_orders,
               "the depth test that keeps the nearer fragment; greater: reversed depth, near at 1 (default less)");
    add_choice(app, options.raster.clip_depth, "--clip-depth", clip_depths,
               "where z of clip space ends (default minus-one-to-one; zero-to-one: glClipControl, Direct3D)");
    add_depth_range(app, options.raster);
    add_option(
        app, options.raster.scissor,
        {"--scissor", "X,Y,W,H", "glScissor: draw these pixels of the picture alone, counted from its top left corner",
         "four whole numbers such as 240,180,160,120, the last two above 0"},
        [](std::string_view text) { return to_region(text); });
    add_choice(app, options.color_format, "--color-format", color_formats,
               "colour target (default rgba8; rgba32f on ideal)");
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
    if (chosen.size() != 1) throw CLI::ValidationError("--algorithm takes one algorithm here");
    return chosen[0];
}

void add_picture_options(CLI::App& app, RunOptions& options) {
    // Options are read in the order in which they are added, so that those which are given change what a pack says.
    add_scene(app, [&options](const std::string& scene) { take_scene(options, scene); });
    add_reading_options(app, options.scene_options);
    add_algorithm_option(app, options);
    add_profile_option(app, options.profile);
    add_origin_option(app, options.origin);
    add_machine_options(app, options.render);
    add_order_options(app, options.render);
    add_view_options(app, options);
}

void add_view_options(CLI::App& app, RunOptions& options) {
    // One option fills two fields: the width is its value, the height is set beside it.
    const auto set_size = [&options](std::string_view text) {
        const auto size = to_size(text);
        if (size) options.render.height = size->height;
        return size ? std::optional(size->width) : std::nullopt;
    };
    add_option(
        app, options.render.width,
        {"--size", "WIDTHxHEIGHT", "pixels (default 1024x1024)", "WIDTHxHEIGHT such as 640x480, each from 1 to 16384"},
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

void add_execution_options(CLI::App& app, RunOptions& options) {
    accept_tiled(
        *add_choice(app, options.render.execution, "--execution", executions,
                    "over the whole frame, or tile by tile with a tile's fragments kept for later passes; same "
                    "bits (default replay)"),
        options);
    add_choice(app, options.simd, "--simd", simds, "instruction set; same bits (default best: what the processor has)");
    add_choice(app, options.render.effects, "--effects", effects,
               "simulate the stages that are needed, or all; same bits (default needed)");
    add_resource_options(app, options);
}

void accept_tiled(CLI::Option& execution, RunOptions& options) {
    execution.transform([&options](const std::string& given) {
        std::string words;
        bool has_tiled = false, has_replay = false;
        for (const std::string& word : split(given, ',')) {
            has_tiled |= word == "tiled";
            has_replay |= word == "replay" || word == "all";
            words += (words.empty() ? "" : ",") + (word == "tiled" ? std::string("replay") : word);
        }
        if (has_tiled && has_replay)
            throw CLI::ValidationError(
                "'tiled' and 'replay' exclude each other: tiled is replay with --fragment-memory 0");
        if (has_tiled) say_warning("--execution tiled is replay with --fragment-memory 0");
        options.keeps_no_fragments = has_tiled;
        return words;
    });
}

void add_resource_options(CLI::App& app, RunOptions& options) {
    add_option(app, options.render.fragment_memory,
               {"--fragment-memory", "SIZE",
                "what replay may keep of fragments, and the audit, in bytes; same bits (default 256M)",
                "bytes such as 65536, 64M or 1G"},
               to_bytes);
    add_choice(app, options.render.tile_size, "--tile", tile_sizes,
               "side of a tile in pixels; same bits (default 64; 32 where a peel runs pass by pass, 128 in large "
               "frames of one pass)");
    add_option(app, options.render.threads,
               {"--threads", "N", "threads at most; same bits (default 0: all that there are)",
                "a whole number from 0 to 1024"},
               to_threads);
}

void check_simd(Simd simd) {
    const auto available = available_simd();
    if (simd == Simd::best || std::find(available.begin(), available.end(), simd) != available.end()) return;
    std::vector<std::string> names;
    for (const Simd has : available) names.push_back(name_of(simds, has));
    throw CLI::ValidationError("--simd", "expected best or what this processor has (" + one_of(names) + "), found '" +
                                             name_of(simds, simd) + "'");
}

void add_output_options(CLI::App& app, RunOptions& options, const std::string& output_help) {
    add_path(app, options.output, {"-o,--output", "FILE", output_help, "a file name or -"});
    add_path(
        app, options.stats,
        {"--stats", "FILE|-", "statistics as JSON, one object an algorithm; - is standard output", "a file name or -"});
    app.add_flag(
        "--counters", options.render.counters,
        "count fragments by their fates, and bytes, for --stats: the frame runs literally, which takes longer");
    app.add_flag_callback(
        "--no-audit", [&options] { options.render.audit = false; },
        "do not compare with the exact A-buffer: faster, and those statistics are null");
    add_option(
        app, options.max_memory,
        {"--max-memory", "SIZE", "refuse a picture that would take more, in bytes (default: what the machine has free)",
         "bytes such as 65536, 64M or 1G"},
        to_bytes);
}

void add_format_option(CLI::App& app, RunOptions& options, const std::string& help) {
    const std::vector<Choice<scenes::ImageFile>> kinds{{"png", scenes::ImageFile::png},
                                                       {"exr", scenes::ImageFile::exr}};
    add_choice(app, options.format, "--format", kinds, help);
}

void complete(RunOptions& options) {
    const bool is_piped = scenes::is_standard_output(options.output);
    if (options.format && !is_piped)
        throw CLI::ValidationError("--format goes with -o - alone: the name '" + options.output +
                                   "' says what the file is");
    if (is_piped && scenes::is_standard_output(options.stats))
        throw CLI::ValidationError("--stats needs a file's name, for with -o - the picture takes standard output");
    if (options.keeps_no_fragments) options.render.fragment_memory = 0;
    if (options.algorithms.empty()) options.algorithms = to_algorithms(options.default_algorithm);
    if (options.orbit && !options.camera.empty()) {
        throw CLI::ValidationError("--orbit excludes --camera");
    }
    if (is_piped && options.algorithms.size() > 1)
        throw CLI::ValidationError("-o", "standard output takes one picture, not those of " +
                                             std::to_string(options.algorithms.size()) +
                                             " algorithms; name a file instead");
}

}  // namespace strata::tools
