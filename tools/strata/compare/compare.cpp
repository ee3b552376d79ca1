// tools/strata/compare/compare.cpp - strata compare: compares a candidate with a reference picture, a golden pack or a
// scene, and reports the differences or a verdict.
#include "tools/oracle/compare/compare.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "scenes/file_ending.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_decode.h"
#include "scenes/files/image_io.h"
#include "scenes/memory_limit.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/compare/drawings.h"
#include "tools/oracle/compare/report.h"
#include "tools/oracle/pack/compare_packs.h"
#include "tools/oracle/picture/stored_like.h"
#include "tools/request/choices.h"
#include "tools/strata/command.h"
#include "tools/strata/compare/compare_pages.h"
#include "tools/strata/compare/compare_scene.h"
#include "tools/strata/compare/folders.h"
#include "tools/strata/compare/tolerances.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/option_readers.h"
#include "tools/strata/render/run.h"
#include "tools/strata/report/plain_page.h"
#include "tools/strata/table.h"

namespace strata::tools {

namespace {

// The options of the command line.
struct CompareOptions {
    std::string reference, candidate;
    std::optional<oracle::RawLayout> layout{}, candidate_layout{};  // of the candidate: the first if it has none
    oracle::Tolerances tolerances{};
    std::optional<oracle::AlphaForm> alpha_form{};
    oracle::Background background{};  // empty: read from the pictures
    std::string algorithm;            // only for packs; empty: all algorithms
    std::string heat, side, junit, report;
    bool json = false, exact = false;
    oracle::PictureNames names{};  // only of two folders
    RunOptions run{};              // only if the reference is a scene
};

// True if the result may be a verdict (right or wrong apart from rounding): the reference is a scene or a pack, and
// neither --exact nor --tolerance is given. Otherwise the result is a list of differences.
bool asks_for_verdict(const CompareOptions& options) {
    const oracle::Tolerances none{.channels = options.tolerances.channels};
    return is_scene(options.reference) && !options.exact && options.tolerances == none;
}

// The algorithm that the command names, or the only one of a pack; null if there is no such algorithm.
const peeling::Algorithm* algorithm_of(const CompareOptions& options) {
    if (!options.algorithm.empty()) return to_algorithm(options.algorithm);
    if (!scenes::is_pack(options.reference)) return nullptr;
    const auto all = oracle::expected_pictures(options.reference);
    return all.size() == 1 ? peeling::find_algorithm(all[0].algorithm) : nullptr;
}

// The algorithm whose picture the candidate has to be: the stated one, or that of a pack if it is not exact.
std::string judged_algorithm(const CompareOptions& options) {
    const peeling::Algorithm* algorithm = algorithm_of(options);
    return algorithm != nullptr && !algorithm->exact ? algorithm->name : options.algorithm;
}

oracle::Picture read_candidate(const CompareOptions& options, const std::string& path) {
    return oracle::read_picture(path, options.candidate_layout ? options.candidate_layout : options.layout);
}

ComparedPaths paths_of(const CompareOptions& options) { return {options.reference, options.candidate}; }

void write_png(const std::string& path, const pipeline::Image& image) {
    if (!path.empty()) scenes::write_image(path, {.color = image});
}

// Of every pixel of the picture, without its fragments (measured).
constexpr std::uint64_t bytes_of_a_verdict(int samples) { return 160 + 80 * static_cast<std::uint64_t>(samples - 1); }

// Returns the requested algorithm alone, or all of them if none is requested.
std::vector<oracle::PackPictures> chosen(std::vector<oracle::PackPictures> all, const std::string& algorithm) {
    if (algorithm.empty()) return all;
    std::vector<std::string> names;
    for (const oracle::PackPictures& pictures : all) names.push_back(pictures.algorithm);
    std::erase_if(all, [&](const oracle::PackPictures& pictures) { return pictures.algorithm != algorithm; });
    if (all.empty())
        throw CLI::ValidationError("--algorithm",
                                   "expected " + one_of(names) + ", found " + found_but_near(algorithm, names));
    return all;
}

// Inserts the algorithm's name before the ending if there are several: "heat.png" becomes "heat.dual.png".
std::string path_of(const std::string& path, const std::string& algorithm, bool is_only) {
    if (path.empty() || is_only) return path;
    const std::size_t dot = path.rfind('.');  // check_outputs has checked that there is an ending
    return path.substr(0, dot) + "." + algorithm + path.substr(dot);
}

// Draws the maps of each algorithm that both folders contain: of the final picture, or, if it is equal, of the first
// pass that differs.
void draw_folders(const CompareOptions& options, const std::vector<oracle::PackPictures>& reference,
                  const std::vector<oracle::PackPictures>& candidate,
                  const std::vector<oracle::PackComparison>& found) {
    const bool is_only = std::ranges::count(found, true, &oracle::PackComparison::is_there) == 1;
    for (const oracle::PackComparison& c : found) {
        const auto shown = shown_pair(reference, candidate, c);
        if (!shown) continue;
        write_png(path_of(options.heat, c.algorithm, is_only), oracle::heat_map_with_legend(shown->comparison));
        write_png(path_of(options.side, c.algorithm, is_only),
                  oracle::side_by_side(shown->reference, shown->candidate, shown->comparison));
    }
}

std::vector<std::string> names_of_targets(const oracle::Picture& picture) {
    std::vector<std::string> names;
    for (const oracle::TargetImage& target : picture.targets)
        if (std::ranges::find(names, target.name) == names.end()) names.push_back(target.name);
    return names;
}

std::vector<std::string> names_of_targets(const std::vector<oracle::PackPictures>& packs) {
    oracle::Picture all;
    for (const oracle::PackPictures& pictures : packs)
        for (const oracle::PassPicture& pass : pictures.passes)
            for (const oracle::TargetImage& target : pass.targets.targets) all.targets.push_back({.name = target.name});
    return names_of_targets(all);
}

// Compares a pack with a port's output folder: the final picture and all passes of every algorithm that both contain.
bool is_linear(const CompareOptions& options) {
    return options.run.scene_options.color_space == pipeline::ColorSpace::linear;
}

int compare_folders(const CompareOptions& options) {
    auto reference = chosen(oracle::expected_pictures(options.reference), options.algorithm);
    const auto candidate = chosen(oracle::candidate_pictures(options.reference, options.candidate), options.algorithm);
    check_targets(options.tolerances, names_of_targets(reference));
    if (is_linear(options))
        for (oracle::PackPictures& own : reference)
            for (const oracle::PackPictures& other : candidate)
                if (own.algorithm == other.algorithm)
                    own.picture = stored_like(own.picture, other.picture, pipeline::ColorSpace::linear);
    const auto found = oracle::compare_packs(reference, candidate, options.tolerances);
    if (std::ranges::none_of(found, &oracle::PackComparison::is_there))
        throw InputError(options.candidate, "has pictures of none of the pack's algorithms");
    draw_folders(options, reference, candidate, found);
    if (!options.junit.empty()) scenes::write_file(options.junit, oracle::to_junit(found));
    if (!options.report.empty()) write_page(options.report, page_of(paths_of(options), reference, candidate, found));
    print(options.json ? oracle::to_json(found) : with_painted_verdicts(oracle::to_text(found)));
    return std::ranges::all_of(found, &oracle::PackComparison::accepted) ? 0 : 1;
}

// The reference picture: of a pack, the picture of its only or requested algorithm; of a scene, the picture that the
// algorithm renders; otherwise the file itself.
oracle::Picture reference_of(const CompareOptions& options) {
    if (!is_scene(options.reference)) return oracle::read_picture(options.reference, options.layout);
    if (!scenes::is_pack(options.reference))
        return drawn_picture({.run = options.run, .algorithm = options.algorithm},
                             read_candidate(options, options.candidate));
    auto all = chosen(oracle::expected_pictures(options.reference), options.algorithm);
    if (all.size() != 1)
        throw CLI::ValidationError("the pack has several algorithms: --algorithm says which one the picture is of");
    return std::move(all[0].picture);
}

// Compares the pictures of two plain folders by their names.
int compare_plain_folders(const CompareOptions& options) {
    return compare_two_folders(
        {.reference = options.reference,
         .candidate = options.candidate,
         .names = options.names,
         .tolerances = options.tolerances,
         .background = options.background,
         .read_reference = [&](const std::string& path) { return oracle::read_picture(path, options.layout); },
         .read_candidate =
             [&](const std::string& path) {
                 oracle::Picture picture = read_candidate(options, path);
                 state_alpha(picture, options.alpha_form);
                 return picture;
             }},
        {.junit = options.junit, .report = options.report, .json = options.json});
}

// Files are written first, so they exist once the text appears on standard output.
int compared(const CompareOptions& options) {
    constexpr std::uint64_t bytes_of_a_comparison = 64;  // of a pixel, for two pictures and the maps
    scenes::expect_for_a_pixel(bytes_of_a_comparison);
    if (scenes::is_pack(options.reference) && std::filesystem::is_directory(options.candidate))
        return compare_folders(options);
    if (!is_scene(options.reference) && are_folders(options.reference, options.candidate))
        return compare_plain_folders(options);
    if (asks_for_verdict(options)) {
        scenes::expect_for_a_pixel(bytes_of_a_verdict(options.run.sampling.samples));
        oracle::Picture picture = read_candidate(options, options.candidate);
        state_alpha(picture, options.alpha_form);
        const bool has_alpha = options.tolerances.channels == oracle::ColorChannels::all;
        return compare_with_scene({options.run,
                                   judged_algorithm(options),
                                   options.json,
                                   {options.report, options.heat, options.side, options.junit},
                                   options.alpha_form.has_value(),
                                   has_alpha},
                                  picture);
    }
    oracle::Picture reference = reference_of(options);
    oracle::Picture candidate = read_candidate(options, options.candidate);
    state_alpha(candidate, options.alpha_form);
    if (is_linear(options) && is_scene(options.reference))
        reference = stored_like(reference, candidate, pipeline::ColorSpace::linear);
    check_targets(options.tolerances, names_of_targets(reference));
    // Pictures of different sizes are an error, but both can be seen.
    if (reference.targets[0].width != candidate.targets[0].width ||
        reference.targets[0].height != candidate.targets[0].height)
        write_png(options.side, oracle::beside({oracle::as_shown(reference), oracle::as_shown(candidate)}));
    const oracle::Comparison found = oracle::compare(reference, candidate, options.tolerances, options.background);
    write_png(options.heat, oracle::heat_map_with_legend(found));
    write_png(options.side, oracle::side_by_side(reference, candidate, found));
    if (!options.junit.empty()) scenes::write_file(options.junit, oracle::to_junit(found));
    if (!options.report.empty()) write_page(options.report, page_of(paths_of(options), reference, candidate, found));
    print(options.json ? oracle::to_json(found) : with_painted_verdicts(oracle::to_text(found)));
    return found.accepted ? 0 : 1;
}

// A picture that cannot be read or compared is a failed test case, so that it is not missing in a CI's list of tests.
int compare(const CompareOptions& options) {
    check_outputs({{"--heat", options.heat, {".png"}},
                   {"--side", options.side, {".png"}},
                   {"--junit", options.junit, {".xml"}},
                   {"--report", options.report, {".html"}}});
    try {
        return compared(options);
    } catch (const InputError& error) {
        if (!options.junit.empty())
            scenes::write_file(options.junit,
                               oracle::to_junit(std::vector<oracle::JunitCase>{
                                   {.group = "strata.compare", .name = "input", .failure = error.what()}}));
        throw;
    }
}

// Rejects options of two folders of pictures elsewhere, and the others on them.
void check_folders(const CLI::App& app, const CompareOptions& options) {
    if (is_scene(options.reference) || !is_folder(options.reference)) {
        for (const char* const name : {"--names", "--baselines"})
            if (app.count(name) > 0)
                throw CLI::ValidationError(std::string(name) + " has no effect: no folders of pictures are compared");
        return;
    }
    for (const char* const name : {"--heat", "--side"})
        if (app.count(name) > 0)
            throw CLI::ValidationError(std::string(name) +
                                       " has no effect on folders of pictures: --report shows what differs");
    if ((options.layout || options.candidate_layout) && !options.names.reference)
        throw CLI::ValidationError("--layout needs --names on folders: which files hold raw numbers");
}

// Rejects options of a scene if the reference is a picture, except --background, which then is the background of the
// reference.
void check_for_scene(const CLI::App& app, const std::vector<CLI::Option*>& of_pictures, CompareOptions& options) {
    if (app.count("--background") > 0) {
        // In the same colour space and alpha form as the reference's values.
        const pipeline::Rgba& color = *options.run.background;
        options.background = {color[0], color[1], color[2]};
        if (color[3] < 1) options.background.push_back(color[3]);
    }
    const bool is_pack_of_folder =
        scenes::is_pack(options.reference) && std::filesystem::is_directory(options.candidate);
    check_folders(app, options);
    if (is_scene(options.reference) && !is_pack_of_folder) return;
    std::vector<std::string> names;
    for (const CLI::Option* option : of_pictures)
        if (const std::string name = option->get_name();
            is_pack_of_folder || (name != "--exact" && name != "--algorithm"))
            names.push_back(name);
    names.emplace_back(is_pack_of_folder ? "--color-space" : "--background");
    refuse_others(app, std::vector<std::string_view>{names.begin(), names.end()},
                  is_pack_of_folder ? "on a pack and a folder of pictures" : "if the reference is a picture");
}

// Files whose ending says what they hold have no other layout.
void check_layout(const CompareOptions& options) {
    const auto is_raw = [](const std::string& file) {
        return !scenes::has_ending(file, ".exr") && !scenes::has_ending(file, ".npy") &&
               scenes::reader_of(file) == nullptr;
    };
    const bool reads_reference = !is_scene(options.reference);
    if (!is_scene(options.reference) && is_folder(options.reference)) return;
    if (options.candidate_layout && !is_raw(options.candidate))
        throw CLI::ValidationError("--candidate-layout has no effect: the candidate is no file of raw numbers");
    const bool is_for_candidate = is_raw(options.candidate) && !options.candidate_layout;
    if (options.layout && !is_for_candidate && !(reads_reference && is_raw(options.reference)))
        throw CLI::ValidationError("--layout has no effect: no file of raw numbers is compared");
}

}  // namespace

Command add_compare(CLI::App& root) {
    auto* app = root.add_subcommand("compare", "show how a picture differs from a reference, by kinds of mistakes");
    const auto options = std::make_shared<CompareOptions>();
    options->run.takes_size_of_picture = true;
    options->run.app = app;
    app->add_option_function<std::string>(
           "REFERENCE",
           [options](const std::string& reference) {
               options->reference = reference;
               if (is_scene(reference)) take_scene(options->run, reference);
           },
           "a scene or a pack, an .exr, .npy, .png, .jpg, .ppm, .tga, .bmp, .tif or .hdr file, or bare numbers with "
           "--layout")
        ->required()
        ->type_name("");
    app->add_option("CANDIDATE", options->candidate,
                    "the same, or for a pack a folder with what a port made; the kinds of files may differ")
        ->required()
        ->type_name("");
    add_layout_option(*app, options->layout);
    add_candidate_layout_option(*app, options->candidate_layout);
    add_tolerance_option(*app, options->tolerances);
    app->add_flag("--exact", options->exact,
                  "of a scene or a pack: hold the picture to every bit, and show where it differs");
    add_channels_option(*app, options->tolerances);
    add_alpha_option(*app, options->alpha_form);
    add_path(*app, options->algorithm,
             {"--algorithm", "NAME", "of a pack: compare this one alone (default: all); of a scene: what the port runs",
              "an algorithm"});
    add_path(*app, options->heat,
             {"--heat", "FILE.png", "the difference of each pixel from the reference, in 8-bit steps, with a legend",
              "a file name"});
    add_path(*app, options->side,
             {"--side", "FILE.png",
              "reference, candidate, heat map and kinds side by side, for a verdict the wrong pixels in place of "
              "kinds; of a "
              "folder NAME.ALGORITHM.png each",
              "a file name"});
    add_path(
        *app, options->junit,
        {"--junit", "FILE.xml",
         "for continuous integration: a test case for the verdict; of pictures one a kind, of a folder one each for "
         "picture, layers and passes",
         "a file name"});
    add_report_option(*app, options->report);
    app->add_flag("--json", options->json, "one JSON document instead of text");
    add_folder_options(*app, options->names);
    add_memory_option(*app, options->run);
    const std::vector<CLI::Option*> of_pictures = app->get_options();
    add_options(*app, options->run, OptionGroup::reading);
    add_profile_option(*app, options->run.profile);
    add_options(*app, options->run, OptionGroup::origin);
    for (const OptionGroup group : {OptionGroup::depth, OptionGroup::targets, OptionGroup::algorithm})
        add_options(*app, options->run, group);
    add_options(*app, options->run, OptionGroup::order);
    add_options(*app, options->run, OptionGroup::view);
    app->get_option("--size")->description(help_of_picture_size);
    add_option_of_table(*app, options->run, "samples")
        ->description("samples per pixel of the port, whose resolved picture is compared (default 1)");
    add_options(*app, options->run, OptionGroup::shading);
    app->footer(
        "Examples:\n"
        "  strata render teapot --size 64x64 -o teapot.exr && strata compare teapot.exr teapot.exr\n"
        "  strata render teapot --size 64x64 -o teapot.png && strata compare --json --side side.png teapot.png "
        "teapot.png\n"
        "  strata render teapot --size 64x64 --algorithm front_to_back -o teapot.png && strata compare teapot "
        "teapot.png\n"
        "With a scene as the reference the picture is right if some port that composites the right fragments in the "
        "right order can make it, "
        "whatever its formats, order of blending and rounding. With --algorithm and one that is not exact (strata list "
        "algorithms) it has to be that algorithm's picture.\n"
        "Exit status: 0 right, equal or within --tolerance, 1 wrong or different, 2 bad input or usage, 3 the system "
        "failed, 130 "
        "interrupted.");
    return {app, [app, options, of_pictures] {
                check_for_scene(*app, of_pictures, *options);
                check_layout(*options);
                return compare(*options);
            }};
}

}  // namespace strata::tools
