// scenes/images/openimageio.h - functions of the image module that its files share.
#pragma once
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "scenes/images/image_module.h"

namespace strata::scenes::images {

[[nodiscard]] std::vector<std::uint8_t> decode(const EncodedPicture& picture, const FileLocation& location);
[[nodiscard]] FileCodes decode_codes(const EncodedPicture& picture, const FileLocation& location);

}  // namespace strata::scenes::images
