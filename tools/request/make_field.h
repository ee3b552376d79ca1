// tools/request/make_field.h - makes the entries of the table of options (option_fields.h) from a member of the
// request, named by the path to it: choice<&PictureRequest::render, &RenderOptions::depth>(...).
#pragma once
#include <fmt/format.h>

#include <utility>

#include "tools/request/names.h"
#include "tools/request/option_fields.h"
#include "tools/request/parse.h"
#include "tools/request/words.h"

namespace strata::tools {

// The names of an option, and the texts of its help and its error.
struct FieldText {
    std::string name, type, help, expected{};
};

// The member at the end of a path of members.
template <auto member, auto... further>
[[nodiscard]] auto& at(auto& object) {
    if constexpr (sizeof...(further) == 0)
        return object.*member;
    else
        return at<further...>(object.*member);
}

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

// An option of several members.
[[nodiscard]] inline OptionField joint(OptionGroup group, const FieldText& text,
                                       std::function<bool(PictureRequest&, std::string_view)> set,
                                       std::function<std::string(const PictureRequest&)> write,
                                       std::function<void(PictureRequest&, const PictureRequest&)> copy) {
    OptionField made{
        .name = text.name, .group = group, .type = text.type, .help = text.help, .expected = text.expected};
    made.set = std::move(set);
    made.text = std::move(write);
    made.copy = std::move(copy);
    return made;
}

// An option whose text `read` converts to an optional value, and whose value `write` converts to text.
template <auto... path, class Read, class Write>
[[nodiscard]] OptionField field(OptionGroup group, const FieldText& text, Read read, Write write) {
    const auto set = [read](PictureRequest& request, std::string_view given) {
        const auto value = read(given);
        if (value) at<path...>(request) = *value;
        return value.has_value();
    };
    const auto written = [write](const PictureRequest& request) -> std::string {
        const auto& value = at<path...>(request);
        if constexpr (is_optional<std::remove_cvref_t<decltype(value)>>)
            return value ? write(*value) : "";
        else
            return write(value);
    };
    return joint(group, text, set, written,
                 [](PictureRequest& to, const PictureRequest& from) { at<path...>(to) = at<path...>(from); });
}

// A number, written in the shortest decimals that read back.
template <auto... path, class Read>
[[nodiscard]] OptionField number(OptionGroup group, const FieldText& text, Read read) {
    return field<path...>(group, text, read, [](auto value) { return fmt::format("{}", value); });
}

// One of a few words.
template <auto... path, class T>
[[nodiscard]] OptionField choice(OptionGroup group, const std::string& name, const std::vector<Choice<T>>& choices,
                                 const std::string& help) {
    const std::vector<std::string> words = names_of(choices);
    OptionField made = field<path...>(
        group, {name, fmt::format("{}", fmt::join(words, "|")), help, one_of(words)},
        [choices](std::string_view given) { return to_choice(choices, given); },
        [choices](const T& value) { return name_of(choices, value); });
    made.words = words;
    return made;
}

template <auto... path>
[[nodiscard]] OptionField flag(OptionGroup group, const std::string& name, const std::string& help) {
    OptionField made = field<path...>(
        group, {name, "", help, "true or false"},
        [](std::string_view given) {
            return given == "true" ? std::optional{true} : given == "false" ? std::optional{false} : std::nullopt;
        },
        [](bool value) -> std::string { return value ? "true" : "false"; });
    made.is_flag = true;
    return made;
}

// An option that only these algorithms read.
[[nodiscard]] inline OptionField read_by(std::vector<std::string> algorithms, OptionField field) {
    field.readers = std::move(algorithms);
    return field;
}
[[nodiscard]] inline OptionField read_if(bool (*is_read_by)(const peeling::Algorithm&), OptionField field) {
    field.is_read_by = is_read_by;
    return field;
}

// An option that many people need.
[[nodiscard]] inline OptionField usual(OptionField field) {
    field.is_usual = true;
    return field;
}

}  // namespace strata::tools
