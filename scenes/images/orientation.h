// scenes/images/orientation.h - turns an image upright whose file names the side of its first row and first column.
//
// Source   TIFF 6.0, tag 274 (Orientation); EXIF 2.32 has the same tag and values
// Tests    tests/tools/oracle/picture/orientation_test.cpp
#pragma once
#include "scenes/images/image_module.h"

namespace strata::scenes::images {

// Values other than 2 to 8 leave the image as it is.
void turn_upright(FileCodes& stored, int orientation);

}  // namespace strata::scenes::images
