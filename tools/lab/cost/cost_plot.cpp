// tools/lab/cost/cost_plot.cpp - plots the frontier as SVG: error over time, both logarithmic.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/printable.h"
#include "tools/lab/cost/cost_report.h"
#include "tools/strata/report/svg_style.h"

namespace strata::tools {

namespace {

constexpr double plot_left = 70, plot_right = 620, plot_top = 40, plot_bottom = 420;

// A logarithmic axis over whole powers of ten that include all values, on pixels `from` to `to`.
struct PowerAxis {
    int low, high;  // exponents
    double from, to;

    [[nodiscard]] double at(double value) const {
        const double power = std::clamp(std::log10(std::max(value, 1e-300)), double(low), double(high));
        return from + (to - from) * (power - low) / (high - low);
    }
};

template <class Coordinate>
[[nodiscard]] PowerAxis power_axis(const std::vector<CostPoint>& points, Coordinate coordinate, double from,
                                   double to) {
    double least = HUGE_VAL, greatest = 0;
    for (const CostPoint& p : points)
        if (const double v = coordinate(p); v > 0) {
            least = std::min(least, v);
            greatest = std::max(greatest, v);
        }
    if (greatest == 0) least = greatest = 1;
    const int low = static_cast<int>(std::floor(std::log10(least) + 1e-9));
    return {low, std::max(low + 1, static_cast<int>(std::ceil(std::log10(greatest) - 1e-9))), from, to};
}

[[nodiscard]] std::string power_of_ten(int exponent) {
    if (exponent >= -2 && exponent <= 3) return fmt::format("{:.6g}", std::pow(10.0, exponent));
    return fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{}</tspan>", exponent);
}

[[nodiscard]] std::string words(double x, double y, const char* anchor, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, text);
}

[[nodiscard]] std::string grid(const PowerAxis& x, const PowerAxis& y) {
    std::string svg;
    for (int e = x.low; e <= x.high; ++e) {
        const double at = x.at(std::pow(10.0, e));
        svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\" stroke=\"#ddd\"/>\n", at, plot_top, plot_bottom) +
               words(at, plot_bottom + 16, "middle", power_of_ten(e));
    }
    for (int e = y.low; e <= y.high; ++e) {
        const double at = y.at(std::pow(10.0, e));
        svg += fmt::format("<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\" stroke=\"#ddd\"/>\n", plot_left, at, plot_right) +
               words(plot_left - 6, at + 4, "end", power_of_ten(e));
    }
    return svg;
}

}  // namespace

std::string frontier_svg(const std::vector<CostPoint>& points, const std::string& title,
                         const std::string& time_label) {
    const PowerAxis x = power_axis(
        points, [](const CostPoint& p) { return p.time; }, plot_left, plot_right);
    const PowerAxis y = power_axis(
        points, [](const CostPoint& p) { return p.error; }, plot_bottom, plot_top);
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"960\" height=\"470\" font-family=\"sans-serif\" "
        "font-size=\"12\">\n" +
        std::string(svg_dark_style) + "<rect width=\"960\" height=\"470\" fill=\"#fff\"/>\n" +
        words(plot_left + 40, 20, "start", scenes::markup_text(title)) + grid(x, y) +
        words((plot_left + plot_right) / 2, plot_bottom + 36, "middle", time_label) +
        words(8, 20, "start", "RMSE / 255");
    for (const CostPoint& p : points)
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"#999\"><title>{}</title></circle>\n",
                           x.at(p.time), y.at(p.error), p.name);
    std::string path, labels;
    const auto frontier = frontier_of(points);
    for (std::size_t i = 0; i < frontier.size(); ++i) {
        const CostPoint& p = points[frontier[i]];
        const double px = x.at(p.time), py = y.at(p.error);
        path += path.empty() ? fmt::format("M{:.1f} {:.1f}", px, py) : fmt::format("H{:.1f}V{:.1f}", px, py);
        // Points of the frontier may be close together, so they are numbered and their names are in a list.
        const double row = plot_top + 10 + 18 * static_cast<double>(i);
        labels += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#d55e00\"/>\n", px, py) +
                  words(px + 5, py - 5, "start", std::to_string(i + 1)) +
                  words(plot_right + 12, row, "start", fmt::format("{} {}", i + 1, p.name));
    }
    return svg + fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"2\"/>\n", path) + labels +
           "</svg>\n";
}

}  // namespace strata::tools
