// tools/strata/papers.h - web addresses of the three papers.
#pragma once
#include <string_view>

namespace strata::tools {

inline constexpr std::string_view everitt_2001_link =
    "https://developer.nvidia.com/content/interactive-order-independent-transparency";
inline constexpr std::string_view bavoil_2008_link =
    "https://developer.download.nvidia.com/SDK/10/opengl/src/dual_depth_peeling/doc/DualDepthPeeling.pdf";
inline constexpr std::string_view carr_2008_link = "https://doi.org/10.2312/EGGH/EGGH08/033-040";

}  // namespace strata::tools
