// Tests the order in which triangles are submitted.
#include "peeling/sort.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "pipeline/vertices/prepare.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using strata::rasterizer::TriangleSoup;

// Triangles whose clip z are integers from -3 to 3, with many ties. Runs of 7, 5 and 8 triangles.
TriangleSoup soup_of_twenty(Random& random) {
    TriangleSoup soup;
    for (std::uint32_t i = 0; i < 60; ++i) {
        soup.vertices.push_back({.z = static_cast<float>(random_int(random, -3, 3))});
        soup.indices.push_back(i);
    }
    soup.runs = {{.first_index = 0, .index_count = 21, .object = 0},
                 {.first_index = 21, .index_count = 15, .object = 1},
                 {.first_index = 36, .index_count = 24, .object = 2}};
    return soup;
}

double sum(const TriangleSoup& soup, std::uint32_t t) {
    return double{soup.vertices[3 * t].z} + soup.vertices[3 * t + 1].z + soup.vertices[3 * t + 2].z;
}

// Checks that each triangle is after exactly those for which `goes_first` is true.
template <class Before>
std::size_t misplaced(const std::vector<std::uint32_t>& order, Before&& goes_first) {
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        std::size_t before = 0;
        for (const std::uint32_t t : order) before += t != order[i] && goes_first(t, order[i]) ? 1 : 0;
        wrong += before != i ? 1 : 0;
    }
    return wrong;
}

bool is_permutation_of(std::vector<std::uint32_t> order, std::uint32_t count) {
    std::ranges::sort(order);
    for (std::uint32_t t = 0; t < count; ++t)
        if (order[t] != t) return false;
    return order.size() == count;
}

}  // namespace

TEST_CASE(
    "exact order is by the sum of clip z with near first and reverse is far first and ties are in submission order") {
    Random random{503};
    for (int round = 0; round < 50; ++round) {
        TriangleSoup soup = soup_of_twenty(random);
        const auto by_sum = [&](bool near_first) {
            return [&soup, near_first](std::uint32_t a, std::uint32_t b) {
                const double x = sum(soup, a), y = sum(soup, b);
                return x == y ? a < b : near_first == (x < y);
            };
        };
        CHECK(misplaced(submission_order(soup, {.rule = SortRule::exact}), by_sum(true)) == 0);
        CHECK(misplaced(submission_order(soup, {.rule = SortRule::reverse}), by_sum(false)) == 0);
        soup.vertices[7].z = std::numeric_limits<float>::quiet_NaN();
        soup.vertices[20].z = -std::numeric_limits<float>::infinity();
        for (const SortRule rule :
             {SortRule::none, SortRule::exact, SortRule::reverse, SortRule::bucket, SortRule::shuffle})
            CHECK(is_permutation_of(submission_order(soup, {.rule = rule, .buckets = 5, .fraction = 0.5}), 20));
    }
}

TEST_CASE("N buckets divide the range of the keys into N equal parts and within a bucket triangles stay as listed") {
    Random random{504};
    for (const int buckets : {1, 2, 3, 7, 1000}) {
        const TriangleSoup soup = soup_of_twenty(random);
        double least = sum(soup, 0), greatest = least;
        for (std::uint32_t t = 1; t < 20; ++t) {
            least = std::min(least, sum(soup, t));
            greatest = std::max(greatest, sum(soup, t));
        }
        // Bucket i: i (greatest - least) <= N (key - least) < (i + 1) (greatest - least), in integers; the last one
        // includes its upper end.
        const auto bucket = [&](std::uint32_t t) {
            int i = 0;
            while (i + 1 < buckets && (i + 1) * (greatest - least) <= buckets * (sum(soup, t) - least)) ++i;
            return i;
        };
        const auto goes_first = [&](std::uint32_t a, std::uint32_t b) {
            return bucket(a) == bucket(b) ? a < b : bucket(a) < bucket(b);
        };
        CHECK(misplaced(submission_order(soup, {.rule = SortRule::bucket, .buckets = buckets}), goes_first) == 0);
    }
}

TEST_CASE("a shuffle moves exactly its fraction of the sorted triangles and its seed decides which") {
    Random random{505};
    const TriangleSoup soup = soup_of_twenty(random);
    const auto sorted = submission_order(soup, {.rule = SortRule::exact});
    for (const double fraction : {0.0, 0.04, 0.1, 0.5, 1.0}) {
        const Sort sort{.rule = SortRule::shuffle, .fraction = fraction, .seed = 3};
        const auto order = submission_order(soup, sort);
        std::size_t moved = 0;
        for (std::size_t i = 0; i < order.size(); ++i) moved += order[i] != sorted[i] ? 1 : 0;
        const auto wanted = static_cast<std::size_t>(fraction * 20 + 0.5);
        CHECK(moved == (wanted < 2 ? 0 : wanted));
        CHECK(is_permutation_of(order, 20));
        CHECK(order == submission_order(soup, sort));
    }
    CHECK(submission_order(soup, {.rule = SortRule::shuffle, .fraction = 0.5, .seed = 3}) !=
          submission_order(soup, {.rule = SortRule::shuffle, .fraction = 0.5, .seed = 4}));
}

TEST_CASE("parts are submitted one after the other and each is sorted or as listed") {
    Random random{506};
    const TriangleSoup soup = soup_of_twenty(random);
    const auto order =
        submission_order(soup, {.rule = SortRule::exact}, {.part_of_run = {1, 0, 1}, .sorts = {false, true}});
    REQUIRE(order.parts == std::vector<strata::pipeline::PrimitiveRange>{{0, 5}, {5, 20}});
    CHECK(is_permutation_of(order.triangles, 20));
    for (std::uint32_t i = 0; i < 5; ++i) CHECK(order.triangles[i] == 7 + i);
    const std::vector<std::uint32_t> rest(order.triangles.begin() + 5, order.triangles.end());
    CHECK(misplaced(rest, [&](std::uint32_t a, std::uint32_t b) {
              return sum(soup, a) == sum(soup, b) ? a < b : sum(soup, a) < sum(soup, b);
          }) == 0);
}

TEST_CASE("the buckets of a part divide the range of its own keys regardless of those of other parts") {
    // Ten triangles with keys 9 to 0 between others a thousand times as far; five buckets take two each.
    TriangleSoup soup;
    for (std::uint32_t t = 0; t < 30; ++t)
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const bool is_inner = t >= 10 && t < 20;
            soup.indices.push_back(3 * t + corner);
            soup.vertices.push_back({.z = is_inner ? static_cast<float>(19 - t) / 3 : t < 10 ? -3000.0f : 3000.0f});
        }
    soup.runs = {{.first_index = 0, .index_count = 30, .object = 0},
                 {.first_index = 30, .index_count = 30, .object = 1},
                 {.first_index = 60, .index_count = 30, .object = 2}};
    const auto order = submission_order(soup, {.rule = SortRule::bucket, .buckets = 5},
                                        {.part_of_run = {0, 1, 2}, .sorts = {true, true, true}});
    REQUIRE(order.parts == std::vector<strata::pipeline::PrimitiveRange>{{0, 10}, {10, 20}, {20, 30}});
    const std::vector<std::uint32_t> inner(order.triangles.begin() + 10, order.triangles.begin() + 20);
    CHECK(inner == std::vector<std::uint32_t>{18, 19, 16, 17, 14, 15, 12, 13, 10, 11});
}
