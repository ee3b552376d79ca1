#include "tools/strata/report/report_page.h"

#include "tools/strata/report/page_parts.h"

namespace strata::tools {

namespace {

// Replaces a placeholder, which occurs exactly once in the page.
void put(std::string& page, std::string_view mark, std::string_view text) {
    page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

std::string script_safe(const nlohmann::ordered_json& document) {
    std::string text = document.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace), safe;
    for (const char c : text) safe += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return safe;
}

std::string report_page(const ReportData& data) {
    std::string page{page_html()};
    put(page, "/*STYLE*/", page_css());
    put(page, "/*SCRIPT*/", page_js());
    put(page, "/*DATA*/", script_safe(data.document));
    put(page, "<!--BLOBS-->", data.blobs.html());
    return page;
}

}  // namespace strata::tools
