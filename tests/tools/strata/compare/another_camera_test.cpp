// Tests what `strata compare` says of a picture from a camera a little off: the amounts are those that render drew
// with.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

// The first line of a verdict on a picture that render drew with these options.
std::string first_line_of(const Folder& folder, const std::string& scene, const std::string& drawn_with) {
    REQUIRE(shell(folder, fmt::format("strata render {} --size 64x48 {} --algorithm front_to_back -q -o port.png",
                                      scene, drawn_with))
                .status == 0);
    const CommandResult found = shell(folder, fmt::format("strata compare {} port.png", scene));
    CHECK(found.status == 1);
    return lines_of(found.out)[0];
}

// The number before these words.
double number_before(const std::string& line, const std::string& words) {
    INFO(line << " / " << words);
    REQUIRE(line.starts_with("wrong: another camera: "));
    const std::size_t at = line.find(words);
    REQUIRE(at != line.npos);
    return std::stod(line.substr(line.rfind(' ', at - 2) + 1));
}

}  // namespace

TEST_CASE("a camera that is a little off is named by how it has moved") {
    const Folder folder;
    const std::string scene = "teapot";
    CHECK(number_before(first_line_of(folder, scene, "--orbit 30.6,20"), " degrees further to the right around") ==
          Approx(0.6).margin(0.05));
    CHECK(number_before(first_line_of(folder, scene, "--orbit 30,19.4"), " degrees lower around") ==
          Approx(0.6).margin(0.05));
    const std::string both = first_line_of(folder, scene, "--orbit 29.2,20.5");
    CHECK(number_before(both, " degrees further to the left around") == Approx(0.8).margin(0.06));
    CHECK(number_before(both, " degrees higher around") == Approx(0.5).margin(0.06));
}

TEST_CASE("a projection of a square picture is named, which no small movement reaches") {
    const Folder folder;
    std::ofstream{folder / "given.json"} << R"({"eye": [0, 0, 9], "center": [0, 0, 0], "up": [0, 1, 0],
        "fovy_degrees": 53.13010235415598, "near": 2, "far": 18})";
    // gluPerspective with an aspect of 1, and the eye at (0, 0, 9).
    std::ofstream{folder / "square.json"} << R"({"view": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -9, 1],
        "projection": [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, -1.25, -1, 0, 0, -4.5, 0]})";
    REQUIRE(
        shell(folder, "strata render teapot --size 64x48 --camera square.json --algorithm front_to_back -q -o port.png")
            .status == 0);
    const CommandResult found = shell(folder, "strata compare teapot port.png --camera given.json");
    CHECK(lines_of(found.out)[0].starts_with(
        "wrong: another camera: the projection is that of a square picture: the aspect is taken as 1; 0 of 3072"));
}

TEST_CASE("an eye that is turned to the right is told as that") {
    const Folder folder;
    // Turned about the y axis by 0.5 degrees: x in the eye is along (cos, 0, sin), z along (-sin, 0, cos).
    const double c = 0.9999619230641713, s = 0.008726535498373935;
    const auto write = [&](const std::string& name, double cosine, double sine) {
        std::ofstream{folder / name} << fmt::format(
            R"({{"view": [{0}, 0, {1}, 0, 0, 1, 0, 0, {2}, 0, {0}, 0, {3}, 0, {4}, 1],
            "projection": [2, 0, 0, 0, 0, 2.6666666666666665, 0, 0, 0, 0, -1.25, -1, 0, 0, -4.5, 0]}})",
            cosine, -sine, sine, -9 * sine, -9 * cosine);
    };
    write("ahead.json", 1, 0);
    write("right.json", c, s);
    REQUIRE(
        shell(folder, "strata render teapot --size 64x48 --camera right.json --algorithm front_to_back -q -o port.png")
            .status == 0);
    const CommandResult found = shell(folder, "strata compare teapot port.png --camera ahead.json");
    CHECK(number_before(lines_of(found.out)[0], " degrees; ") == Approx(0.5).margin(0.06));
    CHECK(lines_of(found.out)[0].find("the eye is turned to the right by") != std::string::npos);
}
