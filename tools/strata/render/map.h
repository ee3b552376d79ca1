// tools/strata/render/map.h - the maps of `render --map`, which replace the picture: depth complexity, ties, or errors
// of an algorithm.
//
// Rule     The number of a pixel is its count of fragments; or its count of fragments whose depth code is that of
//          another fragment of the pixel, or of its opaque surface; or the largest difference of a channel from the
//          exact A-buffer, in units of 1/255. The largest number of the frame is white, 0 is black, with red and yellow
//          between them. The report's maps show the same numbers.
// Tests    tests/tools/strata/render/map_test.cpp
#pragma once
#include <vector>

#include "tools/strata/options/option.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

enum class Map : std::uint8_t { depth_complexity, ties, opaque_ties, error };

struct MapPicture {
    std::vector<double> numbers;  // one per pixel, row by row from the top
    double most = 0;
    pipeline::Image image;  // rgba8
};

[[nodiscard]] MapPicture map_of(Map map, const RunOptions& options, const CompletedRun& finished);

// "ties: black is 0, white is 6".
[[nodiscard]] std::string legend_of(Map map, const MapPicture& picture);
[[nodiscard]] const std::vector<Choice<Map>>& map_names();

}  // namespace strata::tools
