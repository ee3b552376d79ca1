// Model: std::sort of each column on its own.
#include "peeling/closed/columns.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "peeling/closed/arrivals.h"
#include "rasterizer/base/simd.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata;
using namespace strata::peeling;
using strata::testing::Random;
using strata::testing::random_channel;
using strata::testing::random_int;

enum class Order { any, rising, falling, rising_but_for_two, falling_but_for_two };
enum class Heights { equal, any };

std::uint32_t below(Random& random, std::uint32_t end) {
    return static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(end) - 1));
}

// Sixteen columns of words as they arrived, and the block that is to be made of them.
struct Columns {
    std::vector<std::uint64_t> words;
    ColumnBlock block;

    Columns(Random& random, std::uint32_t depth, Order order, Heights heights) : words(depth * block_lanes) {
        block.height = depth;
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            const std::uint32_t height = heights == Heights::equal || lane == 3 ? depth : below(random, depth + 1);
            block.visible[lane] = height;
            std::vector<std::uint64_t> column(height);
            for (auto& word : column) word = random() >> 1;
            const bool has_two = order == Order::rising_but_for_two || order == Order::falling_but_for_two;
            const auto sorted = column.end() - (order == Order::any ? height : has_two ? std::min(height, 2u) : 0);
            std::sort(column.begin(), sorted);
            if (order == Order::falling || order == Order::falling_but_for_two) std::reverse(column.begin(), sorted);
            for (std::size_t k = 0; k < height; ++k) words[k * block_lanes + lane] = column[k];
        }
    }

    [[nodiscard]] std::vector<std::uint64_t> sorted_one_by_one() const {
        std::vector<std::uint64_t> rows(words.size(), ~std::uint64_t{0});
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            std::vector<std::uint64_t> column;
            for (std::size_t k = 0; k < block.visible[lane]; ++k) column.push_back(words[k * block_lanes + lane]);
            std::ranges::sort(column);
            for (std::size_t k = 0; k < column.size(); ++k) rows[k * block_lanes + lane] = column[k];
        }
        return rows;
    }

    [[nodiscard]] std::vector<std::uint64_t> sorted() {
        std::vector<std::uint64_t> rows(words.size());
        LaneWords heights = block.visible, none{};
        const Arrivals from{.stride = block_lanes,
                            .ranks = block.height,
                            .word = words.data(),
                            .count = heights.data(),
                            .hidden = none.data(),
                            .at_surface = none.data()};
        if (take_block(from, 0, block, rows.data()) != (block.height > 0)) rows.clear();
        return rows;
    }
};

}  // namespace

TEST_CASE("columns of any height and order are sorted, each on its own, on every instruction set") {
    Random random{91};
    std::uint64_t wrong = 0;
    for (const Simd simd : available_simd()) {
        const SimdScope kernels{simd};
        for (std::uint32_t depth = 0; depth <= 70; ++depth)
            for (const Order order :
                 {Order::any, Order::rising, Order::falling, Order::rising_but_for_two, Order::falling_but_for_two})
                for (const Heights heights : {Heights::equal, Heights::any}) {
                    Columns columns{random, depth, order, heights};
                    const std::vector<std::uint64_t> expected = columns.sorted_one_by_one();
                    wrong += columns.sorted() == expected ? 0 : 1;
                    wrong += depth == 0 || columns.block.nearest ==
                                               *std::min_element(expected.begin(), expected.begin() + block_lanes) >> 32
                                 ? 0
                                 : 1;
                }
    }
    CHECK(wrong == 0);
}

namespace {

// A block's data. Colours stand anywhere, or row by row in whole columns.
struct Scene {
    std::vector<std::uint64_t> rows;
    std::array<std::vector<float>, 4> color;
    ColumnBlock block;

    Scene(Random& random, std::uint32_t depth, bool full) : rows(depth * block_lanes, ~std::uint64_t{0}) {
        for (auto& channel : color)
            for (std::size_t i = 0; i <= rows.size(); ++i) channel.push_back(random_channel(random));
        block.height = depth;
        block.count = block_lanes;
        std::vector<std::uint32_t> places(rows.size());
        for (std::size_t i = 0; i < places.size(); ++i) places[i] = static_cast<std::uint32_t>(i);
        for (std::size_t i = places.size(); i > 1 && !full; --i)
            std::swap(places[i - 1], places[below(random, static_cast<std::uint32_t>(i))]);
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            block.visible[lane] = lane == 0 || full ? depth : below(random, depth + 1);
            block.hidden[lane] = below(random, 2);
            for (std::size_t k = 0; k < block.visible[lane]; ++k)
                rows[k * block_lanes + lane] = (100 + k) << 32 | places[k * block_lanes + lane];
        }
        block.levels = rows.data();
        for (std::size_t c = 0; c < 4; ++c) block.color[c] = color[c].data();
    }
};

}  // namespace

namespace {

// Fragments on a few pixels in batches that hold no pixel twice, as lists; some dead, some behind the surface.
struct Fragment {
    std::uint32_t pixel, key;
    std::array<float, 4> color;
};

struct Fragments {
    static constexpr std::size_t pixels = 45;  // three blocks
    std::vector<std::vector<Fragment>> batches;
    std::vector<std::uint32_t> opaque;

    Fragments(Random& random, bool in_runs) : opaque(pixels) {
        for (auto& key : opaque) key = 40 + below(random, 20);
        for (int n = 0; n < 30; ++n) {
            std::vector<Fragment> batch;
            for (std::uint32_t pixel = in_runs ? below(random, 9) : 0; pixel < pixels; ++pixel)
                if (in_runs || below(random, 3) > 0) batch.push_back({pixel, below(random, in_runs ? 30 : 70), {}});
            for (std::size_t i = batch.size(); i > 1 && !in_runs; --i)
                std::swap(batch[i - 1], batch[below(random, static_cast<std::uint32_t>(i))]);
            for (Fragment& f : batch)
                for (float& c : f.color) c = random_channel(random);
            batches.push_back(batch);
        }
    }
};

// Room for all of it.
struct Memory {
    std::vector<std::uint64_t> word, rows;
    std::array<std::vector<float>, 4> color;
    std::vector<std::uint32_t> count, hidden, at_surface;
    Arrivals arrivals;

    explicit Memory(const Fragments& fragments, std::uint32_t ranks = 30)
        : word(64 * 30), rows(16 * 30), count(48), hidden(48), at_surface(48) {
        for (auto& channel : color) channel.resize(30 * 45 + 16);
        arrivals = {.stride = 64,
                    .ranks = ranks,
                    .places = 0,
                    .most_places = 30 * 45,
                    .word = word.data(),
                    .count = count.data(),
                    .hidden = hidden.data(),
                    .at_surface = at_surface.data(),
                    .opaque = fragments.opaque.data()};
        for (std::size_t c = 0; c < 4; ++c) arrivals.color[c] = color[c].data();
    }

    [[nodiscard]] bool append_all(const Fragments& fragments) {
        static pipeline::FragmentBatch batch;
        const pipeline::Lanes<std::uint32_t> alive = [] {
            pipeline::Lanes<std::uint32_t> lanes{};
            for (std::size_t i = 0; i < lanes.size(); ++i) lanes[i] = i % 7 == 3 ? 0u : ~0u;
            return lanes;
        }();
        for (const auto& given : fragments.batches) {
            batch.count = static_cast<int>(given.size());
            for (std::size_t i = 0; i < given.size(); ++i) {
                batch.pixel[i] = given[i].pixel;
                batch.code[i] = given[i].key;
                for (std::size_t c = 0; c < 4; ++c) batch.color[c][i] = given[i].color[c];
            }
            if (!append(arrivals, batch, given.size() < 20 ? alive.data() : all_alive().data())) return false;
        }
        return true;
    }
    static const pipeline::Lanes<std::uint32_t>& all_alive() {
        static const auto lanes = [] {
            pipeline::Lanes<std::uint32_t> all{};
            all.fill(~0u);
            return all;
        }();
        return lanes;
    }
};

// What a column must hold: a stable sort of its visible fragments.
std::vector<Fragment> column_of(const Fragments& fragments, std::size_t pixel, std::uint32_t& hidden,
                                std::uint32_t& at_surface) {
    std::vector<Fragment> column;
    for (const auto& batch : fragments.batches)
        for (std::size_t i = 0; i < batch.size(); ++i) {
            if (batch[i].pixel != pixel || (batch.size() < 20 && i % 7 == 3)) continue;
            hidden += batch[i].key >= fragments.opaque[pixel] ? 1 : 0;
            at_surface += batch[i].key == fragments.opaque[pixel] ? 1 : 0;
            if (batch[i].key < fragments.opaque[pixel]) column.push_back(batch[i]);
        }
    std::ranges::stable_sort(column, {}, &Fragment::key);
    return column;
}

}  // namespace

TEST_CASE("fragments come up again sorted by depth and arrival, with their colours, on every instruction set") {
    Random random{93};
    std::uint64_t wrong = 0;
    for (int trial = 0; trial < 40; ++trial) {
        const Fragments fragments{random, trial % 2 == 0};
        for (const Simd simd : available_simd()) {
            const SimdScope kernels{simd};
            Memory memory{fragments};
            REQUIRE(memory.append_all(fragments));
            for (std::size_t pixel = 0; pixel < 48; ++pixel) {
                std::uint32_t hidden = 0, at_surface = 0;
                const auto expected = column_of(fragments, pixel, hidden, at_surface);
                wrong += memory.count[pixel] == expected.size() && memory.hidden[pixel] == hidden &&
                                 memory.at_surface[pixel] == at_surface
                             ? 0
                             : 1;
                ColumnBlock block;
                const std::size_t first = pixel / block_lanes * block_lanes, lane = pixel % block_lanes;
                const bool is_there = take_block(memory.arrivals, first, block, memory.rows.data());
                wrong += is_there || expected.empty() ? 0 : 1;
                wrong += block.visible[lane] == expected.size() && block.hidden[lane] == hidden &&
                                 block.at_surface[lane] == at_surface
                             ? 0
                             : 1;
                wrong += expected.empty() || block.nearest <= expected[0].key ? 0 : 1;
                bool tied = false;
                for (std::size_t k = 0; k < expected.size(); ++k) {
                    wrong += block.key(lane, k) == expected[k].key ? 0 : 1;
                    for (std::size_t c = 0; c < 4; ++c)
                        wrong += memory.color[c][block.place(lane, k)] == expected[k].color[c] ? 0 : 1;
                    tied |= k > 0 && expected[k].key == expected[k - 1].key;
                }
                wrong += tied == (block.has_ties[lane] != 0) ? 0 : 1;
                for (std::size_t k = expected.size(); k < block.height; ++k)
                    wrong += block.levels[k * block_lanes + lane] == ~std::uint64_t{0} ? 0 : 1;
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("fragments that find no room are refused, on every instruction set") {
    Random random{94};
    for (const bool in_runs : {false, true}) {
        const Fragments fragments{random, in_runs};
        for (const Simd simd : available_simd()) {
            const SimdScope kernels{simd};
            Memory few_ranks{fragments, 5}, few_places{fragments};
            few_places.arrivals.most_places = 400;
            CHECK_FALSE(few_ranks.append_all(fragments));
            CHECK_FALSE(few_places.append_all(fragments));
        }
    }
}

TEST_CASE("the last earlier arrival before a fragment in its column is found, on every instruction set") {
    Random random{95};
    std::uint64_t wrong = 0;
    for (std::uint32_t depth = 1; depth <= 30; ++depth)
        for (const bool in_order : {false, true}) {
            const Scene scene{random, depth, in_order};
            std::vector<std::uint32_t> expected(depth * block_lanes);
            for (std::size_t lane = 0; lane < block_lanes; ++lane)
                for (std::size_t k = 0; k < scene.block.visible[lane]; ++k)
                    for (std::size_t q = 0; q < k; ++q)
                        if (scene.block.place(lane, q) < scene.block.place(lane, k))
                            expected[k * block_lanes + lane] = static_cast<std::uint32_t>(q + 1);
            for (const Simd simd : available_simd()) {
                const SimdScope kernels{simd};
                std::vector<std::uint32_t> before(depth * block_lanes, 77);
                find_arrived_before(scene.block, before.data());
                wrong += before == expected ? 0 : 1;
            }
        }
    CHECK(wrong == 0);
}

TEST_CASE(
    "a program's depths keep their order as keys, those at the surface and NaN are hidden, denormals are noticed, on "
    "every instruction set") {
    const std::vector<float> depths{-2.0f,     -0.0f, 0.0f,          0x1p-126f,  0.25f, 0.5f,   0.75f,
                                    1.0f,      2.0f,  std::nanf(""), -0x1p-126f, 0.5f,  0.125f, -1.0f,
                                    0x1.8p-1f, 0.3f,  0.6f,          0.9f,       0.2f};
    static pipeline::FragmentBatch batch;
    batch.count = static_cast<int>(depths.size());
    const float surface = 0.75f;
    const auto opaque = std::bit_cast<std::uint32_t>(surface);
    for (const Simd simd : available_simd())
        for (const bool with_denormal : {false, true}) {
            const SimdScope kernels{simd};
            std::vector<std::uint64_t> word(64);
            std::vector<std::uint32_t> count(48), hidden(48), at_surface(48);
            std::vector<float> color(64);
            Arrivals to{.stride = 64,
                        .ranks = 1,
                        .most_places = 48,
                        .word = word.data(),
                        .count = count.data(),
                        .hidden = hidden.data(),
                        .at_surface = at_surface.data(),
                        .opaque = &opaque,
                        .same_opaque = true,
                        .by_shader_z = true};
            to.color.fill(color.data());
            for (std::size_t i = 0; i < depths.size(); ++i) {
                batch.pixel[i] = static_cast<std::uint32_t>(i);
                batch.shader_z[i] = depths[i];
            }
            if (with_denormal) batch.shader_z[5] = -0x1p-130f;
            REQUIRE(append(to, batch, Memory::all_alive().data()));
            CHECK(to.has_denormals == with_denormal);
            int wrong = 0;
            for (std::size_t i = 0; i < depths.size(); ++i) {
                const float z = batch.shader_z[i];
                wrong +=
                    count[i] == (z < surface ? 1u : 0u) && hidden[i] == (z < surface ? 0u : 1u) && at_surface[i] == 0
                        ? 0
                        : 1;
                for (std::size_t j = 0; j < depths.size(); ++j)
                    if (z < surface && batch.shader_z[j] < surface)
                        wrong += ((word[i] >> 32) < (word[j] >> 32)) == (z < batch.shader_z[j]) ? 0 : 1;
            }
            CHECK(wrong == 0);
        }
}
