// Tests the comparison of pictures that are changed on purpose. The expected numbers of pixels and codes are counted as
// the pixels are changed.
#include "tools/oracle/compare/compare.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "rasterizer/base/input_error.h"
#include "tests/tools/oracle/picture/pictures.h"
#include "tools/oracle/compare/drawings.h"
#include "tools/oracle/compare/report.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

const KindReport* find_kind(const Comparison& found, Kind kind) {
    const auto at = std::ranges::find(found.kinds, kind, &KindReport::kind);
    return at == found.kinds.end() ? nullptr : &*at;
}

std::size_t inside_pixel() { return 15 * 40 + 19; }

}  // namespace

TEST_CASE("a picture is equal to itself for any bits and then has no explanation") {
    const Picture picture = ellipse();
    const Comparison found = compare(picture, picture);
    CHECK(found.equal);
    CHECK(found.accepted);
    CHECK(found.differing == 0);
    CHECK(found.kinds.empty());
    CHECK(found.explanations.empty());
    CHECK(to_text(found) == "equal\n");
}

TEST_CASE("colours one code off are found at their pixel and accepted by a tolerance of that many codes") {
    const Picture reference = ellipse();
    Picture candidate = reference;
    candidate.targets[0].codes[inside_pixel() * 4 + 1] += 2;
    const Comparison found = compare(reference, candidate);
    REQUIRE(find_kind(found, Kind::color) != nullptr);
    CHECK(found.kinds.size() == 1);
    CHECK(find_kind(found, Kind::color)->first_x == 19);
    CHECK(find_kind(found, Kind::color)->first_y == 15);
    CHECK(found.targets[0].distances == std::map<std::uint32_t, std::uint64_t>{{2, 1}});
    CHECK_FALSE(found.accepted);
    CHECK_FALSE(compare(reference, candidate, {.color_codes = 1}).accepted);
    CHECK(compare(reference, candidate, {.color_codes = 2}).accepted);
    CHECK_FALSE(compare(reference, candidate, {.color_codes = 2}).equal);
    CHECK_FALSE(compare(reference, candidate, {.depth_codes = 2, .coverage = {.pixels = 5}}).accepted);
}

TEST_CASE("the first pixel of a kind is the first that the tolerance does not accept") {
    const Picture reference = ellipse();
    Picture candidate = reference;
    candidate.targets[0].codes[inside_pixel() * 4] += 1;
    candidate.targets[0].codes[(inside_pixel() + 3) * 4] += 5;
    const Comparison found = compare(reference, candidate, {.color_codes = 1});
    REQUIRE(find_kind(found, Kind::color) != nullptr);
    CHECK(find_kind(found, Kind::color)->first_x == 22);
    CHECK(find_kind(found, Kind::color)->pixels == 2);
    CHECK(find_kind(found, Kind::color)->beyond == 1);
}

TEST_CASE("a colour where nothing is drawn is a background difference and a missing pixel one of coverage") {
    const Picture reference = ellipse();
    std::uint64_t empty = 0;
    Picture candidate = make_picture({make_target("", Code::unorm8, 40, 30, 4, [&](int x, int y) {
        if (!is_in_ellipse(x, y)) ++empty;
        return is_in_ellipse(x, y) ? ellipse_texel(x, y) : Texel{0, 0, 0, 255};
    })});
    const Comparison found = compare(reference, candidate);
    REQUIRE(found.kinds.size() == 1);
    CHECK(found.kinds[0].kind == Kind::background);
    CHECK(found.kinds[0].pixels == empty);

    Picture holed = reference;
    std::copy_n(reference.targets[0].codes.begin(), 4,
                holed.targets[0].codes.begin() + static_cast<std::ptrdiff_t>(inside_pixel() * 4));
    const Comparison hole = compare(reference, holed);
    REQUIRE(hole.kinds.size() == 1);
    CHECK(hole.kinds[0].kind == Kind::coverage);
    CHECK(compare(reference, holed, {.coverage = {.pixels = 1}}).accepted);
    CHECK_FALSE(compare(reference, holed, {.color_codes = 255}).accepted);
}

TEST_CASE("depths are compared by codes with a histogram and decide which pixels are drawn") {
    const auto depth = [](int off) {
        return make_target("", Code::unorm24, 40, 30, 1, [=](int x, int y) -> Texel {
            if (!is_in_ellipse(x, y)) return {0xffffff, 0, 0, 0};
            return {static_cast<std::uint32_t>(1000 * (x + y) + (x % 3 == 0 ? off : 0)), 0, 0, 0};
        });
    };
    std::uint64_t changed = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) changed += is_in_ellipse(x, y) && x % 3 == 0 ? 1 : 0;
    const Comparison found = compare(make_picture({depth(0)}), make_picture({depth(2)}));
    REQUIRE(found.kinds.size() == 1);
    CHECK(found.kinds[0].kind == Kind::depth);
    CHECK(found.kinds[0].pixels == changed);
    CHECK(found.targets[0].distances == std::map<std::uint32_t, std::uint64_t>{{2, changed}});
    CHECK(compare(make_picture({depth(0)}), make_picture({depth(2)}), {.depth_codes = 2}).accepted);
}

TEST_CASE("pictures of unequal size or without a common target are rejected and a missing alpha is reported") {
    const Picture reference = ellipse();
    CHECK_THROWS_AS(compare(reference, make_picture({make_target("", Code::unorm8, 39, 30, 4, ellipse_texel)})),
                    strata::InputError);
    CHECK_THROWS_AS(compare(reference, make_picture({make_target("", Code::unorm24, 40, 30, 1, ellipse_texel)})),
                    strata::InputError);
    const Comparison rgb = compare(reference, make_picture({make_target("", Code::unorm8, 40, 30, 3, ellipse_texel)}));
    CHECK(rgb.equal);
    CHECK(rgb.not_compared.empty());
    CHECK(rgb.notes == std::vector<std::string>{"color: the candidate has no alpha, which counts as 1"});
}

TEST_CASE("reports name every kind and JUnit fails only those beyond the tolerance") {
    const Picture reference = ellipse();
    Picture candidate = reference;
    candidate.targets[0].codes[inside_pixel() * 4] += 1;
    const std::string strict = to_junit(compare(reference, candidate));
    CHECK(strict.find("failures=\"1\"") != std::string::npos);
    CHECK(strict.find("name=\"color\">") != std::string::npos);
    CHECK(strict.find("name=\"coverage\"/>") != std::string::npos);
    CHECK(to_junit(compare(reference, candidate, {.color_codes = 1})).find("failures=\"0\"") != std::string::npos);
    CHECK(to_text(compare(reference, candidate)).starts_with("different: 1 of 1200 pixels differ\n"));
    CHECK(to_text(compare(reference, candidate, {.color_codes = 1})).starts_with("accepted: 1 of 1200"));
    CHECK(to_json(compare(reference, candidate)).find("\"kind\": \"color\"") != std::string::npos);
}

TEST_CASE("JUnit skips the kinds that the compared targets cannot show") {
    const auto skipped = [](const Picture& picture) {
        const std::string xml = to_junit(compare(picture, picture));
        std::vector<std::string> names;
        for (std::size_t at = xml.find("<skipped/>"); at != xml.npos; at = xml.find("<skipped/>", at + 1)) {
            const std::size_t begin = xml.rfind(" name=\"", at) + 7;
            names.push_back(xml.substr(begin, xml.find('"', begin) - begin));
        }
        CHECK(xml.find("skipped=\"" + std::to_string(names.size()) + "\"") != xml.npos);
        CHECK(xml.find("tests=\"11\"") != xml.npos);
        return names;
    };
    const std::vector<std::string> layers{"layer_missing", "layer_doubled", "layer_swapped", "layer_merged",
                                          "layer_other"};
    const auto with_floats = [](std::vector<std::string> names) {
        names.insert(names.begin(), {"not_finite", "unseen"});
        return names;
    };
    std::vector<std::string> flat = with_floats(layers);
    flat.push_back("depth");
    CHECK(skipped(ellipse()) == flat);  // colour only, with a known background
    TargetImage depth = make_target("", Code::unorm24, 40, 30, 1, ellipse_texel);
    depth.name = "depth";
    depth.meaning = Meaning::depth;
    CHECK(skipped(make_picture({make_target("", Code::unorm8, 40, 30, 4, ellipse_texel), depth})) ==
          with_floats(layers));
    CHECK(skipped(make_picture({make_target("", Code::single, 40, 30, 4, [](int, int) { return Texel{}; })})).front() ==
          "unseen");
}

TEST_CASE(
    "a heat map is black exactly where the pictures are equal and elsewhere has the colour of the distance in codes") {
    const Picture reference = ellipse();
    Picture candidate = reference;
    candidate.targets[0].codes[inside_pixel() * 4] += 44;
    const Comparison found = compare(reference, candidate);
    const strata::pipeline::Image heat = heat_map(found), kinds = kind_map(found);
    const auto lit = [](const strata::pipeline::Image& image) {
        int count = 0;
        for (std::size_t i = 0; i < image.codes.size(); i += 4)
            count += image.codes[i] + image.codes[i + 1] + image.codes[i + 2] > 0 ? 1 : 0;
        return count;
    };
    CHECK(lit(heat) == 1);
    CHECK(lit(kinds) == 1);
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(heat.codes[inside_pixel() * 4 + c] == HeatScale{44}.color(44)[c]);
        CHECK(kinds.codes[inside_pixel() * 4 + c] == color_of(Kind::color)[c]);
    }
    const strata::pipeline::Image side = side_by_side(reference, candidate, found),
                                  legend = heat_map_with_legend(found);
    CHECK(side.width == 4 * 132 + 3 * 4);
    CHECK(legend.width == 132);
    CHECK(legend.height == 30 + legend_height_px);
    CHECK(lit(legend) > 132 * 8);
    int wrong = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            for (int c = 0; c < 3; ++c) {
                const std::size_t own = static_cast<std::size_t>((y * 40 + x) * 4 + c);
                wrong += side.codes[side.index(x, y, c)] != reference.targets[0].codes[own] ? 1 : 0;
                wrong += side.codes[side.index(x + 136, y, c)] != candidate.targets[0].codes[own] ? 1 : 0;
                wrong += side.codes[side.index(x + 272, y, c)] != heat.codes[own] ? 1 : 0;
                wrong += side.codes[side.index(x + 408, y, c)] != kinds.codes[own] ? 1 : 0;
                wrong += legend.codes[legend.index(x, y, c)] != heat.codes[own] ? 1 : 0;
            }
    CHECK(wrong == 0);
}

// 18 of 30,000 pixels are far off, as after a dropped fragment; all others are at most one code off.
TEST_CASE("a budget accepts its number of pixels for any difference and reports how many were used") {
    const TargetImage right = make_target("", Code::unorm8, 200, 150, 4, [](int x, int y) {
        return Texel{static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 30, 255};
    });
    TargetImage noisy = right;
    for (std::size_t p = 0; p < noisy.pixels(); p += 7) noisy.codes[4 * p + 2] += 1;
    for (std::size_t p = 0; p < 18; ++p) noisy.codes[4 * (1600 * p + 1000)] ^= 0xff;
    const Picture reference = make_picture({right}), candidate = make_picture({noisy});
    CHECK_FALSE(compare(reference, candidate, {.color_codes = 2}).accepted);
    CHECK_FALSE(compare(reference, candidate, {.color_codes = 2, .pixels = {.pixels = 17}}).accepted);
    CHECK_FALSE(compare(reference, candidate, {.pixels = {.pixels = 18}}).accepted);
    for (const Tolerances& t :
         {Tolerances{.color_codes = 2, .pixels = {.pixels = 18}}, Tolerances{.color_codes = 1, .color = {.pixels = 18}},
          Tolerances{.color_codes = 2, .pixels = {.share = 0.00061}}}) {
        const Comparison found = compare(reference, candidate, t);
        CHECK(found.accepted);
        CHECK_FALSE(found.equal);
        REQUIRE(found.spent.size() == 1);
        CHECK(found.spent[0].pixels == 18);
        CHECK(found.spent[0].allowed == 18);
    }
    // A pixel that one budget covers does not count against the other; a pixel that neither covers is a difference.
    const Comparison both =
        compare(reference, candidate, {.color_codes = 2, .color = {.pixels = 10}, .pixels = {.pixels = 18}});
    CHECK(both.accepted);
    CHECK(both.spent.size() == 2);
    CHECK_FALSE(compare(reference, candidate, {.color_codes = 2, .depth = {.pixels = 99}}).accepted);
}

TEST_CASE("NaN and infinity are a kind of their own that only its own budget accepts") {
    constexpr std::uint32_t one = 0x3f800000, half = 0x3f000000, nan = 0x7fc00000, infinity = 0x7f800000;
    const auto flat = [](std::uint32_t first, std::uint32_t second) {
        return make_picture({make_target("", Code::single, 4, 4, 3, [=](int x, int y) {
            return Texel{x == 1 && y == 2 ? first : x == 3 && y == 3 ? second : one, half, half, 0};
        })});
    };
    const Picture right = flat(one, one);
    const Tolerances anything{.color_codes = 0xffffffff,
                              .coverage = {.pixels = 16},
                              .background = {.pixels = 16},
                              .color = {.pixels = 16},
                              .pixels = {.share = 1}};
    const auto check = [&](const Picture& reference, const Picture& candidate, std::array<std::uint64_t, 2> nans,
                           std::array<std::uint64_t, 2> infinities) {
        const Comparison found = compare(reference, candidate, anything);
        REQUIRE(find_kind(found, Kind::not_finite) != nullptr);
        CHECK(find_kind(found, Kind::not_finite)->pixels == 1);
        CHECK(find_kind(found, Kind::not_finite)->first_x == 1);
        CHECK(find_kind(found, Kind::not_finite)->first_y == 2);
        CHECK(found.targets.at(0).nan.pixels == nans);
        CHECK(found.targets.at(0).infinite.pixels == infinities);
        CHECK(found.targets.at(0).greatest == one - half);  // of the other pixel
        CHECK_FALSE(found.accepted);
        Tolerances asked = anything;
        asked.not_finite.pixels = 1;
        CHECK(compare(reference, candidate, asked).accepted);
        for (const Explanation& e : found.explanations) CHECK(e.mistake.find("coded") == std::string::npos);
    };
    check(right, flat(nan, half), {0, 1}, {0, 0});
    check(flat(nan, half), right, {1, 0}, {0, 0});
    check(right, flat(infinity, half), {0, 0}, {0, 1});
    check(right, flat(infinity | 0x80000000, half), {0, 0}, {0, 1});
    check(flat(infinity, half), right, {0, 0}, {1, 0});
    CHECK(compare(flat(nan, infinity), flat(nan, infinity)).equal);
    CHECK_FALSE(compare(flat(nan, one), flat(infinity, one), anything).accepted);
}

TEST_CASE("straight colours where alpha is 0 in both pictures are a kind of their own with a budget") {
    // Of 4 x 4 pixels those of one row have a hidden colour.
    const auto flat = [](std::uint32_t hidden, std::uint32_t alpha, std::uint32_t shown) {
        TargetImage target = make_target("", Code::unorm8, 4, 4, 4, [=](int, int y) {
            return y == 2 ? Texel{hidden, 1, 2, alpha} : Texel{shown, 20, 30, 255};
        });
        target.alpha_form = AlphaForm::straight;
        return make_picture({target});
    };
    const Picture reference = flat(0, 0, 10);
    const Comparison found = compare(reference, flat(255, 0, 10));
    REQUIRE(found.kinds.size() == 1);
    CHECK(found.kinds[0].kind == Kind::unseen);
    CHECK(found.kinds[0].pixels == 4);
    CHECK_FALSE(found.accepted);
    CHECK(compare(reference, flat(255, 0, 10), {.unseen = {.share = 1}}).accepted);
    CHECK(compare(reference, flat(255, 0, 10), {.unseen = {.pixels = 4}}).accepted);
    CHECK_FALSE(compare(reference, flat(255, 0, 10), {.unseen = {.pixels = 3}}).accepted);
    CHECK(compare(reference, flat(255, 0, 10), {.pixels = {.pixels = 4}}).accepted);
    CHECK(compare(reference, flat(255, 0, 10), {.color_codes = 255}).accepted);
    // One step of alpha is seen, in one of the pictures or in both.
    for (const std::uint32_t alpha : {0u, 1u})
        CHECK(find_kind(compare(flat(0, alpha, 10), flat(255, 1, 10), {.unseen = {.share = 1}}), Kind::unseen) ==
              nullptr);
    // Other pixels keep their kind.
    CHECK_FALSE(compare(reference, flat(255, 0, 11), {.unseen = {.share = 1}}).accepted);
    // Premultiplied colours are added even where alpha is 0.
    Picture added = flat(255, 0, 10), none = reference;
    for (Picture* const picture : {&added, &none}) picture->targets[0].alpha_form = AlphaForm::premultiplied;
    CHECK(find_kind(compare(none, added), Kind::unseen) == nullptr);
}

TEST_CASE("figures of noise are in the steps of the picture's codes") {
    const auto noise = [](Code code, std::uint32_t a, std::uint32_t b) {
        const auto flat = [code](std::uint32_t word) {
            return make_picture({make_target("", code, 2, 2, 3, [word](int, int) {
                return Texel{word, word, word, 0};
            })});
        };
        return noise_of(compare(flat(a), flat(b)).targets.at(0));
    };
    CHECK(noise(Code::unorm8, 10, 20) == "RMSE 10.000/255, PSNR 28.13 dB");                  // 20 log10(25.5)
    CHECK(noise(Code::unorm16, 1000, 1100) == "RMSE 100.000/65535, PSNR 56.33 dB");          // 20 log10(655.35)
    CHECK(noise(Code::single, 0x3f000000, 0x3f200000) == "RMSE 0.125, PSNR 18.06 dB of 1");  // 20 log10(8)
    CHECK(noise(Code::unorm8, 10, 10).empty());
}

TEST_CASE("RMSE and PSNR are those of all channels in units of 1/255") {
    const auto flat = [](std::uint32_t red) {
        return make_picture({make_target("", Code::unorm8, 2, 2, 3, [red](int x, int) {
            return Texel{x == 0 ? red : 100, 20, 30, 0};
        })});
    };
    // 2 of 12 codes are 6 off: the mean square is 72 / 12 = 6.
    const Comparison found = compare(flat(100), flat(106));
    REQUIRE(found.targets.at(0).rmse);
    CHECK(*found.targets[0].rmse == Approx(std::sqrt(6.0)).epsilon(1e-12));
    CHECK(*found.targets[0].psnr == Approx(10 * std::log10(255.0 * 255.0 / 6)).epsilon(1e-12));
    CHECK_FALSE(compare(flat(100), flat(100)).targets.at(0).rmse);
}
