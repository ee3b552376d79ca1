// tools/lab/hard_cases/hard_page.h - the lines of a sweep as a page for people, with a picture a case.
//
// Rule     FOLDER/RESULTS.md and FOLDER/pictures/NAME.png: the exact A-buffer of the profile ideal. The page follows
//          from the lines alone; it holds no time and no place. A frame of less than 256 pixels is enlarged by a whole
//          number; one of more than 1024 is shown by the brightest pixel of each block, so that a thin line is seen.
// Tests    tests/tools/hard_cases/hard_page_test.cpp
#pragma once
#include <string>

#include "pipeline/formats/image.h"
#include "tools/lab/hard_cases/hard_sweep.h"

namespace strata::tools {

[[nodiscard]] std::string page_of(const HardSweep& sweep, const Lines& lines);

// The picture as the page shows it: no side of less than 32 or more than 1024 pixels.
[[nodiscard]] pipeline::Image page_picture(const pipeline::Image& image);

// Writes the page and its pictures. A case that even the oracle refuses has none.
void write_page(const HardSweep& sweep, const Lines& lines, const std::string& folder);

}  // namespace strata::tools
