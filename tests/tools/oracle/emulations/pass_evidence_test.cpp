// Tests the diagnosis from passes. The candidate's passes are those of a run with a known mistake, or targets changed
// by hand.
#include "tools/oracle/emulations/pass_evidence.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/diagnosis/scenes_of_test.h"
#include "tools/oracle/pack/pack_pictures.h"

using namespace strata;
using namespace strata::oracle;
using strata::test::SceneFixture;

namespace {

constexpr int limit = 60;  // passes after which an endless peel gives up

// One target per sample, as candidate_pictures reads them.
void add_target(const NamedImage& named, std::vector<TargetImage>& targets) {
    const auto count = static_cast<std::size_t>(named.image.samples);
    const auto channels = static_cast<std::size_t>(named.image.channels());
    for (std::size_t sample = 0; sample < count; ++sample) {
        pipeline::Image one{named.image.format, named.image.width, named.image.height};
        for (std::size_t i = 0; i < one.codes.size(); ++i)
            one.codes[i] = named.image.codes[(i / channels * count + sample) * channels + i % channels];
        const std::string ending = count == 1 ? "" : ".sample" + std::to_string(sample);
        targets.push_back(as_target(one, named.name + ending));
    }
}

// The passes that a port with this mistake would write; those of a correct run for nullptr.
std::vector<PassPicture> passes_with(const OpenScene& opened, const char* mistake) {
    AlteredRun e{.list = &opened.scene.list, .view = opened.view, .profile = opened.profile, .options = opened.options};
    e.algorithm = opened.algorithm;
    e.options.max_passes = limit;
    e.right = {.passes = 9, .enough_passes = 9};
    if (mistake != nullptr) REQUIRE(find_mistake(mistake)->make(e));
    const pipeline::Alteration alteration = combined(e);
    std::vector<PassPicture> all;
    passes(
        {*e.list, e.view, e.profile, e.options}, *e.algorithm,
        [&](PassReport&& pass) {
            if (pass.kind == ReportedPassKind::published) return;
            all.push_back({.number = pass.number, .iteration = pass.iteration, .has_own = true});
            for (const NamedImage& target : pass.targets) add_target(target, all.back().targets.targets);
        },
        e.alterations.empty() ? nullptr : &alteration);
    return all;
}

Diagnosis diagnosed(const MistakeImages& mistake_images, const Picture& picture,
                    const std::vector<PassPicture>& passes) {
    return mistake_images.diagnose(picture, {}, {}, &passes);
}

const Finding& first_of(const Diagnosis& diagnosis) { return diagnosis.findings.front(); }

}  // namespace

TEST_CASE("equal passes are counted and the first different one is reported") {
    const SceneFixture bench{"random.dual"};
    std::vector<PassPicture> passes = passes_with(bench.opened, nullptr);
    const auto whole = bench.mistake_renderer.compare_passes({}, passes);
    REQUIRE(whole);
    CHECK(whole->is_whole());
    CHECK(whole->alike == whole->targets);
    CHECK(whole->targets > static_cast<int>(passes.size()));
    passes[3].targets.targets.back().codes[5] ^= 1;
    passes.erase(passes.begin() + 1);  // a pass that the candidate lacks is not compared
    const auto one_less = bench.mistake_renderer.compare_passes({}, passes);
    REQUIRE(one_less);
    CHECK(one_less->first_unlike == 3);
    CHECK(one_less->alike == one_less->targets - 1);
    CHECK(one_less->targets < whole->targets);
}

TEST_CASE("passes of several samples are compared sample by sample and name a mistake that the picture hides") {
    const SceneFixture bench{"samples.front_to_back"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    std::vector<PassPicture> passes = passes_with(bench.opened, nullptr);
    const auto whole = bench.mistake_renderer.compare_passes({}, passes);
    REQUIRE(whole);
    CHECK(whole->is_whole());
    CHECK(whole->targets >= 4 * static_cast<int>(passes.size()));
    TargetImage& last_sample = passes[2].targets.targets.back();
    REQUIRE(last_sample.name.ends_with(".sample3"));
    last_sample.codes[7] ^= 1;
    CHECK(bench.mistake_renderer.compare_passes({}, passes)->first_unlike == 2);
    for (const char* name : {"peel_loads_sample_0", "ping_pong_not_swapped", "sample_0_for_all"}) {
        const Diagnosis found = diagnosed(mistake_images, bench.with(name), passes_with(bench.opened, name));
        INFO(name);
        CHECK(found.conclusion == Conclusion::one_mistake);
        CHECK(first_of(found).mistakes[0]->name == name);
    }
}

TEST_CASE("of mistakes with equal pictures the passes identify the one that was made") {
    const SceneFixture bench{"random.dual"};
    const MistakeRenderer mistake_renderer{bench.opened.input(), *bench.opened.algorithm, Depths::left_out, limit};
    const MistakeImages mistake_images{mistake_renderer};
    // Both have the same picture because nothing is ever peeled.
    for (const char* name : {"min_for_max", "add_for_max"}) {
        const Picture picture = mistake_renderer.with(*find_mistake(name)).value();
        INFO(name);
        CHECK(mistake_images.diagnose(picture).findings.front().mistakes[0]->name == "min_for_max");
        const Diagnosis found = diagnosed(mistake_images, picture, passes_with(bench.opened, name));
        CHECK(found.conclusion == Conclusion::one_mistake);
        CHECK(first_of(found).mistakes[0]->name == name);
        CHECK(first_of(found).passes->is_whole());
    }
}

TEST_CASE("of two simultaneous mistakes the passes identify the one whose picture equals that of another") {
    const SceneFixture bench{"random.dual"};
    const MistakeRenderer mistake_renderer{bench.opened.input(), *bench.opened.algorithm, Depths::left_out, limit};
    const MistakeImages mistake_images{mistake_renderer};
    const Mistake* const both[] = {find_mistake("add_for_max"), find_mistake("red_for_blue")};
    const Picture picture = mistake_renderer.with(both).value();
    const auto passes = passes_with(bench.opened, "add_for_max");
    const Diagnosis found = diagnosed(mistake_images, picture, passes);
    CHECK(found.conclusion == Conclusion::two_mistakes);
    CHECK(first_of(found).mistakes[0]->name == "add_for_max");
    CHECK(first_of(found).mistakes.size() == 2);
}

TEST_CASE("a picture that hides a mistake is accepted and passes that show it are not") {
    const SceneFixture bench{"random.front_to_back"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    const Mistake& hidden = *find_mistake("depth_24");
    REQUIRE_FALSE(mistake_images.shows(hidden));
    const Diagnosis right =
        diagnosed(mistake_images, bench.mistake_renderer.right(), passes_with(bench.opened, nullptr));
    CHECK(right.conclusion == Conclusion::right);
    CHECK(right.right_passes->is_whole());
    const Diagnosis found =
        diagnosed(mistake_images, bench.mistake_renderer.right(), passes_with(bench.opened, "depth_24"));
    CHECK(found.conclusion == Conclusion::one_mistake);
    CHECK(first_of(found).mistakes[0]->name == "depth_24");
}

TEST_CASE("a mistake that explains the picture but whose passes differ as early as without it is not identified") {
    const SceneFixture bench{"random.front_to_back"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    std::vector<PassPicture> passes = passes_with(bench.opened, nullptr);
    for (PassPicture& pass : passes)
        for (TargetImage& target : pass.targets.targets)
            if (target.meaning == Meaning::color) target.codes[0] ^= 0xff;
    const Diagnosis found = diagnosed(mistake_images, bench.with("red_for_blue"), passes);
    CHECK(found.conclusion == Conclusion::unknown_mistake);
    CHECK(found.passes_contradict);
    CHECK(first_of(found).agreeing == found.pixels);
}

TEST_CASE("a few pixels of the first wrong pass do not contradict the mistake that explains the others but many do") {
    const SceneFixture bench{"random.front_to_back"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    for (const bool are_many : {false, true}) {
        std::vector<PassPicture> passes = passes_with(bench.opened, "half_pixel_right");
        for (TargetImage& target : passes[0].targets.targets)
            for (std::size_t i = 0; i < (are_many ? target.codes.size() : 4); ++i) target.codes[i] ^= 0x7f0000ff;
        const Diagnosis found = diagnosed(mistake_images, bench.with("half_pixel_right"), passes);
        CHECK(found.passes_contradict == are_many);
        CHECK((found.conclusion == Conclusion::one_mistake) == !are_many);
        CHECK(first_of(found).mistakes[0]->name == "half_pixel_right");
    }
}

TEST_CASE("a mistake that explains all pixels within one code is identified if that is no accident") {
    const SceneFixture bench{"showroom.weighted_sum"};
    const MistakeImages mistake_images{bench.mistake_renderer};
    Picture rounded = bench.with("red_for_blue");
    auto& codes = rounded.targets[0].codes;
    for (std::size_t i = 0; i < codes.size(); i += 40) codes[i] = codes[i] < 255 ? codes[i] + 1 : 254;
    const Diagnosis found = mistake_images.diagnose(rounded);
    CHECK(found.conclusion == Conclusion::one_mistake);
    CHECK(found.is_nearly);
    CHECK(first_of(found).mistakes[0]->name == "red_for_blue");
    CHECK(first_of(found).nearly == found.pixels);
    CHECK(first_of(found).agreeing < found.pixels);
    // No pixel equals the mistake's, but most differ from the correct ones by more than a code.
    Picture all_off = bench.with("red_for_blue");
    for (auto& code : all_off.targets[0].codes) code = code < 255 ? code + 1 : 254;
    CHECK(mistake_images.diagnose(all_off).is_nearly);
    CHECK(first_of(mistake_images.diagnose(all_off)).mistakes[0]->name == "red_for_blue");
    // A picture that is one code off but otherwise correct has no mistake.
    Picture off = bench.mistake_renderer.right();
    for (std::size_t i = 0; i < off.targets[0].codes.size(); i += 40)
        off.targets[0].codes[i] = off.targets[0].codes[i] < 255 ? off.targets[0].codes[i] + 1 : 254;
    const Diagnosis none = mistake_images.diagnose(off);
    CHECK(none.conclusion == Conclusion::unknown_mistake);
    CHECK_FALSE(none.is_nearly);
}

TEST_CASE("explaining all pixels within one code is evidence only if half are exact or a mistake moves half by more") {
    const Mistake mistake{.name = "mistake"}, option{.name = "option", .is_allowed = true};
    const Mistake *const one[] = {&mistake}, *const both[] = {&mistake, &mistake}, *const allowed[] = {&option};
    CHECK(is_evidence(one, 5, 10, 0));
    CHECK_FALSE(is_evidence(one, 4, 10, 4));
    CHECK(is_evidence(one, 0, 10, 5));
    CHECK_FALSE(is_evidence(both, 4, 10, 10));
    CHECK(is_evidence(both, 5, 10, 10));
    CHECK_FALSE(is_evidence(allowed, 4, 10, 10));
    CHECK_FALSE(is_evidence({}, 4, 10, 10));
}
