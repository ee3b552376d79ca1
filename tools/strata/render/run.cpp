// tools/strata/render/run.cpp - renders with each algorithm: opens scene, profile and view, warns of what would
// mislead, writes files, and decides the exit status (run.h).
#include "tools/strata/render/run.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "pipeline/device/sample_points.h"
#include "scenes/camera.h"
#include "scenes/exr/parts.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/load_module.h"
#include "scenes/files/profile_json.h"
#include "scenes/files/unfinished_files.h"
#include "scenes/inside_folder.h"
#include "scenes/read_files.h"
#include "tools/oracle/picture/picture.h"
#include "tools/request/complete.h"
#include "tools/request/names.h"
#include "tools/strata/messages.h"
#include "tools/strata/progress.h"
#include "tools/strata/render/memory.h"
#include "tools/strata/render/stats.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// The view of --camera or of the orbit; without either option, the scene's own view if it has one.
pipeline::View find_view(const RunOptions& options, const scenes::Scene& scene) {
    const double aspect = double(options.render.width) / options.render.height;
    if (options.takes_own_view) return *scene.own_view;
    if (!options.camera.empty()) return view_named(options.camera, scene, aspect, options.files_in);
    const Orbit orbit = options.orbit.value_or(Orbit{});
    return scenes::orbit_view(scene.bounds, orbit.azimuth, orbit.elevation, aspect);
}

// Checks that the names of --sorted and --only exist in the scene.
void check_names(const RunOptions& options, const scenes::Scene& scene) {
    constexpr std::size_t most_listed = 12;
    std::vector<std::string> names;
    const auto add = [&](const std::string& name) {
        if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    // Meshes and materials share one list of names, because both options accept both.
    for (const auto& mesh : scene.list.meshes) add(mesh.name);
    for (const auto& material : scene.list.materials) add(material.name);
    const std::string listed = names.empty() || names.size() > most_listed ? "strata scene lists them"
                                                                           : fmt::format("{}", fmt::join(names, ", "));
    const auto check = [&](const char* option, const std::vector<std::string>& given) {
        for (const std::string& name : given)
            if (std::find(names.begin(), names.end(), name) == names.end())
                throw CLI::ValidationError(option, "expected a mesh or a material of the scene (" + listed +
                                                       "), found " + found_but_near(name, names));
    };
    check("--sorted", options.render.sorted);
    check("--only", options.render.offset_only);
    if (!options.render.offset_only.empty() && !options.render.raster.polygon_offset.enabled)
        throw CLI::ValidationError("--only is valid only with --polygon-offset");
}

// Warns if the scene has no triangles, or no transparent material and --alpha is not given: then no algorithm peels
// anything.
void warn_of_opaque(const RunOptions& options, const scenes::Scene& scene) {
    const auto has_triangles = [&](const pipeline::Instance& instance) {
        return !scene.list.meshes[instance.mesh].indices.empty();
    };
    if (std::none_of(scene.list.instances.begin(), scene.list.instances.end(), has_triangles)) {
        say_warning(options.scene +
                    ": nothing is drawn, because the scene has no triangles; strata scene lists the "
                    "file's scenes, --scene N chooses one");
        return;
    }
    if (options.render.alpha) return;
    const auto is_transparent = [&](const pipeline::Instance& instance) {
        return scene.list.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend;
    };
    if (std::any_of(scene.list.instances.begin(), scene.list.instances.end(), is_transparent)) return;
    say_warning(options.scene +
                ": nothing is transparent, so there is nothing to peel; --alpha 0.5 draws everything as half "
                "transparent, --alpha MATERIAL=0.5 one material");
}

// An option that repeats the profile's convention is dropped, so that canonical_command has one spelling, unless it
// overrides a pack's.
void drop_repeated_convention(RunOptions& options, const pipeline::DeviceProfile& profile) {
    const rasterizer::RasterState& taken = options.render.raster;
    const scenes::ClipConvention of_pack =
        options.pack_convention.value_or(scenes::ClipConvention{profile.clip_depth, profile.depth_order});
    if (taken.clip_depth == profile.clip_depth && taken.clip_depth == of_pack.clip_depth) options.clip_depth.reset();
    if (taken.depth_order == profile.depth_order && taken.depth_order == of_pack.depth_order)
        options.depth_order.reset();
}

}  // namespace

pipeline::View view_named(const std::string& name, const scenes::Scene& scene, double aspect,
                          const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& camera : scene.cameras) {
        if (camera.name == name) return scenes::camera_view(camera, aspect);
        names.push_back(camera.name);
    }
    if (!folder.empty()) return scenes::load_camera(scenes::path_inside(folder, name, "--camera", "file"), aspect);
    std::error_code unreadable;  // for example a link to itself: treated as no file
    if (name.ends_with(".json") || std::filesystem::exists(name, unreadable)) return scenes::load_camera(name, aspect);
    const std::string cameras =
        names.empty() ? "a .json file (the scene has no camera)" : one_of(names) + ", or a .json file";
    throw CLI::ValidationError("--camera", "expected " + cameras + ", found " + found_but_near(name, names));
}

void take_size(RunOptions& options, const oracle::TargetImage& picture, const std::string& file) {
    peeling::RenderOptions& render = options.render;
    const auto text = [](int width, int height) { return fmt::format("{}x{}", width, height); };
    if (options.states_size && (render.width != picture.width || render.height != picture.height))
        throw InputError(file, "size", text(render.width, render.height) + ", the value of --size",
                         text(picture.width, picture.height));
    render.width = picture.width;
    render.height = picture.height;
}

Session open_session(RunOptions& options) {
    check_simd(options.render.simd);
    Session session;
    // The profile is loaded first: it is small, and its errors are reported before a large scene is read.
    session.profile = scenes::load_profile(options.profile);
    if (const auto open = scenes::open_fields(options.profile); !open.empty())
        say_warning(fmt::format("{}: the values of {} were never measured; results that depend on them are unverified",
                                options.profile, fmt::join(open, ", ")));
    if (options.origin) session.profile = with_origin(session.profile, *options.origin);
    complete(options, session.profile);
    drop_repeated_convention(options, session.profile);
    const auto start = std::chrono::steady_clock::now();
    session.scene = scenes::load_scene(options.scene, options.scene_options);
    // Refused before the frame is drawn; AtomicFile refuses other results.
    for (const std::string& path : {options.output, options.stats}) scenes::check_not_read(path);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    say_detail(fmt::format("read {}: meshes: {}, drawn: {}, in {}", options.scene, session.scene.list.meshes.size(),
                           session.scene.list.instances.size(), seconds_text(taken.count())));
    for (const std::string& warning : session.scene.warnings) say_warning(warning);
    warn_of_opaque(options, session.scene);
    options.names_camera_of_scene =
        std::ranges::any_of(session.scene.cameras, [&](const auto& camera) { return camera.name == options.camera; });
    options.takes_own_view = options.camera.empty() && !options.orbit && session.scene.own_view.has_value();
    const scenes::ClipConvention own =
        options.takes_own_view ? options.pack_convention.value_or(scenes::ClipConvention{}) : scenes::ClipConvention{};
    session.view = scenes::with_clip_convention(find_view(options, session.scene), own,
                                                scenes::view_convention(options.render.raster));
    check_names(options, session.scene);
    return session;
}

namespace {

// The algorithms whose results are missing if an interrupt occurs while algorithm number `current` runs.
std::string undone(const RunOptions& options, std::size_t current) {
    const std::size_t count = options.algorithms.size();
    std::string text = count == 1 ? "" : fmt::format("{} of {} algorithms are done", current, count);
    std::string files;
    for (std::size_t i = current; i < count && !options.output.empty(); ++i)
        files += (files.empty() ? "" : ", ") + path_for(options.output, options, *options.algorithms[i]);
    if (!options.stats.empty()) files += (files.empty() ? "" : ", ") + options.stats;
    if (!files.empty()) text += (text.empty() ? "" : "; ") + ("not written: " + files);
    return text;
}

// Keeps the statistics and discards the pixels.
RunSummary summarize(const peeling::Algorithm& algorithm, peeling::RenderResult&& result) {
    const auto digest_of = [](const pipeline::Image& image) {
        return image.codes.empty() ? "" : pipeline::digest(image);
    };
    RunSummary summary{&algorithm, {}, digest_of(result.frame.color), digest_of(result.frame.depth)};
    result.frame.color = {};
    result.frame.depth = {};
    result.frame.layers.clear();
    summary.result = std::move(result);
    return summary;
}

// Renders, and writes the files while the pixels exist. A refused algorithm writes no file.
RunSummary run_one(const Session& session, const peeling::Algorithm& algorithm, peeling::Renderer& renderer,
                   const Writer& write) {
    Progress progress(algorithm.name);
    peeling::RenderResult result = renderer.render(algorithm, [&](double share) { progress.show(share); });
    const bool is_done = result.outcome == peeling::Outcome::done;
    if (is_done) write({session, algorithm, renderer, result});
    RunSummary summary = summarize(algorithm, std::move(result));
    if (is_done) say_detail(path_text(summary));
    return summary;
}

// Prints the table: as the result if no picture is written, otherwise as a note on standard error.
void tell_table(const RunOptions& options, const std::string& table) {
    if (scenes::is_standard_output(options.output)) return say_note(table);
    if (options.output.empty() || !is_quiet()) print(titled(table));
}

// Prints the statistics after all algorithms have run: as JSON, as a table, or both.
void report(const RunOptions& options, const std::vector<RunSummary>& runs, const std::string& profile) {
    const std::chrono::duration<double> total = std::chrono::steady_clock::now() - options.started;
    const RunContext context{profile, options, total.count()};
    if (scenes::is_standard_output(options.stats)) return print(to_json(runs, context));
    if (!options.stats.empty()) scenes::write_file(options.stats, to_json(runs, context));
    tell_table(options, to_table(runs, context));
}

// Returns 2 if no algorithm ran. Every refusal is printed on standard error.
int exit_status(const std::vector<RunSummary>& runs, const pipeline::DeviceProfile& profile) {
    int status = 2;
    for (const RunSummary& run : runs) {
        if (run.result.outcome == peeling::Outcome::done)
            status = 0;
        else
            say_error(run.algorithm->name + ": " + run.result.refusal->message(profile));
    }
    return status;
}

}  // namespace

int run_algorithms(RunOptions& options, const Writer& write) {
    complete(options);
    check_outputs({{"--stats", scenes::is_standard_output(options.stats) ? "" : options.stats, {".json"}}});
    scenes::set_interrupt_message(undone(options, 0));
    const Session session = open_session(options);
    for (const peeling::Algorithm* algorithm : options.algorithms) check_memory(options, session, *algorithm);
    // One renderer is used for all algorithms, so geometry is transformed and set up once.
    peeling::Renderer renderer(session.request(options.render));
    std::vector<RunSummary> runs;
    for (const peeling::Algorithm* algorithm : options.algorithms) {
        scenes::set_interrupt_message(undone(options, runs.size()));
        runs.push_back(run_one(session, *algorithm, renderer, write));
    }
    scenes::set_interrupt_message("");
    report(options, runs, session.profile.name);
    return exit_status(runs, session.profile);
}

std::string path_for(const std::string& path, const RunOptions& options, const peeling::Algorithm& algorithm) {
    if (options.algorithms.size() == 1) return path;
    const std::size_t dot = path.rfind('.');  // check_outputs has checked that there is an ending
    return path.substr(0, dot) + "." + algorithm.name + path.substr(dot);
}

scenes::ImageFile kind_of(const RunOptions& options, scenes::ImageFile fallback) {
    if (scenes::is_standard_output(options.output)) return options.format.value_or(fallback);
    return scenes::image_file(options.output);
}

scenes::Attributes attributes_of(const std::string& verb, const RunOptions& options, const CompletedRun& finished) {
    const auto one_line = [](const std::string& json) { return nlohmann::ordered_json::parse(json).dump(); };
    return {{"command", canonical_command(verb, options, finished.algorithm)},
            {"profile", one_line(scenes::to_json(finished.session.profile))},
            {"camera", one_line(scenes::to_json(finished.session.view))}};
}

bool OutputFile::is_piped() const { return piped == StandardOutput::possibly && scenes::is_standard_output(path); }

namespace {

void check_output(const OutputFile& output) {
    if (output.is_piped()) {
        if (isatty(STDOUT_FILENO) == 1)
            throw CLI::ValidationError(
                output.option, "a terminal cannot show a picture's bytes: name a file, or send standard output to one");
        return;
    }
    const auto fits = [&](const std::string& ending) { return output.path.ends_with(ending); };
    if (std::none_of(output.endings.begin(), output.endings.end(), fits)) {
        throw CLI::ValidationError(
            output.option, "expected a file that ends in " + one_of(output.endings) + ", found '" + output.path + "'");
    }
    const auto folder = std::filesystem::path(output.path).parent_path();
    if (!folder.empty() && !std::filesystem::is_directory(folder)) {
        throw CLI::ValidationError(output.option, "expected a folder that exists, found " + folder.string());
    }
}

// A unique spelling for each output file: links of the folder are followed. A link in the last component is not,
// because the finished file replaces the link.
std::filesystem::path place_of(const std::string& path) {
    if (scenes::is_standard_output(path)) return "-";
    const auto absolute = std::filesystem::absolute(path);
    return std::filesystem::canonical(absolute.parent_path()) / absolute.filename();
}

}  // namespace

void check_outputs(const std::vector<OutputFile>& outputs) {
    std::map<std::filesystem::path, const OutputFile*> places;
    for (const OutputFile& output : outputs) {
        if (output.path.empty()) continue;
        check_output(output);
        const auto [found, is_new] = places.emplace(place_of(output.path), &output);
        if (!is_new) {
            throw CLI::ValidationError(output.option,
                                       "'" + output.path + "' is also the file of " + found->second->option);
        }
    }
    const bool has_exr =
        std::ranges::any_of(outputs, [](const OutputFile& output) { return output.path.ends_with(".exr"); });
    if (has_exr) static_cast<void>(scenes::exr::start_threads());
}

}  // namespace strata::tools
