#include "tools/probe/kit.h"
#include "tools/probe/page_parts.h"

namespace strata::probe {

namespace {

// The page has each mark once.
void put(std::string& page, std::string_view mark, std::string_view text) {
    page.replace(page.find(mark), mark.size(), text);
}

}  // namespace

// The element that holds the kit ends at "</", which no text of a kit has.
std::string page_of(const std::vector<Item>& items, const std::vector<Operation>& operations) {
    std::string page{probe_html()};
    put(page, "/*SCRIPT*/", probe_js());
    put(page, "/*KIT*/", to_json(items, operations));
    return page;
}

}  // namespace strata::probe
