// tools/oracle/picture/other_size.cpp - decides how a picture of another size relates to the reference, by the pixels
// that agree under each relation (other_size.h).
#include "tools/oracle/picture/other_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace strata::oracle {

namespace {

struct Position {
    int x = 0, y = 0;
};

std::size_t index(const TargetImage& target, Position at) noexcept {
    return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(target.width) + static_cast<std::size_t>(at.x);
}

bool agree(const TargetImage& a, Position at_a, const TargetImage& b, Position at_b) {
    constexpr double one_code = 1.0 / 255;
    const std::size_t i = index(a, at_a), j = index(b, at_b);
    const int channels = std::min({a.channels, b.channels, 3});
    for (int c = 0; c < channels; ++c)
        if (std::fabs(a.value_at(i, c) - b.value_at(j, c)) > one_code + 1e-9) return false;
    return true;
}

// The pixels of a width x height corner of `a` that agree with their partner in `b`.
std::uint64_t agreeing(const TargetImage& a, int width, int height, const TargetImage& b,
                       const std::function<Position(Position)>& partner) {
    std::uint64_t pixels = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) pixels += agree(a, {x, y}, b, partner({x, y})) ? 1 : 0;
    return pixels;
}

bool is_scaled(const TargetImage& small, const TargetImage& large, int by) {
    return large.width == by * small.width && large.height == by * small.height &&
           agreeing(large, large.width, large.height, small, [by](Position at) {
               return Position{at.x / by, at.y / by};
           }) == large.pixels();
}

// Every pixel of the small one is one of the square that it stands for: a picture is made smaller in several ways.
bool is_reduced(const TargetImage& small, const TargetImage& large, int by) {
    if (large.width != by * small.width || large.height != by * small.height) return false;
    for (int first = 0; first < by; ++first)
        if (agreeing(small, small.width, small.height, large, [by, first](Position at) {
                return Position{at.x * by + first, at.y * by + first};
            }) == small.pixels())
            return true;
    return false;
}

std::string turned(const TargetImage& reference, const TargetImage& candidate) {
    if (candidate.width != reference.height || candidate.height != reference.width) return "";
    const int right = reference.width - 1, low = reference.height - 1;
    const auto is_by = [&](const std::function<Position(Position)>& partner) {
        return agreeing(candidate, candidate.width, candidate.height, reference, partner) == candidate.pixels();
    };
    if (is_by([](Position at) { return Position{at.y, at.x}; })) return "the reference transposed";
    if (is_by([&](Position at) { return Position{at.y, low - at.x}; }))
        return "the reference turned right by 90 degrees";
    if (is_by([&](Position at) { return Position{right - at.y, at.x}; }))
        return "the reference turned left by 90 degrees";
    return "";
}

// Up to 32 pixels of the rarest colours among some thousand: few other places have them.
std::vector<Position> rare_pixels(const TargetImage& target) {
    constexpr int most_a_side = 64;
    constexpr std::size_t most = 32;
    const int step_x = (target.width + most_a_side - 1) / most_a_side;
    const int step_y = (target.height + most_a_side - 1) / most_a_side;
    const auto channels = static_cast<std::size_t>(target.channels);
    std::map<std::vector<std::uint32_t>, std::vector<Position>> by_color;
    for (int y = 0; y < target.height; y += step_y)
        for (int x = 0; x < target.width; x += step_x) {
            const auto first = target.codes.begin() + static_cast<std::ptrdiff_t>(index(target, {x, y}) * channels);
            by_color[{first, first + target.channels}].push_back({x, y});
        }
    std::vector<std::vector<Position>> groups;
    for (auto& [color, places] : by_color) groups.push_back(std::move(places));
    std::ranges::stable_sort(groups, {}, [](const std::vector<Position>& places) { return places.size(); });
    std::vector<Position> rare;
    for (const std::vector<Position>& places : groups)
        for (const Position place : places)
            if (rare.size() < most) rare.push_back(place);
    return rare;
}

bool lies_at(const TargetImage& whole, Position offset, const TargetImage& part) {
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            if (!agree(part, {x, y}, whole, {x + offset.x, y + offset.y})) return false;
    return true;
}

// Where the part lies in the whole.
std::optional<Position> place_in(const TargetImage& whole, const TargetImage& part) {
    if (part.width > whole.width || part.height > whole.height) return std::nullopt;
    const std::vector<Position> rare = rare_pixels(part);
    int tries = 64;
    for (int y = 0; y <= whole.height - part.height; ++y)
        for (int x = 0; x <= whole.width - part.width; ++x) {
            const bool is_likely = std::ranges::all_of(rare, [&](Position at) {
                return agree(part, at, whole, {at.x + x, at.y + y});
            });
            if (!is_likely) continue;
            if (lies_at(whole, {x, y}, part)) return Position{x, y};
            if (--tries == 0) return std::nullopt;
        }
    return std::nullopt;
}

std::string cut(const TargetImage& reference, const TargetImage& candidate) {
    if (const auto at = place_in(reference, candidate); at && (at->x > 0 || at->y > 0))
        return fmt::format("cut from the reference at {},{}", at->x, at->y);
    if (const auto at = place_in(candidate, reference); at && (at->x > 0 || at->y > 0))
        return fmt::format("the reference with a border: it begins at {},{}", at->x, at->y);
    return "";
}

std::string overlap(const TargetImage& reference, const TargetImage& candidate) {
    const int width = std::min(reference.width, candidate.width), height = std::min(reference.height, candidate.height);
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    const std::uint64_t equal = agreeing(reference, width, height, candidate, [](Position at) { return at; });
    if (equal == pixels) return "equal where both overlap, from the upper left corner";
    return fmt::format("equal at {} of the {} pixels where both overlap, from the upper left corner", equal, pixels);
}

std::string relation(const TargetImage& reference, const TargetImage& candidate) {
    for (const int by : {2, 3, 4}) {
        if (is_scaled(reference, candidate, by)) return fmt::format("the reference scaled by {}", by);
        if (is_reduced(candidate, reference, by)) return fmt::format("the reference scaled by 1/{}", by);
    }
    if (std::string other = turned(reference, candidate); !other.empty()) return other;
    if (std::string other = cut(reference, candidate); !other.empty()) return other;
    return overlap(reference, candidate);
}

}  // namespace

std::string size_in_words(const TargetImage& reference, const TargetImage& candidate) {
    return fmt::format("{}x{}, {}", candidate.width, candidate.height, relation(reference, candidate));
}

}  // namespace strata::oracle
