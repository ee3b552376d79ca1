// Tests the diagnosis over several scenes, with one mistake in the pictures of all scenes or a different one in each.
#include "tools/oracle/diagnosis/scenes_diagnosis.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/oracle/diagnosis/scenes_of_test.h"

using namespace strata;
using namespace strata::oracle;
using strata::test::SceneFixture;

namespace {

// A scene of the suite with the pictures of all mistakes, made once for all tests.
struct SceneBench {
    explicit SceneBench(const char* name) : bench{name}, mistake_images{bench.mistake_renderer} {}
    SceneFixture bench;
    MistakeImages mistake_images;
};

const SceneBench& random_peel() {
    static const SceneBench scene{"random.front_to_back"};
    return scene;
}
const SceneBench& planes_peel() {
    static const SceneBench scene{"planes.front_to_back"};
    return scene;
}
const SceneBench& averaged() {
    static const SceneBench scene{"showroom.weighted_average"};
    return scene;
}

ScenesDiagnosis diagnosed(const SceneBench& first, const Picture& made_of_first, const SceneBench& second,
                          const Picture& made_of_second) {
    return diagnose_scenes(
        {{.name = "first", .mistake_images = &first.mistake_images, .candidate = &made_of_first},
         {.name = "second", .mistake_images = &second.mistake_images, .candidate = &made_of_second}});
}

std::vector<std::string_view> first_names(const ScenesDiagnosis& diagnosis) {
    std::vector<std::string_view> names;
    for (const Mistake* mistake : diagnosis.findings.front().mistakes) names.push_back(mistake->name);
    return names;
}

using FirstNames = std::vector<std::string_view>;

}  // namespace

TEST_CASE("a port whose pictures are correct in every scene is correct") {
    const ScenesDiagnosis found = diagnosed(random_peel(), random_peel().bench.mistake_renderer.right(), planes_peel(),
                                            planes_peel().bench.mistake_renderer.right());
    CHECK(found.conclusion == Conclusion::right);
    CHECK(found.differing == 0);
    CHECK(found.findings.front().mistakes.empty());
}

TEST_CASE("of two mistakes with equal pictures in one scene another scene identifies the one that was made") {
    const Picture peeled = random_peel().bench.with("order_reversed");
    const Diagnosis alone = random_peel().mistake_images.diagnose(peeled);
    CHECK(alone.findings.front().mistakes[0]->name == "last_of_equals");
    const ScenesDiagnosis both = diagnosed(random_peel(), peeled, averaged(), averaged().bench.with("order_reversed"));
    CHECK(both.conclusion == Conclusion::one_mistake);
    CHECK(first_names(both) == FirstNames{"order_reversed"});
    CHECK(both.findings.front().alike.empty());
    CHECK(both.findings.front().fits == std::vector<bool>{true, true});
}

TEST_CASE("a mistake that one scene hides is identified by the other") {
    REQUIRE_FALSE(random_peel().mistake_images.shows(*find_mistake("depth_stepwise")));
    const ScenesDiagnosis found = diagnosed(random_peel(), random_peel().bench.with("depth_stepwise"), planes_peel(),
                                            planes_peel().bench.with("depth_stepwise"));
    CHECK(found.conclusion == Conclusion::one_mistake);
    CHECK(first_names(found) == FirstNames{"depth_stepwise"});
    CHECK(found.scenes[0].conclusion == Conclusion::right);
}

TEST_CASE("two simultaneous mistakes are identified over several scenes") {
    const ScenesDiagnosis found = diagnosed(random_peel(), random_peel().bench.with("culls_all_backs", "red_for_blue"),
                                            planes_peel(), planes_peel().bench.with("culls_all_backs", "red_for_blue"));
    CHECK(found.conclusion == Conclusion::two_mistakes);
    CHECK(first_names(found) == FirstNames{"culls_all_backs", "red_for_blue"});
}

TEST_CASE("a scene whose colours are all one code off gets the mistake that explains the others") {
    const Picture peeled = random_peel().bench.with("red_for_blue");
    const auto off_by_one = [](Picture picture) {
        for (std::uint32_t& code : picture.targets[0].codes) code = code < 255 ? code + 1 : 254;
        return picture;
    };
    const Picture planes = off_by_one(planes_peel().bench.with("red_for_blue"));
    CHECK(planes_peel().mistake_images.diagnose(planes).is_nearly);
    const ScenesDiagnosis found = diagnosed(random_peel(), peeled, planes_peel(), planes);
    CHECK(found.conclusion == Conclusion::one_mistake);
    CHECK(first_names(found) == FirstNames{"red_for_blue"});
    // If both scenes are one code off, most pixels differ from the right ones by more.
    CHECK(first_names(diagnosed(random_peel(), off_by_one(peeled), planes_peel(), planes)) ==
          FirstNames{"red_for_blue"});
    CHECK(diagnosed(random_peel(), off_by_one(random_peel().bench.mistake_renderer.right()), planes_peel(),
                    off_by_one(planes_peel().bench.mistake_renderer.right()))
              .conclusion == Conclusion::unknown_mistake);
}

TEST_CASE("a port with a different mistake in each scene has no known mistake") {
    const ScenesDiagnosis found = diagnosed(random_peel(), random_peel().bench.with("not_premultiplied"), planes_peel(),
                                            planes_peel().bench.with("upside_down"));
    CHECK(found.conclusion == Conclusion::unknown_mistake);
    CHECK(std::ranges::count(found.findings.front().fits, true) == 1);
    const std::vector<SceneReport> reports{
        {"first", compare(random_peel().bench.mistake_renderer.right(), random_peel().bench.with("not_premultiplied"))},
        {"second", compare(planes_peel().bench.mistake_renderer.right(), planes_peel().bench.with("upside_down"))}};
    const std::string text = to_text(found, reports);
    CHECK_THAT(text, Catch::StartsWith("none that is known"));
    CHECK_THAT(text, Catch::Contains("  first: ") && Catch::Contains("(not_premultiplied)") &&
                         Catch::Contains("(upside_down)"));
    const auto document = nlohmann::json::parse(to_json(found, reports));
    CHECK(document["verdict"] == "unknown_mistake");
    CHECK(document["scenes"][1]["mistakes"][0] == "upside_down");
    CHECK(document["scenes"][0]["kinds"][0]["pixels"].get<int>() > 0);
}
