// Tests the diagnosis of coverage. Shapes are sampled at pixel centres by an inequality; the deliberate mistake is a
// change of that inequality.
#include "tools/oracle/compare/coverage.h"

#include <catch2/catch.hpp>
#include <functional>

#include "tests/tools/oracle/picture/pictures.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

constexpr int shape_width = 64, shape_height = 48;

Mask sampled(const std::function<bool(double x, double y)>& is_in) {
    Mask mask;
    for (int y = 0; y < shape_height; ++y)
        for (int x = 0; x < shape_width; ++x) mask.push_back(is_in(x + 0.5, y + 0.5));
    return mask;
}

bool is_in_disc(double x, double y) { return (x - 31.2) * (x - 31.2) + (y - 24.7) * (y - 24.7) < 18.3 * 18.3; }

// The edges pass through pixel centres, so there are ties on all four sides.
enum class Owns { left_and_top, right_and_bottom, all, none };
Mask rectangle(Owns owns) {
    return sampled([=](double x, double y) {
        const bool low = owns == Owns::left_and_top || owns == Owns::all;
        const bool high = owns == Owns::right_and_bottom || owns == Owns::all;
        const auto in = [&](double v, double from, double to) {
            return (low ? v >= from : v > from) && (high ? v <= to : v < to);
        };
        return in(x, 10.5, 50.5) && in(y, 8.5, 40.5);
    });
}

}  // namespace

TEST_CASE("a shape moved by half a pixel is reported as moved with its direction") {
    const Masks right{sampled(is_in_disc), sampled([](double x, double y) { return is_in_disc(x - 0.5, y); })};
    const CoverageReport found = compare_coverage(right, shape_width, shape_height);
    CHECK(found.mistake == CoverageMistake::moved);
    CHECK(found.moved_x == Approx(0.5).margin(0.15));
    CHECK(found.moved_y == Approx(0.0).margin(0.1));
    const Masks up{sampled(is_in_disc), sampled([](double x, double y) { return is_in_disc(x, y + 0.5); })};
    CHECK(compare_coverage(up, shape_width, shape_height).moved_y == Approx(-0.5).margin(0.15));
    CHECK(compare_coverage(up, shape_width, shape_height).mistake == CoverageMistake::moved);
}

TEST_CASE("edges that include their ties on all sides or on none are reported as a fill rule") {
    const CoverageReport all =
        compare_coverage({rectangle(Owns::left_and_top), rectangle(Owns::all)}, shape_width, shape_height);
    CHECK(all.mistake == CoverageMistake::edge_rule);
    CHECK(all.lost == 0);
    const CoverageReport none =
        compare_coverage({rectangle(Owns::left_and_top), rectangle(Owns::none)}, shape_width, shape_height);
    CHECK(none.mistake == CoverageMistake::edge_rule);
    CHECK(none.gained == 0);
    const CoverageReport grown =
        compare_coverage({rectangle(Owns::none), rectangle(Owns::all)}, shape_width, shape_height);
    CHECK(grown.mistake == CoverageMistake::edge_rule);
    CHECK(grown.lost == 0);
}

TEST_CASE("ties assigned to the opposite edge gain pixels on one side and lose them on the other") {
    // Six of its 33 rows have ties at the left and right ends; there are no ties at the top and bottom.
    const auto shape = [](Owns owns) {
        return sampled([=](double x, double y) {
            if (y < 8.2 || y > 41.2) return false;
            if (y > 14) return x > 10.2 && x < 50.2;
            return owns == Owns::left_and_top ? x >= 10.5 && x < 50.5 : x > 10.5 && x <= 50.5;
        });
    };
    const CoverageReport found =
        compare_coverage({shape(Owns::left_and_top), shape(Owns::right_and_bottom)}, shape_width, shape_height);
    CHECK(found.mistake == CoverageMistake::edge_rule);
    CHECK(found.gained > 0);
    CHECK(found.lost > 0);
}

TEST_CASE("a border with random offsets is reported as snapping and a hole far from it as a lost surface") {
    std::uint32_t state = 1;
    const Masks trembling{sampled(is_in_disc), sampled([&](double x, double y) {
                              state = state * 1664525u + 1013904223u;
                              const double shake = (static_cast<double>(state >> 8) / 16777216.0 - 0.5) * 0.8;
                              return is_in_disc(x + shake, y + shake);
                          })};
    CHECK(compare_coverage(trembling, shape_width, shape_height).mistake == CoverageMistake::snapping);
    const Masks holed{sampled(is_in_disc), sampled([](double x, double y) {
                          return is_in_disc(x, y) && (x - 31) * (x - 31) + (y - 25) * (y - 25) > 49;
                      })};
    const CoverageReport hole = compare_coverage(holed, shape_width, shape_height);
    CHECK(hole.mistake == CoverageMistake::surface);
    CHECK(hole.gained == 0);
}

TEST_CASE("a pixel is drawn if its depth or its alpha or its colour differs from the background") {
    const Picture reference = ellipse();
    const TargetPair same{&reference.targets[0], &reference.targets[0]};
    const auto by_color = drawn(std::span{&same, 1});
    REQUIRE(by_color);
    int wrong = 0;
    for (std::size_t i = 0; i < 1200; ++i)
        wrong += by_color->reference[i] != is_in_ellipse(static_cast<int>(i % 40), static_cast<int>(i / 40)) ? 1 : 0;
    CHECK(wrong == 0);

    const Picture deep = make_picture({make_target("", Code::single, 40, 30, 1, [](int x, int y) -> Texel {
        return {is_in_ellipse(x, y) ? 0x3f000000u : 0x3f800000u, 0, 0, 0};
    })});
    const TargetPair depth{&deep.targets[0], &deep.targets[0]};
    CHECK(drawn(std::span{&depth, 1})->candidate == by_color->reference);

    const Picture clear = make_picture({make_target("", Code::unorm8, 40, 30, 4, [](int x, int y) -> Texel {
        return {1, 2, 3, is_in_ellipse(x, y) ? 9u : 0u};
    })});
    const TargetPair alpha{&clear.targets[0], &clear.targets[0]};
    CHECK(drawn(std::span{&alpha, 1})->reference == by_color->reference);

    const Picture noise = make_picture({make_target("", Code::unorm8, 40, 30, 3, [](int x, int y) -> Texel {
        return {static_cast<std::uint32_t>(x * 6), static_cast<std::uint32_t>(y * 8), 0, 0};
    })});
    const TargetPair full{&noise.targets[0], &noise.targets[0]};
    CHECK_FALSE(drawn(std::span{&full, 1}));
}
