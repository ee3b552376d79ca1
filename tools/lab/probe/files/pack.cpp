// tools/lab/probe/files/pack.cpp - reads and checks a device's answers, an image per scene and orientation, and writes
// those of a profile (pack.h).
#include "tools/lab/probe/files/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "pipeline/device/profile_fields.h"
#include "rasterizer/base/enum_values.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/strict_json.h"
#include "scenes/packs/new_folder.h"
#include "tools/lab/probe/files/archive.h"
#include "tools/lab/probe/kit/draw_item.h"
#include "tools/lab/probe/kit/kit.h"
#include "tools/oracle/pack/target_json.h"

namespace strata::probe {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using pipeline::Image;
using scenes::NumberArray;

using Files = std::map<std::string, std::string>;

constexpr int answers_version = 1;

std::string file_name(YDirection y, const Item& item, std::string_view target) {
    return fmt::format("probe/{}/{}/{}.npy", name(y), item.name, target);
}

// Converts a depth that a shader read to the nearest code; the float's own rounding is far less than half a code. If
// 24-bit floats are farther from every code than two roundings of binary32, the buffer contains the floats themselves
// (Depth24::binary32).
Image from_texels(const NumberArray& array, pipeline::Format format, int width, int height) {
    Image codes{format, width, height}, floats{pipeline::Format::d32f, width, height};
    const double greatest = rasterizer::buffer_units(pipeline::depth_format(format));
    bool holds_codes = true;
    for (std::size_t i = 0; i < codes.codes.size(); ++i) {
        floats.codes[i] = array.word(i);
        const double scaled = double{std::bit_cast<float>(array.word(i))} * greatest;
        const double code = std::clamp(std::floor(scaled + 0.5), 0.0, greatest);
        codes.codes[i] = static_cast<std::uint32_t>(code);
        holds_codes &= std::abs(scaled - code) <= scaled * 0x1p-23;
    }
    return holds_codes || format != pipeline::Format::d24 ? codes : floats;
}

Image read_image(const std::string& bytes, const std::string& file, const Item& item, pipeline::Format format) {
    const NumberArray array = scenes::parse_npy(bytes, file);
    const std::vector<std::size_t> sides{static_cast<std::size_t>(item.height), static_cast<std::size_t>(item.width)};
    if (pipeline::is_depth(format) && array.element == scenes::Element::f4 && array.shape == sides &&
        format != pipeline::Format::d32f)
        return from_texels(array, format, item.width, item.height);
    std::optional<Image> image = oracle::as_image(array, format, 1);
    if (!image || image->width != item.width || image->height != item.height)
        throw InputError(file, "shape",
                         fmt::format("{} of {} x {} pixels", pipeline::info(format).name, item.width, item.height),
                         "another array");
    return *std::move(image);
}

// Null: the client did not draw it.
std::optional<Answer> read_answer(const Files& files, YDirection y, const Item& item, const std::string& path) {
    const std::string color = file_name(y, item, "color"), depth = file_name(y, item, "depth");
    if (!files.contains(color) || (item.depth && !files.contains(depth))) return std::nullopt;
    Answer answer{.color = read_image(files.at(color), path + "/" + color, item, item.color)};
    if (item.depth)
        answer.depth = read_image(files.at(depth), path + "/" + depth, item, pipeline::target_format(*item.depth));
    return answer;
}

// InputError unless every scene of an orientation that has answers has one, or a reason why it has none.
void check_complete(const ProbePack& pack, const std::vector<Item>& items, const std::string& path) {
    for (const auto& [y, answers] : pack.answers)
        for (const Item& item : items)
            if (!answers.contains(item.name))
                throw InputError(path, file_name(y, item, "color"),
                                 "the picture of a scene, or the reason in /probe/missing why there is none",
                                 "neither");
}

// Features and limits are reported by the driver, not determined from pictures.
bool is_feature(const pipeline::ProfileField& field) {
    return field.key.starts_with("has_") || field.key.starts_with("max_");
}

ordered_json features_of(const pipeline::DeviceProfile& profile) {
    ordered_json device = ordered_json::object();
    for (const pipeline::ProfileField& field : pipeline::profile_fields()) {
        if (!is_feature(field)) continue;
        const int value = field.value(profile);
        ordered_json& entry = device[std::string{field.key}];
        if (field.kind == pipeline::FieldKind::boolean)
            entry = value != 0;
        else
            entry = value;
    }
    return device;
}

ordered_json refusals(const ProbePack& pack) {
    ordered_json all = ordered_json::object();
    for (const auto& [y, answers] : pack.answers)
        for (const auto& [item, reply] : answers)
            if (!reply.answer) all[fmt::format("{}/{}", name(y), item)] = reply.refusal;
    return all;
}

}  // namespace

std::string_view name(YDirection y) noexcept { return enum_name(y); }

ProbePack answer(const pipeline::DeviceProfile& profile, const std::vector<Item>& items,
                 const std::vector<YDirection>& orientations) {
    ProbePack pack{.made_by = "strata probe, profile " + profile.name,
                   .kit_digest = digest(items),
                   .device = features_of(profile)};
    for (const YDirection y : orientations)
        for (const Item& item : items)
            pack.answers[y][item.name] = draw_item(with_origin(profile, origin_of(y)), item, y);
    return pack;
}

void write_pack(const ProbePack& pack, const std::vector<Item>& items, const std::string& folder) {
    scenes::NewFolder place{folder};
    for (const auto& [y, answers] : pack.answers)
        for (const Item& item : items) {
            const auto found = answers.find(item.name);
            if (found == answers.end() || !found->second.answer) continue;
            const Answer& answer = *found->second.answer;
            place.write(file_name(y, item, "color"), scenes::to_npy(oracle::as_array(answer.color)));
            if (answer.depth) place.write(file_name(y, item, "depth"), scenes::to_npy(oracle::as_array(*answer.depth)));
        }
    const ordered_json probe{{"kit", pack.kit_digest}, {"device", pack.device}, {"missing", refusals(pack)}};
    const ordered_json document{
        {"format", "strata-candidate"}, {"version", answers_version}, {"made_by", pack.made_by}, {"probe", probe}};
    place.write("candidate.json", document.dump(1) + "\n");
    place.keep();
}

ProbePack read_pack(const std::string& path, const std::vector<Item>& items) {
    const Files files = read_files(path);
    const std::string file = path + "/candidate.json";
    if (!files.contains("candidate.json"))
        throw InputError(path, "holds no candidate.json, in which a device's answers to the probe's scenes stand");
    const json document = scenes::parse_strict_json(files.at("candidate.json"), file, "a candidate in JSON");
    if (!document.is_object() || !document.contains("probe") || !document["probe"].is_object())
        throw InputError(file, "/probe", "an object that says which kit was answered", "none");
    const json& probe = document["probe"];
    if (document.value("version", json{}) != answers_version)
        throw InputError(file, "/version", fmt::format("{}, the version that this program reads", answers_version),
                         document.value("version", json{}).dump());
    const auto text_of = [&](const json& object, const std::string& key, const std::string& place) -> std::string {
        if (!object.contains(key)) return "";
        if (!object[key].is_string()) throw InputError(file, place, "a string", object[key].type_name());
        return object[key].get<std::string>();
    };
    ProbePack pack{.made_by = text_of(document, "made_by", "/made_by"),
                   .kit_digest = text_of(probe, "kit", "/probe/kit")};
    if (const std::string expected = digest(items); pack.kit_digest != expected)
        throw InputError(file, "/probe/kit", "the kit of this program, " + expected, pack.kit_digest);
    if (probe.contains("device")) pack.device = ordered_json::parse(probe["device"].dump());
    const json missing = probe.value("missing", json::object());
    for (const YDirection y : enum_values<YDirection>)
        for (const Item& item : items) {
            const std::string key = fmt::format("{}/{}", name(y), item.name);
            std::optional<Answer> read = read_answer(files, y, item, path);
            if (read)
                pack.answers[y][item.name] = {.answer = std::move(read)};
            else if (missing.contains(key) && missing[key].is_string())
                pack.answers[y][item.name] = {.answer = std::nullopt, .refusal = missing[key].get<std::string>()};
        }
    check_complete(pack, items, path);
    return pack;
}

}  // namespace strata::probe
