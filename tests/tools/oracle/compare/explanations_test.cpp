// Tests the explanations of whole-picture mistakes. Each mistake is made here in integers or by the formulas of IEC
// 61966-2-1 with the C library.
#include "tools/oracle/compare/explanations.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/oracle/picture/pictures.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

// Colours with all alphas, without symmetries.
Texel spread(int x, int y) {
    const auto i = static_cast<std::uint32_t>(x), j = static_cast<std::uint32_t>(y);
    return {(i * 11 + j * 3) % 256, (i * 5 + j * 17 + 40) % 256, (i * 2 + j * 29 + 90) % 256, (i * 13 + j * 7) % 256};
}

std::uint32_t in_byte(double v) {
    return static_cast<std::uint32_t>(std::floor(std::min(std::max(v, 0.0), 1.0) * 255 + 0.5));
}

double encoded(double l) { return l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055; }
double decoded(double e) { return e <= 0.04045 ? e / 12.92 : std::pow((e + 0.055) / 1.055, 2.4); }

std::string best(const std::function<Texel(int x, int y)>& candidate) {
    const Picture mine = make_picture({make_target("", Code::unorm8, 40, 30, 4, spread)});
    const Picture theirs = make_picture({make_target("", Code::unorm8, 40, 30, 4, candidate)});
    const TargetPair pair{&mine.targets[0], &theirs.targets[0]};
    const auto found = explanations(std::span{&pair, 1});
    if (found.empty()) return "";
    return found[0].mistake + (found[0].is_whole() ? "" : " in part");
}

std::function<Texel(int, int)> each_color(double (*change)(double v, double alpha)) {
    return [=](int x, int y) {
        Texel texel = spread(x, y);
        for (std::size_t c = 0; c < 3; ++c) texel[c] = in_byte(change(texel[c] / 255.0, texel[3] / 255.0));
        return texel;
    };
}

}  // namespace

TEST_CASE("each mistake that changes a whole picture is the first explanation and explains all of it") {
    CHECK(best([](int x, int y) { return spread(x, 29 - y); }) == "flipped_rows");
    CHECK(best([](int x, int y) { return spread(39 - x, y); }) == "flipped_columns");
    CHECK(best([](int x, int y) { return spread(39 - x, 29 - y); }) == "turned");
    CHECK(best([](int x, int y) { return spread(x - 1, y); }) == "moved_right");
    CHECK(best([](int x, int y) { return spread(x + 1, y); }) == "moved_left");
    CHECK(best([](int x, int y) { return spread(x, y - 1); }) == "moved_down");
    CHECK(best([](int x, int y) { return spread(x, y + 1); }) == "moved_up");
    CHECK(best(each_color([](double v, double a) { return v * a; })) == "premultiplied");
    CHECK(best(each_color([](double v, double a) { return a > 0 ? v / a : 0.0; })) == "straight");
    CHECK(best(each_color([](double v, double) { return encoded(v); })) == "encoded_again");
    CHECK(best(each_color([](double v, double) { return decoded(v); })) == "decoded");
    CHECK(best([](int x, int y) {
              const Texel t = spread(x, y);
              return Texel{t[2], t[1], t[0], t[3]};
          }) == "red_for_blue");
    CHECK(best([](int x, int y) {
              const Texel t = spread(x, y);
              return Texel{t[0], t[1], t[2], 255};
          }) == "alpha_lost");
    CHECK(best([](int x, int y) {
              const Texel t = spread(x, y);
              return Texel{t[0], t[1], t[2], 255 - t[3]};
          }) == "alpha_inverted");
}

TEST_CASE("an unknown mistake has no explanation") {
    CHECK(best([](int x, int y) {
              Texel t = spread(x, y);
              t[1] = (t[1] + 77) % 256;
              return t;
          }).empty());
}

TEST_CASE("a flip of a part of the picture explains that part and reports the pixels that contradict it") {
    const Picture mine = make_picture({make_target("", Code::unorm8, 40, 30, 4, spread)});
    const Picture theirs = make_picture({make_target(
        "", Code::unorm8, 40, 30, 4, [](int x, int y) { return x < 10 ? spread(x, 29 - y) : spread(x, y); })});
    const TargetPair pair{&mine.targets[0], &theirs.targets[0]};
    // 300 pixels are explained and 900 equal ones contradict: not reported.
    CHECK(explanations(std::span{&pair, 1}).empty());
}

TEST_CASE("reversed depths and 16-bit depths are explained") {
    const auto depth = [](auto change) {
        return make_picture({make_target("", Code::unorm24, 40, 30, 1, [=](int x, int y) -> Texel {
            return {change(static_cast<std::uint32_t>(x * 400009 + y * 1237)), 0, 0, 0};
        })});
    };
    const Picture mine = depth([](std::uint32_t code) { return code; });
    const auto best_of = [&](const Picture& theirs) {
        const TargetPair pair{&mine.targets[0], &theirs.targets[0]};
        const auto found = explanations(std::span{&pair, 1});
        return found.empty() ? "" : found[0].mistake;
    };
    CHECK(best_of(depth([](std::uint32_t code) { return 0xffffffu - code; })) == "depth_reversed");
    CHECK(best_of(depth([](std::uint32_t code) {
              const double z = code / 16777215.0, rounded = std::floor(z * 65535 + 0.5) / 65535;
              return static_cast<std::uint32_t>(std::floor(rounded * 16777215 + 0.5));
          })) == "depth_in_16_bits");
}
