// tools/lab/invariance/invariance.cpp - strata invariance: measures the effect on a peel of two depths that should be
// equal but are computed differently, and of each remedy.
//
// Rule     In FOLDER/images, for cells with a duplicate or a loss, named by the cell's number: NNNN.png, the peeled
//          image; NNNN.difference.png, 4 times the magnitude of its difference from the exact A-buffer's;
//          NNNN.difference.exr, that difference itself, signed, binary32; NNNN.errors.png, the picture in dark grey,
//          pixels with a duplicated layer red, with a lost one blue, with both magenta.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "scenes/files/text_file.h"
#include "tools/lab/commands.h"
#include "tools/lab/invariance/invariance_cell.h"
#include "tools/lab/invariance/invariance_row.h"
#include "tools/lab/invariance/invariance_summary.h"
#include "tools/lab/invariance/precision.h"
#include "tools/lab/sweep/sweep.h"
#include "tools/request/choices.h"
#include "tools/strata/options/options.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

namespace {

using pipeline::Image;

// An 8-bit code of a value from 0 to 1, clamped and rounded to nearest. Only for viewing: no result depends on it.
std::uint32_t to_code(double value) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

// An opaque rgba8 image whose channel c at (x, y) is color(x, y, c).
template <class Color>
Image draw(int width, int height, Color&& color) {
    Image image(pipeline::Format::rgba8, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) image.codes[image.index(x, y, c)] = color(x, y, c);
            image.codes[image.index(x, y, 3)] = 255;
        }
    return image;
}

// The magnitude of the difference times four: a difference of a quarter is full brightness.
Image magnified(const Image& difference) {
    return draw(difference.width, difference.height, [&](int x, int y, int c) {
        return to_code(4.0 * std::fabs(peeling::channel_value(difference, x, y, c)));
    });
}

// `map` has one byte per pixel, row by row from the top: 0, or bits for a duplicated and a lost layer.
Image error_map(const Image& picture, const std::vector<std::uint8_t>& map) {
    return draw(picture.width, picture.height, [&](int x, int y, int c) {
        const std::uint8_t error =
            map[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)];
        if (error != 0) {
            const bool is_lit =
                (c == 0 && (error & peeling::layer_duplicated) != 0) || (c == 2 && (error & peeling::layer_lost) != 0);
            return is_lit ? 255u : 0u;
        }
        // The mean of r, g and b at 40 %, so that the marks are conspicuous.
        double grey = 0;
        for (int k = 0; k < 3; ++k) grey += peeling::channel_value(picture, x, y, k) / 3.0;
        return to_code(0.4 * grey);
    });
}

void write_cell_images(const std::string& folder, std::size_t number, const CellResult& result) {
    // A cell without errors has no files.
    if (result.measured.refusal || result.measured.errors.total() == 0) return;
    const std::filesystem::path images = std::filesystem::path(folder) / "images";
    // The folder may come from someone else: a link would lead the pictures elsewhere.
    if (std::filesystem::is_symlink(images))
        throw InputError(images.string(), "folder", "a folder in its own place", "a link");
    std::filesystem::create_directories(images);
    const auto path = [&](const char* ending) { return (images / fmt::format("{:04}{}", number, ending)).string(); };
    const Image& picture = result.measured.picture;
    const Image difference = peeling::difference(picture, result.measured.truth);
    scenes::write_image(path(".png"), {.color = picture});
    scenes::write_image(path(".difference.png"), {.color = magnified(difference)});
    scenes::write_image(path(".difference.exr"), {.color = difference});
    scenes::write_image(path(".errors.png"), {.color = error_map(picture, result.measured.errors.map)});
}

// The command line. `keys` are the options that are keys of a plan. Of `run` the scene and its reading options, the
// resources and the output folder are used.
struct InvarianceOptions {
    RunOptions run;
    KeyValues keys;
    std::string plan;
    Shard shard;
    bool dry_run = false, images = true, hypotheses = false;
    std::optional<DepthSpan> precision{};
};

// depth_format becomes --depth-format.
std::string option_of(const PlanKey& key) {
    std::string name = "--" + key.name;
    std::replace(name.begin() + 2, name.end(), '_', '-');
    return name;
}

// Declares the option of a key. Each value is tried on a temporary cell; the real cells are set when the plan is
// expanded.
void add_key(CLI::App& app, InvarianceOptions& options, const PlanKey& key) {
    const auto fill = [&options, key](const std::string& given) {
        const auto values = key.is_list ? split(given, ',') : std::vector{given};
        for (const std::string& value : values) {
            Cell cell;
            if (!key.set(cell, value))
                throw CLI::ValidationError(option_of(key), "expected " + key.expected + ", found '" + value + "'");
        }
        options.keys[key.name] = values;
    };
    const std::string help = key.help + " (default " + key.fallback + ")";
    app.add_option_function<std::string>(option_of(key), fill, help)
        ->type_name(key.is_list ? "VALUE[,VALUE...]" : "VALUE");
}

std::vector<Cell> all_cells(const InvarianceOptions& options, CellRunner& runner) {
    const auto cells = options.plan.empty()
                           ? cells_of(options.keys)
                           : parse_plan(scenes::read_text_file(options.plan), options.plan, options.keys);
    return runner.expanded(cells);
}

MeasuredRow measured(std::size_t number, const Cell& cell, CellRunner& runner, const std::string& image_folder) {
    const auto start = std::chrono::steady_clock::now();
    const CellResult result = runner.run(cell);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    if (!image_folder.empty()) write_cell_images(image_folder, number, result);
    return {.line = to_line(number, cell, result),
            .timing = {{"cell", number}, {"seconds", taken.count()}, {"peel_seconds", result.measured.seconds}},
            .seconds = taken.count()};
}

// `cells` and `runner` must outlive the result.
Sweep sweep_of(const InvarianceOptions& options, const std::vector<Cell>& cells, CellRunner& runner) {
    const auto described = [&](std::size_t i) { return description(i, cells[i], runner.view(cells[i])); };
    const std::string folder = options.run.output;
    return {.name = "invariance",
            .rows = cells.size(),
            .description = described,
            .measure = [&, image_folder = options.images && !options.dry_run ? folder : ""](
                           std::size_t i) { return measured(i, cells[i], runner, image_folder); },
            .csv = csv_of,
            .summary = [folder](const Lines& lines, const Lines&) { return summary(lines, folder); },
            .timing_class =
                [described](std::size_t i) {
                    const nlohmann::ordered_json line = described(i);
                    return json_text({line["scene"], line["width"], line["height"], line["algorithm"]});
                }};
}

// With --max-memory: refuses the whole plan if a cell needs more.
void check_memory_of(const InvarianceOptions& options, const std::vector<Cell>& cells) {
    if (!options.run.max_memory) return;
    for (const Cell& cell : cells) {
        RunOptions run = options.run;
        run.scene = cell.scene;
        run.profile = cell.profile;
        run.render.width = cell.width;
        run.render.height = cell.height;
        check_memory(run, open_session(run), *cell.algorithm);
    }
}

// Writes FOLDER/precision.csv and prints its rows.
int measure_precision(const InvarianceOptions& options) {
    if (!options.run.scene.empty() || !options.plan.empty() || !options.keys.empty())
        throw CLI::ValidationError("--precision takes neither a scene nor a plan");
    const std::vector<PrecisionRow> rows = precision_rows(*options.precision);
    if (const std::string& folder = options.run.output; !folder.empty()) {
        std::filesystem::create_directories(folder);
        scenes::write_file(folder + "/precision.csv", precision_csv(rows));
    }
    print(titled(precision_table(rows)));
    return 0;
}

int invariance(InvarianceOptions& options) {
    if (options.precision) return measure_precision(options);
    if (options.run.output.empty() && !options.dry_run)
        throw CLI::ValidationError("-o is missing: the folder for the results");
    if (!options.run.scene.empty()) options.keys["scene"] = {options.run.scene};
    if (options.hypotheses) options.keys["hypothesis"] = {"all"};
    CellRunner runner(options.run.scene_options, options.run.render);
    const std::vector<Cell> cells = all_cells(options, runner);
    for (const Cell& cell : cells) runner.check(cell);
    check_memory_of(options, cells);
    const Sweep sweep = sweep_of(options, cells, runner);
    if (options.dry_run) return dry_run(sweep, options.shard), 0;
    return run_sweep(sweep, options.run.output, options.shard);
}

std::optional<DepthSpan> to_span(std::string_view text) {
    const auto parts = split(text, ':');
    if (parts.size() != 2) return std::nullopt;
    const auto near = to_number<double>(parts[0]), far = to_number<double>(parts[1]);
    if (!near || !far || *near < 1e-12 || *far > 1e12 || *near >= *far) return std::nullopt;
    return DepthSpan{*near, *far};
}

void add_sweep_options(CLI::App& app, InvarianceOptions& options) {
    add_path(app, options.plan, {"--plan", "FILE", "a JSON plan (tools/lab/invariance/README.md)", "a file name"});
    add_path(app, options.run.output,
             {"-o,--output", "FOLDER", "folder for results.jsonl, results.csv, timings.jsonl and images/", "a folder"});
    add_shard_option(app, options.shard);
    app.add_flag("--hypotheses", options.hypotheses, "every hypothesis about the device: the same as --hypothesis all");
    add_option(app, options.precision,
               {"--precision", "NEAR:FAR",
                "how close two surfaces may be for each depth buffer, by their distance from the eye: a table in units "
                "of the scene, and with -o precision.csv",
                "two distances such as 0.1:10000, from 1e-12 to 1e12"},
               to_span);
    app.add_flag("--dry-run", options.dry_run, "print the rows and how long they would take, without measuring them");
    app.add_flag_callback(
        "--no-images", [&options] { options.images = false; }, "no pictures of cells with errors");
}

}  // namespace

Command add_invariance(CLI::App& root) {
    auto* app = add_lab_command(root, "invariance");
    const auto options = std::make_shared<InvarianceOptions>();
    app->add_option("SCENE", options->run.scene,
                    "a model's file (.gltf, .glb, .obj, .ply, .stl, .off), or a built-in scene (strata list scenes)")
        ->type_name("");
    add_options(*app, options->run, OptionGroup::reading);
    for (const PlanKey& key : plan_keys())
        if (key.name != "scene") add_key(*app, *options, key);
    add_sweep_options(*app, *options);
    add_memory_option(*app, options->run);
    add_options(*app, options->run, OptionGroup::resources);
    app->footer(
        footer("  strata invariance teapot --size 64x48 --profile ideal --algorithm front_to_back --pair "
               "float32:perspective_rq "
               "--depth-format d24 --remedy none,epsilon:1ulp -o results\n"
               "  strata invariance planes:gap=8 --size 64x48 --remedy none,bias:4 --dry-run\n"));
    return {app, [options] { return invariance(*options); }};
}

}  // namespace strata::tools
