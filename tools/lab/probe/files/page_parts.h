// tools/lab/probe/files/page_parts.h - the files of page/ as text, embedded in the library by the build.
#pragma once
#include <string_view>

namespace strata::probe {

[[nodiscard]] std::string_view probe_html();
[[nodiscard]] std::string_view probe_js();

}  // namespace strata::probe
