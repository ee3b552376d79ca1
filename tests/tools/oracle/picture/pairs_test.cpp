// Tests the pairing of channels between formats. The expected channels are written by hand; premultiplied codes are
// multiplied by alpha in integers and divided again.
#include "tools/oracle/picture/pairs.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "tests/tools/oracle/picture/pictures.h"
#include "tools/oracle/compare/compare.h"

using namespace strata::oracle;
using namespace strata::test;
using ChannelCodes = std::vector<std::uint32_t>;

namespace {

Picture one(int channels, const ChannelCodes& codes, bool is_grey = false, AlphaForm form = AlphaForm::unknown) {
    TargetImage target{.name = "color",
                       .width = static_cast<int>(codes.size()) / channels,
                       .height = 1,
                       .channels = channels,
                       .codes = codes,
                       .is_grey = is_grey,
                       .alpha_form = form};
    return {"picture", {std::move(target)}};
}

}  // namespace

TEST_CASE("grey is compared with colour as equal red and green and blue") {
    const Picture color = one(3, {10, 20, 30, 7, 7, 7}), grey = one(1, {10, 7}, true);
    for (const auto& [a, b] : {std::pair{&color, &grey}, std::pair{&grey, &color}}) {
        const Comparison found = compare(*a, *b);
        CHECK(found.differing == 1);
        CHECK(found.targets.at(0).greatest == 20);
        CHECK(found.targets.at(0).channels == 3);
        REQUIRE(found.notes.size() == 1);
        CHECK(found.notes[0].find(a == &grey ? "the reference is grey" : "the candidate is grey") != std::string::npos);
    }
    CHECK(compare(one(2, {10, 255, 7, 255}, true), one(3, {10, 10, 10, 7, 7, 7})).equal);
    CHECK(compare(one(2, {10, 255}, true), one(1, {10}, true)).equal);
    CHECK_FALSE(compare(one(2, {10, 254}, true), one(1, {10}, true)).equal);
}

TEST_CASE("a picture without alpha equals only one whose alpha is 1 and the missing channel is reported") {
    const Picture rgb = one(3, {1, 2, 3}), opaque = one(4, {1, 2, 3, 255}), clear = one(4, {1, 2, 3, 0});
    CHECK(compare(rgb, opaque).equal);
    CHECK(compare(opaque, rgb).notes ==
          std::vector<std::string>{"color: the candidate has no alpha, which counts as 1"});
    CHECK(compare(rgb, clear).differing == 1);
    CHECK(compare(clear, rgb).targets.at(0).greatest == 255);
    const Comparison without = compare(clear, rgb, {.channels = ColorChannels::rgb});
    CHECK(without.equal);
    CHECK(without.not_compared == std::vector<std::string>{"color: alpha, as --channels rgb asks"});
    CHECK(compare(clear, opaque, {.channels = ColorChannels::rgb}).equal);
    CHECK_FALSE(compare(clear, one(4, {1, 2, 4, 0}), {.channels = ColorChannels::rgb}).equal);
}

TEST_CASE("channels that no rule makes comparable are an error and not compared in part") {
    Picture two = one(2, {1, 2});
    CHECK_THROWS_WITH(compare(one(4, {1, 2, 3, 4}), two),
                      "picture: color: expected 4 channels, as in the reference, found 2");
    CHECK_THROWS_WITH(compare(one(3, {1, 2, 3}), one(1, {1})),
                      "picture: color: expected 3 channels, as in the reference, found 1");
}

// For all 255 alphas above 0 and all colours up to alpha.
TEST_CASE("premultiplied colours that are divided by alpha equal the original straight colours in every code") {
    ChannelCodes premultiplied, straight;
    for (std::uint32_t a = 1; a < 256; ++a)
        for (std::uint32_t p = 0; p <= a; ++p) {
            premultiplied.insert(premultiplied.end(), {p, 0, a, a});
            // rounded to nearest, ties up
            const auto divided = [&](std::uint32_t c) { return (2 * 255 * c + a) / (2 * a); };
            straight.insert(straight.end(), {divided(p), 0, 255, a});
        }
    const Picture a = one(4, premultiplied, false, AlphaForm::premultiplied);
    const Picture b = one(4, straight, false, AlphaForm::straight);
    CHECK(compare(a, b).equal);
    CHECK(compare(b, a).equal);
    CHECK(compare(a, b).notes ==
          std::vector<std::string>{
              "color: straight colours of the candidate are multiplied by their alpha, as those of the reference are"});
    // Colours of unknown form, of the same form, or opaque everywhere are compared unchanged.
    CHECK_FALSE(compare(a, one(4, straight)).equal);
    CHECK_FALSE(compare(one(4, premultiplied, false, AlphaForm::straight), b).equal);
    CHECK(compare(one(4, {9, 8, 7, 255}, false, AlphaForm::premultiplied),
                  one(4, {9, 8, 7, 255}, false, AlphaForm::straight))
              .notes.empty());
}
