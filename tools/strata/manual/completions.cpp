// tools/strata/manual/completions.cpp - writes the bash completion of all commands, options and values, from CLI11's
// description of them.
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "peeling/registry.h"
#include "pipeline/device/profile.h"
#include "scenes/scene.h"
#include "tools/strata/manual/manual.h"

namespace strata::tools {

namespace {

std::string joined(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

// Escapes text for single quotes of a shell.
std::string in_quotes(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const scenes::ProceduralScene& scene : scenes::procedural_scenes()) names.push_back(scene.name);
    return names;
}

std::vector<const CLI::Option*> typed_options(CLI::App& command) {
    std::vector<const CLI::Option*> options;
    for (const CLI::Option* option : command.get_options())
        if (!option->get_positional()) options.push_back(option);
    return options;
}

std::vector<std::string> command_names(CLI::App& root) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(root)) names.push_back(command->get_name());
    return names;
}

bool takes_scene(CLI::App& command) {
    const auto options = command.get_options();
    return std::any_of(options.begin(), options.end(), [](const CLI::Option* option) {
        return option->get_positional() && option->get_name(true).starts_with("SCENE");
    });
}

}  // namespace

// The values of an option: the words of a list type, as add_choice writes it, or the names of a registry.
std::vector<std::string> values_of(const CLI::Option& option) {
    std::vector<std::string> words;
    if (option.check_lname("algorithm")) {
        for (const peeling::Algorithm& algorithm : peeling::algorithms()) words.push_back(algorithm.name);
        words.emplace_back("all");
        return words;
    }
    if (option.check_lname("profile")) {
        for (const pipeline::DeviceProfile& profile : pipeline::builtin_profiles()) words.push_back(profile.name);
        return words;
    }
    const std::string type = option.get_type_name();
    if (type.find('|') == type.npos) return {};
    std::istringstream rest{type};
    for (std::string word; std::getline(rest, word, '|');) {
        const bool is_word = std::all_of(word.begin(), word.end(), [](char c) {
            return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
        });
        if (is_word && word != "-") words.push_back(word);  // FILE, ratio:R and similar types are placeholders
    }
    return words;
}

// One case per command: its options, and the values of each option that has a list of them.
std::string completions(CLI::App& root) {
    std::string text =
        "# bash completion of strata, made by: strata completions\n_strata() {\n"
        "    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
        "    if [ \"$COMP_CWORD\" = 1 ]; then\n"
        "        COMPREPLY=($(compgen -W " +
        in_quotes(joined(command_names(root))) +
        " -- \"$word\"))\n"
        "        return\n    fi\n    case ${COMP_WORDS[1]} in\n";
    for (CLI::App* command : commands_of(root)) {
        std::vector<std::string> names;
        std::string values;
        for (const CLI::Option* option : typed_options(*command)) {
            names.push_back(typed_name(*option));
            const auto words = values_of(*option);
            if (!words.empty())
                values += "                " + names.back() + ") words=" + in_quotes(joined(words)) + " ;;\n";
        }
        text += "        " + command->get_name() + ")\n            case $before in\n" + values +
                "                *) if [[ $word == -* ]]; then words=" + in_quotes(joined(names)) + "; " +
                (takes_scene(*command) ? "else words=" + in_quotes(joined(scene_names())) + "; " : "") +
                "fi ;;\n            esac ;;\n";
    }
    return text +
           "    esac\n    COMPREPLY=($(compgen -W \"$words\" -- \"$word\") $([[ $word == -* ]] || compgen -f -- "
           "\"$word\"))\n}\n"
           "complete -o filenames -F _strata strata\n";
}

}  // namespace strata::tools
