// Tests the page of hard cases on invented rows. The expected figures are counted by hand.
#include "tools/lab/hard_cases/hard_page.h"

#include <catch2/catch.hpp>

#include "peeling/registry.h"

using namespace strata;

TEST_CASE("the page counts each verdict per device and describes the first failure of each kind") {
    const tools::HardSweep sweep{.cases = {scenes::find_hard_case("coincident")},
                                 .profiles = {*pipeline::find_profile("geforce8"), *pipeline::find_profile("ideal")},
                                 .formats = {pipeline::DepthFormat::d24},
                                 .algorithms = {peeling::find_algorithm("dual"), peeling::find_algorithm("k_buffer")}};
    tools::HardRow breaks, refused;
    breaks.verdict = tools::HardVerdict::breaks;
    breaks.reasons = {"2048 fragments lost by ties at 1024 pixels"};
    refused.verdict = tools::HardVerdict::refused;
    refused.refusal = "no";
    const tools::Lines lines{to_line(sweep, 0, breaks), to_line(sweep, 1, refused), to_line(sweep, 2, breaks),
                             to_line(sweep, 3, {})};
    const std::string page = page_of(sweep, lines);
    CHECK_THAT(page, Catch::Contains("| all | 1 | 0 | 2 | 0 | 1 |\n"));
    CHECK_THAT(page, Catch::Contains("| geforce8 | 0 | 0 | 1 | 0 | 1 |\n"));
    CHECK_THAT(page, Catch::Contains("| ideal | 1 | 0 | 1 | 0 | 0 |\n"));
    CHECK_THAT(page, Catch::Contains("- breaks as the hardware did, for instance dual on geforce8 at d24: 2048 "
                                     "fragments lost by ties at 1024 pixels.\n"));
    CHECK_THAT(page, Catch::Contains("![coincident](pictures/coincident.png)"));
    CHECK_THAT(page, Catch::Contains("Exact geometry has 3072 visible fragments, 3 at the deepest pixel, 1 layers"));
}

TEST_CASE("the page compares two devices and its sentence has the figures of their rows and names their rules") {
    const tools::HardSweep sweep{.cases = {scenes::find_hard_case("planes-1-unit")},
                                 .profiles = {*pipeline::find_profile("geforce3"), *pipeline::find_profile("geforce8"),
                                              *pipeline::find_profile("llvmpipe")},
                                 .formats = {pipeline::DepthFormat::d24},
                                 .algorithms = {peeling::find_algorithm("depth_units")}};
    const auto moved = [](std::uint64_t device, double depth, std::uint64_t order) {
        tools::MovedRow row;
        tools::SizeRow& unit = row.stability.by_size[0];
        unit.exact = {.gained = 4, .lost = 4, .depth = 0.25};
        unit.ours[0] = {.gained = 3, .depth = depth / 4};
        unit.ours[1] = {.lost = device};
        unit.ours[2] = {.reordered = 2};
        row.own = {.compared = 1000, .order = order, .coverage = 5};
        return row;
    };
    const tools::Lines lines{to_line(sweep, 0, {}, moved(77, 12, 40)), to_line(sweep, 1, {}, moved(1, 2, 30)),
                             to_line(sweep, 2, {}, moved(90, 16, 33))};
    const std::string page = page_of(sweep, lines);
    // 3 within the move, 77 within the device, 2 beyond: 82, against 8 of the exact answer.
    CHECK_THAT(page, Catch::Contains("| geforce3 | d24 | 82 | 8 | 10.25 | 12 | 3 | 77 | 2 | 40 | 5 | stable |\n"));
    CHECK_THAT(page, Catch::Contains("| llvmpipe | 1 | 0 | 0 | 0 | 33 | 5 |\n"));
    CHECK_THAT(page, Catch::Contains("At d24 llvmpipe changes 90 times within a step of the device and 2 times beyond, "
                                     "geforce8 1 and 2 times; along the path llvmpipe flips 33 times in order and 5 in "
                                     "coverage, geforce8 30 and 5. The reason: llvmpipe begins each plane at the "
                                     "window's corner"));
    CHECK_THAT(page,
               Catch::Contains("llvmpipe moves a depth up to 16 times as far as the exact answer, geforce8 2 times."));
    const tools::HardSweep chips{.cases = sweep.cases,
                                 .profiles = {sweep.profiles[0], sweep.profiles[1]},
                                 .formats = sweep.formats,
                                 .algorithms = sweep.algorithms};
    CHECK_THAT(page_of(chips, {lines[0], lines[1]}),
               Catch::Contains("the grid of geforce3 has steps of 1/16 pixel, that of geforce8 1/256"));
}

TEST_CASE("a page of cases that are not moved does not mention movements") {
    const tools::HardSweep sweep{.cases = {scenes::find_hard_case("coincident")},
                                 .profiles = {*pipeline::find_profile("geforce8")},
                                 .formats = {pipeline::DepthFormat::d24},
                                 .algorithms = {peeling::find_algorithm("dual")}};
    CHECK_THAT(page_of(sweep, {to_line(sweep, 0, {})}), !Catch::Contains("oved"));
}

TEST_CASE(
    "a picture of the page shows every pixel of a small frame as a block and keeps every bright pixel of a large one") {
    using pipeline::Image;
    const auto red_at = [](const Image& image, int x, int y) { return image.codes[image.index(x, y)]; };
    // 2 x 1 pixels, enlarged 128 times.
    Image small{pipeline::Format::rgba8, 2, 1};
    small.codes[small.index(1, 0)] = 200;
    const Image blocks = tools::page_picture(small);
    REQUIRE((blocks.width == 256 && blocks.height == 128));
    int wrong = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x)
            if (red_at(blocks, x, y) != (x < 128 ? 0u : 200u)) ++wrong;
    CHECK(wrong == 0);
    // 4096 columns are reduced to 1024 by fours; the one row is enlarged to 32.
    Image wide{pipeline::Format::rgba8, 4096, 1};
    wide.codes[wide.index(2, 0)] = 90;
    wide.codes[wide.index(3, 0)] = 40;
    wide.codes[wide.index(4095, 0)] = 7;
    const Image line = tools::page_picture(wide);
    REQUIRE((line.width == 1024 && line.height == 32));
    CHECK(red_at(line, 0, 31) == 90);
    CHECK(red_at(line, 1, 0) == 0);
    CHECK(red_at(line, 1023, 5) == 7);
}
