// tools/lab/reproduce/reproduce_chart.h - curves over two logarithmic axes, as an SVG picture of a page.
#pragma once
#include <string>
#include <vector>

#include "tools/lab/reproduce/reproduce_page.h"

namespace strata::tools {

// x and y are above 0: both axes are logarithmic.
struct Point {
    double x, y;  // above 0
};

// Points in the order in which they are joined.
struct Curve {
    std::string name;
    std::vector<Point> points{};
};

// Curves share both axes and are drawn in their order. There is at least one point in all.
struct Chart {
    std::string x_label, y_label;
    std::vector<Curve> curves{};  // at least one point in all
};

// Writes the chart as folder/file. Throws SystemError where that fails.
[[nodiscard]] Picture write_chart(const std::string& folder, const std::string& file, const std::string& caption,
                                  const Chart& chart);

}  // namespace strata::tools
