// tools/lab/invariance/invariance_images.h - writes images of a cell's errors.
//
// Rule     In FOLDER/images, named by the cell's number: NNNN.png, the peeled image; NNNN.difference.png, 4 times the
//          magnitude of its difference from the exact A-buffer's; NNNN.difference.exr, that difference itself,
//          signed, binary32; NNNN.errors.png, the picture in dark grey, pixels with a duplicated layer red, with a lost
//          one blue, with both magenta. Only for cells with a duplicate or a loss.
#pragma once
#include "tools/lab/invariance/invariance_cell.h"

namespace strata::tools {

void write_cell_images(const std::string& folder, std::size_t number, const CellResult& result);

}  // namespace strata::tools
