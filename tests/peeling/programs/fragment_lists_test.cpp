// Tests lists of fragments against the scene's fragments, counted and selected one by one.
#include "peeling/programs/fragment_lists.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/pipeline/frames.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

FragmentScene random_scene(Random& random) {
    FragmentScene scene{16, 8};
    for (GivenPixel& pixel : scene.pixels) {
        if (random_int(random, 0, 3) == 0) pixel.opaque = {0.5f, {0, 0, 1, 1}};
        for (int i = random_int(random, 0, 5); i > 0; --i)
            pixel.fragments.push_back({static_cast<float>(random_int(random, 1, 15)) / 16.0f, random_color(random)});
    }
    return scene;
}

// The longest range of whole rows from `first` that fits, or of pixels in its row; extended from the smallest range.
PixelRange expected_range(const std::vector<std::uint32_t>& coverage, std::uint32_t width, std::uint32_t first,
                          std::uint64_t most) {
    PixelRange best{first, first + 1};
    for (std::uint32_t last = first + 1; last <= coverage.size(); ++last) {
        std::uint64_t sum = 0;
        for (std::uint32_t p = first; p < last; ++p) sum += coverage[p];
        const bool is_in_row = first / width == (last - 1) / width, is_rows = first % width == 0 && last % width == 0;
        if (sum <= most && (is_in_row || is_rows)) best.last = last;
    }
    return best;
}

}  // namespace

TEST_CASE("a range is the largest number of whole rows or of pixels of one row whose fragments fit") {
    Random random{501};
    std::size_t wrong = 0;
    for (int round = 0; round < 400; ++round) {
        const auto width = static_cast<std::uint32_t>(random_int(random, 1, 6));
        std::vector<std::uint32_t> coverage(width * static_cast<std::uint32_t>(random_int(random, 1, 6)));
        for (std::uint32_t& c : coverage) c = static_cast<std::uint32_t>(random_int(random, 0, 4));
        const auto most = static_cast<std::uint64_t>(random_int(random, 0, 40));
        for (std::uint32_t first = 0; first < coverage.size(); ++first)
            wrong += next_range(coverage, static_cast<int>(width), first, most) ==
                             expected_range(coverage, width, first, most)
                         ? 0
                         : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a range's rectangle has its pixels in their order") {
    const strata::rasterizer::Rect region{5, 7, 9, 12};
    CHECK(rect_of({0, 20}, region) == region);
    CHECK(rect_of({4, 12}, region) == strata::rasterizer::Rect{5, 8, 9, 10});
    CHECK(rect_of({5, 7}, region) == strata::rasterizer::Rect{6, 8, 8, 9});
    CHECK(rect_of({19, 20}, region) == strata::rasterizer::Rect{8, 11, 9, 12});
    CHECK(rect_of({2, 3}, {3, 3, 4, 8}) == strata::rasterizer::Rect{3, 5, 4, 6});
}

TEST_CASE("lists have the fragments before the opaque surface in submission order for any ranges") {
    Random random{502};
    const FragmentScene scene = random_scene(random);
    const auto extent = GENERATE(Extent::frame, Extent::tile);
    const std::uint64_t most = GENERATE(as<std::uint64_t>{}, 1, 7, 60, 100000);
    TestFrame test{scene, "geforce8"};
    RegionStatistics statistics;
    Region region{test.frame,
                  {extent == Extent::frame ? test.frame.rect() : strata::rasterizer::Rect{8, 0, 16, 8}, 1, extent},
                  statistics};
    const std::vector<std::uint32_t> coverage = coverage_of(region);
    std::set<std::uint32_t> seen;
    std::size_t wrong = 0;
    FragmentLists lists;
    for (std::uint32_t first = 0; first < coverage.size(); first = lists.pixels.last) {
        const PixelRange range = next_range(coverage, region.rect().width(), first, most);
        list_visible(region, range, coverage, Counting::silent, lists);
        for (std::uint32_t p = range.first; p < range.last; ++p) {
            seen.insert(p);
            const auto width = static_cast<std::uint32_t>(region.rect().width());
            const std::uint32_t x = p % width + static_cast<std::uint32_t>(region.rect().x0), y = p / width;
            const GivenPixel& given = scene.pixels[y * 16 + x];
            wrong += coverage[p] == given.fragments.size() ? 0 : 1;
            std::vector<Rgba> expected;
            for (const GivenFragment& f : given.fragments)
                if (!given.opaque || f.depth < given.opaque->depth) expected.push_back(f.color);
            const auto found = lists.of(p);
            wrong += found.size() == expected.size() ? 0 : 1;
            for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i)
                wrong += found[i].color == expected[i] ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
    CHECK(seen.size() == coverage.size());
}
