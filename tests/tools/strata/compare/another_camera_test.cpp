// Tests what `strata compare` says of a picture from a camera a little off: the amounts are those that render drew
// with.
#include <fmt/format.h>

#include <catch2/catch.hpp>

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
