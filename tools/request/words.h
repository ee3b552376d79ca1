// tools/request/words.h - options whose values are words.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace strata::tools {

// A word and its value.
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

// The word of a value; empty if the value is not in the list.
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

}  // namespace strata::tools
