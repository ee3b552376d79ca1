// Tests that the diagnosis finds the option with which a picture was made.
#include "tools/oracle/emulations/allowed_options.h"

#include <catch2/catch.hpp>
#include <set>

#include "peeling/registry.h"
#include "tests/tools/oracle/diagnosis/scenes_of_test.h"
#include "tools/oracle/diagnosis/diagnosis_report.h"

using namespace strata;
using namespace strata::oracle;
using strata::test::SceneFixture;

namespace {

const Mistake& option_of(const std::vector<Mistake>& all, const char* name) {
    return *std::ranges::find(all, name, &Mistake::name);
}

bool names(const Finding& finding, const char* name) {
    const auto is = [&](const Mistake* m) { return m->name == name; };
    return std::ranges::any_of(finding.mistakes, is) || std::ranges::any_of(finding.alike, is);
}

}  // namespace

TEST_CASE(
    "options have unique names that no mistake has and limits of passes end below the number that the picture takes") {
    const peeling::Algorithm& front_to_back = *peeling::find_algorithm("front_to_back");
    const std::vector<Mistake> all = allowed_options(front_to_back, {.passes = 5, .enough_passes = 4});
    std::set<std::string> names, descriptions;
    for (const Mistake& option : all) {
        names.insert(option.name);
        descriptions.insert(option.description);
        CHECK(find_mistake(option.name) == nullptr);
    }
    CHECK(names.size() == all.size());
    CHECK(descriptions.size() == all.size());
    CHECK(names.contains("passes_3"));
    CHECK_FALSE(names.contains("passes_4"));
    pipeline::DeviceProfile mine = *pipeline::find_profile("geforce8");
    mine.name = "mine";
    CHECK(allowed_options(front_to_back, {}, {&mine, 1}).size() == allowed_options(front_to_back, {}).size() + 1);
    CHECK(option_of(all, "passes_3").description == "only the nearest 3 layers of 4 (--max-passes 3)");
    const auto of_dual = allowed_options(*peeling::find_algorithm("dual"), {.passes = 5, .enough_passes = 4});
    CHECK(option_of(of_dual, "passes_3").description == "only the first 3 passes of 4 (--max-passes 3)");
}

TEST_CASE("options are listed before mistakes and allowed ones are accepted and a limit of passes is a mistake") {
    const SceneFixture bench{"showroom.dual"};
    const std::vector<Mistake> all = allowed_options(*bench.opened.algorithm, bench.mistake_renderer.right_run());
    const MistakeImages mistake_images{bench.mistake_renderer, {}, all};
    for (const char* name :
         {"profile_llvmpipe", "blend_truncate", "accumulators_rgba16f", "format_rgba32f", "back_rgba32f"}) {
        INFO(name);
        const auto picture = bench.mistake_renderer.with(option_of(all, name));
        REQUIRE(picture);
        const Diagnosis found = mistake_images.diagnose(*picture);
        CHECK(found.conclusion == Conclusion::other_options);
        CHECK(names(found.findings.front(), name));
        CHECK_THAT(to_text(found, compare(bench.mistake_renderer.right(), *picture)),
                   Catch::StartsWith("right under other options: every pixel is that of: "));
    }
    for (const char* name : {"passes_1", "passes_2", "epsilon_2_10", "background_none"}) {
        INFO(name);
        const Diagnosis found = mistake_images.diagnose(bench.mistake_renderer.with(option_of(all, name)).value());
        CHECK(found.conclusion == Conclusion::one_mistake);
        CHECK(names(found.findings.front(), name));
        CHECK(found.findings.front().mistakes[0]->name.starts_with(std::string{name}.substr(0, 6)));
    }
    for (const char* name : {"vertex_paths_separate_fused", "vertex_paths_double_separate", "reference_path_exact"}) {
        INFO(name);
        const auto picture = bench.mistake_renderer.with(option_of(all, name));
        REQUIRE(picture);
        const Diagnosis found = mistake_images.diagnose(*picture);
        CHECK((found.conclusion == Conclusion::one_mistake || found.conclusion == Conclusion::right));
        if (found.conclusion == Conclusion::one_mistake) CHECK(names(found.findings.front(), name));
    }
    CHECK(mistake_images.diagnose(bench.mistake_renderer.right()).conclusion == Conclusion::right);
    CHECK(mistake_images.diagnose(bench.with("culls_front")).findings.front().mistakes[0]->name == "culls_front");
}

TEST_CASE("a resolved picture with other sample positions is right under that option") {
    const SceneFixture bench{"samples.front_to_back"};
    const std::vector<Mistake> all = allowed_options(*bench.opened.algorithm, bench.mistake_renderer.right_run());
    const MistakeImages mistake_images{bench.mistake_renderer, {}, all};
    OpenScene other = open(*find_suite_scene("samples.front_to_back"));
    other.profile.sample_positions = pipeline::SamplePositions::nv20;
    const Diagnosis found = mistake_images.diagnose(MistakeRenderer{other.input(), *other.algorithm}.right());
    CHECK(found.conclusion == Conclusion::other_options);
    CHECK(names(found.findings.front(), "sample_positions_nv20"));
    const SceneFixture single{"random.front_to_back"};
    for (const char* name : {"sample_positions_nv20", "sample_positions_standard"}) {
        CHECK_FALSE(single.mistake_renderer.with(option_of(all, name)));
    }
    CHECK_FALSE(bench.mistake_renderer.with(option_of(all, "sample_positions_standard")));
}

TEST_CASE("two simultaneous options are found and accepted if both are allowed") {
    const SceneFixture bench{"showroom.dual"};
    const std::vector<Mistake> all = allowed_options(*bench.opened.algorithm, bench.mistake_renderer.right_run());
    const MistakeImages mistake_images{bench.mistake_renderer, {}, all};
    const Mistake* const limited[] = {&option_of(all, "profile_llvmpipe"), &option_of(all, "passes_2")};
    const Diagnosis few = mistake_images.diagnose(bench.mistake_renderer.with(limited).value());
    CHECK(few.conclusion == Conclusion::two_mistakes);
    CHECK(names(few.findings.front(), "passes_2"));
    const Mistake* const both[] = {&option_of(all, "blend_truncate"), &option_of(all, "back_rgba16f")};
    CHECK(mistake_images.diagnose(bench.mistake_renderer.with(both).value()).conclusion == Conclusion::other_options);
}

TEST_CASE("where every triangle has one colour no mistake that needs colour slopes is made") {
    const SceneFixture flat{"planes.front_to_back"}, sloped{"showroom.front_to_back"};
    for (const char* name : {"colors_affine", "colors_unnormalised"}) {
        CHECK_FALSE(flat.mistake_renderer.with(*find_mistake(name)));
        CHECK(sloped.mistake_renderer.with(*find_mistake(name)));
    }
}
