// Tests verdicts on the renderer's own pictures, which are right by definition, and on copies that are wrong at changed
// pixels.
#include "tools/oracle/verdict/verdict.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/opened_scene.h"

using namespace strata;
using namespace strata::oracle::verdict;
using strata::test::OpenedScene;

namespace {

constexpr pipeline::Format formats[] = {pipeline::Format::rgba8, pipeline::Format::rgba16f, pipeline::Format::rgba32f};

Verdict judged(SceneFragments& fragments, const oracle::TargetImage& picture) {
    return judge(fragments, Colors{picture});
}

// The names of all exact algorithms and formats whose pictures are not called right.
std::vector<std::string> not_right(const OpenedScene& opened) {
    SceneFragments fragments = opened.fragments();
    std::vector<std::string> names;
    for (const peeling::Algorithm& algorithm : peeling::algorithms())
        for (const pipeline::Format format : formats) {
            const auto picture = algorithm.exact ? opened.picture(algorithm.name, format) : std::nullopt;
            if (picture && !judged(fragments, *picture).is_right)
                names.push_back(algorithm.name + " in " + std::string{pipeline::info(format).name});
        }
    return names;
}

}  // namespace

TEST_CASE("the picture of every exact algorithm in every format is right", "[long]") {
    CHECK(not_right(OpenedScene{"showroom", 40, 30}).empty());
    OpenedScene ties{"random:seed=7,triangles=60", 24, 24};
    CHECK(not_right(ties) == std::vector<std::string>{});
    ties.profile = *pipeline::find_profile("llvmpipe");
    CHECK(not_right(ties) == std::vector<std::string>{});
}

TEST_CASE("a pixel changed by more than rounding allows is the only wrong one") {
    const OpenedScene opened{"teapot", 48, 36};
    oracle::TargetImage picture = *opened.picture("dual", pipeline::Format::rgba8);
    SceneFragments fragments = opened.fragments();
    const Verdict right = judged(fragments, picture);
    CHECK(right.is_right);
    CHECK(right.right.pixels == 48 * 36);
    picture.codes[4 * (30 * 48 + 24)] += 4;  // on a plane that faces the eye, where snapping changes no colour
    const Verdict wrong = judged(fragments, picture);
    CHECK_FALSE(wrong.is_right);
    CHECK(wrong.right.wrong_pixels == std::vector<std::uint32_t>{30 * 48 + 24});
}

TEST_CASE("a picture blended in submission order is wrong") {
    const OpenedScene opened{"teapot", 48, 36};
    SceneFragments fragments = opened.fragments();
    const Verdict found = judged(fragments, *opened.picture("unsorted", pipeline::Format::rgba8));
    CHECK_FALSE(found.is_right);
    CHECK(found.right.wrong_pixels.size() > 50);
}

TEST_CASE("the reported hypothesis has the formats with which the picture was made") {
    const OpenedScene opened{"showroom", 64, 64};
    SceneFragments fragments = opened.fragments();
    const Verdict codes = judged(fragments, *opened.picture("front_to_back", pipeline::Format::rgba8));
    CHECK(codes.right.account.hypothesis.order == Order::under);
    CHECK(codes.right.account.hypothesis.front ==
          End{Storage::unorm8, SourceRounding::premultiplied, Rounding::nearest});
    CHECK(codes.right.ties.rule == TieHandling::unique);
    const Verdict floats = judged(fragments, *opened.picture("a_buffer", pipeline::Format::rgba8));
    CHECK(floats.right.account.hypothesis.front.storage == Storage::single);
    CHECK(floats.right.observed <= floats.right.possible);
    CHECK(floats.right.ties.rule == TieHandling::first);
    CHECK(floats.right.has_one_tie_rule);
}
