// Model: std::sort of each column on its own; for the dual blocks the passes themselves, fragment by fragment in binary32 as dual.cpp
// writes them, stored by an UNORM8 rule of the test's own.
#include "peeling/columns.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/block_passes.h"
#include "rasterizer/simd.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata;
using namespace strata::peeling;
using strata::testing::Random;
using strata::testing::random_channel;
using strata::testing::random_int;

using Rows = std::vector<std::uint64_t>;

enum class Order { random, rising, falling, falling_but_for_two };

Rows make_rows(Random& random, std::size_t depth, Order order) {
    Rows rows(depth * block_lanes);
    for (auto& value : rows) value = random();
    const std::size_t sorted = order == Order::random ? 0 : order == Order::falling_but_for_two && depth > 2 ? depth - 2 : depth;
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        std::vector<std::uint64_t> column;
        for (std::size_t k = 0; k < sorted; ++k) column.push_back(rows[k * block_lanes + lane]);
        std::ranges::sort(column);
        if (order != Order::rising) std::ranges::reverse(column);
        for (std::size_t k = 0; k < sorted; ++k) rows[k * block_lanes + lane] = column[k];
    }
    return rows;
}

Rows sorted_by_column(const Rows& rows) {
    Rows result = rows;
    const std::size_t depth = rows.size() / block_lanes;
    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
        std::vector<std::uint64_t> column;
        for (std::size_t k = 0; k < depth; ++k) column.push_back(rows[k * block_lanes + lane]);
        std::ranges::sort(column);
        for (std::size_t k = 0; k < depth; ++k) result[k * block_lanes + lane] = column[k];
    }
    return result;
}

}  // namespace

TEST_CASE("columns of any depth and order are sorted, each on its own, on every instruction set") {
    Random random{91};
    std::uint64_t wrong = 0;
    for (const Simd simd : available_simd()) {
        REQUIRE(choose_simd(simd));
        for (std::size_t depth = 0; depth <= 70; ++depth)
            for (const Order order : {Order::random, Order::rising, Order::falling, Order::falling_but_for_two}) {
                Rows rows = make_rows(random, depth, order);
                const Rows expected = sorted_by_column(rows);
                sort_columns(rows.data(), depth);
                wrong += rows == expected ? 0 : 1;
            }
    }
    REQUIRE(choose_simd(Simd::best));
    CHECK(wrong == 0);
}

namespace {

std::uint32_t below(Random& random, std::uint32_t end) {
    return static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(end) - 1));
}

std::uint32_t stored(float x) {
    const double clamped = std::clamp(double{x}, 0.0, 1.0);
    return static_cast<std::uint32_t>(std::floor(clamped * 255.0 + 0.5));
}

// A block's data, and the passes over one column of it.
struct Scene {
    std::vector<std::uint16_t> order;
    std::array<std::vector<float>, 4> color;
    PeelBlock block;

    Scene(Random& random, std::uint32_t depth) : order(depth * block_lanes) {
        for (auto& channel : color)
            for (std::size_t i = 0; i < order.size(); ++i) channel.push_back(random_channel(random));
        block = {};
        block.depth = depth;
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            block.visible[lane] = lane == 0 ? depth : below(random, depth + 1);
            block.alive[lane] = block.visible[lane] + below(random, 2);
            std::vector<std::uint16_t> arrivals(block.visible[lane]);
            for (std::size_t k = 0; k < arrivals.size(); ++k) arrivals[k] = static_cast<std::uint16_t>(k);
            for (std::size_t k = arrivals.size(); k > 1; --k) std::swap(arrivals[k - 1], arrivals[below(random, static_cast<std::uint32_t>(k))]);
            for (std::size_t k = 0; k < depth; ++k)
                order[k * block_lanes + lane] = k < arrivals.size() ? arrivals[k] : std::uint16_t{0xffff};
            for (std::size_t c = 0; c < 4; ++c) block.back[c][lane] = below(random, 256);
        }
        block.order = order.data();
        for (std::size_t c = 0; c < 4; ++c) block.color[c] = color[c].data();
    }

    [[nodiscard]] float value(std::size_t lane, std::size_t k, std::size_t c) const {
        return color[c][order[k * block_lanes + lane] * block_lanes + lane];
    }

    void expect(std::size_t lane, BlockCodes& front, BlockCodes& back) const {
        std::size_t near = 0, far = block.visible[lane];
        std::array<std::uint32_t, 4> f{}, b{};
        for (std::size_t c = 0; c < 4; ++c) b[c] = block.back[c][lane];
        for (; near < far; ++near) {
            std::array<float, 4> held;
            for (std::size_t c = 0; c < 4; ++c) held[c] = static_cast<float>(f[c]) / 255.0f;
            for (std::size_t c = 0; c < 4; ++c) {
                const float a = value(lane, near, 3);
                const float under = c == 3 ? 1.0f - (1.0f - held[3]) * (1.0f - a)
                                           : held[c] + (1.0f - held[3]) * (a * value(lane, near, c));
                f[c] = std::max(block.alive[lane] > 1 ? f[c] : 0u, stored(under));
            }
            if (near + 1 >= far) break;
            --far;
            const std::uint32_t a = stored(value(lane, far, 3));
            for (std::size_t c = 0; c < 3 && a != 0; ++c)
                b[c] = static_cast<std::uint32_t>(std::floor((stored(value(lane, far, c)) * a + b[c] * (255 - a)) / 255.0 + 0.5));
        }
        for (std::size_t c = 0; c < 4; ++c) front[c][lane] = f[c], back[c][lane] = b[c];
    }
};

}  // namespace

TEST_CASE("a block of columns is peeled from both ends like its passes, on every instruction set") {
    Random random{92};
    std::uint64_t wrong = 0;
    for (std::uint32_t depth = 0; depth <= 40; ++depth) {
        const Scene scene{random, depth};
        BlockCodes front{}, back{};
        for (std::size_t lane = 0; lane < block_lanes; ++lane) scene.expect(lane, front, back);
        for (const Simd simd : available_simd()) {
            REQUIRE(choose_simd(simd));
            PeelBlock block = scene.block;
            peel_both_ends(block, pipeline::BlendRounding::nearest);
            wrong += block.front == front && block.back == back ? 0 : 1;
        }
    }
    REQUIRE(choose_simd(Simd::best));
    CHECK(wrong == 0);
}
