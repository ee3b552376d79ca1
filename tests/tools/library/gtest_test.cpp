// Tests the GoogleTest matcher on pictures of 4 x 2 pixels written by hand.
#include "strata/gtest.h"

#include <gtest/gtest-spi.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace {

strata::Picture small_picture(unsigned char red) {
    std::array<unsigned char, 4 * 2 * 4> bytes{};
    for (std::size_t i = 0; i < bytes.size(); i += 4) bytes[i + 3] = 255;
    bytes[4 * 5] = red;  // (1, 1)
    return strata::from_memory(bytes.data(), bytes.size(), "4x2:rgba8");
}

const strata::Reference& reference() {
    static const strata::Reference made{small_picture(100), "by hand"};
    return made;
}

}  // namespace

TEST(MatchesReference, AcceptsAnEqualPicture) {
    EXPECT_THAT(small_picture(100), strata::MatchesReference(reference()));
    EXPECT_TRUE(strata::matches_reference(small_picture(100), reference()));
}

TEST(MatchesReference, NamesKindPixelAndPicturesOfADifference) {
    std::string pattern = (std::filesystem::temp_directory_path() / "strata-gtest-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    const std::filesystem::path folder{pattern};
    setenv("STRATA_PICTURES", folder.c_str(), 1);
    EXPECT_NONFATAL_FAILURE(EXPECT_THAT(small_picture(103), strata::MatchesReference(reference())),
                            "color at 1 pixels, first at (1, 1)");
    EXPECT_NONFATAL_FAILURE(EXPECT_TRUE(strata::matches_reference(small_picture(103), reference())),
                            (folder / "by_hand.side.png").string());
    EXPECT_NONFATAL_FAILURE(EXPECT_THAT(small_picture(103), strata::MatchesReference(reference())),
                            "4x2 color of 4 x unorm8");
    EXPECT_TRUE(std::filesystem::exists(folder / "by_hand.side.png"));
    std::filesystem::remove_all(folder);
    unsetenv("STRATA_PICTURES");
}

TEST(MatchesReference, ForgivesWhatATolerancePermits) {
    strata::Tolerances tolerances;
    tolerances.color_codes = 3;
    EXPECT_THAT(small_picture(103), strata::MatchesReference(reference(), tolerances));
    EXPECT_THAT(small_picture(104), testing::Not(strata::MatchesReference(reference(), tolerances)));
    std::filesystem::remove_all("strata-pictures");
}

TEST(MatchesScene, AcceptsARightPictureAndSaysTheVerdictOfAWrongOne) {
    const strata::Scene scene("planes:count=2");
    const strata::RenderOptions frame{.width = 16, .height = 12};
    const auto profile = strata::profile("geforce8");
    auto picture = strata::picture_of(strata::render(scene, strata::algorithm("dual"), profile, frame).color());
    EXPECT_TRUE(strata::matches_scene(picture, scene, profile, frame));
    for (std::size_t i = 0; i < picture.targets[0].codes.size(); i += 5) picture.targets[0].codes[i] ^= 0x55;
    EXPECT_NONFATAL_FAILURE(EXPECT_TRUE(strata::matches_scene(picture, scene, profile, frame)), "wrong: ");
}
