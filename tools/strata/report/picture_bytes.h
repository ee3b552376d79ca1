// tools/strata/report/picture_bytes.h - bytes within a page.
#pragma once
#include <string>
#include <string_view>

namespace strata::tools {

// As zlib has it (RFC 1950).
[[nodiscard]] std::string deflated(std::string_view bytes);
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace strata::tools
