// Tests the peel loop over blocks against its passes, one depth after the other, fragment by fragment, on the colour
// targets of color_machine.h.
#include "peeling/loops/block_passes.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "rasterizer/base/simd.h"
#include "tests/support/color_machine.h"
#include "tests/support/random_numbers.h"

// A separate namespace: models of several tests use the same short names, and a unity build joins their files.
namespace strata::peeling::block_passes_model {
namespace {

using pipeline::ChannelType;
using strata::testing::Random;
using strata::testing::random_channel;
using strata::testing::random_int;
using namespace strata::testing::color_model;

using scalar::Codes;
using scalar::Color;

std::vector<BlockRules> all_rules() {
    std::vector<BlockRules> rules;
    for (const pipeline::ColorRules& color : all_color_rules()) rules.push_back({color});
    return rules;
}

enum class Colors { plain, any };

float random_value(Random& random, const BlockRules& rules, Colors colors) {
    const float channel = random_channel(random);
    if (rules.color.type == ChannelType::unorm8 && colors == Colors::plain) return channel;
    const int kind = random_int(random, 0, colors == Colors::plain ? 15 : 25);
    const int exponent = random_int(random, -140, 10);
    if (kind < 11) return channel;
    if (kind < 14) return std::ldexp(channel, exponent);
    if (kind < 16) return channel * 1024.0f;
    if (kind < 20) return -std::ldexp(channel, exponent);
    if (kind < 22) return std::ldexp(channel, exponent + 120);
    const std::array<std::uint32_t, 4> rare{0x7f800000u, 0xff800000u, 0x7fc01234u, 0xffa00001u};
    return std::bit_cast<float>(rare[static_cast<std::size_t>(kind - 22)]);
}

// Sixteen lists of at most `depth` fragments; in half of the scenes fragments share depths.
struct PassScene {
    std::vector<std::uint64_t> levels;
    std::vector<Color> color;
    ListBlock block;

    PassScene(Random& random, std::uint32_t depth, bool full, bool ties, const BlockRules& rules, Colors colors)
        : levels(depth * block_lanes, ~std::uint64_t{0}) {
        color.resize(levels.size() + 2 * block_lanes);
        for (std::size_t c = 0; c < 4; ++c)
            for (Color& to : color) {
                const float value = random_value(random, rules, colors);
                to[c] = c == 3 && colors == Colors::plain ? std::min(value, 1.0f) : value;
            }
        block.height = depth;
        block.count = block_lanes;
        for (std::size_t lane = 0; lane < block_lanes; ++lane) {
            block.visible[lane] =
                lane == 0 || full ? depth : static_cast<std::uint32_t>(random_int(random, 0, int(depth)));
            block.hidden[lane] = static_cast<std::uint32_t>(random_int(random, 0, 1));
            std::uint64_t key = 100;
            for (std::size_t k = 0; k < block.visible[lane]; ++k) {
                const bool is_tied = k > 0 && ties && random_int(random, 0, 2) == 0;
                key += is_tied ? 0 : 1;
                if (is_tied) block.has_ties[lane] = ~0u;
                const std::size_t index = full ? k * block_lanes + lane : random() % levels.size();
                levels[k * block_lanes + lane] = key << 32 | index;
            }
        }
        block.levels = levels.data();
        block.color = color.data();
    }

    // A list's colours, grouped by depth.
    [[nodiscard]] std::vector<std::vector<Color>> depths(std::size_t lane) const {
        std::vector<std::vector<Color>> all;
        for (std::size_t k = 0; k < block.visible[lane]; ++k) {
            const std::uint64_t word = levels[k * block_lanes + lane];
            if (k == 0 || word >> 32 != levels[(k - 1) * block_lanes + lane] >> 32) all.emplace_back();
            const auto index = static_cast<std::size_t>(word & 0xffffffffu);
            all.back().push_back(color[index]);
        }
        return all;
    }

    void peel_dual(const BlockRules& rules, std::size_t lane, Codes& front, Codes& back) const {
        const ColorMachine machine{rules.color};
        const auto all = depths(lane);
        for (std::size_t near = 0, far = all.size(); near < far && near < rules.most_passes; ++near) {
            const std::size_t others = block.visible[lane] + block.hidden[lane] - all[near].size();
            const Codes before = front;
            if (others == 0) front = {};
            const float transmittance = sum(1, -machine.read(before[3]));
            for (const Color& c : all[near]) {
                for (std::size_t i = 0; i < 3; ++i) {
                    const float layer = product(transmittance, product(c[3], c[i]));
                    front[i] = machine.max(sum(machine.read(before[i]), layer), front[i]);
                }
                front[3] = machine.max(sum(1, -product(transmittance, sum(1, -c[3]))), front[3]);
            }
            if (near + 1 == far) break;
            Codes dump{};
            for (const Color& c : all[--far])
                for (std::size_t i = 0; i < 4; ++i) dump[i] = machine.max(c[i], dump[i]);
            for (std::size_t i = 0; i < 3 && dump[3] != 0; ++i) back[i] = machine.over(dump[i], dump[3], back[i]);
        }
    }

    void peel_front_to_back(const BlockRules& rules, std::size_t lane, Codes& front) const {
        const ColorMachine machine{rules.color};
        auto all = depths(lane);
        all.push_back({Color{}});
        if (all.size() > rules.most_passes) all.resize(rules.most_passes);
        for (const auto& depth : all) {
            const Color& c = depth.front();
            for (std::size_t i = 0; i < 3; ++i)
                front[i] = machine.under(machine.write(product(c[i], c[3])), front[i], front[3]);
            front[3] = machine.through(machine.write(c[3]), front[3]);
        }
    }
};

// No limit, or one near the end of the deepest list.
std::uint32_t any_limit(Random& random, std::uint32_t depth) {
    const int limit = random_int(random, -4, static_cast<int>(depth) + 2);
    return limit < 0 ? ~0u : static_cast<std::uint32_t>(limit);
}

}  // namespace

TEST_CASE(
    "a block is peeled from both ends like its passes by every rule of a target and limit on every instruction set") {
    Random random{92};
    for (BlockRules rules : all_rules()) {
        std::uint64_t wrong = 0, refused = 0, pixels = 0;
        for (std::uint32_t depth = 0; depth <= 24; ++depth)
            for (const bool ties : {false, true}) {
                rules.most_passes = any_limit(random, depth);
                const PassScene scene{random, depth, depth % 3 == 0, ties, rules, Colors::plain};
                BlockCodes opaque{}, front{}, back{};
                for (auto& channel : opaque)
                    for (auto& code : channel) code = any_stored_code(random, rules.color);
                for (std::size_t lane = 0; lane < block_lanes; ++lane) {
                    Codes f{}, b = scalar::list(opaque, lane);
                    scene.peel_dual(rules, lane, f, b);
                    scalar::put_column(f, lane, front);
                    scalar::put_column(b, lane, back);
                    pixels += 1;
                }
                for (const Simd simd : available_simd()) {
                    const SimdScope kernels{simd};
                    BlockCodes f{}, b = opaque;
                    refused += peel_both_ends(scene.block, f, b, rules) ? 0 : 1;
                    wrong += f == front && b == back ? 0 : 1;
                }
            }
        INFO("type " << static_cast<int>(rules.color.type) << ", half " << static_cast<int>(rules.color.rounding.half)
                     << ", unorm " << static_cast<int>(rules.color.rounding.unorm) << ", blend "
                     << static_cast<int>(rules.color.blend) << ", flushes " << rules.color.flushes);
        CHECK(pixels > 0);
        CHECK(refused == 0);
        CHECK(wrong == 0);
    }
}

TEST_CASE(
    "a block is peeled from the front like its passes by every rule and of any colours on every instruction set") {
    Random random{93};
    for (BlockRules rules : all_rules()) {
        std::uint64_t wrong = 0;
        for (std::uint32_t depth = 0; depth <= 24; ++depth)
            for (const bool ties : {false, true})
                for (const Colors colors : {Colors::plain, Colors::any}) {
                    rules.most_passes = any_limit(random, depth);
                    const PassScene scene{random, depth, depth % 3 == 0, ties, rules, colors};
                    BlockCodes cleared{}, front{};
                    cleared[3].fill(ColorMachine{rules.color}.write(1.0f));
                    for (std::size_t lane = 0; lane < block_lanes; ++lane) {
                        Codes f = scalar::list(cleared, lane);
                        scene.peel_front_to_back(rules, lane, f);
                        scalar::put_column(f, lane, front);
                    }
                    for (const Simd simd : available_simd()) {
                        const SimdScope kernels{simd};
                        BlockCodes f = cleared;
                        peel_near_end(scene.block, f, rules);
                        wrong += f == front ? 0 : 1;
                    }
                }
        INFO("type " << static_cast<int>(rules.color.type) << ", half " << static_cast<int>(rules.color.rounding.half)
                     << ", unorm " << static_cast<int>(rules.color.rounding.unorm) << ", blend "
                     << static_cast<int>(rules.color.blend) << ", flushes " << rules.color.flushes);
        CHECK(wrong == 0);
    }
}

TEST_CASE("colours that MAX cannot order are reported on float targets at any position on every instruction set") {
    Random random{94};
    const std::array<float, 6> foreign{-0.0f,  -0.5f, 1024.5f, std::nanf(""), std::numeric_limits<float>::infinity(),
                                       -1e-40f};
    std::uint64_t wrong = 0;
    for (const BlockRules& rules : all_rules())
        for (std::size_t k = 0; k < 5; ++k)
            for (std::size_t c = 0; c < 4; ++c)
                for (const bool ties : {false, true})
                    for (const float value : foreign) {
                        PassScene scene{random, 5, true, ties, rules, Colors::plain};
                        scene.color[k * block_lanes + random() % block_lanes][c] =
                            c == 3 && value > 1024 ? 1.0000001f : value;
                        for (const Simd simd : available_simd()) {
                            const SimdScope kernels{simd};
                            BlockCodes f{}, b{};
                            const bool is_plain = peel_both_ends(scene.block, f, b, rules);
                            wrong += is_plain == (rules.color.type == ChannelType::unorm8) ? 0 : 1;
                        }
                    }
    CHECK(wrong == 0);
}

TEST_CASE("the last quad composites a front over what is behind it and leaves codes without a front unchanged") {
    Random random{95};
    std::uint64_t wrong = 0;
    for (const BlockRules& rules : all_rules()) {
        if (rules.color.type != ChannelType::unorm8) continue;
        const ColorMachine machine{rules.color};
        for (int trial = 0; trial < 128; ++trial) {
            const bool is_empty = trial < 32;
            const FrontAlpha meaning = trial % 2 == 0 ? FrontAlpha::covers : FrontAlpha::lets_through;
            BlockCodes front{}, back{};
            BlockLanes expected;
            for (std::size_t lane = 0; lane < block_lanes; ++lane) {
                expected[lane] = 0xff000000u;
                for (std::size_t c = 0; c < 4; ++c) {
                    const auto code = static_cast<std::uint32_t>(random_int(random, 0, 255));
                    const std::uint32_t empty = c == 3 && meaning == FrontAlpha::lets_through ? 255u : 0u;
                    front[c][lane] = is_empty ? empty : code;
                    back[c][lane] = static_cast<std::uint32_t>(trial / 2 % 16) * 16 + static_cast<std::uint32_t>(lane);
                }
                const float alpha = machine.read(front[3][lane]);
                const float through = meaning == FrontAlpha::covers ? sum(1, -alpha) : alpha;
                for (std::size_t c = 0; c < 3; ++c) {
                    const float behind = product(through, machine.read(back[c][lane]));
                    const std::uint32_t code =
                        is_empty ? back[c][lane] : machine.write(sum(machine.read(front[c][lane]), behind));
                    expected[lane] |= code << (8 * c);
                }
            }
            for (const Simd simd : available_simd()) {
                const SimdScope kernels{simd};
                BlockLanes words{};
                composite_block(front, back, meaning, rules, words.data());
                wrong += words == expected ? 0 : 1;
            }
        }
    }
    CHECK(wrong == 0);
}

}  // namespace strata::peeling::block_passes_model
