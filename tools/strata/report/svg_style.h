// tools/strata/report/svg_style.h - what makes a plot dark on a dark page.
#pragma once
#include <string_view>

namespace strata::tools {

// For an SVG picture of white paper, #ddd grid lines, black words and black or blue curves: put behind its <svg>.
inline constexpr std::string_view svg_dark_style =
    "<style>@media (prefers-color-scheme: dark) { rect[fill='#fff'] { fill: #14171a } text { fill: #e6e9ec } "
    "path[stroke='#ddd'] { stroke: #3b434b } path[stroke='#000000'] { stroke: #e6e9ec } "
    "path[stroke='#0072b2'] { stroke: #56b4e9 } }</style>\n";

}  // namespace strata::tools
