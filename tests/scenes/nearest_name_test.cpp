// Tests name suggestions against the edit distance as a recursion over the last letters, by its definition.
#include "scenes/nearest_name.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

namespace {

using strata::scenes::nearest_name;
using strata::scenes::quoted_with_suggestion;
using Words = std::vector<std::string>;

std::size_t letters_apart(std::string_view a, std::string_view b) {
    if (a.empty() || b.empty()) return a.size() + b.size();
    const auto without = [](std::string_view s, std::size_t n) { return s.substr(0, s.size() - n); };
    std::size_t least = 1 + std::min(letters_apart(without(a, 1), b), letters_apart(a, without(b, 1)));
    least = std::min(least, letters_apart(without(a, 1), without(b, 1)) + (a.back() == b.back() ? 0u : 1u));
    if (a.size() > 1 && b.size() > 1 && a.back() == b[b.size() - 2] && b.back() == a[a.size() - 2])
        least = std::min(least, 1 + letters_apart(without(a, 2), without(b, 2)));
    return least;
}

// All words of up to `longest` letters from "abc".
Words words_of_abc(std::size_t longest) {
    Words words{""};
    for (std::size_t first = 0, length = 1; length <= longest; ++length) {
        const std::size_t last = words.size();
        for (; first < last; ++first)
            for (const char letter : {'a', 'b', 'c'}) words.push_back(words[first] + letter);
    }
    return words;
}

std::string_view nearest(std::string_view name, const Words& candidates) {
    const std::vector<std::string_view> views(candidates.begin(), candidates.end());
    const std::string_view found = nearest_name(name, views);
    for (const std::string& candidate : candidates)
        if (candidate == found) return candidate;
    return "";
}

}  // namespace

TEST_CASE("a name is near if at most a third of its letters differ or one of two for any pair of words") {
    // A common ending does not change the distance but raises the limit, so the exact distance is tested.
    std::string wrong;
    const Words words = words_of_abc(3);
    REQUIRE(words.size() == 40);
    for (const std::string& a : words)
        for (const std::string& b : words)
            for (std::size_t more = 0; more <= 7; ++more) {
                const std::string ending(more, 'x'), candidate = b + ending;
                const std::size_t apart = letters_apart(a, b);
                const bool is_near = 3 * apart <= candidate.size() || (candidate.size() == 2 && apart == 1);
                const bool found = !nearest_name(a + ending, std::vector<std::string_view>{candidate}).empty();
                if (found != (is_near && !candidate.empty()) && wrong.empty())
                    wrong.append(a).append(ending).append(" for ").append(candidate);
            }
    CHECK(wrong == "");
}

TEST_CASE("two exchanged neighbouring letters are one change unless another letter is between them") {
    CHECK(nearest("ab", {"ba"}) == "ba");
    CHECK(nearest("ca", {"abc"}) == "");  // distance 3: a letter inserted between exchanged ones counts separately
    CHECK(nearest("retapot", {"teapot"}) == "teapot");
    CHECK(nearest("litreal", {"literal"}) == "literal");
}

TEST_CASE("of several near names the nearest is suggested and of equally near ones the first") {
    const Words words = words_of_abc(3);
    std::string wrong;
    for (const std::string& name : words)
        for (std::size_t first = 1; first + 4 <= words.size(); first += 3) {
            Words list(words.begin() + static_cast<std::ptrdiff_t>(first),
                       words.begin() + static_cast<std::ptrdiff_t>(first + 4));
            for (int turn = 0; turn < 4; ++turn) {
                std::rotate(list.begin(), list.begin() + 1, list.end());
                std::size_t least = 99;
                std::string expected;
                for (const std::string& candidate : list) {
                    const std::size_t distance = letters_apart(name, candidate);
                    const bool is_near = 3 * distance <= candidate.size() || (candidate.size() == 2 && distance == 1);
                    if (candidate.empty() || !is_near || distance >= least) continue;
                    least = distance;
                    expected = candidate;
                }
                if (nearest(name, list) != expected && wrong.empty()) wrong = "'" + name + "' among " + list[0];
            }
        }
    CHECK(wrong == "");
    CHECK(nearest("", words) == "");
    CHECK(nearest("abc", {}) == "");
}

TEST_CASE("only the first 64 letters of a word are compared and quoted") {
    const std::string long_name(64, 'n'), longer = long_name + std::string(1000, 'm');
    CHECK(nearest(longer, {long_name}) == long_name);
    CHECK(nearest(std::string(63, 'n') + "o", {long_name}) == long_name);
    const std::vector<std::string_view> none;
    CHECK(quoted_with_suggestion(longer, none) == "'" + long_name + "'");
    CHECK(quoted_with_suggestion(longer, std::vector<std::string_view>{long_name}) ==
          "'" + long_name + "' (did you mean '" + long_name + "'?)");
}

TEST_CASE("a suggestion is a question after the quoted name") {
    const std::vector<std::string_view> names{"near", "far"};
    CHECK(quoted_with_suggestion("nera", names) == "'nera' (did you mean 'near'?)");
    CHECK(quoted_with_suggestion("middle", names) == "'middle'");
    CHECK(quoted_with_suggestion("", names) == "''");
}
