// scenes/files/picture_attributes.h - what a picture says of itself: the command, camera and profile that were written
// beside its pixels.
// Tests    tests/tools/manual_test.cpp
#pragma once
#include <string>

#include "scenes/files/image_io.h"

namespace strata::scenes {

// Those under "strata:", without that; of an EXR file the first part's. Empty for a picture of another program;
// InputError for what is none.
[[nodiscard]] Attributes read_attributes(const std::string& path);

}  // namespace strata::scenes
