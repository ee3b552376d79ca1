#include "tools/lab/reproduce/reproduce_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/files/atomic_file.h"
#include "tools/strata/report/svg_style.h"

namespace strata::tools {

namespace {

// The colours of Okabe and Ito, which colour-blind people can distinguish.
constexpr std::array colors{"#000000", "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"};

// One axis: values `low` to `high`, whole powers of `base`, on pixels `from` to `to`.
struct Axis {
    double base, low, high, from, to;

    // The pixel of a value, logarithmic.
    [[nodiscard]] double operator()(double value) const {
        return from + (to - from) * std::log(value / low) / std::log(high / low);
    }
};

// The axis that includes a coordinate of every point of the chart: whole powers of `base`, at least one step, on pixels
// `from` to `to`.
template <class Coordinate>
Axis axis_of(const Chart& chart, double base, Coordinate coordinate, double from, double to) {
    double low = coordinate(chart.curves.front().points.front()), high = low;
    for (const Curve& curve : chart.curves)
        for (const Point& point : curve.points) {
            low = std::min(low, coordinate(point));
            high = std::max(high, coordinate(point));
        }
    const auto power = [&](double exponent) { return std::pow(base, exponent); };
    // The logarithm of a whole power may be slightly off an integer: 1e-9 prevents an additional step.
    const double first = std::floor(std::log(low) / std::log(base) + 1e-9);
    return {base, power(first), power(std::max(first + 1, std::ceil(std::log(high) / std::log(base) - 1e-9))), from,
            to};
}

// SVG elements at pixels, y down. `anchor` is start, middle or end.
std::string text(double x, double y, const char* anchor, const std::string& words) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
}

std::string line(double x0, double y0, double x1, double y1) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#ddd\"/>\n", x0, y0, x1, y1);
}

// The label of a grid line: numbers from 0.01 to 9999 in full, others as powers of ten.
std::string mark(double value) {
    if (value >= 0.01 && value < 1e4) return fmt::format("{:.6g}", value);
    return fmt::format("10<tspan dy=\"-5\" font-size=\"9\">{:.0f}</tspan>", std::log10(value));
}

// The whole plot: grid, labels, curves, and a legend at the right.
std::string drawn(const Chart& chart) {
    const Axis x = axis_of(
        chart, 2, [](const Point& p) { return p.x; }, 60, 300);
    const Axis y = axis_of(
        chart, 10, [](const Point& p) { return p.y; }, 230, 20);
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"430\" height=\"280\" font-family=\"sans-serif\" "
        "font-size=\"12\">\n" +
        std::string(svg_dark_style) + "<rect width=\"430\" height=\"280\" fill=\"#fff\"/>\n";
    // 1.001 includes the last line although products of the base round.
    for (double v = x.low; v <= x.high * 1.001; v *= x.base)
        svg += line(x(v), y.from, x(v), y.to) + text(x(v), y.from + 16, "middle", mark(v));
    for (double v = y.low; v <= y.high * 1.001; v *= y.base)
        svg += line(x.from, y(v), x.to, y(v)) + text(x.from - 6, y(v) + 4, "end", mark(v));
    svg += text((x.from + x.to) / 2, y.from + 36, "middle", chart.x_label) +
           text(x.from - 50, y.to - 8, "start", chart.y_label);
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        const Curve& curve = chart.curves[i];
        const char* const color = colors[i % colors.size()];
        std::string path;
        for (const Point& p : curve.points)
            path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x(p.x), y(p.y));
        const double row = y.to + 14 + 18 * static_cast<double>(i);
        // Alternating widths of 5 to 2 pixels, so that the edges of a curve remain visible under a later one.
        svg += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"/>\n", path, color,
                           5 - static_cast<int>(i) % 4);
        svg += fmt::format("<path d=\"M310 {0:.1f}h14\" stroke=\"{1}\" stroke-width=\"3\"/>\n", row - 4, color) +
               text(328, row, "start", curve.name);
    }
    return svg + "</svg>\n";
}

}  // namespace

Picture write_chart(const std::string& folder, const std::string& file, const std::string& caption,
                    const Chart& chart) {
    scenes::write_file(folder + '/' + file, drawn(chart));
    return {file, caption};
}

}  // namespace strata::tools
