// tools/strata/reproduce/reproduce_chart.h - curves over two logarithmic axes, as an SVG picture of a page.
#pragma once
#include <string>
#include <vector>

#include "tools/strata/reproduce/reproduce_page.h"

namespace strata::tools {

struct Point {
    double x, y;  // above 0
};

struct Curve {
    std::string name;
    std::vector<Point> points{};
};

struct Chart {
    std::string x_label, y_label;
    std::vector<Curve> curves{};  // at least one point in all
};

// `folder`/file.
[[nodiscard]] Picture write_chart(const std::string& folder, const std::string& file, const std::string& caption,
                                  const Chart& chart);

}  // namespace strata::tools
