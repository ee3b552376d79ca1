#include "scenes/models/obj_centre.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "scenes/far_places.h"

namespace strata::scenes {
namespace {

// The three coordinates of a line "v X Y Z ...", and where they end in it.
struct VertexLine {
    Vec3d at;
    std::size_t end;
};

std::optional<VertexLine> vertex_of(std::string_view line) {
    std::size_t next = line.find_first_not_of(" \t");
    if (next == line.npos || line[next] != 'v' || next + 1 >= line.size()) return std::nullopt;
    if (line[++next] != ' ' && line[next] != '\t') return std::nullopt;
    VertexLine vertex{};
    for (std::size_t i = 0; i < 3; ++i) {
        next = line.find_first_not_of(" \t", next);
        if (next == line.npos) return std::nullopt;
        if (line[next] == '+') ++next;
        const char* const end = line.data() + line.size();
        const auto [rest, failure] = std::from_chars(line.data() + next, end, vertex.at[i]);
        if (failure != std::errc{} || !std::isfinite(vertex.at[i])) return std::nullopt;
        next = static_cast<std::size_t>(rest - line.data());
    }
    vertex.end = next;
    return vertex;
}

// Calls take(line) for each line, without its end.
void for_each_line(std::string_view text, const auto& take) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        take(text.substr(begin, end - begin));
        begin = end + 1;
    }
}

// Empty if the model is near enough to the origin.
std::optional<Vec3d> far_middle(std::string_view text) {
    Vec3d lo{INFINITY, INFINITY, INFINITY}, hi{-INFINITY, -INFINITY, -INFINITY};
    for_each_line(text, [&](std::string_view line) {
        if (const auto vertex = vertex_of(line))
            for (std::size_t i = 0; i < 3; ++i)
                lo[i] = std::min(lo[i], vertex->at[i]), hi[i] = std::max(hi[i], vertex->at[i]);
    });
    double size = 0, place = 0;
    Vec3d middle{};
    for (std::size_t i = 0; i < 3; ++i) {
        size = std::max(size, hi[i] - lo[i]);
        place = std::max({place, std::abs(lo[i]), std::abs(hi[i])});
        middle[i] = std::round((lo[i] + hi[i]) / 2);
    }
    if (!(size > 0) || place > 1e30 || step_at(place) * 0x1p16 <= size) return std::nullopt;
    return middle;
}

}  // namespace

Vec3d move_obj_to_origin(std::string& text) {
    const std::optional<Vec3d> middle = far_middle(text);
    if (!middle) return {0, 0, 0};
    std::string moved;
    moved.reserve(text.size());
    for_each_line(text, [&](std::string_view line) {
        const auto vertex = vertex_of(line);
        if (vertex)
            moved += fmt::format("v {} {} {}", vertex->at[0] - (*middle)[0], vertex->at[1] - (*middle)[1],
                                 vertex->at[2] - (*middle)[2]);
        moved += vertex ? line.substr(vertex->end) : line;
        moved += '\n';
    });
    text = std::move(moved);
    return *middle;
}

}  // namespace strata::scenes
