// tools/strata/compare/compare_scene.cpp - compares a candidate with a scene: opens the scene at the picture's size,
// asks for the verdict, and writes pages and maps (compare_scene.h).
#include "tools/strata/compare/compare_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/image_io.h"
#include "scenes/models/models.h"
#include "scenes/packs/pack_scene.h"
#include "scenes/packs/plain_triangles.h"
#include "tools/oracle/compare/drawings.h"
#include "tools/oracle/compare/report.h"
#include "tools/oracle/judge/emulated.h"
#include "tools/oracle/judge/judge.h"
#include "tools/oracle/judge/layers_verdict.h"
#include "tools/oracle/picture/stored_like.h"
#include "tools/oracle/search/edits.h"
#include "tools/oracle/verdict/equal_picture.h"
#include "tools/oracle/verdict/other_profile.h"
#include "tools/strata/compare/compare_pages.h"
#include "tools/strata/progress.h"
#include "tools/strata/recorded_command.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

bool is_scene(const std::string& reference) {
    if (reference == "-") return true;  // a glTF file from standard input
    if (scenes::is_procedural(reference) || scenes::is_pack(reference) || scenes::is_model(reference) ||
        scenes::is_array_of_triangles(reference))
        return true;
    std::string ending = std::filesystem::path(reference).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".gltf" || ending == ".glb" || ending == ".json";
}

std::string camera_in_words(const RunOptions& run) {
    if (!run.camera.empty()) return "--camera " + run.camera;
    if (run.takes_own_view) return "the scene's own view";
    const Orbit orbit = run.orbit.value_or(Orbit{});
    return fmt::format("--orbit {},{}", orbit.azimuth, orbit.elevation);
}

Session open_at_size(SceneQuestion& question, const oracle::TargetImage& target, const std::string& file) {
    RunOptions& run = question.run;
    if (!question.algorithm.empty()) run.algorithms = {to_algorithm(question.algorithm)};
    complete(run);
    take_size(run, target, file);
    return open_session(run);
}

namespace {

// The algorithm's own picture; with a depth target if the candidate has one.
oracle::Picture drawn_by(const peeling::Algorithm& algorithm, const Session& session, const RunOptions& run,
                         const oracle::Picture& candidate) {
    peeling::RenderOptions options = run.render;
    options.audit = options.keep_layers = false;
    peeling::Renderer renderer{session.request(options)};
    peeling::RenderResult result = renderer.render(algorithm);
    if (result.refusal) throw pipeline::Refused{session.profile, *std::move(result.refusal)};
    oracle::Picture picture{.file = run.scene, .targets = {oracle::as_target(result.frame.color, "color")}};
    picture.targets[0].alpha_form = oracle::AlphaForm::premultiplied;
    if (oracle::has_depth(candidate) && !result.frame.depth.codes.empty())
        picture.targets.push_back(oracle::as_target(result.frame.depth, "depth"));
    return picture;
}

}  // namespace

oracle::Picture drawn_picture(SceneQuestion question, const oracle::Picture& candidate) {
    const Session session = open_at_size(question, candidate.targets[0], candidate.file);
    oracle::Picture picture = drawn_by(*question.run.algorithms[0], session, question.run, candidate);
    // A file of 8-bit colours holds those of a float target rounded.
    const bool is_linear = question.run.scene_options.color_space == pipeline::ColorSpace::linear;
    return is_linear ? picture : stored_like(std::move(picture), candidate, pipeline::ColorSpace::encoded);
}

namespace {

using oracle::verdict::EditMap;

// Colours of the kinds of edits, by their index; they repeat after the last one.
constexpr std::array<std::uint8_t, 3> edit_colors[] = {{230, 80, 60},  {70, 140, 230},  {240, 200, 60},
                                                       {80, 190, 100}, {190, 100, 210}, {70, 200, 210}};
constexpr std::array<std::uint8_t, 3> unexplained_color = {255, 150, 200}, wrong_alpha_color = {140, 140, 140};

pipeline::Image drawn(const EditMap& map) {
    pipeline::Image image{pipeline::Format::rgba8, map.width, map.height};
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const std::size_t first = image.index(x, y);
            const std::uint8_t edit = map.of_pixel[first / 4];
            image.codes[first + 3] = 255;
            if (edit == EditMap::right) continue;
            const auto& color = edit == EditMap::unexplained   ? unexplained_color
                                : edit == EditMap::wrong_alpha ? wrong_alpha_color
                                                               : edit_colors[(edit - 1u) % std::size(edit_colors)];
            std::ranges::copy(color, image.codes.begin() + static_cast<std::ptrdiff_t>(first));
        }
    return image;
}

std::string counted(std::uint64_t pixels, const std::string& what) {
    return std::to_string(pixels) + (pixels == 1 ? " pixel: " : " pixels: ") + what;
}

// The wrong pixels of a verdict as files show them.
struct ShownVerdict {
    pipeline::Image map;      // of the wrong pixels
    std::string map_caption;  // what its colours mean
    std::vector<PlainPage::Swatch> legend{};
};

// The picture that an exact algorithm makes of the scene: the named one, or the first that the profile runs.
oracle::Picture right_picture(const SceneQuestion& question, const Session& session, const oracle::Picture& candidate) {
    std::vector<const peeling::Algorithm*> tried = question.run.algorithms;
    for (const peeling::Algorithm& algorithm : peeling::algorithms())
        if (algorithm.exact) tried.push_back(&algorithm);
    for (const peeling::Algorithm* algorithm : tried) try {
            return drawn_by(*algorithm, session, question.run, candidate);
        } catch (const pipeline::Refused&) {
            if (algorithm == tried.back()) throw;
        }
    throw InputError(question.run.scene, "has no algorithm that draws it");
}

// The page: what a right port shows, the candidate, the difference and the wrong pixels next to each other, then the
// verdict.
PlainPage page_of(const std::string& scene, const oracle::Picture& right, const oracle::Picture& candidate,
                  const oracle::Comparison& difference, const std::string& text, const ShownVerdict& verdict) {
    const std::string name = std::filesystem::path(candidate.file).filename().string();
    PlainPage page{"Verdict", name + " of " + std::filesystem::path(scene).filename().string()};
    std::istringstream lines(text);
    std::vector<std::string> messages;
    for (std::string line; std::getline(lines, line);) messages.push_back(line);
    page.lead(messages[0]);
    page.begin_pictures();
    page.picture(oracle::as_shown(right), "What a right port shows");
    page.picture(oracle::as_shown(candidate), "The candidate, " + name);
    page.picture(oracle::heat_map(difference),
                 "How far apart they are, in codes: black is equal; a right port may be some codes off");
    page.picture(verdict.map, verdict.map_caption);
    page.beside_pictures();
    add_heat_scale(page, difference);
    if (!verdict.legend.empty()) page.legend(verdict.legend);
    messages.erase(messages.begin());
    page.indented_items(messages);
    page.end_pictures();
    return page;
}

// The verdict as one line: what failed, and the findings.
std::string one_line(const std::string& text) {
    std::istringstream lines(text);
    std::string all;
    for (std::string line; std::getline(lines, line);)
        all += (all.empty() ? "" : "; ") + line.substr(std::min(line.find_first_not_of(' '), line.size()));
    return all;
}

ShownVerdict shown(const oracle::verdict::PictureVerdict& verdict, const pipeline::DrawList& list) {
    const oracle::verdict::Verdict& found = verdict.found;
    const EditMap map = edit_map(*verdict.fragments, verdict.formed.colors(), found);
    ShownVerdict shown{.map = drawn(map),
                       .map_caption = found.is_right ? "Wrong pixels: none, so all of it is black"
                                                     : "What each wrong pixel composited: black is right"};
    if (found.is_right) return shown;
    for (std::size_t i = 0; i < map.edits.size(); ++i)
        shown.legend.push_back({edit_colors[i % std::size(edit_colors)],
                                counted(map.edits[i].pixels, description(map.edits[i].rules, found.facts, list))});
    if (!found.alpha.wrong_pixels.empty())
        shown.legend.push_back({wrong_alpha_color, counted(found.alpha.wrong_pixels.size(), "alpha alone is wrong")});
    if (map.not_explained > 0)
        shown.legend.push_back({unexplained_color, counted(map.not_explained, "no mistake that is known here")});
    return shown;
}

ShownVerdict shown(const oracle::verdict::ResolvedVerdict& verdict) {
    EditMap map{.width = verdict.form.target.width, .height = verdict.form.target.height};
    map.of_pixel.assign(verdict.form.target.pixels(), EditMap::right);
    const auto mark = [&map](const std::vector<std::uint32_t>& pixels, std::uint8_t as) {
        for (const std::uint32_t pixel : pixels) map.of_pixel[pixel] = as;
    };
    mark(verdict.wrong_pixels, EditMap::unexplained);
    mark(verdict.alpha.wrong_pixels, EditMap::wrong_alpha);
    return {.map = drawn(map),
            .map_caption = verdict.is_right() ? "Wrong pixels: none, so all of it is black"
                                              : "Wrong pixels: pink, or grey if alpha alone is wrong"};
}

ShownVerdict shown(const oracle::Judgement& judgement, const pipeline::DrawList& list) {
    return judgement.layers->single ? shown(*judgement.layers->single, list) : shown(*judgement.layers->samples);
}

void write_files(const SceneQuestion& question, const Session& session, const oracle::Picture& candidate,
                 const oracle::Judgement& judgement) {
    const VerdictFiles& files = question.files;
    if (!files.junit.empty())
        scenes::write_file(files.junit, oracle::to_junit(std::vector<oracle::JunitCase>{
                                            {.group = "strata.compare",
                                             .name = "verdict",
                                             .failure = judgement.is_right ? "" : one_line(judgement.text)}}));
    if (files.heat.empty() && files.side.empty() && files.report.empty()) return;
    const ShownVerdict verdict = shown(judgement, session.scene.list);
    const oracle::Picture right = right_picture(question, session, candidate);
    const oracle::Comparison difference = oracle::compare(right, candidate, {}, {});
    if (!files.heat.empty()) scenes::write_image(files.heat, {.color = oracle::heat_map_with_legend(difference)});
    if (!files.side.empty())
        scenes::write_image(files.side, {.color = oracle::beside({oracle::as_shown(right), oracle::as_shown(candidate),
                                                                  oracle::heat_map(difference), verdict.map})});
    if (!files.report.empty())
        write_page(files.report, page_of(question.run.scene, right, candidate, difference, judgement.text, verdict));
}

oracle::ShowProgress shares_of(Progress& bar) {
    return [&bar](double share) { bar.show(share); };
}

// Whether a picture is right with the other --color-space (AskedPicture).
bool is_right_in_other_space(SceneQuestion question, const oracle::Picture& candidate, bool is_narrow) {
    using enum pipeline::ColorSpace;
    if (scenes::is_pack(question.run.scene)) return false;
    pipeline::ColorSpace& space = question.run.scene_options.color_space;
    space = space == linear ? encoded : linear;
    const Session session = open_at_size(question, colors_of(candidate), candidate.file);
    const peeling::FrameRequest input = session.request(question.run.render, space);
    if (is_narrow) {
        namespace verdict = oracle::verdict;
        verdict::SceneFragments fragments{input, input.options.fragment_memory};
        const peeling::Algorithm& peel =
            question.algorithm.empty() ? *peeling::find_algorithm("dual") : *question.run.algorithms[0];
        if (oracle::is_picture_of(input, peel, {.candidate = candidate}, fullest(fragments))) return true;
        if (space == encoded) return right_narrowly(fragments, verdict::Colors{colors_of(candidate)}).has_value();
        return std::ranges::any_of(
            std::array{verdict::ColorStorage::encoded, verdict::ColorStorage::srgb_target}, [&](auto stored) {
                fragments.set_stored(stored);
                return right_narrowly(fragments, verdict::Colors{colors_of(candidate)}).has_value();
            });
    }
    return oracle::judge_layers(
               input,
               {.candidate = candidate, .is_form_stated = question.is_form_stated, .has_alpha = question.has_alpha})
        .is_right();
}

}  // namespace

int compare_with_scene(SceneQuestion question, const oracle::Picture& candidate) {
    const Session session = open_at_size(question, colors_of(candidate), candidate.file);
    const peeling::FrameRequest input = session.request(question.run.render, question.run.scene_options.color_space);
    const oracle::Judgement judgement = [&] {
        Progress layers("verdict"), view("options of the view");
        return judge(
            input,
            {.candidate = candidate,
             .is_form_stated = question.is_form_stated,
             .has_alpha = question.has_alpha,
             .algorithm = question.algorithm.empty() ? nullptr : question.run.algorithms[0],
             .camera = camera_in_words(question.run),
             .tolerances = {.channels = question.has_alpha ? oracle::ColorChannels::all : oracle::ColorChannels::rgb},
             .is_right_in_other_space =
                 [&](bool is_narrow) { return is_right_in_other_space(question, candidate, is_narrow); },
             .layers = shares_of(layers),
             .view = shares_of(view)},
            oracle::Effort::single);
    }();
    write_files(question, session, candidate, judgement);
    print(question.json ? judgement.json : with_painted_verdicts(judgement.text));
    if (!judgement.is_right) warn_of_other_command(candidate.file, question.run, "compare");
    return judgement.is_right ? 0 : 1;
}

}  // namespace strata::tools
