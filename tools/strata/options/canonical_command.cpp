// tools/strata/options/canonical_command.cpp - the command that renders a picture again, with every option whose value
// is not the default, in a fixed order; stored in picture files.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "scenes/packs/pack_scene.h"
#include "tools/request/option_fields.h"
#include "tools/strata/options/options.h"
#include "tools/strata/options/shell_words.h"

namespace strata::tools {

namespace {

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

// The value of an option in a canonical command; empty if the command does not contain it. Size and view are always
// written, even if they are the defaults, unless the scene contains the view.
std::string value_of(const OptionField& field, const RunOptions& options) {
    if (field.name == "size") return field.text(options);
    if (field.name == "camera") return options.names_camera_of_scene ? options.camera : file_name(options.camera);
    if (field.name == "orbit") {
        if (!options.camera.empty() || options.takes_own_view) return "";
        const Orbit orbit = options.orbit.value_or(Orbit{});
        return fmt::format("{},{}", orbit.azimuth, orbit.elevation);
    }
    return field.is_default(options) ? "" : field.text(options);
}

}  // namespace

std::string canonical_command(const std::string& verb, const RunOptions& options, const peeling::Algorithm& algorithm) {
    return canonical_command(verb, options, Algorithms{&algorithm});
}

std::string canonical_command(const std::string& verb, const RunOptions& options, const Algorithms& algorithms) {
    const bool is_procedural = scenes::is_procedural(options.scene);
    std::string names;
    for (const peeling::Algorithm* algorithm : algorithms) names += (names.empty() ? "" : ",") + algorithm->name;
    std::vector<std::string> words{"strata", verb,
                                   is_procedural ? options.scene : file_name(scenes::pack_folder(options.scene)),
                                   "--algorithm", names};
    // A pack contains its own profile.
    if (options.profile != scenes::pack_folder(options.scene) + "/profile.json")
        words.insert(words.end(), {"--profile", file_name(options.profile)});
    for (const OptionField& field : option_fields()) {
        // The command would be refused with an option that none of its algorithms reads.
        const auto is_reader = [&](const auto* algorithm) { return reads(*algorithm, field, options); };
        if (keeps_bits(field.group) || std::ranges::none_of(algorithms, is_reader)) continue;
        const std::string value = value_of(field, options);
        if (value.empty()) continue;
        words.push_back(field.option());
        if (!field.is_flag) words.push_back(value);
    }
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
    return line;
}

}  // namespace strata::tools
