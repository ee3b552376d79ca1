// Tests the diagnosis on pictures with a known mistake. The expected numbers of pixels are counted by a loop over both
// pictures.
#include "tools/oracle/diagnosis/diagnosis.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/oracle/diagnosis/scenes_of_test.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"

using namespace strata;
using namespace strata::oracle;
using strata::test::SceneFixture;

namespace {

std::uint64_t equal_pixels(const Picture& a, const Picture& b) {
    std::uint64_t equal = 0;
    for (std::size_t i = 0; i < a.targets[0].pixels(); ++i) {
        bool is_equal = true;
        for (int c = 0; c < a.targets[0].channels; ++c)
            is_equal &= a.targets[0].at(i, c).word == b.targets[0].at(i, c).word;
        equal += is_equal ? 1 : 0;
    }
    return equal;
}

std::vector<std::string_view> names_of(const Finding& finding) {
    std::vector<std::string_view> names;
    for (const Mistake* mistake : finding.mistakes) names.push_back(mistake->name);
    return names;
}

}  // namespace

TEST_CASE("the correct picture is diagnosed as correct and no mistake is listed before that") {
    const SceneFixture bench{"showroom.front_to_back"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    const Diagnosis found = mistake_images.diagnose(bench.mistake_renderer.right());
    CHECK(found.conclusion == Conclusion::right);
    CHECK(found.differing == 0);
    CHECK(found.findings.front().mistakes.empty());
    CHECK(found.findings.front().agreeing == found.pixels);
    CHECK(found.tried > 40);
    CHECK(found.tried + found.hidden + found.impossible == static_cast<int>(catalogue().size()));
}

TEST_CASE("one mistake is identified with the number of pixels that it explains") {
    const SceneFixture bench{"showroom.front_to_back"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    for (const char* name : {"one_pass_too_few", "last_of_equals", "depth_16", "srgb_twice", "half_pixel_up"}) {
        const Picture picture = bench.with(name);
        const Diagnosis found = mistake_images.diagnose(picture);
        INFO(name);
        CHECK(found.conclusion == Conclusion::one_mistake);
        const Finding& best = found.findings.front();
        const auto is_alike = [&](const Mistake* m) { return m->name == name; };
        CHECK((names_of(best)[0] == name || std::ranges::any_of(best.alike, is_alike)));
        CHECK(best.agreeing == found.pixels);
        CHECK(best.explained == found.differing);
        CHECK(best.contradicted == 0);
        CHECK(found.differing == found.pixels - equal_pixels(bench.mistake_renderer.right(), picture));
    }
}

TEST_CASE("two simultaneous mistakes are identified") {
    const SceneFixture bench{"showroom.dual"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    for (const auto& [first, second] :
         {std::pair{"one_pass_too_few", "flipped_rows"}, std::pair{"culls_front", "mask_ignored"},
          std::pair{"premultiplied_twice", "background_lost"}}) {
        const Diagnosis found = mistake_images.diagnose(bench.with(first, second));
        INFO(first << " and " << second);
        CHECK(found.conclusion == Conclusion::two_mistakes);
        const auto names = names_of(found.findings.front());
        CHECK(std::ranges::find(names, first) != names.end());
        CHECK(std::ranges::find(names, second) != names.end());
        CHECK(found.pairs_tried > 0);
    }
}

TEST_CASE(
    "a picture of no known mistake has that verdict and the best finding has the number of pixels that it explains") {
    const SceneFixture bench{"showroom.weighted_sum"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    Picture spoiled = bench.with("flipped_rows");
    const std::uint64_t pixels = spoiled.targets[0].pixels();
    for (std::size_t i = 0; i < pixels; i += 97) spoiled.targets[0].codes[4 * i] ^= 0x55;
    const Diagnosis found = mistake_images.diagnose(spoiled);
    CHECK(found.conclusion == Conclusion::unknown_mistake);
    const Finding& best = found.findings.front();
    const auto names = names_of(best);
    CHECK(std::ranges::find(names, "flipped_rows") != names.end());
    CHECK(best.agreeing >= pixels - (pixels + 96) / 97);
    CHECK(best.agreeing < pixels);
    const std::string text = to_text(found, compare(bench.mistake_renderer.right(), spoiled));
    CHECK_THAT(text, Catch::StartsWith("none that is known"));
    CHECK_THAT(text, Catch::Contains("compare: different"));
    const nlohmann::json document = json_of(found, compare(bench.mistake_renderer.right(), spoiled));
    CHECK(document["verdict"] == "unknown_mistake");
    CHECK(document["findings"].size() == found.findings.size());
    CHECK(document["comparison"]["equal"] == false);
}

TEST_CASE("a picture in which nothing is drawn is not evidence of two mistakes") {
    const SceneFixture bench{"showroom.dual"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    Picture blank = bench.mistake_renderer.right();
    auto& codes = blank.targets[0].codes;
    for (std::size_t i = 4; i < codes.size(); ++i) codes[i] = codes[i % 4];
    const Diagnosis found = mistake_images.diagnose(blank);
    CHECK(found.conclusion == Conclusion::unknown_mistake);
    CHECK(found.pairs_tried == 0);
    CHECK(found.is_blank);
    const std::string text = to_text(found, compare(bench.mistake_renderer.right(), blank));
    CHECK_THAT(text, Catch::StartsWith("none that is known: the picture has one colour everywhere: "));
    // Zero in every channel, as a target that was never written: two mistakes would explain it, and so would many
    // others.
    std::ranges::fill(codes, 0);
    CHECK(mistake_images.diagnose(blank).conclusion == Conclusion::unknown_mistake);
    codes[codes.size() / 2] ^= 1;
    CHECK(mistake_images.diagnose(blank).pairs_tried > 0);
    CHECK_FALSE(mistake_images.diagnose(blank).is_blank);
}

TEST_CASE("colours within the tolerance count as equal and the default tolerance is zero") {
    const SceneFixture bench{"showroom.weighted_sum"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    Picture rounded = bench.with("red_for_blue");
    for (std::uint32_t& code : rounded.targets[0].codes) code = code < 254 ? code + 2 : code;
    CHECK(mistake_images.diagnose(rounded).conclusion == Conclusion::unknown_mistake);
    const Diagnosis found = mistake_images.diagnose(rounded, {.color_codes = 2});
    CHECK(found.conclusion == Conclusion::one_mistake);
    CHECK(names_of(found.findings.front())[0] == "red_for_blue");
}

TEST_CASE("a picture that no option explains but that is at most two codes away is reported with that tolerance") {
    const SceneFixture bench{"showroom.weighted_sum"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    const Picture right = bench.mistake_renderer.right();
    for (const std::uint32_t distance : {1u, 2u, 3u}) {
        Picture rounded = right;
        std::vector<std::uint32_t>& codes = rounded.targets[0].codes;
        for (std::size_t i = 0; i < codes.size(); i += 7) codes[i] += codes[i] + distance <= 255 ? distance : 0;
        const Diagnosis found = mistake_images.diagnose(rounded);
        REQUIRE(found.conclusion == Conclusion::unknown_mistake);
        const std::string text = to_text(found, compare(right, rounded));
        INFO(text);
        CHECK((text.find("--tolerance color=" + std::to_string(distance) + " accepts it\n") != std::string::npos) ==
              (distance < 3));
    }
}
