// Tests runs that read no PNG or JPEG: the libraries that the dynamic loader lists, and the peak memory that the system
// counts.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

TEST_CASE("a run that reads no PNG or JPEG takes less than 30 MB") {
    const auto words =
        GENERATE(values<std::vector<std::string>>({{"list", "algorithms"},
                                                   {"list", "scenes"},
                                                   {"list", "profiles", "--json", "ideal"},
                                                   {"render", "teapot", "--size", "64x64"},
                                                   {"render", "teapot", "--size", "64x64", "-o", "a.exr"},
                                                   {"render", "teapot", "--size", "64x64", "-o", "a.png"}}));
    const Folder folder;
    const std::uint64_t peak = peak_of_strata(folder, words);
    INFO(words[0] << ": " << peak << " bytes");
    CHECK(peak > 0);
    CHECK(peak < 30'000'000);
}

TEST_CASE("the program itself is not linked with OpenImageIO") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {}, {.environment = {{"LD_TRACE_LOADED_OBJECTS", "1"}}});
    CHECK(ended.out.find("libstdc++") != std::string::npos);
    CHECK(ended.out.find("OpenImageIO") == std::string::npos);
    CHECK(lines_of(ended.out).size() < 25);
}
