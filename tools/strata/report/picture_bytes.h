// tools/strata/report/picture_bytes.h - compresses bytes and encodes them as text, to embed them in an HTML page.
#pragma once
#include <string>
#include <string_view>

namespace strata::tools {

// Compresses to the zlib format (RFC 1950).
[[nodiscard]] std::string deflated(std::string_view bytes);
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace strata::tools
