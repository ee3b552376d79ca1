// tools/strata/render/map.h - what `render --map` draws in a picture's place: where many fragments lie, where ties,
// where an algorithm is wrong.
//
// Rule     A pixel's number is its count of fragments; its fragments at the depth (the code of the buffer) of another
//          one of it, or of its opaque surface; or the largest difference of a channel from the exact A-buffer's, in
//          255ths. The greatest number of the frame is white, 0 is black, between them red and yellow. The numbers are
//          those of the report's maps.
// Tests    tests/tools/map_test.cpp
#pragma once
#include <vector>

#include "tools/strata/options/option.h"
#include "tools/strata/render/run.h"

namespace strata::tools {

enum class Map : std::uint8_t { depth_complexity, ties, opaque_ties, error };

struct MapPicture {
    std::vector<double> numbers;  // of each pixel, row by row from the top
    double most = 0;
    pipeline::Image image;  // rgba8
};

[[nodiscard]] MapPicture map_of(Map map, const RunOptions& options, const Finished& finished);

// "ties: black is 0, white is 6".
[[nodiscard]] std::string legend_of(Map map, const MapPicture& picture);
[[nodiscard]] const std::vector<Choice<Map>>& map_names();

}  // namespace strata::tools
