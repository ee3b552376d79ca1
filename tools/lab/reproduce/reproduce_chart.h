// tools/lab/reproduce/reproduce_chart.h - plots curves over two logarithmic axes as SVG, for a page.
#pragma once
#include <string>
#include <vector>

#include "tools/lab/reproduce/reproduce_page.h"

namespace strata::tools {

// x and y must be above 0: both axes are logarithmic.
struct Point {
    double x, y;  // above 0
};

// Points in drawing order.
struct Curve {
    std::string name;
    std::vector<Point> points{};
};

// Curves share both axes and are drawn in order. There must be at least one point in total.
struct Chart {
    std::string x_label, y_label;
    std::vector<Curve> curves{};  // at least one point in total
};

// Writes the chart to folder/file. Throws SystemError if that fails.
[[nodiscard]] Picture write_chart(const std::string& folder, const std::string& file, const std::string& caption,
                                  const Chart& chart);

}  // namespace strata::tools
