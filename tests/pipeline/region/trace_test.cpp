// Tests a trace against a std::vector.
#include "pipeline/frame/trace.h"

#include <catch2/catch.hpp>

#include "pipeline/region/region_shortcuts.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::pipeline;

TraceEntry entry(std::uint32_t number) { return {.pixel = number, .key = 3 * number, .side = Side::front}; }

// Number of the first `count` entries that differ from entry(0), entry(1), ...
std::size_t wrong(const Trace& trace, std::size_t count) {
    std::size_t wrong = trace.size() == count ? 0 : 1;
    for (std::size_t i = 0; i < std::min(count, trace.size()); ++i)
        wrong += trace[i].pixel != i || trace[i].key != 3 * i ? 1 : 0;
    return wrong;
}

}  // namespace

TEST_CASE("a trace keeps as many entries as fit into its bytes and with one more becomes empty and takes none") {
    for (const std::uint32_t most : {0u, 1u, 5u, 1023u, 1024u, 1025u, 5000u}) {
        INFO(most);
        Trace trace;
        trace.start(16 * std::uint64_t{most} + 15);
        for (std::uint32_t i = 0; i < most; ++i) trace.push_back(entry(i));
        CHECK(trace.is_complete());
        CHECK(wrong(trace, most) == 0);
        for (std::uint32_t i = 0; i < 2000; ++i) trace.push_back(entry(i));
        CHECK_FALSE(trace.is_complete());
        CHECK(trace.size() == 0);
        trace.start(16 * 2000);
        for (std::uint32_t i = 0; i < 2000; ++i) trace.push_back(entry(i));
        CHECK(trace.is_complete());
        CHECK(wrong(trace, 2000) == 0);
    }
}

TEST_CASE("a trace that is shortened and cleared and extended has the entries of a vector") {
    strata::testing::Random random{77};
    Trace trace;
    std::vector<std::uint32_t> model;
    std::size_t wrong = 0;
    for (std::uint32_t step = 0; step < 300; ++step) {
        const int what = strata::testing::random_int(random, 0, 9);
        if (what == 0) {
            trace.clear();
            model.clear();
        } else if (what < 4) {
            model.resize(
                static_cast<std::size_t>(strata::testing::random_int(random, 0, static_cast<int>(model.size()))));
            trace.shorten(model.size());
        } else {
            for (int n = strata::testing::random_int(random, 0, 900); n > 0; --n) {
                trace.push_back(entry(step));
                model.push_back(step);
            }
        }
        wrong += trace.size() == model.size() ? 0 : 1;
        for (std::size_t i = 0; i < model.size(); ++i) wrong += trace[i].pixel == model[i] ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(trace.is_complete());
}
