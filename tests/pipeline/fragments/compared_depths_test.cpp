// Columns sorted by a compared depth. Models: every pixel's fragments in a list of its own, sorted by std::stable_sort; questions asked of
// one fragment after the other; the least and the greatest by looking at all.
#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <limits>
#include <memory>

#include "pipeline/fragments/sorted_fragments.h"
#include "rasterizer/rules/depth_code.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr std::size_t compared_pixels = 40;
constexpr std::uint64_t much_memory = std::uint64_t{64} << 20;

struct ComparedArrival {
    double own;
    std::uint32_t key, place;
};

// Batches of depths on a grid, so that many are equal, a few steps beside what is compared of them.
struct ComparedColumns {
    FragmentStore store;
    std::vector<std::vector<ComparedArrival>> columns = std::vector<std::vector<ComparedArrival>>(compared_pixels);
    std::vector<std::uint32_t> surface = std::vector<std::uint32_t>(compared_pixels);

    ComparedColumns(Random& random, int batches, const DepthCompare& compare) {
        for (std::uint32_t& code : surface) code = std::bit_cast<std::uint32_t>(random_float(random, 0.5f, 1));
        store.start({.shader_z = true, .code = false, .color = true, .reference = true}, much_memory);
        const auto batch = std::make_unique<strata::rasterizer::FragmentBatch>();
        strata::rasterizer::Lanes<std::uint32_t> alive;
        alive.fill(~0u);
        for (int b = 0; b < batches; ++b) {
            batch->count = compared_pixels;
            for (std::uint32_t p = 0; p < compared_pixels; ++p) {
                batch->pixel[p] = p;
                batch->shader_z[p] = static_cast<float>(random_int(random, 0, 64)) / 64.0f;
                batch->reference_z[p] = double{batch->shader_z[p]} + random_int(random, -2, 2) * 0x1p-30;
                batch->reference_code[p] = 0;
                const bool is_hidden = !(batch->shader_z[p] < std::bit_cast<float>(surface[p]));
                columns[p].push_back(
                    {is_hidden ? std::numeric_limits<double>::infinity() : compare.own(batch->reference_z[p]),
                     strata::rasterizer::ordered_code(batch->shader_z[p]),
                     FragmentStore::place(static_cast<std::size_t>(b), p)});
            }
            store.append(*batch, alive);
        }
        store.finish();
        for (auto& column : columns) std::ranges::stable_sort(column, {}, &ComparedArrival::own);
    }
};

}  // namespace

TEST_CASE(
    "columns are sorted by what is compared, arrivals in order where it is equal, and what is hidden comes last") {
    Random random{31};
    for (const bool quantizes : {false, true})
        for (const int batches : {1, 7, 60}) {
            const DepthCompare compare{.has_reference = true, .quantizes = quantizes};
            ComparedColumns given{random, batches, compare};
            SortedFragments sorted;
            REQUIRE(sorted.sort(given.store, {.key = DepthKey::shader_z, .compared = compare}, compared_pixels,
                                much_memory, given.surface.data()));
            REQUIRE(sorted.occupied().size() == compared_pixels);
            int wrong = 0;
            for (std::size_t p = 0; p < compared_pixels; ++p)
                for (std::size_t k = 0; k < given.columns[p].size(); ++k) {
                    const auto& [own, key, place] = given.columns[p][k];
                    wrong += sorted.compared(p)[k] == own ? 0 : 1;
                    wrong += sorted.column(p)[k] == (std::uint64_t{key} << 32 | place) ? 0 : 1;
                }
            INFO(batches << " batches, quantizes " << quantizes);
            CHECK(wrong == 0);
        }
}

TEST_CASE("where a depth begins to hold, and what the extreme keys of a range are, is what looking at all finds") {
    Random random{32};
    const DepthCompare compare{.has_reference = true, .quantizes = false};
    ComparedColumns given{random, 50, compare};
    SortedFragments sorted;
    REQUIRE(sorted.sort(given.store, {.key = DepthKey::shader_z, .compared = compare}, compared_pixels, much_memory,
                        given.surface.data()));
    int wrong = 0, several = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const auto p = static_cast<std::size_t>(random_int(random, 0, compared_pixels - 1));
        const auto& column = given.columns[p];
        const double bound = random_int(random, -1, 65) / 64.0 + random_int(random, -2, 2) * 0x1p-30;
        const auto first = sorted.first_compared(p, 2, [&](double own) { return own > bound; });
        const auto expected = std::ranges::find_if(column, [&](const auto& a) { return a.own > bound; });
        wrong += first == static_cast<std::uint32_t>(expected - column.begin()) ? 0 : 1;
        const auto end = static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(column.size())));
        if (first >= end) continue;
        ++several;
        const auto [least, greatest] = sorted.extremes(p, first, end);
        const std::span<const ComparedArrival> range{column.data() + first, end - first};
        wrong += least >> 32 == std::ranges::min(range, {}, &ComparedArrival::key).key ? 0 : 1;
        wrong += greatest >> 32 == std::ranges::max(range, {}, &ComparedArrival::key).key ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(several > 500);
}

TEST_CASE("a store without fragments is sorted, one with a depth that is no number is not") {
    const SortRequest request{.key = DepthKey::shader_z, .compared = DepthCompare{.quantizes = false}};
    FragmentStore store;
    store.start({.shader_z = true, .code = false, .reference = true}, much_memory);
    store.finish();
    SortedFragments sorted;
    CHECK(sorted.sort(store, request, compared_pixels, much_memory));
    CHECK(sorted.size() == 0);
    const auto batch = std::make_unique<strata::rasterizer::FragmentBatch>();
    strata::rasterizer::Lanes<std::uint32_t> alive;
    alive.fill(~0u);
    for (const double z : {0.5, std::numeric_limits<double>::quiet_NaN()}) {
        store.start({.shader_z = true, .code = false, .reference = true}, much_memory);
        batch->count = 1;
        batch->pixel[0] = 3;
        batch->shader_z[0] = 0.5f;
        batch->reference_z[0] = z;
        batch->reference_code[0] = 0;
        store.append(*batch, alive);
        store.finish();
        CHECK(sorted.sort(store, request, compared_pixels, much_memory) == (z == 0.5));
    }
}
