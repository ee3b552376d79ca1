// tools/web/workbench.cpp - the renderer's interface to the web page: scenes, pictures, layers and histories, as JSON
// and plain arrays.
//
// Rule     A request is a JSON object with the key "do"; its other keys, and those of its object "options", have the
//          names and meanings of the command's options (tools/request/option_fields.h), so `strata render` with the
//          same options gives the same digest. The answer is an object; if it has
//          the key "error", its value is a message. The arrays of an answer are valid until the next request of the
//          same kind.
// Tests    tools/web/test.sh
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/files/image_io.h"
#include "scenes/files/profile_json.h"
#include "scenes/gltf/gltf.h"
#include "scenes/numbers/srgb_encode.h"
#include "scenes/scene.h"
#include "tools/oracle/explain/history_report.h"
#include "tools/request/complete.h"
#include "tools/request/option_fields.h"
#include "tools/strata/report/survey.h"

namespace strata::web {

class Workbench {
  public:
    // Stores a .glb or .gltf file, which requests name as "scene".
    void keep_file(const std::string& name, std::vector<std::byte> bytes) { files_[name] = std::move(bytes); }

    // Throws nothing except std::bad_alloc.
    [[nodiscard]] std::string answer(const std::string& question);

  private:
    using Json = nlohmann::ordered_json;

    [[nodiscard]] Json answer_of(const Json& question);
    void open(const Json& question);
    void open_scene(const std::string& name, const tools::PictureRequest& request);
    [[nodiscard]] pipeline::View view_of(const tools::PictureRequest& request) const;
    [[nodiscard]] Json render(const Json& question);
    [[nodiscard]] Json layers(const Json& question);
    [[nodiscard]] Json explain(const Json& question);
    [[nodiscard]] scenes::Scene load(const std::string& name, const scenes::SceneOptions& options) const;

    std::map<std::string, std::vector<std::byte>> files_;
    std::string scene_key_;
    std::optional<scenes::Scene> scene_;
    pipeline::View view_;
    pipeline::DeviceProfile profile_;
    peeling::RenderOptions options_;
    pipeline::ColorSpace space_ = pipeline::ColorSpace::encoded;
    std::vector<std::uint8_t> picture_;  // r, g, b, a, not premultiplied
    std::vector<std::uint32_t> codes_;
    tools::Columns columns_;
    std::vector<std::uint32_t> numbers_[3];  // depth code, triangle, rank in submission order
    std::vector<float> values_[5];           // depth, red, green, blue, alpha
};

namespace {

using nlohmann::ordered_json;

// Larger pictures and their fragments would exceed the memory that browsers give a page.
constexpr int most_side = 2048;

const peeling::Algorithm& algorithm_of(const ordered_json& question) {
    const auto name = question.at("algorithm").get<std::string>();
    const peeling::Algorithm* algorithm = peeling::find_algorithm(name);
    if (algorithm == nullptr) throw InputError("page", "algorithm", "one of the list", name);
    return *algorithm;
}

// The address of an array in the memory of the page, and its number of elements.
template <class T>
ordered_json place_of(const std::vector<T>& values) {
    return {reinterpret_cast<std::uintptr_t>(values.data()), values.size()};
}

ordered_json lists() {
    ordered_json document{
        {"algorithms", ordered_json::array()}, {"profiles", ordered_json::array()}, {"scenes", ordered_json::array()}};
    for (const peeling::Algorithm& a : peeling::algorithms())
        document["algorithms"].push_back({{"name", a.name}, {"summary", a.summary}, {"paper", a.paper}});
    for (const pipeline::DeviceProfile& p : pipeline::builtin_profiles())
        document["profiles"].push_back({{"name", p.name}, {"description", p.description}});
    for (const scenes::ProceduralScene& s : scenes::procedural_scenes())
        document["scenes"].push_back({{"name", s.name}, {"parameters", s.parameters}, {"description", s.description}});
    document["options"] = ordered_json::array();
    for (const tools::OptionField& f : tools::option_fields())
        if (!tools::keeps_bits(f.group))
            document["options"].push_back({{"name", f.key()},
                                           {"option", f.option()},
                                           {"type", f.type},
                                           {"help", f.help},
                                           {"words", f.is_flag ? std::vector<std::string>{"true", "false"} : f.words},
                                           {"default", f.text({})}});
    return document;
}

ordered_json diagnostics_of(const peeling::RenderResult& result) {
    ordered_json list = ordered_json::array();
    for (const pipeline::Diagnostic& d : result.frame.diagnostics)
        list.push_back({{"fault", pipeline::name(d.fault)}, {"pixels", d.pixels}, {"detail", d.detail}});
    return list;
}

// The options of a question: its keys that are no words of the question, and those in its object "options".
tools::PictureRequest request_of(const ordered_json& question) {
    tools::PictureRequest request;
    request.render.audit = false;
    constexpr std::array own{"do", "scene", "algorithm", "profile", "pixel", "options"};
    const auto take = [&](const std::string& name, const ordered_json& value) {
        const tools::OptionField* const field = tools::find_option(name);
        std::vector<std::string> parts;
        for (const ordered_json& part : value.is_array() ? value : ordered_json::array({value}))
            parts.push_back(part.is_string() ? part.get<std::string>() : part.dump());
        const std::string text = field == nullptr ? "" : tools::text_of_parts(*field, parts);
        tools::set_option(request, name, text, "page");
    };
    for (const auto& [name, value] : question.items())
        if (std::ranges::find(own, name) == own.end()) take(name, value);
    if (question.contains("options"))
        for (const auto& [name, value] : question["options"].items()) take(name, value);
    if (const auto found = tools::option_conflict(request))
        throw InputError("page", found->option.empty() ? found->sentence : found->option + ": " + found->sentence);
    request.render.threads = 1;
    return request;
}

void check_size(const tools::PictureRequest& request) {
    const int width = request.render.width, height = request.render.height;
    if (!request.states_size || width > most_side || height > most_side)
        throw InputError("page", "size", fmt::format("1 to {} pixels a side", most_side),
                         request.states_size ? fmt::format("{}x{}", width, height) : "none");
}

}  // namespace

scenes::Scene Workbench::load(const std::string& name, const scenes::SceneOptions& options) const {
    if (const auto file = files_.find(name); file != files_.end())
        return scenes::load_gltf_bytes(file->second, name, options);
    return scenes::make_procedural(name, options);
}

// Loads the scene unless it is loaded, with the options that its reading needs.
void Workbench::open_scene(const std::string& name, const tools::PictureRequest& request) {
    std::string key = name + " " + tools::find_option("alpha")->text(request);
    for (const std::string& word : tools::words_of(request, tools::OptionGroup::reading)) key += " " + word;
    if (key == scene_key_) return;
    scene_key_.clear();
    scene_ = load(name, request.scene_options);
    scene_key_ = key;
}

pipeline::View Workbench::view_of(const tools::PictureRequest& request) const {
    const double aspect = double(request.render.width) / request.render.height;
    for (const scenes::SceneCamera& camera : scene_->cameras)
        if (camera.name == request.camera) return scenes::camera_view(camera, aspect);
    if (!request.camera.empty()) throw InputError("page", "camera", "a camera of the scene", request.camera);
    if (scene_->own_view && !request.orbit) return *scene_->own_view;
    const tools::Orbit orbit = request.orbit.value_or(tools::Orbit{});
    return scenes::orbit_view(scene_->bounds, orbit.azimuth, orbit.elevation, aspect);
}

// Missing keys have the command's defaults.
void Workbench::open(const Json& question) {
    tools::PictureRequest request = request_of(question);
    check_size(request);
    profile_ = scenes::load_profile(question.value("profile", "geforce8"));
    if (request.origin) profile_ = with_origin(profile_, *request.origin);
    tools::complete(request, profile_);
    open_scene(question.at("scene").get<std::string>(), request);
    options_ = request.render;
    space_ = request.scene_options.color_space;
    view_ = scenes::with_clip_convention(view_of(request), {}, scenes::view_convention(options_.raster));
}

Workbench::Json Workbench::render(const Json& question) {
    open(question);
    const peeling::Algorithm& algorithm = algorithm_of(question);
    peeling::Renderer renderer{scene_->list, view_, profile_, options_};
    peeling::RenderResult result = renderer.render(algorithm);
    if (result.outcome == peeling::Outcome::refused) return {{"refusal", result.refusal->message(profile_)}};
    const scenes::OutputColor color{.color = result.frame.color, .premultiplied = true, .space = space_};
    const pipeline::Image straight = scenes::as_straight_rgba8(color);
    picture_.assign(straight.codes.begin(), straight.codes.end());
    codes_.assign(result.frame.color.codes.begin(), result.frame.color.codes.end());
    Json answer{{"refusal", nullptr},
                {"digest", pipeline::digest(result.frame.color)},
                {"depth_digest", result.frame.depth.codes.empty() ? "" : pipeline::digest(result.frame.depth)},
                {"format", pipeline::info(result.frame.color.format).name},
                {"passes", result.frame.passes.geometry},
                {"full_screen", result.frame.passes.full_screen},
                {"picture", place_of(picture_)},
                {"codes", place_of(codes_)},
                {"diagnostics", diagnostics_of(result)},
                {"has_own_view", scene_->own_view.has_value()},
                {"warnings", scene_->warnings}};
    return answer;
}

// Fragments from near to far, collected with the A-buffer, which every device can run, as for the report.
Workbench::Json Workbench::layers(const Json& question) {
    open(question);
    peeling::Renderer renderer{scene_->list, view_, profile_, options_};
    columns_ = tools::columns_of(renderer.fragments(*peeling::find_algorithm("a_buffer")).of_sample(0).all,
                                 static_cast<std::size_t>(options_.width) * static_cast<std::size_t>(options_.height));
    for (auto& numbers : numbers_) numbers.clear();
    for (auto& values : values_) values.clear();
    for (std::size_t f = 0; f < columns_.fragments.size(); ++f) {
        const pipeline::CapturedFragment& fragment = columns_.fragments[f];
        numbers_[0].push_back(fragment.code);
        numbers_[1].push_back(fragment.primitive);
        numbers_[2].push_back(columns_.arrival[f]);
        values_[0].push_back(fragment.shader_z);
        for (std::size_t c = 0; c < 4; ++c) values_[c + 1].push_back(fragment.color[c]);
    }
    return {{"first", place_of(columns_.first)}, {"code", place_of(numbers_[0])}, {"primitive", place_of(numbers_[1])},
            {"order", place_of(numbers_[2])},    {"z", place_of(values_[0])},     {"red", place_of(values_[1])},
            {"green", place_of(values_[2])},     {"blue", place_of(values_[3])},  {"alpha", place_of(values_[4])}};
}

Workbench::Json Workbench::explain(const Json& question) {
    open(question);
    const auto [x, y] = question.at("pixel").get<std::array<int, 2>>();
    const peeling::FrameRequest input{scene_->list, view_, profile_, options_};
    return {{"text", oracle::to_text(oracle::explain_samples(input, algorithm_of(question), x, y))}};
}

Workbench::Json Workbench::answer_of(const Json& question) {
    const auto kind = question.at("do").get<std::string>();
    if (kind == "render") return render(question);
    if (kind == "layers") return layers(question);
    if (kind == "explain") return explain(question);
    return lists();
}

std::string Workbench::answer(const std::string& question) {
    Json answer;
    try {
        answer = answer_of(Json::parse(question));
    } catch (const std::exception& error) {
        answer = {{"error", error.what()}};
    }
    return answer.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace strata::web

namespace {

strata::web::Workbench& workbench() {
    static strata::web::Workbench one;
    return one;
}

}  // namespace

extern "C" {

// Takes and returns JSON; the returned text is valid until the next call.
const char* strata_ask(const char* question) {
    static std::string answer;
    answer = workbench().answer(question);
    return answer.c_str();
}

void strata_keep_file(const char* name, const unsigned char* bytes, std::size_t size) {
    const auto* begin = reinterpret_cast<const std::byte*>(bytes);
    workbench().keep_file(name, {begin, begin + size});
}
}
