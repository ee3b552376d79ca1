// Tests the small pictures of a failed case against means and maxima that are computed here.
#include "tools/oracle/folders/case_pictures.h"

#include <catch2/catch.hpp>

using namespace strata;
using namespace strata::oracle;

TEST_CASE("a picture is shrunk to the means of squares, also of those that the edge cuts") {
    pipeline::Image image{pipeline::Format::rgba8, 3, 3};
    for (std::size_t i = 0; i < 9; ++i) image.codes[4 * i] = static_cast<std::uint32_t>(10 * i);
    const pipeline::Image made = shrunk(image, 2);
    CHECK(made.width == 2);
    CHECK(made.height == 2);
    CHECK(made.codes[made.index(0, 0)] == 20);  // 0, 10, 30, 40
    CHECK(made.codes[made.index(1, 0)] == 35);  // 20, 50
    CHECK(made.codes[made.index(0, 1)] == 65);  // 60, 70
    CHECK(made.codes[made.index(1, 1)] == 80);
    CHECK(shrunk(image, 1) == image);
}

TEST_CASE("a single pixel that differs stays visible in a small heat map") {
    Comparison found{.width = 5, .height = 3, .distance_of = std::vector<std::uint32_t>(15)};
    found.distance_of[9] = 7;  // 4,1
    const Comparison made = shrunk_distances(found, 2);
    CHECK(made.width == 3);
    CHECK(made.height == 2);
    CHECK(made.distance_of == std::vector<std::uint32_t>{0, 0, 7, 0, 0, 0});
}
