#include "tools/lab/probe/files/page_parts.h"
#include "tools/lab/probe/kit/kit.h"

namespace strata::probe {

namespace {

// Replaces a mark, which occurs once in the page.
void put(std::string& page, std::string_view mark, std::string_view text) {
    page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

// A kit contains no '</' that could end the element that contains it.
std::string page_of(const std::vector<Item>& items) {
    std::string page{probe_html()};
    put(page, "/*SCRIPT*/", probe_js());
    put(page, "/*KIT*/", to_json(items));
    return page;
}

}  // namespace strata::probe
