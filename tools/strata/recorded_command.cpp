// tools/strata/recorded_command.cpp - parses the command that a picture records and replaces --from by it; names
// options that differ from a candidate's (recorded_command.h).
#include "tools/strata/recorded_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "pipeline/device/profile.h"
#include "rasterizer/base/input_error.h"
#include "scenes/files/picture_attributes.h"
#include "scenes/inside_folder.h"
#include "scenes/printable.h"
#include "scenes/scene.h"
#include "tools/strata/messages.h"
#include "tools/strata/options/option.h"
#include "tools/strata/options/options.h"
#include "tools/strata/options/shell_words.h"

namespace strata::tools {

namespace {

constexpr std::string_view from = "--from", files_in = "--files-in";
using Words = std::vector<std::string>;

// The options that a recorded command may have, mapped to whether each takes a value.
std::map<std::string, bool> options_of_pictures() {
    CLI::App app;
    RunOptions unused;
    add_picture_options(app, unused);
    std::map<std::string, bool> options{{"--map", true}};
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames())
            options["--" + name] = option->get_items_expected_max() > 0;
    options.erase("--help");
    return options;
}

// Removes `option VALUE` or `option=VALUE` and returns the value; empty if the option is absent or has no value.
std::string take(Words& words, std::string_view option) {
    const auto at = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
        return word.starts_with(option) && (word.size() == option.size() || word[option.size()] == '=');
    });
    if (at == words.end()) return "";
    const bool is_one_word = at->size() > option.size();
    if (!is_one_word && at + 1 == words.end()) return "";
    const std::string value = is_one_word ? at->substr(option.size() + 1) : *(at + 1);
    if (!value.empty()) words.erase(at, at + (is_one_word ? 1 : 2));
    return value;
}

// The words after `strata`, empty if the line is not a command of strata.
std::optional<Words> words_behind_strata(const std::string& line) {
    auto words = shell_words(line);
    if (!words || words->size() < 3 || words->front() != "strata") return std::nullopt;
    words->erase(words->begin());
    return words;
}

class Recorded {
  public:
    Recorded(std::string file, std::string folder) : file_{std::move(file)}, folder_{std::move(folder)} {}

    // The words after `strata VERB`, each option and its value as one word, so that no value is mistaken for an option.
    [[nodiscard]] Words words_of(const std::string& verb) const {
        const std::string line = recorded_command(file_);
        const auto words = words_behind_strata(line);
        if (!words) fail("a command of strata", line);
        if (words->front() != verb) fail("a command of strata " + verb, "a command of strata " + words->front());
        Words chosen{scene((*words)[1])};
        const auto known = options_of_pictures();
        for (std::size_t i = 2; i < words->size(); ++i) {
            const std::string& name = (*words)[i];
            const auto option = known.find(name);
            if (option == known.end()) fail("options that choose what is drawn and nothing else", "'" + name + "'");
            if (option->second && ++i == words->size()) fail("a value of " + name, "none");
            chosen.push_back(option->second ? name + "=" + value(name, (*words)[i]) : name);
        }
        return chosen;
    }

  private:
    [[noreturn]] void fail(const std::string& expected, const std::string& found) const {
        throw InputError(file_, "strata:command", expected, found);
    }

    [[nodiscard]] std::string scene(const std::string& name) const {
        if (scenes::is_procedural(name)) return name;
        if (name == "-") fail("the name of a scene", "'-': the scene came from standard input, and no file holds it");
        if (name.starts_with('-')) fail("a scene", "'" + name + "'");
        return path_of(name);
    }

    [[nodiscard]] std::string value(const std::string& option, const std::string& given) const {
        const bool is_file = option == "--profile" && pipeline::find_profile(given) == nullptr;
        return is_file ? path_of(given) : given;
    }

    [[nodiscard]] std::string path_of(const std::string& name) const {
        if (scenes::inside_folder(folder_, name).status == scenes::InsideFolder::PathStatus::nothing)
            fail("the file '" + name + "' in the folder " + folder_ + " (--files-in FOLDER names another folder)",
                 "no such file");
        return scenes::path_inside(folder_, name, file_, "strata:command");
    }

    std::string file_, folder_;
};

// A map of the options and their values, with the scene under the key "scene".
std::map<std::string, std::string> choices_of(const std::string& line) {
    const auto words = words_behind_strata(line);
    if (!words) return {};
    std::map<std::string, std::string> choices{{"scene", (*words)[1]}};
    for (std::size_t i = 2; i < words->size(); ++i) {
        const bool has_value = i + 1 < words->size() && !(*words)[i + 1].starts_with("--");
        choices[(*words)[i]] = has_value ? (*words)[i + 1] : "given";
        i += has_value ? 1 : 0;
    }
    return choices;
}

}  // namespace

std::vector<std::string> differences(const std::string& recorded, const std::string& here) {
    auto there = choices_of(recorded), ours = choices_of(here);
    if (there.empty()) return {};
    std::vector<std::string> found;
    for (const auto& [name, value] : there)
        if (const auto other = ours.find(name); other == ours.end() || other->second != value)
            if (name != "--size" && name != "--algorithm")
                found.push_back(name + " " + value + " (here: " + (other == ours.end() ? "none" : other->second) + ")");
    for (const auto& [name, value] : ours)
        if (!there.contains(name) && name != "--size") found.push_back("no " + name + " (here: " + value + ")");
    return found;
}

void warn_of_other_command(const std::string& file, const RunOptions& run, std::string_view command) {
    if (!file.ends_with(".png") && !file.ends_with(".exr")) return;
    const scenes::Attributes attributes = scenes::read_attributes(file);
    const auto recorded = attributes.find("command");
    if (recorded == attributes.end()) return;
    const auto found = differences(recorded->second, canonical_command("render", run, run.algorithms));
    if (found.empty()) return;
    say_warning(fmt::format("{}: made by a command with {}; give {} the same, or compare other pictures", file,
                            fmt::join(found, ", "), command));
}

std::string recorded_command(const std::string& file) {
    const scenes::Attributes attributes = scenes::read_attributes(file);
    const auto found = attributes.find("command");
    if (found == attributes.end())
        throw InputError(file, "strata:command", "a picture with the command that strata recorded in it",
                         "no such command");
    return found->second;
}

void expand_from(Words& words) {
    if (words.front() != "render" && words.front() != "layers") return;
    const std::string given_folder = take(words, files_in), file = take(words, from);
    if (file.empty()) {
        if (!given_folder.empty()) throw CLI::ValidationError(std::string(files_in) + " is valid only with --from");
        return;
    }
    const std::string own_folder = std::filesystem::path(file).parent_path().string();
    const std::string folder = !given_folder.empty() ? given_folder : own_folder.empty() ? "." : own_folder;
    Words chosen = Recorded{file, folder}.words_of(words.front());
    const auto is_given = [&](std::string_view option) {
        return std::ranges::any_of(words, [&](const std::string& word) {
            return word.starts_with(option) && (word.size() == option.size() || word[option.size()] == '=');
        });
    };
    std::erase_if(chosen, [&](const std::string& word) {
        const std::string name = word.substr(0, word.find('='));
        return word.starts_with("--") && (is_given(name) || (name == "--orbit" && is_given("--camera")) ||
                                          (name == "--camera" && is_given("--orbit")));
    });
    chosen.push_back(std::string(files_in) + "=" + folder);
    words.insert(words.begin() + 1, chosen.begin(), chosen.end());
}

void add_from_option(CLI::App& app, std::string& folder) {
    app.add_option_function<std::string>(
           std::string(from),
           [](const std::string& file) {
               throw CLI::ValidationError("--from", "expected a picture's name, found '" + file + "'");
           },
           "draw what this picture shows: the scene and the options of its command (strata info shows it), but for "
           "those given here; no output")
        ->type_name("FILE");
    add_path(app, folder,
             {std::string(files_in), "FOLDER",
              "where the scene, the profile and the camera are that --from names (default: the picture's folder)",
              "a folder"});
}

}  // namespace strata::tools
