// Tests the library's verdict on pictures that the library renders with another format, and with layers lost.
#include "tools/oracle/judge/judge.h"

#include <strata/catch2.h>
#include <strata/strata.h>

#include <bit>
#include <catch2/catch.hpp>

#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/emulations/mistake_renderer.h"
#include "tools/oracle/suite/suite.h"

using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;

namespace {

const strata::Scene& teapot() {
    static const strata::Scene scene("teapot");
    return scene;
}

strata::Rendering drawn_teapot(const strata::RenderOptions& options) {
    return strata::render(teapot(), strata::algorithm("front_to_back"), strata::profile("geforce8"), options);
}

const strata::RenderOptions small_frame{.width = 48, .height = 36};

}  // namespace

TEST_CASE("the library calls a port with accumulators of another format right and diagnose names no mistake") {
    strata::RenderOptions halves = small_frame;
    halves.color_format = strata::pipeline::Format::rgba16f;
    halves.result_format = strata::pipeline::Format::rgba8;
    const auto picture = strata::picture_of(drawn_teapot(halves).color());
    const strata::Judgement found = strata::judge(teapot(), picture, strata::profile("geforce8"), small_frame);
    CHECK(found.is_right);
    CHECK_THAT(found.sentence, StartsWith("right: structure exact at "));
    CHECK(found.leads.empty());
    const auto diagnosed =
        strata::diagnose(teapot(), picture, strata::algorithm("dual"), strata::profile("geforce8"), small_frame);
    CHECK(diagnosed.is_right());
    CHECK(diagnosed.mistakes().empty());
}

TEST_CASE("the library's verdict on a wrong picture has the sentence of the command and its mistakes") {
    strata::RenderOptions two = small_frame;
    two.max_passes = 2;
    const auto picture = strata::picture_of(drawn_teapot(two).color());
    const strata::Judgement found = strata::judge(teapot(), picture, strata::profile("geforce8"), small_frame);
    CHECK_FALSE(found.is_right);
    CHECK_THAT(found.sentence, StartsWith("wrong: "));
    REQUIRE(found.mistakes.size() >= 1);
    CHECK_THAT(found.text, StartsWith(found.sentence + "\n") && Contains(found.mistakes[0]));
    CHECK_THAT(found.json, Contains("\"verdict\": \"wrong\""));
}

TEST_CASE("the library's verdict on a resolved picture says which option of the view looks forgotten") {
    strata::RenderOptions four = small_frame;
    four.sampling.samples = 4;
    const auto picture = strata::picture_of(drawn_teapot(four).color());
    CHECK(strata::judge(teapot(), picture, strata::profile("geforce8"), four).is_right);
    const strata::Judgement single = strata::judge(teapot(), picture, strata::profile("geforce8"), small_frame);
    CHECK_FALSE(single.is_right);
    CHECK(single.forgotten == std::vector<std::string>{"looks forgotten: --samples 4; with it the picture is right"});
}

// Opaque surfaces that are drawn after all others hide what is in front of them, as reversed depths do if nothing
// transparent lies behind.
TEST_CASE("diagnose says of opaque surfaces drawn last that they cover the layers before them") {
    const float wall[] = {-0.8f, -0.8f, 0.5f, 0.8f, -0.8f, 0.5f, 0.0f, 0.8f, 0.5f};
    const float pane[] = {-0.9f, 0.5f, -0.5f, 0.9f, 0.5f, -0.5f, 0.0f, -0.9f, -0.5f};
    strata::Scene scene, opaque;
    scene.add({.positions = {wall, 3}, .color = {0.2f, 0.7f, 0.3f, 1}, .is_transparent = false});
    scene.add({.positions = {pane, 3}, .color = {0.9f, 0.4f, 0.1f, 0.6f}});
    opaque.add({.positions = {wall, 3}, .color = {0.2f, 0.7f, 0.3f, 1}, .is_transparent = false});
    const auto profile = strata::profile("geforce8");
    const auto& peel = strata::algorithm("front_to_back");
    const auto behind = strata::render(opaque, peel, profile, small_frame).color();
    auto picture = strata::picture_of(strata::render(scene, peel, profile, small_frame).color());
    auto& codes = picture.targets[0].codes;
    for (std::size_t i = 0; i < codes.size(); i += 4)
        if (behind.codes[i + 1] != 0) std::copy_n(behind.codes.begin() + static_cast<std::ptrdiff_t>(i), 4, &codes[i]);
    const auto found = strata::diagnose(scene, picture, peel, profile, small_frame);
    INFO(found.text());
    CHECK_FALSE(found.is_right());
    CHECK_THAT(found.text(), Contains("opaque surfaces cover the layers before them"));
}

// Right pictures, and pictures with a mistake of the catalogue, by the emulations' own renderer.
TEST_CASE("judge and diagnose give one state and one first sentence about forty pictures", "[exhaustive]") {
    const auto profile = strata::profile("geforce8");
    strata::RenderOptions frame{.width = 24, .height = 20, .background = {0.2f, 0.3f, 0.5f, 1}};
    int pictures = 0;
    std::string unlike;
    for (const char* name : {"showroom", "random:seed=7,triangles=60"})
        for (const char* ran : {"front_to_back", "dual"}) {
            const strata::Scene scene{name};
            const strata::Algorithm& algorithm = strata::algorithm(ran);
            const auto view = scene.view(frame.width, frame.height, frame.raster);
            const strata::oracle::MistakeRenderer renderer{{scene.list(), view, profile, frame, scene.space()},
                                                           algorithm};
            const auto look_at = [&](const strata::Picture& picture, std::string_view what) {
                const auto judged = strata::judge(scene, picture, profile, frame, &algorithm);
                const auto diagnosed = strata::diagnose(scene, picture, algorithm, profile, frame).judgement;
                ++pictures;
                if (judged.state != diagnosed.state || judged.sentence != diagnosed.sentence)
                    unlike += std::string{what} + ": " + judged.sentence + "\n    but " + diagnosed.sentence + '\n';
                return judged;
            };
            CHECK(look_at(renderer.right(), "right").is_right);
            const auto mistakes = strata::oracle::catalogue();
            for (std::size_t i = 3; i < mistakes.size(); i += 10)
                if (const auto picture = renderer.with(mistakes[i]))
                    static_cast<void>(look_at(*picture, mistakes[i].name));
        }
    CHECK(unlike == "");
    CHECK(pictures >= 40);
}

// 255 times 0.7 in binary32 is 178.499997, which binary32 rounds to 178.5.
TEST_CASE("of an approximate algorithm a background in the middle between two codes may have either one") {
    using namespace strata::oracle;
    OpenScene opened =
        open({.scene = "planes:count=8", .algorithm = "weighted_sum", .profile = "ideal", .width = 16, .height = 16});
    opened.options.background = {0.8f, 0.7f, 0.2f, 1};
    const TargetImage right = MistakeRenderer{opened.input(), *opened.algorithm}.right().targets[0];
    const auto judged = [&](std::uint32_t green, Effort effort) {
        TargetImage file{.name = "color", .width = 16, .height = 16, .channels = 3, .holds_encoded = true};
        for (std::size_t i = 0; i < right.pixels(); ++i)
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t code = nearest(Code::unorm8, right.value_at(i, c));
                file.codes.push_back(c == 1 && code == 178 ? green : code);
            }
        const Picture picture{.file = "", .targets = {file}};
        return judge(opened.input(), {.candidate = picture, .has_alpha = false, .algorithm = opened.algorithm}, effort);
    };
    for (const Effort effort : {Effort::single, Effort::all}) {
        CHECK_THAT(judged(178, effort).sentence, StartsWith("right: equal to the picture of weighted_sum"));
        CHECK_THAT(judged(179, effort).sentence,
                   StartsWith("right but for rounding: the picture of weighted_sum; ") &&
                       EndsWith(" of 256 pixels have the other of the two codes in whose middle a value lies"));
    }
    CHECK_THAT(judged(180, Effort::single).sentence, StartsWith("wrong"));
}

TEST_CASE("floats of an approximate algorithm in the last bits are right and larger differences are not") {
    using namespace strata::oracle;
    const OpenScene opened =
        open({.scene = "planes:count=8", .algorithm = "multi_layer", .profile = "ideal", .width = 16, .height = 16});
    const Picture own = MistakeRenderer{opened.input(), *opened.algorithm}.right();
    const auto judged = [&](float change) {
        Picture port = own;
        std::size_t i = 0;
        for (std::uint32_t& word : port.targets[0].codes) {
            const float value = std::bit_cast<float>(word);
            if (++i % 4 != 0 && value > 0 && value < 0.9f) word = std::bit_cast<std::uint32_t>(value + change);
        }
        return judge(opened.input(), {.candidate = port, .has_alpha = false, .algorithm = opened.algorithm},
                     Effort::single);
    };
    const Judgement right = judged(3e-7f);
    CHECK(right.is_right);
    CHECK_THAT(right.sentence, StartsWith("right but for rounding: the picture of multi_layer; ") &&
                                   EndsWith(" differ, by at most 3e-07"));
    CHECK_THAT(judged(2e-6f).sentence, !StartsWith("right but for rounding: the picture of"));
}

TEST_CASE("premultiplied colours in a file of straight ones are right and the first sentence says so") {
    using namespace strata::oracle;
    OpenScene opened = open({.scene = "teapot", .algorithm = "front_to_back"});
    opened.options.background = {0, 0, 0, 0};
    Picture picture = MistakeRenderer{opened.input(), *opened.algorithm}.right();
    picture.targets[0].alpha_form = AlphaForm::straight;
    picture.targets[0].holds_encoded = true;
    const auto found = judge(opened.input(), {.candidate = picture, .algorithm = opened.algorithm}, Effort::single);
    CHECK(found.is_right);
    CHECK_THAT(found.sentence, StartsWith("right: equal to the picture of front_to_back at all 4096 pixels; ") &&
                                   EndsWith("; colours are premultiplied, where such a file has straight ones"));
}

TEST_CASE("the matcher of a scene accepts a right picture and its message has the verdict's sentence") {
    const auto right = strata::picture_of(drawn_teapot(small_frame).color());
    const strata::MatchesScene matches{teapot(), strata::profile("geforce8"), small_frame};
    CHECK(matches.match(right));
    auto wrong = right;
    for (std::size_t i = 0; i < wrong.targets[0].codes.size(); i += 5) wrong.targets[0].codes[i] ^= 0x55;
    CHECK_FALSE(matches.match(wrong));
    CHECK_THAT(matches.describe(), Contains("wrong: "));
    CHECK_THROWS_WITH(strata::judge(teapot(), strata::Picture{}, strata::profile("geforce8"), small_frame),
                      "candidate: targets: expected colours, found none");
}
