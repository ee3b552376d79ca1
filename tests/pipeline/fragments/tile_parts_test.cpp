// Tests the division of tiles into parts, against the fragments of a scene given pixel by pixel.
#include "pipeline/fragments/tile_parts.h"

#include <catch2/catch.hpp>

#include "tests/pipeline/frames.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::Rect;

// Most pixels have few fragments and some have many.
FragmentScene uneven_scene(Random& random) {
    FragmentScene made{32, 16};
    for (auto& pixel : made.pixels)
        for (int n = random_int(random, 0, random_int(random, 0, 20) == 0 ? 90 : 5); n-- > 0;)
            pixel.fragments.push_back({0.5f, {1, 1, 1, 1}});
    return made;
}

struct Room {
    std::uint64_t all = 0, deepest = 0;
    Room(const FragmentScene& scene, const Rect& rect) {
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                const std::uint64_t own = scene.pixels[static_cast<std::size_t>(y * scene.width + x)].fragments.size();
                all += own;
                deepest = std::max(deepest, own);
            }
    }
    // Bound on the 32-bit values: sixteen lists as long as the longest.
    [[nodiscard]] std::uint64_t words(const Rect& rect) const {
        return std::min(16 * all, (rect.area() + 15) / 16 * 16 * deepest);
    }
    [[nodiscard]] bool fits(const Replay& replay, const Rect& rect) const {
        return all * replay.bytes_per_fragment + 8 * words(rect) <= replay.bytes;
    }
};

Rect tile_of(const Rect& part, int tile_side) {
    const int x = part.x0 / tile_side * tile_side, y = part.y0 / tile_side * tile_side;
    return {x, y, x + tile_side, y + tile_side};
}

}  // namespace

TEST_CASE("tiles are divided into parts that fit or are single pixels and no part that fits is divided") {
    Random random{2086};
    std::size_t cut = 0, whole = 0, pixels = 0;
    for (int round = 0; round < 40; ++round) {
        const FragmentScene scene = uneven_scene(random);
        TestFrame test{scene, "ideal", 16};
        test.frame.replay = {.bytes = 512 << 10, .bytes_per_fragment = std::uint64_t{1} << random_int(random, 3, 16)};
        const auto parts = tile_parts(test.frame, 1 + round % 3);
        std::vector<int> covered(scene.pixels.size());
        bool is_right = true;
        for (const RegionArea& part : parts) {
            const Rect around = tile_of(part.rect, 16);
            const bool is_whole = part.rect == around, fits = Room{scene, part.rect}.fits(test.frame.replay, part.rect);
            is_right &= part.extent == Extent::tile &&
                        part.tile == static_cast<std::size_t>(around.y0 / 16 * 2 + around.x0 / 16);
            is_right &= intersection(part.rect, around) == part.rect && (fits || part.rect.area() == 1);
            is_right &= is_whole || !Room{scene, around}.fits(test.frame.replay, around);
            cut += is_whole ? 0 : 1;
            whole += is_whole ? 1 : 0;
            pixels += part.rect.area() == 1 ? 1 : 0;
            for (int y = part.rect.y0; y < part.rect.y1; ++y)
                for (int x = part.rect.x0; x < part.rect.x1; ++x) ++covered[static_cast<std::size_t>(y * 32 + x)];
        }
        INFO("round " << round);
        CHECK(is_right);
        CHECK(std::ranges::all_of(covered, [](int n) { return n == 1; }));
    }
    CHECK(cut > 100);
    CHECK(whole > 10);
    CHECK(pixels > 10);
}

TEST_CASE("tiles are not divided without fragment statistics or with less than 512 KiB of memory") {
    Random random{2087};
    TestFrame test{uneven_scene(random), "ideal", 16};
    const auto parts_with = [&](const Replay& replay) {
        test.frame.replay = replay;
        return tile_parts(test.frame, 1).size();
    };
    constexpr std::uint64_t least = 512 << 10;
    CHECK(parts_with({.bytes = least, .bytes_per_fragment = 100'000}) > 2);
    CHECK(parts_with({.bytes = least - 1, .bytes_per_fragment = 100'000}) == 2);
    CHECK(parts_with({.bytes = least}) == 2);
    CHECK(parts_with({.bytes = 0, .bytes_per_fragment = 1}) == 2);
}

TEST_CASE("a part is halved along its longer side and both halves make up the whole") {
    for (int width = 1; width <= 9; ++width)
        for (int height = 1; height <= 9; ++height) {
            if (width * height == 1) continue;
            const Rect whole{3, 5, 3 + width, 5 + height};
            const auto [a, b] = halves(whole);
            CHECK(a.area() + b.area() == whole.area());
            CHECK(intersection(a, b).area() == 0);
            CHECK((height >= width ? a.width() == width : a.height() == height));
            CHECK(std::min(a.area(), b.area()) * 3 >= whole.area());
        }
}
