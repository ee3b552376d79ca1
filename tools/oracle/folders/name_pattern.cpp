// tools/oracle/folders/name_pattern.cpp - finds the name in a path by the parts of a pattern before and after it
// (name_pattern.h).
#include "tools/oracle/folders/name_pattern.h"

#include <algorithm>

namespace strata::oracle {

namespace {

constexpr std::string_view placeholder = "{name}";

// True if the text with stars fits all of `path`: the last star takes one character more whenever the rest fails.
bool fits(std::string_view path, std::string_view stars) {
    std::size_t at = 0, in_stars = 0, taken = 0;
    std::size_t star = std::string_view::npos;
    while (at < path.size()) {
        if (in_stars < stars.size() && stars[in_stars] == '*') {
            star = in_stars++;
            taken = at;
        } else if (in_stars < stars.size() && stars[in_stars] == path[at]) {
            ++in_stars;
            ++at;
        } else if (star != std::string_view::npos && path[taken] != '/') {
            at = ++taken;
            in_stars = star + 1;
        } else {
            return false;
        }
    }
    return stars.find_first_not_of('*', in_stars) == std::string_view::npos;
}

bool has_star(std::string_view text) { return text.find('*') != std::string_view::npos; }

}  // namespace

std::optional<NamePattern> name_pattern(std::string_view text) {
    const std::size_t at = text.find(placeholder);
    if (at == std::string_view::npos) return std::nullopt;
    const std::string_view after = text.substr(at + placeholder.size());
    if (after.find(placeholder) != std::string_view::npos) return std::nullopt;
    return NamePattern{std::string(text.substr(0, at)), std::string(after)};
}

std::optional<std::vector<NamePattern>> name_patterns(std::string_view text) {
    std::vector<NamePattern> patterns;
    for (bool is_last = false; !is_last;) {
        const std::size_t comma = text.find(',');
        const auto pattern = name_pattern(text.substr(0, comma));
        if (!pattern) return std::nullopt;
        patterns.push_back(*pattern);
        is_last = comma == std::string_view::npos;
        text.remove_prefix(is_last ? text.size() : comma + 1);
    }
    return patterns;
}

std::optional<std::string> name_in(std::string_view path, const NamePattern& pattern) {
    if (path.size() <= pattern.before.size() && !has_star(pattern.before)) return std::nullopt;
    // Without a star a part of the pattern has only one place.
    const std::size_t last_begin = has_star(pattern.before) ? path.size() : pattern.before.size();
    for (std::size_t begin = has_star(pattern.before) ? 0 : last_begin; begin <= last_begin; ++begin) {
        if (!fits(path.substr(0, begin), pattern.before)) continue;
        const std::size_t first_end =
            has_star(pattern.after) ? begin + 1 : path.size() - std::min(path.size(), pattern.after.size());
        for (std::size_t end = has_star(pattern.after) ? path.size() : first_end; end >= first_end && end > begin;
             --end)
            if (fits(path.substr(end), pattern.after)) return std::string(path.substr(begin, end - begin));
    }
    return std::nullopt;
}

}  // namespace strata::oracle
