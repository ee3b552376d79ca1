// tools/web/page_door.cpp - the three functions that the page's script sees.
#include "tools/web/workbench.h"

namespace {

strata::web::Workbench& workbench() {
    static strata::web::Workbench one;
    return one;
}

}  // namespace

extern "C" {

// JSON in, JSON out; the answer stays until the next question.
const char* strata_ask(const char* question) {
    static std::string answer;
    answer = workbench().answer(question);
    return answer.c_str();
}

void strata_keep_file(const char* name, const unsigned char* bytes, std::size_t size) {
    const auto* begin = reinterpret_cast<const std::byte*>(bytes);
    workbench().keep_file(name, {begin, begin + size});
}
}
