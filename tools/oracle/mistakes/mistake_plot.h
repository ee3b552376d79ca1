// tools/oracle/mistakes/mistake_plot.h - how many mistakes each scene of the suite shows, as a drawing: a bar a scene.
#pragma once
#include <string>
#include <vector>

#include "tools/oracle/mistakes/mistake_table.h"

namespace strata::oracle {

// An SVG file.
[[nodiscard]] std::string to_svg(const std::vector<TableColumn>& columns);

}  // namespace strata::oracle
