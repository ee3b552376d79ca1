// scenes/files/profile_json.cpp - profiles as JSON. The fields with their ranges and choices come from
// pipeline::profile_fields().
#include "scenes/files/profile_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/device/profile_fields.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/strict_json.h"
#include "scenes/files/text_file.h"
#include "scenes/nearest_name.h"

namespace strata::scenes {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using pipeline::DeviceProfile;
using pipeline::FieldKind;
using pipeline::profile_fields;
using pipeline::ProfileField;

using Names = std::vector<std::string_view>;

// Fields of the rasterizer are in an object of their own, `raster`, according to the prefix of their keys.
constexpr std::string_view raster_prefix = "raster.";
// In bytes. Names are printed in tables and error messages, descriptions in the list of profiles.
constexpr std::size_t longest_name = 64, longest_description = 1000;

// Fields that were added after the first profile files were written. If a file has no `base`, the profile that it
// inherits from, and omits such a field, the field gets DeviceProfile's default, which describes the earlier behaviour.
// All other fields are required there, so that no default of the program enters a user's profile.
constexpr std::string_view later_fields[] = {"alpha_to_coverage",
                                             "blend_storage",
                                             "centroid",
                                             "clip_depth",
                                             "depth24",
                                             "depth_order",
                                             "fog",
                                             "has_d24f",
                                             "has_logic_op",
                                             "has_unordered_access",
                                             "lighting",
                                             "min_samples",
                                             "origin",
                                             "raster.area_sign",
                                             "raster.depth_limits",
                                             "raster.equal_colors",
                                             "raster.lines",
                                             "raster.offset_rule",
                                             "raster.perspective_coordinates",
                                             "raster.plane_corners",
                                             "raster.points",
                                             "raster.reciprocal_deficit",
                                             "raster.sample_divisor",
                                             "raster.w_signs",
                                             "raster.w_slope",
                                             "raster.weights",
                                             "raster.y_axis",
                                             "resolve",
                                             "sample_coverage",
                                             "sample_positions"};

[[nodiscard]] bool is_raster(const ProfileField& field) { return field.key.starts_with(raster_prefix); }

[[nodiscard]] bool is_later(const ProfileField& field) {
    return std::ranges::find(later_fields, field.key) != std::end(later_fields);
}

// The last part of the key, which is the key in the JSON object.
[[nodiscard]] std::string_view leaf(const ProfileField& field) {
    return is_raster(field) ? field.key.substr(raster_prefix.size()) : field.key;
}

[[nodiscard]] std::string pointer(const ProfileField& field) {
    return (is_raster(field) ? "/raster/" : "/") + std::string{leaf(field)};
}

Names builtin_names() {
    Names names;
    for (const DeviceProfile& profile : pipeline::builtin_profiles()) names.push_back(profile.name);
    return names;
}

// The allowed keys of an object: the document (false) or `raster` (true).
Names keys(bool of_raster) {
    Names names;
    if (!of_raster) names = {"base", "name", "description", "open", "raster"};
    for (const ProfileField& field : profile_fields())
        if (is_raster(field) == of_raster) names.push_back(leaf(field));
    return names;
}

void check_keys(const json& object, const Names& allowed, const std::string& file, const std::string& location) {
    if (!object.is_object()) throw InputError(file, location, "an object", json_in_words(object));
    // A misspelled key is an error: if it were ignored, its field would silently keep the base's value.
    for (const auto& [key, value] : object.items())
        if (std::ranges::find(allowed, key) == allowed.end())
            throw InputError(file, location, "a key of a profile", quoted_with_suggestion(key, allowed));
}

// A required string, which may be empty.
std::string text(const json& document, const std::string& key, std::size_t longest, const std::string& file) {
    const auto found = document.find(key);
    const std::string expected = fmt::format("a string of at most {} bytes", longest);
    if (found == document.end()) throw InputError(file, "/" + key, expected, "nothing");
    if (!found->is_string() || found->get_ref<const std::string&>().size() > longest)
        throw InputError(file, "/" + key, expected, json_in_words(*found));
    return found->get<std::string>();
}

// The field's allowed values, for error messages.
[[nodiscard]] std::string expectation(const ProfileField& field) {
    switch (field.kind) {
        case FieldKind::boolean: return "true or false";
        case FieldKind::choice: return fmt::format("one of {}", fmt::join(field.choices, ", "));
        case FieldKind::integer: break;
    }
    if (field.step == 1) return fmt::format("a whole number from {} to {}", field.lowest, field.highest);
    return fmt::format("a number from {} to {} in steps of {}", field.lowest, field.highest, field.step);
}

// The value as ProfileField::set takes it; empty if the JSON value is not allowed for the field.
std::optional<int> value_of(const ProfileField& field, const json& value) {
    switch (field.kind) {
        case FieldKind::boolean:
            if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
            return std::nullopt;
        case FieldKind::choice: {
            if (!value.is_string()) return std::nullopt;
            const auto found = std::ranges::find(field.choices, value.get_ref<const std::string&>());
            if (found == field.choices.end()) return std::nullopt;
            return static_cast<int>(found - field.choices.begin());
        }
        case FieldKind::integer: break;
    }
    if (!value.is_number_unsigned()) return std::nullopt;  // no field is negative
    const auto number = value.get<std::uint64_t>();
    // Compared as 64 bits before the cast to int, because a number beyond int must not wrap into the range.
    const auto lowest = static_cast<std::uint64_t>(field.lowest), highest = static_cast<std::uint64_t>(field.highest);
    if (number < lowest || number > highest) return std::nullopt;
    if ((number - lowest) % static_cast<std::uint64_t>(field.step) != 0) return std::nullopt;
    return static_cast<int>(number);
}

// Shows a value in an error message, with a suggestion if it resembles a choice.
std::string found_text(const ProfileField& field, const json& value) {
    if (field.kind == FieldKind::choice && value.is_string())
        return quoted_with_suggestion(value.get_ref<const std::string&>(), field.choices);
    return json_in_words(value);
}

// The built-in profile that the file is based on; null if the file has no base.
const DeviceProfile* base_of(const json& document, const std::string& file) {
    if (!document.contains("base")) return nullptr;
    const std::string name = text(document, "base", longest_name, file);
    const DeviceProfile* const base = pipeline::find_profile(name);
    const Names names = builtin_names();
    if (base == nullptr)
        throw InputError(file, "/base", fmt::format("one of {}", fmt::join(names, ", ")),
                         quoted_with_suggestion(name, names));
    return base;
}

// A field that the file leaves out keeps the base's value.
void read_field(const ProfileField& field, const json& object, bool has_base, const std::string& file,
                DeviceProfile& profile) {
    const auto found = object.find(leaf(field));
    if (found == object.end()) {
        if (has_base || is_later(field)) return;
        throw InputError(file, pointer(field), expectation(field), "nothing, and no \"base\" to take it from");
    }
    const std::optional<int> value = value_of(field, *found);
    if (!value) throw InputError(file, pointer(field), expectation(field), found_text(field, *found));
    field.set(profile, *value);
}

std::vector<std::string> open_of(const json& document, const std::string& file) {
    std::vector<std::string> open;
    if (!document.contains("open")) return open;
    Names known;
    for (const ProfileField& field : profile_fields()) known.push_back(field.key);
    const json& listed = document["open"];
    const std::string expected = "an array of keys of a profile, such as raster.snap";
    if (!listed.is_array()) throw InputError(file, "/open", expected, json_in_words(listed));
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const std::string location = fmt::format("/open/{}", i);
        if (!listed[i].is_string()) throw InputError(file, location, "a key of a profile", json_in_words(listed[i]));
        open.push_back(listed[i].get<std::string>());
        if (std::ranges::find(known, open.back()) == known.end())
            throw InputError(file, location, "a key of a profile", quoted_with_suggestion(open.back(), known));
    }
    return open;
}

}  // namespace

std::string to_json(const DeviceProfile& profile, std::span<const std::string> open) {
    // The keys are in the order of the fields, so the same profile gives the same text; a built-in profile can be
    // printed, changed and read back.
    ordered_json document;
    document["name"] = profile.name;
    document["description"] = profile.description;
    if (!open.empty()) document["open"] = std::vector<std::string>(open.begin(), open.end());
    for (const ProfileField& field : profile_fields()) {
        ordered_json& object = is_raster(field) ? document["raster"] : document;
        ordered_json& value = object[std::string{leaf(field)}];
        switch (field.kind) {
            case FieldKind::boolean: value = field.value(profile) != 0; break;
            case FieldKind::integer: value = field.value(profile); break;
            case FieldKind::choice: value = pipeline::text_of(field, profile); break;
        }
    }
    return document.dump(2) + "\n";
}

DeviceProfile parse_profile(const std::string& document_text, const std::string& file) {
    const json document = parse_strict_json(document_text, file, "a profile in JSON");
    check_keys(document, keys(false), file, "/");
    // A document without `raster` omits all raster fields.
    const json none = json::object();
    const json& raster = document.contains("raster") ? document["raster"] : none;
    check_keys(raster, keys(true), file, "/raster");
    static_cast<void>(open_of(document, file));
    const DeviceProfile* const base = base_of(document, file);
    DeviceProfile profile = base != nullptr ? *base : DeviceProfile{};
    profile.name = text(document, "name", longest_name, file);
    // A file always has its own name, so that an image's attributes do not name the base. The name is printed in tables
    // and messages, so line breaks and zero bytes are not allowed.
    const bool breaks = std::ranges::any_of(profile.name, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
    if (profile.name.empty() || breaks)
        throw InputError(file, "/name", "a name without control characters", json_in_words(document["name"]));
    // A description may be inherited, a name may not.
    if (base == nullptr || document.contains("description"))
        profile.description = text(document, "description", longest_description, file);
    for (const ProfileField& field : profile_fields())
        read_field(field, is_raster(field) ? raster : document, base != nullptr, file, profile);
    if (const auto conflict = pipeline::conflict_of(profile)) {
        const auto field = std::ranges::find(profile_fields(), conflict->key, &ProfileField::key);
        throw InputError(file, pointer(*field), conflict->expected, conflict->found);
    }
    return profile;
}

DeviceProfile load_profile(const std::string& name_or_path) {
    if (const DeviceProfile* builtin = pipeline::find_profile(name_or_path)) return *builtin;
    std::error_code error;
    // A built-in name takes precedence over a file of that name. A text that looks like a path is read even if there is
    // no such file, so that the error says so.
    const bool looks_like_file = name_or_path.find('/') != std::string::npos || name_or_path.ends_with(".json");
    if (looks_like_file || std::filesystem::exists(name_or_path, error))
        return parse_profile(read_text_file(name_or_path), name_or_path);
    const Names names = builtin_names();
    throw InputError("--profile", "name", fmt::format("{}, or a JSON file", fmt::join(names, ", ")),
                     quoted_with_suggestion(name_or_path, names));
}

std::vector<std::string> open_fields(const std::string& name_or_path) {
    if (pipeline::find_profile(name_or_path) != nullptr) return {};
    return open_of(parse_strict_json(read_text_file(name_or_path), name_or_path, "a profile in JSON"), name_or_path);
}

}  // namespace strata::scenes
