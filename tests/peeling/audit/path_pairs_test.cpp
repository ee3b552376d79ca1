// Tests the pairing of fragments of two captures against a comparison of every two fragments; the expected histogram
// bins are written by hand.
#include "peeling/audit/path_pairs.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "pipeline/frame/captured_fragment.h"
#include "tests/support/random_numbers.h"

using namespace strata::peeling;
using strata::pipeline::CapturedFragment;
using strata::testing::Random;
using strata::testing::random_int;

namespace {

CapturedFragment fragment(std::uint32_t pixel, std::uint32_t primitive, std::uint32_t code) {
    CapturedFragment f;
    f.pixel = pixel;
    f.primitive = primitive;
    f.code = code;
    return f;
}

// In submission order; each pixel gets some of the primitives.
std::vector<CapturedFragment> random_capture(Random& random) {
    std::vector<CapturedFragment> all;
    for (std::uint32_t primitive = 0; primitive < 6; ++primitive)
        for (std::uint32_t pixel = 0; pixel < 5; ++pixel)
            if (random_int(random, 0, 2) > 0)
                all.push_back(fragment(pixel, primitive, static_cast<std::uint32_t>(random_int(random, 0, 9))));
    return all;
}

PairedFragments pairs_by_search(const std::vector<CapturedFragment>& a, const std::vector<CapturedFragment>& b) {
    PairedFragments found;
    for (std::uint32_t pixel = 0; pixel < 5; ++pixel)
        for (const CapturedFragment& f : a)
            for (const CapturedFragment& g : b)
                if (f.pixel == pixel && g.pixel == pixel && f.primitive == g.primitive)
                    found.pairs.push_back({pixel, f.primitive, f.code, g.code});
    found.unmatched = a.size() + b.size() - 2 * found.pairs.size();
    return found;
}

std::vector<UlpBin> bins_of(std::vector<std::int64_t> differences) {
    PairedFragments fragments;
    for (const std::int64_t d : differences)
        fragments.pairs.push_back({0, 0, 1u << 31, static_cast<std::uint32_t>((std::int64_t{1} << 31) + d)});
    return compare(fragments).histogram;
}

}  // namespace

TEST_CASE("fragments of two captures are paired by pixel and primitive and the others counted") {
    Random random{3};
    int wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const auto a = random_capture(random), b = random_capture(random);
        const PairedFragments found = pair_up(a, b), expected = pairs_by_search(a, b);
        if (found.pairs != expected.pairs || found.unmatched != expected.unmatched) ++wrong;
    }
    CHECK(wrong == 0);
}

TEST_CASE("where diagonals differ a fragment's partner is its quad's other triangle unless its own is present") {
    using Captured = std::vector<CapturedFragment>;
    const auto pairs = [](const Captured& a, const Captured& b) { return pair_up(a, b, Match::quad).pairs; };
    CHECK(pairs({fragment(0, 4, 1)}, {fragment(0, 5, 2)}) == std::vector<PathPair>{{0, 4, 1, 2}});
    CHECK(pairs({fragment(0, 5, 1)}, {fragment(0, 4, 2)}) == std::vector<PathPair>{{0, 5, 1, 2}});
    CHECK(pairs({fragment(0, 5, 1)}, {fragment(0, 4, 2), fragment(0, 5, 3)}) == std::vector<PathPair>{{0, 5, 1, 3}});
    CHECK(pairs({fragment(0, 4, 1)}, {fragment(0, 6, 2), fragment(1, 4, 2)}).empty());
    CHECK(pair_up(Captured{fragment(0, 4, 1)}, Captured{fragment(0, 5, 2)}).unmatched == 2);
}

TEST_CASE("the histogram of differences has bins that double in width from 2 on for both signs") {
    CHECK(bins_of({0, 0, 1, 2, 3, 4, 5, 8, 9}) ==
          std::vector<UlpBin>{{0, 0, 2}, {1, 1, 1}, {2, 2, 1}, {3, 4, 2}, {5, 8, 2}, {9, 16, 1}});
    CHECK(bins_of({-1, -2, -3, -4, -5, 7}) ==
          std::vector<UlpBin>{{-8, -5, 1}, {-4, -3, 2}, {-2, -2, 1}, {-1, -1, 1}, {5, 8, 1}});
}

TEST_CASE("the largest difference is reported with its sign and its first fragment") {
    PairedFragments fragments;
    fragments.pairs = {{0, 0, 5, 5}, {1, 4, 9, 7}, {2, 1, 3, 5}, {3, 2, 8, 7}};
    const PathComparison found = compare(fragments);
    CHECK(found.fragments == 4);
    CHECK(found.differing == 3);
    CHECK(found.largest == -2);
    CHECK(found.where == PathPair{1, 4, 9, 7});
    CHECK(compare({}).largest == 0);
}
