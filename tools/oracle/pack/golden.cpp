#include "tools/oracle/pack/golden.h"

#include "peeling/registry.h"
#include "scenes/files/profile_json.h"
#include "scenes/files/text_file.h"
#include "scenes/packs/new_folder.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/pack/draw_json.h"
#include "tools/oracle/pack/exr_copies.h"
#include "tools/oracle/pack/result_json.h"
#include "tools/oracle/pack/state_json.h"

namespace strata::oracle {

using nlohmann::json;
using nlohmann::ordered_json;

void derive(const Golden& golden, const scenes::PackFiles::Sink& sink,
            const std::function<void(double share)>& progress) {
    scenes::PackFiles files{sink};
    ordered_json manifest{{"format", "strata-pack"}, {"version", scenes::pack_version}, {"command", golden.command}};
    files.add_text("profile.json", scenes::to_json(golden.profile));
    manifest["scene"] = scenes::scene_json(golden.scene, golden.color_space, files);
    manifest["view"] = scenes::view_json(*golden.scene.own_view);
    manifest["state"] = state_json({golden.options, golden.sampling}, golden.profile);
    manifest["draws"] =
        draws_json({golden.scene.list, *golden.scene.own_view, golden.profile, golden.options, golden.sampling}, files);
    manifest["results"] = ordered_json::array();
    for (std::size_t i = 0; i < golden.algorithms.size(); ++i) {
        manifest["results"].push_back(result_json(golden, *golden.algorithms[i], files));
        if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(golden.algorithms.size()));
    }
    manifest["files"] = files.list();
    sink("manifest.json", manifest.dump(1) + '\n');
}

void write_pack(const Golden& golden, const std::string& folder, Copies copies,
                const std::function<void(double share)>& progress) {
    scenes::NewFolder place{folder};
    derive(
        golden, [&](const std::string& name, const std::string& bytes) { place.write(name, bytes); }, progress);
    if (copies == Copies::exr) write_exr_copies(folder);
    place.keep();
}

Golden read_pack(const std::string& path) {
    const std::string folder = scenes::pack_folder(path), file = folder + "/manifest.json";
    const json manifest = scenes::read_manifest(folder);
    Golden golden;
    golden.color_space = scenes::color_space_of(folder, manifest);
    golden.scene = scenes::load_pack(path, {.color_space = golden.color_space});
    const std::string profile = scenes::pack_profile(folder);
    golden.profile = scenes::parse_profile(scenes::read_text_file(profile), profile);
    auto [options, sampling] = read_state(manifest, file, golden.profile);
    golden.options = std::move(options);
    golden.sampling = sampling;
    scenes::JsonReader top{manifest, file, ""};
    top.text("command", golden.command);
    const json& results = top.at("results");
    if (!results.is_array()) top.fail("results", "an array");
    for (std::size_t i = 0; i < results.size(); ++i) {
        scenes::JsonReader result{results[i], file, "/results/" + std::to_string(i)};
        std::string name;
        result.text("algorithm", name);
        golden.algorithms.push_back(peeling::find_algorithm(name));
        if (golden.algorithms.back() == nullptr)
            result.fail("algorithm", "an algorithm (strata list algorithms shows them)");
    }
    return golden;
}

}  // namespace strata::oracle
