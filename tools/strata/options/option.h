// tools/strata/options/option.h - declares an option next to the variable that it fills. Its error names the option,
// the expected value and the value that was found.
#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/request/names.h"
#include "tools/request/parse.h"
#include "tools/request/words.h"

namespace strata::tools {

// The texts of an option, for --help and for its error.
struct OptionText {
    std::string name;  // --size
    std::string type;  // WIDTHxHEIGHT
    std::string help;
    std::string expected;  // follows "expected" in the error message
};

// Adds an option. `parse` returns an empty optional for an invalid text.
template <class T, class Parse>
CLI::Option* add_option(CLI::App& app, T& target, const OptionText& text, Parse parse) {
    const auto fill = [&target, text, parse](const std::string& given) {
        const auto value = parse(std::string_view(given));
        if (!value) throw CLI::ValidationError(text.name, "expected " + text.expected + ", found '" + given + "'");
        target = *value;
    };
    return app.add_option_function<std::string>(text.name, fill, text.help)->type_name(text.type);
}

// Adds an option for the name of a file or other external object; it must not be empty. Messages use the long name only
// if there is no short one.
inline CLI::Option* add_path(CLI::App& app, std::string& target, const OptionText& text) {
    OptionText named = text;
    named.name = text.name.substr(0, text.name.find(','));
    const auto fill = [&target, named](const std::string& given) {
        if (given.empty()) throw CLI::ValidationError(named.name + " needs " + named.expected);
        target = given;
    };
    return app.add_option_function<std::string>(text.name, fill, text.help)->type_name(text.type);
}

// Parses words separated by commas that must be among `choices`, without repetition. `all` means `everything` unless it
// is itself a choice.
template <class T>
[[nodiscard]] std::vector<T> to_choices(const std::string& name, const std::string& text,
                                        const std::vector<Choice<T>>& choices, const std::vector<T>& everything) {
    std::vector<T> chosen;
    const auto add = [&](const T& value) {
        if (std::find(chosen.begin(), chosen.end(), value) == chosen.end()) chosen.push_back(value);
    };
    for (const std::string& word : split(text, ',')) {
        if (const auto choice = to_choice(choices, word)) {
            add(*choice);
        } else if (word == "all") {
            std::for_each(everything.begin(), everything.end(), add);
        } else {
            auto names = names_of(choices);
            names.emplace_back("all");
            throw CLI::ValidationError(name, "expected " + one_of(names) + ", found " + found_but_near(word, names));
        }
    }
    return chosen;
}

// Adds an option whose value is a list of some of a few names.
template <class T>
CLI::Option* add_choices(CLI::App& app, std::vector<T>& target, const std::string& name,
                         const std::vector<Choice<T>>& choices, const std::vector<T>& everything,
                         const std::string& help) {
    const auto fill = [&target, name, choices, everything](const std::string& given) {
        target = to_choices(name, given, choices, everything);
    };
    return app.add_option_function<std::string>(name, fill, help)->type_name("NAME[,NAME...]|all");
}

// Adds an option whose value is one of a few names. `Target` is T or a type that a T can be assigned to.
template <class Target, class T>
CLI::Option* add_choice(CLI::App& app, Target& target, const std::string& name, const std::vector<Choice<T>>& choices,
                        const std::string& help) {
    const auto fill = [&target, name, choices](const std::string& given) {
        const auto choice = to_choice(choices, given);
        const auto names = names_of(choices);
        if (!choice)
            throw CLI::ValidationError(name, "expected " + one_of(names) + ", found " + found_but_near(given, names));
        target = *choice;
    };
    std::string type;
    for (const auto& choice : choices) type += (type.empty() ? "" : "|") + choice.name;
    return app.add_option_function<std::string>(name, fill, help)->type_name(type);
}

}  // namespace strata::tools
