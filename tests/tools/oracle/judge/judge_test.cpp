// Tests what the judge says of pictures that emulations, forgotten options and fitted programs explain. The test makes
// every picture: by a mistake that it chooses, or by changing lists or codes itself.
#include "tools/oracle/judge/judge.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/oracle/verdict/wrong_ports.h"
#include "tools/oracle/emulations/catalogue.h"
#include "tools/oracle/emulations/mistake_renderer.h"
#include "tools/oracle/fragments/fragments.h"

using namespace strata;
using namespace strata::test;
using oracle::Effort;
using oracle::Judgement;
using pipeline::CapturedFragment;

namespace {

// Of a scene of many colours.
struct SmallScene {
    OpenedScene opened{"random:seed=9,triangles=120", 48, 36};

    [[nodiscard]] std::string sentence_of(oracle::TargetImage colors) const {
        const oracle::Picture picture{.targets = {std::move(colors)}};
        return judge(opened.input(), {.candidate = picture, .has_alpha = false}, Effort::single).sentence;
    }
    // Blended in floats, so that many blends add no rounding.
    [[nodiscard]] oracle::TargetImage port(const ChangeList& change) const {
        using namespace oracle::verdict;
        Hypothesis floats = port_of_codes(Order::under);
        floats.front = floats.back = {Storage::single, SourceRounding::unrounded, Rounding::nearest};
        return picture_of_port(opened, floats, change);
    }
};

Judgement with_mistake(const OpenedScene& opened, const char* ran, const char* mistake, bool is_stated, Effort effort) {
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(ran);
    const auto picture = oracle::MistakeRenderer{opened.input(), algorithm}.with(*oracle::find_mistake(mistake));
    REQUIRE(picture.has_value());
    return judge(opened.input(), {.candidate = *picture, .algorithm = is_stated ? &algorithm : nullptr}, effort);
}

}  // namespace

TEST_CASE("of a port whose algorithm is not known the mistakes of a peel from the front are tried") {
    const OpenedScene opened{"teapot", 32, 24};
    const Judgement found = with_mistake(opened, "front_to_back", "under_without_transmittance", false, Effort::single);
    CHECK(found.sentence ==
          "wrong: every pixel is that of: layers added in front without the transmittance of the layers before them "
          "(under_without_transmittance), of front_to_back");
}

TEST_CASE("the judge names a single emulated mistake with little effort and with all, and all has leads") {
    OpenedScene opened{"planes:count=8", 32, 24};
    opened.profile = *pipeline::find_profile("ideal");
    const std::string wanted =
        "wrong: every pixel is that of: weights that grow with the distance: the wrong sign of z "
        "(weight_grows_with_depth)";
    for (const Effort effort : {Effort::single, Effort::all}) {
        const Judgement found = with_mistake(opened, "weighted_blended", "weight_grows_with_depth", true, effort);
        CHECK(found.sentence == wanted);
        const auto document = nlohmann::ordered_json::parse(found.json);
        CHECK(document["sentence"] == wanted);
        CHECK(document.contains("leads"));
        CHECK(document.contains("structure") == (effort == Effort::all));
    }
}

TEST_CASE("a forgotten background is told with the pixels that have it") {
    const SmallScene scene;
    std::size_t empty = 0, number = 0;
    const oracle::TargetImage noise = scene.port([&](PortList& l) {
        empty += l.visible.empty() && !l.has_opaque ? 1 : 0;
        l.background = {1, 1, 1, 1};
        for (CapturedFragment& f : l.visible) {
            f.color[static_cast<int>(number % 3)] = static_cast<float>(number * 7 % 11) / 11;
            ++number;
        }
    });
    const oracle::Picture picture{.targets = {noise}};
    const Judgement found = judge(scene.opened.input(), {.candidate = picture, .has_alpha = false}, Effort::single);
    INFO(found.text);
    REQUIRE(!found.forgotten.empty());
    CHECK(found.forgotten[0] == "looks forgotten: --background 1,1,1, the colour of " + std::to_string(empty) +
                                    " of the " + std::to_string(empty) + " pixels where nothing is drawn");
}

TEST_CASE("a picture in 6 bits and one that is the mean of two rows are named") {
    const SmallScene scene;
    const oracle::TargetImage right = scene.port({});
    oracle::TargetImage few = right;
    for (std::uint32_t& code : few.codes)
        code = static_cast<std::uint32_t>(std::lround(std::lround(code * 63 / 255.0) * 255 / 63.0));
    CHECK(scene.sentence_of(few) == "wrong: the picture is rounded to 6 bits");
    oracle::TargetImage mean = right;
    const std::size_t row = std::size_t{4} * 48;
    for (std::size_t i = 0; i + row < mean.codes.size(); ++i)
        mean.codes[i] = (right.codes[i] + right.codes[i + row] + 1) / 2;
    CHECK(scene.sentence_of(mean) == "wrong: every pixel is the mean of itself and the one below");
}

TEST_CASE("faces of one side that are drawn before those of the other are named") {
    const SmallScene scene;
    const oracle::verdict::SceneFragments fragments{scene.opened.input(), scene.opened.options.fragment_memory};
    std::map<std::uint32_t, bool> is_front;
    fragments.for_each_tile([&](const oracle::verdict::TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p)
            for (const auto& f : fragments.at(tile, p).visible) is_front[f.primitive] = f.is_front_facing;
    });
    for (const bool has_front_first : {false, true}) {
        // The last drawn is on top, that is, first in the list. The scene has one instance.
        const auto drawn = [&](const CapturedFragment& f) {
            return std::pair{is_front.at(f.primitive) != has_front_first, f.primitive};
        };
        CHECK(scene.sentence_of(scene.port([&](PortList& l) {
            std::ranges::sort(l.visible, std::ranges::greater{}, drawn);
        })) == fmt::format("wrong: layers are composited in the order of drawing (as submitted, {}): nothing is sorted",
                           has_front_first ? "all front faces first" : "back faces of each instance first"));
    }
}

TEST_CASE("layers that are blended eight times and ones of a colour are named") {
    const SmallScene scene;
    CHECK(scene.sentence_of(scene.port([](PortList& l) {
        std::vector<CapturedFragment> all;
        for (CapturedFragment f : l.visible) all.insert(all.end(), 8, f);
        l.visible = all;
    })) == "wrong: all fragments are blended 8 times");
    CHECK(scene.sentence_of(scene.port([](PortList& l) {
        std::erase_if(l.visible,
                      [](const CapturedFragment& f) { return f.color[2] > f.color[0] && f.color[2] > f.color[1]; });
    })) == "wrong: fragments of mostly blue ones are left out");
}
