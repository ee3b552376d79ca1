// Tests the Catch2 matcher on pictures of 4 x 2 pixels written by hand, and the files that a failure writes.
#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "strata/catch2.h"
#include "strata/strata.h"
#include "tests/tools/oracle/picture/own_file.h"
#include "tools/oracle/pack/golden.h"

using Catch::Matchers::Contains;

namespace {

// Sets STRATA_PICTURES to a folder that does not exist yet and is deleted when the test ends.
class PictureFolder {
  public:
    PictureFolder() { setenv("STRATA_PICTURES", folder_.path().c_str(), 1); }
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;
    ~PictureFolder() {
        unsetenv("STRATA_PICTURES");
        std::filesystem::remove_all(folder_.path());
    }
    [[nodiscard]] std::filesystem::path path() const { return folder_.path(); }

  private:
    strata::test::OwnFile folder_{""};
};

// Red codes of row 1 from the left; alpha 255.
strata::Picture row_of_reds(const std::array<unsigned char, 4>& reds) {
    std::array<unsigned char, 4 * 2 * 4> bytes{};
    for (std::size_t i = 0; i < 8; ++i) bytes[4 * i + 3] = 255;
    for (std::size_t x = 0; x < 4; ++x) bytes[4 * (4 + x)] = reds[x];
    return strata::from_memory(bytes.data(), bytes.size(), "4x2:rgba8");
}

const strata::Reference& reds() {
    static const strata::Reference reference{row_of_reds({10, 20, 30, 40}), "some/red row.exr"};
    return reference;
}

}  // namespace

TEST_CASE("an equal picture matches and no file is written") {
    const PictureFolder folder;
    CHECK_THAT(row_of_reds({10, 20, 30, 40}), strata::MatchesReference(reds()));
    CHECK_FALSE(std::filesystem::exists(folder.path()));
}

TEST_CASE("a failure's message has the kind and number and first pixel of the differences and the pictures' path") {
    const PictureFolder folder;
    const strata::MatchesReference matcher{reds()};
    CHECK_FALSE(matcher.match(row_of_reds({10, 20, 31, 44})));
    const std::string side = (folder.path() / "red_row.exr.side.png").string();
    CHECK_THAT(matcher.describe(), Contains("color at 2 pixels, first at (2, 1)"));
    CHECK_THAT(matcher.describe(), Contains("some/red row.exr") && Contains(side));
    const strata::Picture left = strata::read_picture(side);
    CHECK(left.targets[0].width > 3 * 4);  // three pictures and separating lines
}

TEST_CASE("a tolerance accepts differences up to its number of codes") {
    const PictureFolder folder;
    strata::Tolerances two;
    two.color_codes = 2;
    CHECK_THAT(row_of_reds({12, 18, 30, 40}), strata::MatchesReference(reds(), two));
    CHECK_THAT(row_of_reds({13, 20, 30, 40}), !strata::MatchesReference(reds(), two));
}

TEST_CASE("pictures of unequal size are a failure with a message and not an error") {
    const std::array<unsigned char, 4> one{1, 2, 3, 4};
    const auto checked = strata::check(strata::from_memory(one.data(), one.size(), "1x1:rgba8"), reds());
    CHECK_FALSE(checked.is_accepted);
    CHECK_THAT(checked.message, Contains("cannot be compared") && Contains("4x2") && Contains("1x1"));
}

TEST_CASE("if pictures cannot be written the failure still reports the difference") {
    const strata::test::OwnFile file{"", "not a folder"};
    setenv("STRATA_PICTURES", file.path().c_str(), 1);
    const auto checked = strata::check(row_of_reds({11, 20, 30, 40}), reds());
    unsetenv("STRATA_PICTURES");
    CHECK_FALSE(checked.is_accepted);
    CHECK_THAT(checked.message, Contains("color at 1 pixels, first at (0, 1)") && Contains("no picture could be left"));
}

TEST_CASE("a golden pack is a reference for each of its algorithms") {
    const strata::test::OwnFile folder{""};
    strata::oracle::Golden golden;
    golden.scene = strata::scenes::load_scene("volume-beam:slices=4", {});
    golden.scene.own_view = strata::scenes::orbit_view(golden.scene.bounds, 30, 20, 1.5);
    golden.profile = strata::profile("geforce8");
    golden.options.width = 12;
    golden.options.height = 8;
    golden.algorithms = {&strata::algorithm("unsorted"), &strata::algorithm("weighted_average")};
    strata::oracle::write_pack(golden, folder.path());

    const PictureFolder pictures;
    strata::Scene scene{"volume-beam:slices=4"};
    scene.look(*golden.scene.own_view);
    for (const char* name : {"unsorted", "weighted_average"}) {
        const auto mine =
            strata::render(scene, strata::algorithm(name), golden.profile, {.width = 12, .height = 8}).picture();
        CHECK_THAT(mine, strata::MatchesReference(strata::Reference(folder.path(), name)));
        CHECK_THAT(mine, strata::MatchesReference(strata::Reference(folder.path() + "/manifest.json", name)));
        const char* other = name == std::string{"unsorted"} ? "weighted_average" : "unsorted";
        CHECK_THAT(mine, !strata::MatchesReference(strata::Reference(folder.path(), other)));
    }
    CHECK_THROWS_WITH(strata::Reference(folder.path()),
                      Contains("algorithm: expected unsorted, weighted_average, found ''"));
    CHECK_THROWS_WITH(strata::Reference(folder.path(), "unsortd"), Contains("did you mean 'unsorted'?"));
    CHECK_THROWS_WITH(strata::Reference("some.exr", "dual"), Contains("some.exr: algorithm: expected none"));
    std::filesystem::remove_all(folder.path());
}

TEST_CASE("a missing reference file is reported by its name") {
    const strata::test::OwnFile missing{".exr"};
    CHECK_THROWS_WITH(strata::Reference{missing.path()}, Contains(missing.path()));
}
