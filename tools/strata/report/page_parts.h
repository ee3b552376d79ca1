// tools/strata/report/page_parts.h - the files of page/ as strings, embedded in the program by the build.
#pragma once
#include <string_view>

namespace strata::tools {

[[nodiscard]] std::string_view page_html();
[[nodiscard]] std::string_view page_css();
[[nodiscard]] std::string_view page_js();
[[nodiscard]] std::string_view plain_js();

}  // namespace strata::tools
