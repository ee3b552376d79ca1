// tools/strata/options/option.h - one option: declared beside the variable it fills; an error names the option, what
// was wanted and what was found.
#pragma once
#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/strata/options/names.h"
#include "tools/strata/options/parse.h"

namespace strata::tools {

// The words of an option, for --help and for its error.
struct OptionText {
    std::string name;  // --size
    std::string type;  // WIDTHxHEIGHT
    std::string help;
    std::string expected;  // what a sentence says after "expected"
};

// `parse` answers nothing for a text that it cannot use.
template <class T, class Parse>
CLI::Option* add_option(CLI::App& app, T& target, const OptionText& text, Parse parse) {
    const auto fill = [&target, text, parse](const std::string& given) {
        const auto value = parse(std::string_view(given));
        if (!value) throw CLI::ValidationError(text.name, "expected " + text.expected + ", found '" + given + "'");
        target = *value;
    };
    return app.add_option_function<std::string>(text.name, fill, text.help)->type_name(text.type);
}

// A name of something outside, which is never empty. A long name is what messages call the option unless it has a
// short one.
inline CLI::Option* add_path(CLI::App& app, std::string& target, const OptionText& text) {
    OptionText named = text;
    named.name = text.name.substr(0, text.name.find(','));
    const auto fill = [&target, named](const std::string& given) {
        if (given.empty()) throw CLI::ValidationError(named.name + " needs " + named.expected);
        target = given;
    };
    return app.add_option_function<std::string>(text.name, fill, text.help)->type_name(text.type);
}

// A word and the value that it means.
template <class T>
struct Choice {
    std::string name;
    T value;
};

template <class T>
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Choice<T>>& choices) {
    std::vector<std::string> names;
    for (const auto& choice : choices) names.push_back(choice.name);
    return names;
}

// Empty for a value that is not in the list.
template <class T>
[[nodiscard]] std::string name_of(const std::vector<Choice<T>>& choices, const T& value) {
    for (const auto& choice : choices) {
        if (choice.value == value) return choice.name;
    }
    return "";
}

template <class T>
[[nodiscard]] std::optional<T> to_choice(const std::vector<Choice<T>>& choices, std::string_view name) {
    for (const auto& choice : choices) {
        if (choice.name == name) return choice.value;
    }
    return std::nullopt;
}

// Of the words with commas between, those in `choices`, none twice; `all` stands for `everything` unless it is one of
// them.
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

// An option that takes some of a few names.
template <class T>
CLI::Option* add_choices(CLI::App& app, std::vector<T>& target, const std::string& name,
                         const std::vector<Choice<T>>& choices, const std::vector<T>& everything,
                         const std::string& help) {
    const auto fill = [&target, name, choices, everything](const std::string& given) {
        target = to_choices(name, given, choices, everything);
    };
    return app.add_option_function<std::string>(name, fill, help)->type_name("NAME[,NAME...]|all");
}

// An option that takes one of a few names. `Target` is T or something that T can be assigned to.
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
