// Expected values: a picture of smooth layers, composited by plain code of the test, then moved, enlarged, blurred or
// dithered by plain loops; the judge must say which.
#include "tools/oracle/program/screen/screen.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/tools/oracle/program/plain_port.h"

using namespace strata::test;
using namespace strata::oracle::program;

namespace {

// 0 to 3 layers on discs, with colours that change from pixel to pixel.
PortScene discs() {
    PortScene scene;
    scene.width = 64;
    scene.height = 48;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            PortList& list = scene.pixels.emplace_back();
            for (std::uint32_t k = 0; k < 3; ++k) {
                const double cx = 20 + 11.0 * k, cy = 18 + 6.0 * k, r = 15 - 2.0 * k;
                if ((x - cx) * (x - cx) + (y - cy) * (y - cy) > r * r) continue;
                const double wave = std::sin(0.9 * x + 0.6 * y * (k + 1)), other = std::cos(0.7 * y - 1.1 * x);
                list.push_back({.color = {0.5 + 0.4 * wave, 0.5 + 0.3 * other, k / 3.0},
                                .alpha = 0.35 + 0.1 * k,
                                .depth = 0.2 + 0.2 * k,
                                .submission = k,
                                .instance = k});
            }
        }
    return scene;
}

PortPicture mapped(const PortScene& scene, const PortPicture& given,
                   const std::function<PortColor(const std::function<PortColor(int, int)>&, int x, int y)>& of) {
    const auto at = [&](int x, int y) {
        x = std::clamp(x, 0, scene.width - 1);
        y = std::clamp(y, 0, scene.height - 1);
        return given[static_cast<std::size_t>(y * scene.width + x)];
    };
    PortPicture made;
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x) {
            PortColor color = of(at, x, y);
            for (double& c : color) c = in_8_bits(c);
            made.push_back(color);
        }
    return made;
}

std::string screen_of(const PortScene& scene, const PortPicture& picture) {
    const Lists lists = lists_of(scene, picture);
    const std::vector<ScreenMap> found = explain_by_screen(lists, best_fitness(lists, {}));
    return found.empty() ? "" : found[0].words;
}

using At = std::function<PortColor(int, int)>;
PortColor mean_of(const At& at, int x, int y, int wide, int high) {
    PortColor sum{};
    for (int j = 0; j < high; ++j)
        for (int i = 0; i < wide; ++i)
            for (std::size_t c = 0; c < 3; ++c) sum[c] += at(x + i, y + j)[c] / (wide * high);
    return sum;
}

}  // namespace

TEST_CASE("what became of the place of pixels is named") {
    const PortScene scene = discs();
    const PortPicture right = painted(scene, unchanged, as_it_is);
    struct Case {
        const char* words;
        std::function<PortColor(const At&, int x, int y)> of;
    };
    const Case cases[] = {
        {"every pixel shows the one 1 pixel to the left", [](const At& at, int x, int y) { return at(x - 1, y); }},
        {"every pixel shows the one 2 pixels to the right and 1 pixel below",
         [](const At& at, int x, int y) { return at(x + 2, y + 1); }},
        {"pixels of odd rows show the one 1 pixel above",
         [](const At& at, int x, int y) { return at(x, y % 2 == 1 ? y - 1 : y); }},
        {"pixels with y at least 20 show the one 1 pixel below",
         [](const At& at, int x, int y) { return at(x, y >= 20 ? y + 1 : y); }},
        {"blocks of 2 x 2 pixels show the upper left",
         [](const At& at, int x, int y) { return at(x / 2 * 2, y / 2 * 2); }},
        {"blocks of 2 x 2 pixels show their mean",
         [](const At& at, int x, int y) { return mean_of(at, x / 2 * 2, y / 2 * 2, 2, 2); }},
        {"tiles of 8 x 8 pixels are transposed",
         [](const At& at, int x, int y) { return at(x / 8 * 8 + y % 8, y / 8 * 8 + x % 8); }},
        {"rows are 66 pixels apart in memory and are read as if 64",
         [](const At& at, int x, int y) {
             const int address = 64 * y + x;
             return at(address % 66, address / 66);
         }},
        {"every pixel is the mean of 2 x 2 pixels down and right: half a texel off",
         [](const At& at, int x, int y) { return mean_of(at, x, y, 2, 2); }},
        {"every pixel is the mean of 3 x 3 pixels: a blur",
         [](const At& at, int x, int y) { return mean_of(at, x - 1, y - 1, 3, 3); }},
        {"the picture is rounded to 5, 6 and 5 bits with a dither of 2 x 2 pixels",
         [](const At& at, int x, int y) {
             const int order[] = {0, 2, 3, 1}, bits[] = {5, 6, 5};
             PortColor color = at(x, y);
             for (std::size_t c = 0; c < 3; ++c) {
                 const double threshold = (order[y % 2 * 2 + x % 2] + 0.5) / 4;
                 const int code = static_cast<int>(color[c] * ((1 << bits[c]) - 1) + threshold);
                 color[c] = (code << (8 - bits[c]) | code >> (2 * bits[c] - 8)) / 255.0;
             }
             return color;
         }},
        {"the picture is rounded to 5 bits with a dither of 4 x 4 pixels",
         [](const At& at, int x, int y) {
             const int order[] = {0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5};
             PortColor color = at(x, y);
             for (double& c : color)
                 c = std::min(std::floor(c * 31 + (order[y % 4 * 4 + x % 4] + 0.5) / 16), 31.0) / 31;
             return color;
         }},
    };
    for (const Case& c : cases) {
        const std::string words = screen_of(scene, mapped(scene, right, c.of));
        INFO(words);
        CHECK(words.starts_with(c.words));
    }
}

TEST_CASE("fragments that are kept or dropped by a pattern are told as that, with its period") {
    const PortScene scene = discs();
    const auto screen_door = [&](int period) {
        PortPicture picture;
        for (int y = 0; y < scene.height; ++y)
            for (int x = 0; x < scene.width; ++x) {
                const double threshold = ((x % period * 3 + y % period * 5) % 16 + 0.5) / 16;
                PortColor color = scene.background;
                for (const PortFragment& f : scene.pixels[static_cast<std::size_t>(y * scene.width + x)])
                    if (f.alpha > threshold) {
                        color = f.color;
                        break;
                    }
                for (double& c : color) c = in_8_bits(c);
                picture.push_back(color);
            }
        return picture;
    };
    const std::string start =
        "every pixel shows one layer or what is behind: fragments are kept or dropped, not blended";
    CHECK(screen_of(scene, screen_door(4)) ==
          start + ", by a pattern that repeats every 4 x 4 pixels and serves all layers");
    CHECK(screen_of(scene, screen_door(3)) ==
          start + ", by a pattern that repeats every 3 x 3 pixels and serves all layers");
    CHECK(screen_of(scene, screen_door(2)) ==
          start + ", by a pattern that repeats every 2 x 2 pixels and serves all layers");
}

TEST_CASE("a right picture, and one whose layers are lost, are in their place") {
    const PortScene scene = discs();
    CHECK(screen_of(scene, painted(scene, unchanged)).empty());
    const auto only_two = [](PortList list, int, int) {
        list.resize(std::min<std::size_t>(list.size(), 1));
        return list;
    };
    CHECK(screen_of(scene, painted(scene, only_two)).empty());
}
