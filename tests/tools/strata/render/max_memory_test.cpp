// Tests the prediction of --max-memory against the peak that the system measures.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <iterator>
#include <regex>
#include <sstream>

#include "tests/tools/program.h"

namespace {

using namespace strata::test;

constexpr double bytes_of_a_mebibyte = 1 << 20;

// The number of bytes in the message that rejects the run.
double predicted(const Folder& folder, std::vector<std::string> words) {
    words.insert(words.end(), {"--max-memory", "1M"});
    const CommandResult ended = run_strata(folder, words);
    CHECK(ended.status == 2);
    std::smatch found;
    REQUIRE(std::regex_search(ended.err, found, std::regex("needs about ([0-9]+) MB, the limit is 1 MB")));
    return std::stod(found[1]) * bytes_of_a_mebibyte;
}

struct Peak {
    double told, measured;  // bytes
};

Peak peak_of(const Folder& folder, const std::string& job, const char* threads) {
    std::istringstream in(job + " --threads " + threads);
    const std::vector<std::string> words{std::istream_iterator<std::string>{in}, {}};
    const auto measured = static_cast<double>(peak_of_strata(folder, words));
    REQUIRE(measured > 0);
    return {predicted(folder, words), measured};
}

}  // namespace

TEST_CASE("the predicted memory of a picture is within a quarter of the measured one") {
    const std::vector<std::string> jobs{
        "render teapot --size 1024x1024 --algorithm dual",
        "render teapot --size 1024x1024 --algorithm dual --no-audit -o a.png",
        "render teapot --size 1024x1024 --algorithm dual --no-audit -o a.exr",
        "render teapot --size 1024x1024 --algorithm dual --execution literal --no-audit",
        "render teapot --size 1024x1024 --algorithm dual --execution literal --profile ideal --no-audit",
        "render teapot --size 1024x1024 --algorithm depth_units --execution literal --no-audit",
        "layers teapot --size 512x512 --algorithm front_to_back -o layers.exr",
        "render volume-beam:slices=64 --size 512x512 --algorithm dual",
        "render volume-beam:slices=64 --size 512x512 --algorithm a_buffer",
        "render volume-beam:slices=64 --size 512x512 --algorithm depth_units --no-audit"};
    const Folder folder;
    double worst = 0;
    for (const std::string& job : jobs) {
        const Peak one = peak_of(folder, job, "1"), two = peak_of(folder, job, "2");
        INFO(job << ": " << one.measured / bytes_of_a_mebibyte << " and " << two.measured / bytes_of_a_mebibyte
                 << " MiB");
        CHECK(one.told == Approx(one.measured).epsilon(0.25));
        // Two threads may work on their tiles alternately and then need less, but never a quarter more than predicted.
        CHECK(two.measured < 1.25 * two.told);
        worst = std::max(worst, std::abs(one.told / one.measured - 1));
    }
    std::cout << jobs.size() << " pictures: memory told within " << std::ceil(100 * worst) << " %" << std::endl;
}

TEST_CASE("a picture that would exceed --max-memory is rejected before anything is written") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"render", "teapot", "--size", "2048x2048", "--execution", "literal",
                                                    "--max-memory", "64M", "-o", "a.exr"});
    CHECK(ended.status == 2);
    CHECK(std::regex_match(
        ended.err, std::regex(R"(strata: --max-memory: dual at 2048x2048 needs about [0-9]+ MB, the limit is 64 MB; )"
                              R"(a smaller --size or --fragment-memory takes less\n)")));
    CHECK(folder.files().empty());
    CHECK(run_strata(folder, {"render", "teapot", "--size", "64x64", "--max-memory", "64M"}).status == 0);
}

TEST_CASE("a verdict takes at most 200 bytes a pixel and 64 MB", "[long]") {
    const Folder folder;
    constexpr std::uint64_t side = 1024;
    REQUIRE(
        run_strata(folder, {"render", "teapot", "--alpha", "0.5", "--size", "1024x1024", "--no-audit", "-o", "a.exr"})
            .status == 0);
    const std::uint64_t peak = peak_of_strata(folder, {"compare", "teapot", "a.exr", "--alpha", "0.5"});
    INFO(static_cast<double>(peak) / bytes_of_a_mebibyte << " MiB");
    CHECK(peak > 0);
    CHECK(peak < 200 * side * side + (std::uint64_t{64} << 20));
}

TEST_CASE("the pixels of a picture are counted before they are decoded") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "strata render planes:count=1 --size 1024x1024 --no-audit -q -o a.png && strata render "
                  "planes:count=1 --size 1024x1024 --no-audit -q -o a.exr")
                .status == 0);
    for (const char* file : {"a.png", "a.exr"})
        for (const char* reference : {"planes:count=1", "a.png"}) {
            const CommandResult ended = run_strata(folder, {"compare", reference, file, "--max-memory", "40M"});
            INFO(ended.err);
            CHECK(ended.status == 2);
            CHECK(std::regex_match(
                ended.err, std::regex(R"(strata: a\.(png|exr): size: expected a picture that takes at most [0-9]+ MB, )"
                                      R"(which --max-memory leaves, found 1024x1024, which takes about [0-9]+ MB\n)")));
        }
    for (const char* command : {"golden", "passes"})
        CHECK(run_strata(folder, {command, "teapot", "--size", "1024x1024", "--max-memory", "40M", "-o", "out"})
                  .err.starts_with("strata: --max-memory: "));
    CHECK_FALSE(std::filesystem::exists(folder / "out"));
}
