// tools/oracle/explain/history_svg.cpp - a drawing of a pixel's fragments by depth, and of the fragments that each
// algorithm took.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "tools/oracle/explain/history_report.h"

namespace strata::oracle {

namespace {

constexpr int row_px = 26, column_px = 170, top_px = 40, swatch_px = 20;

std::string fill_of(const FragmentFact& f) {
    const auto byte = [&](std::size_t c) { return static_cast<int>(std::clamp(f.color[c], 0.0f, 1.0f) * 255 + 0.5f); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
}

std::string words(int x, int y, const std::string& text) {
    return fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n", x, y, text);
}

// Indices of the fragments near to far; ties in submission order.
std::vector<std::size_t> by_depth(const History& history) {
    std::vector<std::size_t> order(history.fragments.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t f) { return history.fragments[f].shader_z; });
    return order;
}

// "pass 2 near, pass 4 far": the passes in which an algorithm took a fragment.
std::string takings(const History& history, std::uint32_t primitive) {
    std::string text;
    for (const Line& line : history.lines) {
        if (line.kind != LineKind::taken) continue;
        const bool has = std::ranges::any_of(line.fragments, [&](int f) {
            return history.fragments[static_cast<std::size_t>(f)].primitive == primitive;
        });
        if (!has) continue;
        text += fmt::format("{}pass {} {}{}", text.empty() ? "" : ", ", line.pass,
                            line.side == pipeline::Side::back ? "far" : "near",
                            line.fragments.size() > 1 ? " (with others of its depth)" : "");
    }
    return text.empty() ? "-" : text;
}

}  // namespace

std::string to_svg(std::span<const History> histories) {
    if (histories.empty()) return "";
    const History& first = histories[0];
    const auto order = by_depth(first);
    const int width = 260 + column_px * static_cast<int>(histories.size()),
              height = top_px + row_px * static_cast<int>(order.size()) + 10;
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" font-family=\"monospace\" "
        "font-size=\"12\">\n",
        width, height);
    svg += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"white\"/>\n", width, height);
    svg += words(10, 24, fmt::format("pixel {},{}: near", first.x, first.y));
    for (std::size_t h = 0; h < histories.size(); ++h)
        svg += words(250 + column_px * static_cast<int>(h), 24, histories[h].algorithm);
    for (std::size_t row = 0; row < order.size(); ++row) {
        const FragmentFact& f = first.fragments[order[row]];
        const int y = top_px + row_px * static_cast<int>(row);
        svg += fmt::format(
            "<rect x=\"10\" y=\"{}\" width=\"40\" height=\"{}\" fill=\"{}\" fill-opacity=\"{:.3f}\" "
            "stroke=\"black\"/>\n",
            y, swatch_px, fill_of(f), std::clamp(f.color[3], 0.0f, 1.0f));
        svg += words(58, y + 14, fmt::format("#{} z {:.7f}", order[row], f.shader_z));
        for (std::size_t h = 0; h < histories.size(); ++h)
            svg += words(250 + column_px * static_cast<int>(h), y + 14, takings(histories[h], f.primitive));
    }
    return svg + "</svg>\n";
}

}  // namespace strata::oracle
