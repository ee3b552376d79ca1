// Tests what is said of a picture of another size. The other pictures are made pixel by pixel.
#include "tools/oracle/picture/other_size.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "tests/tools/oracle/picture/pictures.h"
#include "tools/oracle/compare/compare.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

constexpr int own_width = 6, own_height = 4;

Texel texel(int x, int y) {
    return {static_cast<std::uint32_t>(40 * x), static_cast<std::uint32_t>(60 * y),
            static_cast<std::uint32_t>(7 * x * y), 255};
}

TargetImage made(int w, int h, const std::function<Texel(int x, int y)>& of) {
    return make_target("", Code::unorm8, w, h, 4, of);
}

std::string words_of(int w, int h, const std::function<Texel(int x, int y)>& of) {
    return size_in_words(made(own_width, own_height, texel), made(w, h, of));
}

}  // namespace

TEST_CASE("a scaled picture is told with its factor") {
    CHECK(words_of(12, 8, [](int x, int y) { return texel(x / 2, y / 2); }) == "12x8, the reference scaled by 2");
    CHECK(words_of(18, 12, [](int x, int y) { return texel(x / 3, y / 3); }) == "18x12, the reference scaled by 3");
    CHECK(words_of(3, 2, [](int x, int y) { return texel(2 * x, 2 * y); }) == "3x2, the reference scaled by 1/2");
    CHECK(words_of(3, 2, [](int x, int y) { return texel(2 * x + 1, 2 * y + 1); }) ==
          "3x2, the reference scaled by 1/2");
    // Twice the size, but one pixel is another one.
    CHECK(words_of(12, 8, [](int x, int y) {
              return x == 11 && y == 7 ? Texel{9, 9, 9, 255} : texel(x / 2, y / 2);
          }).find("scaled") == std::string::npos);
}

TEST_CASE("a transposed and a turned picture are told apart") {
    CHECK(words_of(4, 6, [](int x, int y) { return texel(y, x); }) == "4x6, the reference transposed");
    // The first row is the reference's first column from the lowest pixel on.
    CHECK(words_of(4, 6, [](int x, int y) { return texel(y, own_height - 1 - x); }) ==
          "4x6, the reference turned right by 90 degrees");
    CHECK(words_of(4, 6, [](int x, int y) { return texel(own_width - 1 - y, x); }) ==
          "4x6, the reference turned left by 90 degrees");
}

TEST_CASE("a picture that is cut from the reference, or has a border, is told with its place") {
    CHECK(words_of(4, 3, [](int x, int y) { return texel(x + 2, y + 1); }) == "4x3, cut from the reference at 2,1");
    CHECK(words_of(6, 3, [](int x, int y) { return texel(x, y + 1); }) == "6x3, cut from the reference at 0,1");
    const auto bordered = [](int x, int y) {
        const bool is_inside = x >= 3 && y >= 1 && x < own_width + 3 && y < own_height + 1;
        return is_inside ? texel(x - 3, y - 1) : Texel{7, 7, 7, 255};
    };
    CHECK(words_of(10, 7, bordered) == "10x7, the reference with a border: it begins at 3,1");
    CHECK(words_of(10, 7, [&](int x, int y) {
              return x == 5 && y == 3 ? Texel{200, 1, 1, 255} : bordered(x, y);
          }).find("border") == std::string::npos);
    // All places of a flat picture agree: the first one is the upper left corner.
    const auto flat = [](int, int) { return Texel{9, 9, 9, 255}; };
    CHECK(size_in_words(made(9, 9, flat), made(4, 5, flat)) ==
          "4x5, equal where both overlap, from the upper left corner");
}

TEST_CASE("of any other size the overlap is told") {
    CHECK(words_of(6, 5, texel) == "6x5, equal where both overlap, from the upper left corner");
    CHECK(words_of(5, 6, [](int x, int y) {
              return x == 0 ? Texel{1, 2, 200, 255} : texel(x, y);
          }) == "5x6, equal at 16 of the 20 pixels where both overlap, from the upper left corner");
    // A code of rounding, and alpha, do not count.
    CHECK(words_of(6, 5, [](int x, int y) {
              const Texel t = texel(x, y);
              return Texel{t[0] + 1, t[1], t[2], 0};
          }) == "6x5, equal where both overlap, from the upper left corner");
}

TEST_CASE("the error of compare contains the relation of the sizes") {
    const Picture a = make_picture({made(own_width, own_height, texel)});
    Picture b = make_picture({made(12, 8, [](int x, int y) { return texel(x / 2, y / 2); })});
    b.file = "twice.png";
    CHECK_THROWS_WITH(compare(a, b),
                      "twice.png: size: expected 6x4, the reference's size, found 12x8, the reference scaled by 2");
}
