#include "tools/oracle/pack/golden.h"

#include <fmt/format.h>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "scenes/files/profile_json.h"
#include "scenes/files/text_file.h"
#include "scenes/packs/new_folder.h"
#include "scenes/packs/pack_scene.h"
#include "tools/oracle/pack/draw_json.h"
#include "tools/oracle/pack/exr_copies.h"
#include "tools/oracle/pack/state_json.h"
#include "tools/oracle/pack/target_json.h"
#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;

ordered_json pass_json(const PassReport& pass, TargetWriter& targets) {
    ordered_json object{
        {"number", pass.number},           {"kind", name(pass.kind)}, {"iteration", pass.iteration},
        {"before", pass.before},           {"reads", pass.reads},     {"writes", pass.writes},
        {"passed", pass.passed},           {"tallied", pass.tallied}, {"queries", ordered_json::array()},
        {"targets", ordered_json::array()}};
    for (const Query& query : pass.queries)
        object["queries"].push_back({{"count", query.count}, {"goes_on", query.goes_on}});
    for (const NamedImage& target : pass.targets)
        object["targets"].push_back(
            targets.write_once(fmt::format("pass.{:03}/", pass.number), target.name, target.image));
    return object;
}

// Every pass, and the published image.
void add_passes(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, TargetWriter& targets,
                ordered_json& object) {
    int geometry = 0, full_screen = 0;
    ordered_json list = ordered_json::array(), picture;
    passes(input, algorithm, [&](PassReport&& pass) {
        if (pass.kind == ReportedPassKind::published) {
            picture = targets.write("", "picture", pass.targets.at(0).image);
            return;
        }
        ++(pass.kind == ReportedPassKind::geometry ? geometry : full_screen);
        list.push_back(pass_json(pass, targets));
    });
    object["geometry_passes"] = geometry;
    object["full_screen_passes"] = full_screen;
    object["picture"] = std::move(picture);
    object["passes"] = std::move(list);
}

// The layers and the nearest depth, from a separate run.
void add_layers(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, TargetWriter& targets,
                ordered_json& object) {
    peeling::RenderOptions options = input.options;
    options.audit = false;
    options.nearest_depth = true;
    options.keep_layers = algorithm.makes_layers;
    peeling::Renderer renderer{input.with(options)};
    peeling::RenderResult result = renderer.render(algorithm);
    if (result.refusal) throw pipeline::Refused{input.profile, *std::move(result.refusal)};
    object["depth"] = targets.write("", "depth", result.frame.depth);
    object["premultiplied_layers"] = algorithm.premultiplied_layers;
    object["layers"] = ordered_json::array();
    int front = 0, back = 0;
    for (const pipeline::PeeledLayer& layer : result.frame.layers) {
        const bool is_back = layer.side == pipeline::Side::back;
        const char* end = !algorithm.takes_both_ends ? "layer" : is_back ? "back" : "front";
        const std::string name = fmt::format("{}.{:03}", end, is_back ? back++ : front++);
        ordered_json both{{"name", name}};
        both["color"] = targets.write("", name + ".color", layer.color);
        both["depth"] = targets.write("", name + ".depth", layer.depth);
        object["layers"].push_back(std::move(both));
    }
}

ordered_json result_json(const Golden& golden, const peeling::Algorithm& algorithm, scenes::PackFiles& files) {
    const peeling::FrameRequest input = golden.request();
    const std::string folder = "expected/" + algorithm.name;
    TargetWriter targets{folder, files};
    ordered_json object{{"algorithm", algorithm.name}, {"order", nullptr}};
    const std::vector<std::uint32_t> order = submission_of(input, algorithm.order);
    if (!order.empty()) {
        scenes::NumberArray numbers{.element = scenes::Element::u4, .shape = {order.size()}};
        for (const std::uint32_t number : order) numbers.append(number);
        object["order"] = files.add(folder + "/order.npy", numbers);
    }
    add_passes(input, algorithm, targets, object);
    add_layers(input, algorithm, targets, object);
    return object;
}

}  // namespace

using nlohmann::json;
using nlohmann::ordered_json;

void derive(const Golden& golden, const scenes::PackFiles::Sink& sink,
            const std::function<void(double share)>& progress) {
    scenes::PackFiles files{sink};
    ordered_json manifest{{"format", "strata-pack"}, {"version", scenes::pack_version}, {"command", golden.command}};
    files.add_text("profile.json", scenes::to_json(golden.profile));
    manifest["scene"] = scenes::scene_json(golden.scene, golden.color_space, files);
    manifest["view"] = scenes::view_json(*golden.scene.own_view);
    manifest["state"] = state_json(golden.options, golden.profile);
    manifest["draws"] = draws_json(golden.request(), files);
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
    golden.options = read_state(manifest, file, golden.profile);
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
