#include "tools/strata/compare_scene.h"

#include <algorithm>
#include <filesystem>

#include "peeling/render.h"
#include "rasterizer/base/input_error.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/verdict/report.h"
#include "tools/oracle/verdict/sample.h"
#include "tools/oracle/verdict/verdict.h"
#include "tools/strata/compare_pages.h"
#include "tools/strata/render/run.h"
#include "tools/strata/table.h"

namespace strata::tools {

bool is_scene(const std::string& reference) {
    if (scenes::is_procedural(reference) || scenes::is_pack(reference)) return true;
    std::string ending = std::filesystem::path(reference).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".gltf" || ending == ".glb" || ending == ".json";
}

namespace {

const oracle::Target& colors_of(const oracle::Picture& candidate) {
    const auto found = std::ranges::find(candidate.targets, oracle::Meaning::color, &oracle::Target::meaning);
    if (found == candidate.targets.end()) throw InputError(candidate.file, "targets", "colours", "none");
    return *found;
}

// The scene at the candidate's size.
Session open_at_size(SceneQuestion& question, const oracle::Target& target) {
    RunOptions& run = question.run;
    if (!question.algorithm.empty()) run.algorithms = {to_algorithm(question.algorithm)};
    complete(run);
    run.render.width = target.width;
    run.render.height = target.height;
    return open_session(run);
}

}  // namespace

oracle::Picture drawn_picture(SceneQuestion question, const oracle::Picture& candidate) {
    const Session session = open_at_size(question, candidate.targets[0]);
    const peeling::RenderOptions& options = question.run.render;
    peeling::Renderer renderer{session.scene.list, session.view, session.profile, options};
    peeling::RenderResult result = renderer.render(*question.run.algorithms[0]);
    if (result.refusal) throw pipeline::Refused{session.profile, *std::move(result.refusal)};
    oracle::Picture picture{.file = question.run.scene, .targets = {oracle::as_target(result.frame.color, "color")}};
    if (oracle::has_depth(candidate)) picture.targets.push_back(oracle::as_target(result.frame.depth, "depth"));
    return picture;
}

int compare_with_scene(SceneQuestion question, const oracle::Picture& candidate) {
    const oracle::Target& colors = colors_of(candidate);
    const Session session = open_at_size(question, colors);
    const peeling::RenderOptions& options = question.run.render;
    oracle::verdict::SceneFragments fragments{{session.scene.list, session.view, session.profile, options},
                                              options.fragment_memory};
    const oracle::verdict::Verdict found = oracle::verdict::judge(fragments, oracle::verdict::Colors{colors});
    const pipeline::DrawList& list = session.scene.list;
    print(question.json ? to_json(found, list) : with_painted_verdicts(to_text(found, list)));
    return found.is_right ? 0 : 1;
}

}  // namespace strata::tools
