// scenes/procedural/parameters.cpp - splits the text into keys and values; numbers and choices are parsed when a scene
// requests them. All errors are found before the scene is built.
#include "scenes/procedural/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "rasterizer/base/input_error.h"
#include "scenes/nearest_name.h"

namespace strata::scenes {

std::string scene_name(const std::string& spec) { return spec.substr(0, spec.find(':')); }

Parameters::Parameters(std::string spec, std::span<const std::string_view> keys) : spec_{std::move(spec)} {
    const std::size_t colon = spec_.find(':');
    // A bare name uses all defaults.
    if (colon == std::string::npos) return;
    std::string_view rest = std::string_view{spec_}.substr(colon + 1);
    // One item per iteration, up to the next comma or the end. "name:" has one empty item, and "name:a=1," ends with
    // one: both lack an equals sign and are rejected.
    while (true) {
        const std::string_view item = rest.substr(0, rest.find(','));
        const std::size_t equals = item.find('=');
        if (equals == std::string_view::npos)
            throw InputError(spec_, "parameters", "key=value", fmt::format("'{}'", item));
        const std::string_view key = item.substr(0, equals);
        if (std::ranges::find(keys, key) == keys.end()) {
            throw InputError(spec_, "parameters", fmt::format("one of {}", fmt::join(keys, ", ")),
                             quoted_with_suggestion(key, keys));
        }
        // With a repeated key the result would depend on which of them is used.
        if (find(key) != nullptr) throw InputError(spec_, std::string{key}, "one value", "two");
        // The value may contain further equals signs; it is compared or parsed as a whole later.
        values_.emplace_back(key, item.substr(equals + 1));
        // The last item has no comma after it.
        if (item.size() == rest.size()) return;
        rest.remove_prefix(item.size() + 1);
    }
}

const std::string* Parameters::find(std::string_view key) const {
    const auto found = std::ranges::find(values_, key, &std::pair<std::string, std::string>::first);
    return found == values_.end() ? nullptr : &found->second;
}

std::uint64_t Parameters::integer(std::string_view key, std::uint64_t low, std::uint64_t high,
                                  std::uint64_t absent) const {
    const std::string* text = find(key);
    if (text == nullptr) return absent;
    std::uint64_t value = 0;
    const char* const last = text->data() + text->size();
    // std::from_chars accepts no sign, whitespace or locale; a number too large for 64 bits is an error, like a letter
    // after the digits.
    const auto [end, error] = std::from_chars(text->data(), last, value);
    if (error == std::errc{} && end == last && value >= low && value <= high) return value;
    throw InputError(spec_, std::string{key}, fmt::format("a whole number from {} to {}", low, high),
                     fmt::format("'{}'", *text));
}

std::size_t Parameters::choice(std::string_view key, std::span<const std::string_view> choices) const {
    const std::string* text = find(key);
    if (text == nullptr) return 0;
    const auto found = std::ranges::find(choices, *text);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
    throw InputError(spec_, std::string{key}, fmt::format("one of {}", fmt::join(choices, ", ")),
                     quoted_with_suggestion(*text, choices));
}

}  // namespace strata::scenes
