// Expected values: the renderer's own pictures of exact algorithms are right by definition; a peel that stops early
// leaves out the layers behind, whatever composites the others.
#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tools/oracle/program/fit/fitting.h"

using namespace strata;
using namespace strata::test;

namespace {

std::string text_of(const OpenedScene& opened, const oracle::TargetImage& picture) {
    const oracle::verdict::SceneFragments fragments = opened.fragments();
    return to_text(oracle::program::fit(oracle::program::lists_of(fragments, oracle::verdict::Colors{picture})));
}

}  // namespace

TEST_CASE("pictures of every exact algorithm are right in every format") {
    constexpr pipeline::Format formats[] = {pipeline::Format::rgba8, pipeline::Format::rgba16f,
                                            pipeline::Format::rgba32f};
    std::vector<std::string> wrong;
    for (const char* scene : {"showroom", "teapot", "random:seed=5"}) {
        const OpenedScene opened{scene, 48, 36};
        for (const peeling::Algorithm& algorithm : peeling::algorithms())
            for (const pipeline::Format format : formats) {
                const auto picture = algorithm.exact ? opened.picture(algorithm.name, format) : std::nullopt;
                if (!picture) continue;
                const std::string text = text_of(opened, *picture);
                if (!text.starts_with("right: "))
                    wrong.push_back(std::string{scene} + " " + algorithm.name + " in " +
                                    std::string{pipeline::info(format).name} + ": " + text);
            }
    }
    CHECK(wrong == std::vector<std::string>{});
}

TEST_CASE("a peel of two passes leaves out what lies behind two layers") {
    OpenedScene opened{"volume-beam:slices=8", 64, 48};
    opened.options.max_passes = 2;
    const auto picture = opened.picture("front_to_back", pipeline::Format::rgba8);
    REQUIRE(picture);
    opened.options.max_passes = peeling::RenderOptions{}.max_passes;
    const std::string text = text_of(opened, *picture);
    INFO(text);
    CHECK(text.starts_with("wrong: "));
    CHECK(text.find("fragments with rank from the front at least 2 are left out") != text.npos);
}

TEST_CASE("rows of a scene's lists are those of the picture: a mistake in the upper half is found there", "[slow]") {
    const OpenedScene opened{"teapot", 64, 48};
    auto picture = opened.picture("front_to_back", pipeline::Format::rgba8);
    REQUIRE(picture);
    for (std::size_t y = 0; y < 20; ++y)
        for (std::size_t x = 0; x < 64; ++x)
            std::swap(picture->codes[4 * (64 * y + x)], picture->codes[4 * (64 * y + x) + 2]);
    const std::string text = text_of(opened, *picture);
    INFO(text);
    CHECK(text.starts_with("wrong: red and blue of the picture are exchanged at pixels with y below 20\n"));
}
