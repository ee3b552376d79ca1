// tools/strata/report/svg_style.h - a style that adapts SVG plots to dark pages.
//
// Why      The program writes its own plots (two charts, a bar chart, a pixel's fragments) as SVG text, because it must
//          render reports without gnuplot. The result pages of tools/invariance, which a developer makes, use gnuplot.
#pragma once
#include <string_view>

namespace strata::tools {

// For an SVG plot with a white background, #ddd grid lines, black text and black or blue curves; inserted after its
// <svg> tag.
inline constexpr std::string_view svg_dark_style =
    "<style>@media (prefers-color-scheme: dark) { rect[fill='#fff'] { fill: #14171a } text { fill: #e6e9ec } "
    "path[stroke='#ddd'] { stroke: #3b434b } path[stroke='#000000'] { stroke: #e6e9ec } "
    "path[stroke='#0072b2'] { stroke: #56b4e9 } }</style>\n";

}  // namespace strata::tools
