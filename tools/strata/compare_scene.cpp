#include "tools/strata/compare_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "scenes/models/models.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/drawings.h"
#include "tools/oracle/judge/forgotten.h"
#include "tools/oracle/judge/samples_verdict.h"
#include "tools/oracle/mistakes/suite.h"
#include "tools/oracle/verdict/distinguish_rules.h"
#include "tools/oracle/verdict/edits.h"
#include "tools/oracle/verdict/picture_verdict.h"
#include "tools/strata/compare_pages.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

bool is_scene(const std::string& reference) {
    if (scenes::is_procedural(reference) || scenes::is_pack(reference) || scenes::is_model(reference)) return true;
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

const oracle::Target& colors_of(const oracle::Picture& candidate) {
    const auto found = std::ranges::find(candidate.targets, oracle::Meaning::color, &oracle::Target::meaning);
    if (found == candidate.targets.end()) throw InputError(candidate.file, "targets", "colours", "none");
    return *found;
}

Session open_at_size(SceneQuestion& question, const oracle::Target& target) {
    RunOptions& run = question.run;
    if (!question.algorithm.empty()) run.algorithms = {to_algorithm(question.algorithm)};
    complete(run);
    run.render.width = target.width;
    run.render.height = target.height;
    return open_session(run);
}

oracle::Picture drawn_picture(SceneQuestion question, const oracle::Picture& candidate) {
    const Session session = open_at_size(question, candidate.targets[0]);
    const peeling::RenderOptions& options = question.run.render;
    peeling::Renderer renderer{session.scene.list, session.view, session.profile, options};
    peeling::RenderResult result = renderer.render(*question.run.algorithms[0]);
    if (result.refusal) throw pipeline::Refused{session.profile, *std::move(result.refusal)};
    oracle::Picture picture{.file = question.run.scene, .targets = {oracle::as_target(result.frame.color, "color")}};
    picture.targets[0].alpha_form = oracle::AlphaForm::premultiplied;
    if (oracle::has_depth(candidate)) picture.targets.push_back(oracle::as_target(result.frame.depth, "depth"));
    return picture;
}

namespace {

using oracle::verdict::EditMap;

// Colours of the kinds of edits, by their index; they repeat after the last one.
constexpr std::array<std::uint8_t, 3> edit_colors[] = {{230, 80, 60},  {70, 140, 230},  {240, 200, 60},
                                                       {80, 190, 100}, {190, 100, 210}, {70, 200, 210}};
constexpr std::array<std::uint8_t, 3> unexplained_color = {255, 255, 255}, wrong_alpha_color = {140, 140, 140};

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

// Returns the command of the first scene of the suite on which the explanations give different pictures; "" if there is
// no such scene, or fewer than two explanations.
std::string distinguishing_command(const oracle::verdict::Verdict& found) {
    std::vector<std::vector<oracle::verdict::Rule>> rules;
    for (const oracle::verdict::CheckedAccount& c : found.explanations)
        if (is_of_any_scene(c.account.rules)) rules.push_back(c.account.rules);
    if (rules.size() < 2) return "";
    for (const oracle::SuiteScene& scene : oracle::suite()) {
        if (scene.samples > 1) continue;  // the rules are about pictures of one
        const oracle::OpenScene opened = open(scene);
        const oracle::verdict::SceneFragments fragments{opened.input(), opened.options.fragment_memory};
        if (distinguishes(fragments, rules)) return command_of(scene);
    }
    return "";
}

std::string counted(std::uint64_t pixels, const std::string& what) {
    return std::to_string(pixels) + (pixels == 1 ? " pixel: " : " pixels: ") + what;
}

// A page with the verdict's text and the candidate.
PlainPage verdict_page(const std::string& scene, const oracle::Picture& candidate, const std::string& verdict) {
    PlainPage page{"Verdict", std::filesystem::path(candidate.file).filename().string() + " of " +
                                  std::filesystem::path(scene).filename().string()};
    std::istringstream lines(verdict);
    std::vector<std::string> messages;
    for (std::string line; std::getline(lines, line);) messages.push_back(line.substr(line.find_first_not_of(' ')));
    page.lead(messages[0]);
    messages.erase(messages.begin());
    page.items(messages);
    page.picture(oracle::as_shown(candidate),
                 "The candidate, " + std::filesystem::path(candidate.file).filename().string());
    return page;
}

PlainPage page_of(const std::string& scene, const oracle::Picture& candidate,
                  const oracle::verdict::PictureVerdict& verdict, const pipeline::DrawList& list) {
    const oracle::verdict::Verdict& found = verdict.found;
    const EditMap map = edit_map(*verdict.fragments, verdict.formed.colors(), found);
    PlainPage page = verdict_page(scene, candidate, to_text(verdict, list));
    page.picture(drawn(map), found.is_right ? "Wrong pixels: none, so all of it is black"
                                            : "What each wrong pixel composited: black is right");
    if (found.is_right) return page;
    std::vector<PlainPage::Swatch> kinds;
    for (std::size_t i = 0; i < map.edits.size(); ++i)
        kinds.push_back({edit_colors[i % std::size(edit_colors)],
                         counted(map.edits[i].pixels, description(map.edits[i].rules, found.facts, list))});
    if (!found.alpha.wrong_pixels.empty())
        kinds.push_back({wrong_alpha_color, counted(found.alpha.wrong_pixels.size(), "alpha alone is wrong")});
    if (map.not_explained > 0)
        kinds.push_back({unexplained_color, counted(map.not_explained, "no mistake that is known here")});
    page.legend(kinds);
    return page;
}

}  // namespace

namespace {

PlainPage page_of(const std::string& scene, const oracle::Picture& candidate, const oracle::SamplesVerdict& verdict) {
    PlainPage page = verdict_page(scene, candidate, to_text(verdict));
    EditMap map{.width = verdict.form.target.width, .height = verdict.form.target.height};
    map.of_pixel.assign(verdict.form.target.pixels(), EditMap::right);
    const auto mark = [&map](const std::vector<std::uint32_t>& pixels, std::uint8_t as) {
        for (const std::uint32_t pixel : pixels) map.of_pixel[pixel] = as;
    };
    mark(verdict.found.wrong_pixels, EditMap::unexplained);
    mark(verdict.found.alpha.wrong_pixels, EditMap::wrong_alpha);
    page.picture(drawn(map), verdict.found.is_right() ? "Wrong pixels: none, so all of it is black"
                                                      : "Wrong pixels: white, or grey if alpha alone is wrong");
    return page;
}

// The verdict on a picture with several samples per pixel.
int compare_resolved(const SceneQuestion& question, const Session& session, const oracle::Picture& candidate) {
    const oracle::Target& colors = colors_of(candidate);
    const oracle::RunInput input{session.scene.list,  session.view,           session.profile,
                                 question.run.render, sampling(question.run), question.run.scene_options.color_space};
    const oracle::SamplesVerdict verdict = judge_samples(input, {colors, question.is_form_stated, question.has_alpha});
    if (!question.report.empty()) write_page(question.report, page_of(question.run.scene, candidate, verdict));
    const std::vector<std::string> forgotten = oracle::forgotten_options(input, verdict, camera_in_words(question.run));
    print(question.json ? oracle::json_with_forgotten(to_json(verdict), forgotten)
                        : with_painted_verdicts(oracle::with_forgotten(to_text(verdict), forgotten)));
    return verdict.found.is_right() ? 0 : 1;
}

}  // namespace

int compare_with_scene(SceneQuestion question, const oracle::Picture& candidate) {
    const oracle::Target& colors = colors_of(candidate);
    const Session session = open_at_size(question, colors);
    if (question.run.samples > 1) return compare_resolved(question, session, candidate);
    const pipeline::DrawList& list = session.scene.list;
    const oracle::RunInput input{
        list, session.view, session.profile, question.run.render, {}, question.run.scene_options.color_space};
    oracle::verdict::PictureVerdict verdict = oracle::verdict::judge_picture(
        input, {.colors = colors,
                .is_form_stated = question.is_form_stated,
                .has_alpha = question.has_alpha,
                .is_frame_linear = question.run.scene_options.color_space == pipeline::ColorSpace::linear,
                .algorithm = question.algorithm.empty() ? nullptr : question.run.algorithms[0]});
    verdict.found.distinguishing_command = distinguishing_command(verdict.found);
    if (!question.report.empty()) write_page(question.report, page_of(question.run.scene, candidate, verdict, list));
    const std::vector<std::string> forgotten = oracle::forgotten_options(input, verdict, camera_in_words(question.run));
    print(question.json ? oracle::json_with_forgotten(to_json(verdict, list, session.profile.name), forgotten)
                        : with_painted_verdicts(oracle::with_forgotten(to_text(verdict, list), forgotten)));
    return verdict.is_right() ? 0 : 1;
}

}  // namespace strata::tools
