// Tests the comparison of two folders by the library, on PPM files of a few pixels whose bytes are written here.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "strata/strata.h"
#include "tests/tools/oracle/folders/two_folders.h"

using Catch::Matchers::Contains;
using strata::test::TwoFolders;

namespace {

std::string two_pixels(char first, char second) {
    return "P6\n2 1\n255\n" + std::string(3, first) + std::string(3, second);
}

}  // namespace

TEST_CASE("the library compares two folders by name as text, JSON and JUnit") {
    const TwoFolders folders;
    folders.write_reference("a.ppm", two_pixels('a', 'b'));
    folders.write_candidate("a.ppm", two_pixels('a', 'b'));
    folders.write_reference("b.ppm", two_pixels('a', 'b'));
    folders.write_candidate("b.ppm", two_pixels('a', 'e'));
    folders.write_reference("c.ppm", two_pixels('a', 'b'));
    const auto compared = strata::compare_folders(folders.reference(), folders.candidate());
    CHECK_FALSE(compared.is_accepted());
    REQUIRE(compared.cases.size() == 3);
    CHECK(compared.cases[1].state == strata::oracle::CaseState::different);
    CHECK(compared.cases[2].state == strata::oracle::CaseState::missing);
    CHECK_THAT(strata::to_text(compared), Catch::StartsWith("different: 2 of 3 pictures fail: 1 different, 1 missing\n"
                                                            "a.ppm: equal\nb.ppm: different: 1 of 2 pixels differ"));
    CHECK(nlohmann::json::parse(strata::to_json(compared)).dump().find("b.ppm") != std::string::npos);
    CHECK_THAT(strata::to_junit(compared), Contains("tests=\"3\"") && Contains("failures=\"2\""));
}

TEST_CASE("tolerances and patterns of names are those of the command") {
    const TwoFolders folders;
    folders.write_reference("menu-expected.ppm", two_pixels('a', 'b'));
    folders.write_reference("menu@mac.ppm", two_pixels('a', 'f'));
    folders.write_candidate("menu-actual.ppm", two_pixels('a', 'e'));
    const auto accepted = [&](std::uint32_t codes, const strata::FolderNames& names) {
        return strata::compare_folders(folders.reference(), folders.candidate(), {.color_codes = codes}, names)
            .is_accepted();
    };
    const std::string names = "{name}-expected.ppm,{name}-actual.ppm";
    CHECK_FALSE(accepted(2, {names, ""}));
    CHECK(accepted(3, {names, ""}));
    CHECK(accepted(1, {names, "{name}@*.ppm"}));
    CHECK_THROWS_WITH(accepted(0, {"menu.ppm", ""}),
                      "folders: names: expected patterns with {name} such as '{name}.png', found 'menu.ppm'");
    CHECK_THROWS_WITH(accepted(0, {names, "a,b"}), Contains("folders: baselines: expected patterns with {name}"));
    CHECK_THROWS_AS(strata::compare_folders(folders.reference() + "x", folders.candidate()), strata::InputError);
}
