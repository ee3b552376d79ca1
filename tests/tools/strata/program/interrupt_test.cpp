// Tests that an output file is either complete or absent, whenever the interrupt arrives.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("an interrupt at any moment gives exit status 130 and leaves no partial file") {
    int interrupted = 0;
    std::string wrong;
    for (int delay = 5; delay <= 640; delay += delay) {
        const Folder folder;
        const CommandResult ended = run_strata(
            folder, {"render", "random:seed=3,triangles=20000", "--size", "1024x1024", "--no-audit", "-o", "out.exr"},
            {.interrupt_after_ms = delay});
        const auto files = folder.files();
        const bool whole = files == std::vector<std::string>{"out.exr"} &&
                           run_strata(folder, {"info", "--digests", "out.exr"}).status == 0;
        interrupted += ended.status == 130 ? 1 : 0;
        const bool right = (ended.status == 130 && (files.empty() || whole)) || (ended.status == 0 && whole);
        if (!right && wrong.empty())
            wrong = "after " + std::to_string(delay) + " ms: status " + std::to_string(ended.status);
    }
    CHECK(wrong.empty());
    INFO(wrong);
    CHECK(interrupted > 0);
}
