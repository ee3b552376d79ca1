// tools/strata/report/picture_bytes.h - pictures as bytes within a page.
#pragma once
#include <string>
#include <string_view>

#include "pipeline/formats/image.h"

namespace strata::tools {

// As zlib has it (RFC 1950).
[[nodiscard]] std::string deflated(std::string_view bytes);
[[nodiscard]] std::string base64(std::string_view bytes);

// An rgba8 image as a PNG of 8-bit red, green and blue: what a page shows stands on no other ground.
// Source   PNG (ISO/IEC 15948), 11.2; every row by filter 0
[[nodiscard]] std::string png_bytes(const pipeline::Image& image);

}  // namespace strata::tools
