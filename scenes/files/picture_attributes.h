// scenes/files/picture_attributes.h - reads the attributes of an image file: the command, camera and profile that were
// stored with its pixels.
// Tests    tests/tools/strata/program/manual_test.cpp
#pragma once
#include <string>

#include "scenes/files/image_io.h"

namespace strata::scenes {

// The attributes with the prefix "strata:", without the prefix; for an EXR file those of the first part. Empty for an
// image of another program; InputError if the file is no image.
[[nodiscard]] Attributes read_attributes(const std::string& path);

}  // namespace strata::scenes
