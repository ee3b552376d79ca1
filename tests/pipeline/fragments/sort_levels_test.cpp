// Tests the sorting of sixteen lists against std::sort of each list.
#include "pipeline/fragments/sort_levels.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata;
using pipeline::block_lanes;
using testing::Random;
using testing::random_int;

enum class Order { any, rising, falling, rising_but_for_two, falling_but_for_two };
enum class Heights { equal, any };

using List = std::vector<std::uint64_t>;

// Sixteen lists in submission order, padded with ~0.
std::vector<List> columns_of(Random& random, std::size_t height, Order order, Heights heights) {
    std::vector<List> lists(block_lanes);
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        const bool is_full = heights == Heights::equal || lane == 3;
        List& list = lists[lane];
        list.resize(is_full ? height : static_cast<std::size_t>(random_int(random, 0, static_cast<int>(height))));
        for (auto& entry : list) entry = random() >> 1;
        const bool has_two = order == Order::rising_but_for_two || order == Order::falling_but_for_two;
        const auto behind = order == Order::any ? list.size() : has_two ? std::min<std::size_t>(list.size(), 2) : 0;
        const auto ordered = list.end() - static_cast<std::ptrdiff_t>(behind);
        std::sort(list.begin(), ordered);
        if (order == Order::falling || order == Order::falling_but_for_two) std::reverse(list.begin(), ordered);
        list.resize(height, ~std::uint64_t{0});
    }
    return lists;
}

std::vector<std::uint64_t> levels_of(const std::vector<List>& lists, std::size_t height) {
    std::vector<std::uint64_t> levels(height * block_lanes);
    for (std::size_t k = 0; k < height; ++k)
        for (std::size_t lane = 0; lane < block_lanes; ++lane) levels[k * block_lanes + lane] = lists[lane][k];
    return levels;
}

}  // namespace

TEST_CASE("lists of any height and order are sorted independently on every instruction set") {
    Random random{91};
    std::uint64_t wrong = 0;
    for (const Simd simd : available_simd()) {
        const SimdScope kernels{simd};
        for (std::size_t height = 0; height <= 70; ++height)
            for (const Order order :
                 {Order::any, Order::rising, Order::falling, Order::rising_but_for_two, Order::falling_but_for_two})
                for (const Heights heights : {Heights::equal, Heights::any}) {
                    std::vector<List> lists = columns_of(random, height, order, heights);
                    std::vector<std::uint64_t> levels = levels_of(lists, height);
                    pipeline::sort_levels(levels.data(), height);
                    for (List& list : lists) std::ranges::sort(list);
                    wrong += levels == levels_of(lists, height) ? 0 : 1;
                }
    }
    CHECK(wrong == 0);
}
