// Expected values: a picture is right exactly if plain code composites all fragments, in any rounding of a port.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/tools/oracle/program/plain_port.h"
#include "tools/oracle/program/fit/fitting.h"

using namespace strata::test;
using strata::oracle::program::PortFormat;

namespace {

PortPicture with(const PortScene& scene, const std::function<PortColor(const PortList&)>& composite) {
    PortPicture picture;
    for (const PortList& list : scene.pixels) picture.push_back(composite(list));
    return picture;
}

PortColor kept(PortColor color, Keep keep) {
    for (double& c : color) c = keep(c);
    return color;
}

// The near half front to back, the far half over the background.
PortColor from_both_ends(const PortList& list, const PortColor& background, Keep keep) {
    const auto half = list.begin() + static_cast<std::ptrdiff_t>((list.size() + 1) / 2);
    const PortList near{list.begin(), half}, far{half, list.end()};
    return under(near, over(far, background, keep), keep);
}

PortList stored(PortList list, Keep keep) {
    for (PortFragment& f : list) {
        f.color = kept(f.color, keep);
        f.alpha = keep(f.alpha);
    }
    return list;
}

std::string first_word(const std::string& text) { return text.substr(0, text.find(':')); }

}  // namespace

TEST_CASE("a picture of all fragments is right in every rounding of a port") {
    const PortScene scene = random_scene(1);
    const PortColor& behind = scene.background;
    const auto judge = [&](PortFormat format, const std::function<PortColor(const PortList&)>& composite) {
        return first_word(judged(scene, with(scene, composite), format));
    };
    CHECK(judge(PortFormat::exact, [&](const PortList& l) { return over(l, behind, as_it_is); }) == "right");
    CHECK(judge(PortFormat::unorm8, [&](const PortList& l) { return kept(over(l, behind, as_it_is), in_8_bits); }) ==
          "right");
    CHECK(judge(PortFormat::unorm8,
                [&](const PortList& l) { return kept(over(l, behind, as_it_is), in_8_bits_truncated); }) == "right");
    for (const Keep keep : {in_8_bits, in_8_bits_truncated}) {
        CHECK(judge(PortFormat::unorm8, [&](const PortList& l) { return over(l, behind, keep); }) == "right");
        CHECK(judge(PortFormat::unorm8, [&](const PortList& l) { return under(l, behind, keep); }) == "right");
    }
    CHECK(judge(PortFormat::unorm8, [&](const PortList& l) { return from_both_ends(l, behind, in_8_bits); }) ==
          "right");
    CHECK(judge(PortFormat::unorm8, [&](const PortList& l) { return over(stored(l, in_8_bits), behind, in_8_bits); }) ==
          "right");
    CHECK(judge(PortFormat::unorm8, [&](const PortList& l) { return kept(under(l, behind, in_half), in_8_bits); }) ==
          "right");
    CHECK(judge(PortFormat::half, [&](const PortList& l) { return over(l, behind, in_half); }) == "right");
    CHECK(judge(PortFormat::half, [&](const PortList& l) { return under(l, behind, in_half); }) == "right");
}

TEST_CASE("one pixel that no rounding leaves makes an exact picture wrong, and is not explained") {
    const PortScene scene = random_scene(2);
    PortPicture picture = painted(scene, unchanged, as_it_is);
    picture[777][1] += 0.25;
    CHECK(judged(scene, picture, PortFormat::exact).starts_with("wrong: 1 of 2400 pixels, and nothing explains them"));
}

TEST_CASE("noise of 20 codes is wrong and gets no name") {
    const PortScene scene = random_scene(3);
    PortPicture picture = painted(scene, unchanged);
    std::mt19937 engine{7};
    for (PortColor& color : picture)
        for (double& c : color) c = in_8_bits(c + (static_cast<double>(engine() % 41) - 20) / 255);
    const std::string text = judged(scene, picture);
    INFO(text);
    CHECK(text.find("nothing explains them") != text.npos);
}

TEST_CASE("noise of half a code is right") {
    const PortScene scene = random_scene(4);
    PortPicture picture = painted(scene, unchanged, as_it_is);
    std::mt19937 engine{9};
    for (PortColor& color : picture)
        for (double& c : color) c = in_8_bits(c + (static_cast<double>(engine() % 1024) / 1024 - 0.5) / 255);
    CHECK(first_word(judged(scene, picture)) == "right");
}
