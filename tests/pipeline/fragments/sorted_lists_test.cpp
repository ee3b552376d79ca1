// Tests sorted per-pixel lists against std::stable_sort of each pixel's fragments in submission order.
#include "pipeline/fragments/sorted_lists.h"

#include <catch2/catch.hpp>
#include <limits>

#include "pipeline/formats/unorm8.h"
#include "rasterizer/rules/depth_code.h"
#include "tests/pipeline/fragments/recorded_fragments.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

constexpr std::uint64_t enough = std::uint64_t{64} << 20;

std::uint32_t key_by(const SortRequest& request, const GivenRecord::Fragment& f) {
    return request.key == DepthKey::shader_z ? strata::rasterizer::ordered_code(f.shader_z) : f.code;
}

// Expected (key, index) of the fragments that the request selects, pixel by pixel, near to far.
std::vector<std::vector<std::uint64_t>> model(const GivenRecord& given, const SortRequest& request,
                                              std::uint32_t pixels, const std::uint32_t* surface) {
    std::vector<std::vector<std::uint64_t>> lists(pixels);
    for (std::size_t index = 0; index < given.living.size(); ++index) {
        const auto& f = given.living[index];
        const bool is_of_part =
            request.primitives.empty() || std::ranges::any_of(request.primitives, [&](const auto& r) {
                return f.primitive >= r.first && f.primitive < r.last;
            });
        const bool is_bright =
            !request.alpha.enabled || (request.eight_bit_alpha ? to_unorm8(f.color[3]) > to_unorm8(request.alpha.ref)
                                                               : f.color[3] > request.alpha.ref);
        const bool is_visible = surface == nullptr || f.code < surface[f.pixel];
        if (is_of_part && is_bright && is_visible)
            lists[f.pixel].push_back(std::uint64_t{key_by(request, f)} << 32 | index);
    }
    for (auto& list : lists)
        if (!request.by_submission) std::ranges::stable_sort(list, {}, [](std::uint64_t entry) { return entry >> 32; });
    return lists;
}

std::uint64_t differing(const SortedLists& sorted, const std::vector<std::vector<std::uint64_t>>& expected) {
    std::uint64_t wrong = sorted.pixels() == expected.size() ? 0 : 1, size = 0;
    for (std::size_t p = 0; p < expected.size(); ++p) {
        const auto list = sorted.list(p);
        wrong += list.size() == expected[p].size() && sorted.count(p) == list.size() ? 0 : 1;
        for (std::uint32_t k = 0; k < std::min<std::size_t>(list.size(), expected[p].size()); ++k)
            wrong += list[k] == expected[p][k] ? 0 : 1;
        for (std::uint32_t k = list.size(); k < sorted.height(p / block_lanes); ++k)
            wrong += sorted.levels(p / block_lanes)[k * block_lanes + p % block_lanes] == ~std::uint64_t{0} ? 0 : 1;
        size += expected[p].size();
    }
    return wrong + (sorted.size() == size ? 0 : 1);
}

}  // namespace

TEST_CASE(
    "lists contain the requested fragments of a record from near to far and in submission order where keys are equal") {
    Random random{2311};
    const AlphaTest bright{.enabled = true, .func = CompareFunc::greater, .ref = 0.25f};
    const std::vector<SortRequest> requests{{},
                                            {.key = DepthKey::shader_z},
                                            {.is_float = true},
                                            {.by_submission = true},
                                            {.alpha = bright},
                                            {.alpha = bright, .eight_bit_alpha = false},
                                            {.primitives = {{2, 4}, {7, 20}}},
                                            {.by_submission = true, .primitives = {{0, 5}}}};
    for (const std::uint32_t pixels : {1u, 16u, 37u, 300u})
        for (const SortRequest& request : requests)
            for (const bool has_surface : {false, true}) {
                GivenRecord given;
                fill_record(random, random_int(random, 0, 30), pixels, 12, all_values, given);
                std::vector<std::uint32_t> surface(pixels);
                for (auto& code : surface) code = static_cast<std::uint32_t>(random_int(random, 0, 12));
                const std::uint32_t* const codes = has_surface ? surface.data() : nullptr;
                SortedLists sorted;
                REQUIRE(sorted.sort(given.record, request, pixels, enough, codes));
                CHECK(sorted.is_of(request));
                CHECK(sorted.is_sorted());
                CHECK(differing(sorted, model(given, request, pixels, codes)) == 0);
            }
}

TEST_CASE("depths without an order are not sorted and the request is not tried again") {
    const auto sorts = [](float z, std::uint32_t code, const SortRequest& request) {
        TileFragments record;
        record.start({}, enough);
        auto batch = std::make_unique<strata::rasterizer::FragmentBatch>();
        batch->count = 1;
        batch->pixel[0] = 0;
        batch->shader_z[0] = z;
        batch->code[0] = code;
        strata::rasterizer::Lanes<std::uint32_t> alive{~0u};
        record.append(*batch, alive);
        record.finish();
        SortedLists sorted;
        const bool is_sorted = sorted.sort(record, request, 1, enough);
        CHECK(sorted.is_of(request));
        CHECK(sorted.is_sorted() == is_sorted);
        return is_sorted;
    };
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    CHECK(sorts(0.5f, 0, {.key = DepthKey::shader_z}));
    CHECK_FALSE(sorts(not_a_number, 0, {.key = DepthKey::shader_z}));
    CHECK(sorts(not_a_number, 7, {}));
    CHECK(sorts(0, 0x7f800000u, {.is_float = true}));
    CHECK_FALSE(sorts(0, 0x7f800001u, {.is_float = true}));
    CHECK(sorts(0, 0x7f800001u, {.is_float = false}));
}

TEST_CASE("lists that would exceed their limit are not sorted") {
    Random random{2312};
    GivenRecord given;
    fill_record(random, 10, 40, 12, all_values, given);
    std::vector<std::uint32_t> count(48);
    for (const auto& f : given.living) ++count[f.pixel];
    std::uint64_t entries = 0;
    for (std::size_t block = 0; block < 3; ++block)
        entries += block_lanes * *std::max_element(count.begin() + static_cast<std::ptrdiff_t>(16 * block),
                                                   count.begin() + static_cast<std::ptrdiff_t>(16 * block + 16));
    SortedLists sorted;
    CHECK(sorted.sort(given.record, {}, 40, 8 * entries));
    CHECK_FALSE(sorted.sort(given.record, {}, 40, 8 * entries - 1));
    CHECK_FALSE(sorted.is_sorted());
}

TEST_CASE("the number of keys below a bound is found from any starting point of the search") {
    Random random{2313};
    GivenRecord given;
    fill_record(random, 60, 5, 40, all_values, given);
    SortedLists sorted;
    REQUIRE(sorted.sort(given.record, {}, 5, enough));
    std::uint64_t wrong = 0;
    for (std::size_t p = 0; p < 5; ++p) {
        const auto list = sorted.list(p);
        for (const std::uint64_t bound : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{17}, std::uint64_t{39},
                                          std::uint64_t{40}, std::uint64_t{0xffffffff}, std::uint64_t{1} << 32}) {
            std::uint32_t expected = 0;
            while (expected < list.size() && list[expected] >> 32 < bound) ++expected;
            for (std::uint32_t from = 0; from <= list.size(); ++from)
                wrong += list.below(bound, from) == expected ? 0 : 1;
        }
    }
    CHECK(wrong == 0);
}
