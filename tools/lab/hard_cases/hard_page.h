// tools/lab/hard_cases/hard_page.h - writes the lines of a sweep as a page, with one image per case.
//
// Rule     FOLDER/RESULTS.md and FOLDER/pictures/NAME.png: the exact A-buffer of the profile ideal. The page depends on
//          the lines alone; it contains no times and no paths. A frame smaller than 256 pixels is enlarged by a whole
//          factor; one larger than 1024 is reduced to the brightest pixel of each block, so that thin lines remain
//          visible.
// Tests    tests/tools/hard_cases/hard_page_test.cpp
#pragma once
#include <string>

#include "pipeline/formats/image.h"
#include "tools/lab/hard_cases/hard_sweep.h"

namespace strata::tools {

[[nodiscard]] std::string page_of(const HardSweep& sweep, const Lines& lines);

// The image for the page, with sides of 32 to 1024 pixels.
[[nodiscard]] pipeline::Image page_picture(const pipeline::Image& image);

// Writes the page and its images. A case that even the oracle refuses has no image.
void write_page(const HardSweep& sweep, const Lines& lines, const std::string& folder);

}  // namespace strata::tools
