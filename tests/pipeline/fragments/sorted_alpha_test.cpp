// Model: the alpha test of one alpha at a time, by the formula of its rule.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "pipeline/formats/unorm8.h"
#include "pipeline/fragments/sorted_fragments.h"

namespace {

using namespace strata::pipeline;

constexpr std::array all_tests{CompareFunc::never,   CompareFunc::less,     CompareFunc::equal,  CompareFunc::lequal,
                               CompareFunc::greater, CompareFunc::notequal, CompareFunc::gequal, CompareFunc::always};

bool passes_by_rule(CompareFunc func, auto alpha, auto reference) {
    switch (func) {
        case CompareFunc::never: return false;
        case CompareFunc::less: return alpha < reference;
        case CompareFunc::equal: return alpha == reference;
        case CompareFunc::lequal: return alpha <= reference;
        case CompareFunc::greater: return alpha > reference;
        case CompareFunc::notequal: return alpha != reference;
        case CompareFunc::gequal: return alpha >= reference;
        case CompareFunc::always: return true;
    }
    return false;
}

// Alphas on both sides of 0.25 and 0.5, of one side alone, equal ones, and what has no place between two floats of no sign.
std::vector<std::vector<float>> kinds_of_alphas() {
    constexpr float endless = std::numeric_limits<float>::infinity(), none = std::numeric_limits<float>::quiet_NaN();
    return {{0.5f},
            {0.25f, 0.5f},
            {0.0f, 1.0f, 0.5f},
            {0.25f, 0.75f, 0.5f, 0.501f},
            {0.6f, 0.9f, 1.5f, endless},
            {0.0f, 0.1f, 0x1p-140f},
            {-0.0f, 0.5f},
            {0.5f, -0.5f, 0.75f},
            {-1.0f, -0.25f},
            {none, 0.5f},
            {0.75f, std::copysign(none, -1.0f)},
            {none}};
}

// One batch of each kind in one store, a fragment a pixel.
void fill_kinds(FragmentStore& store) {
    store.start({.code = true, .color = true}, std::uint64_t{16} << 20);
    auto batch = std::make_unique<strata::rasterizer::FragmentBatch>();
    strata::rasterizer::Lanes<std::uint32_t> alive;
    alive.fill(~0u);
    std::uint32_t pixel = 0;
    for (const std::vector<float>& alphas : kinds_of_alphas()) {
        batch->count = static_cast<int>(alphas.size());
        for (std::size_t i = 0; i < alphas.size(); ++i) {
            batch->pixel[i] = pixel++;
            batch->code[i] = 7;
            batch->color[3][i] = alphas[i];
        }
        store.append(*batch, alive);
    }
    store.finish();
}

}  // namespace

TEST_CASE("an alpha test takes from what is sorted the fragments that fail one by one, whatever alphas a batch has") {
    FragmentStore store;
    fill_kinds(store);
    for (const CompareFunc func : all_tests)
        for (const float reference : {0.0f, 0.25f, 0.5f, 1.0f})
            for (const bool eight_bit : {false, true}) {
                const SortRequest request{.alpha = {.enabled = true, .func = func, .ref = reference},
                                          .eight_bit_alpha = eight_bit};
                SortedFragments sorted;
                REQUIRE(sorted.sort(store, request, 64, std::uint64_t{16} << 20));
                std::size_t pixel = 0, wrong = 0, killed = 0;
                for (const std::vector<float>& alphas : kinds_of_alphas())
                    for (const float alpha : alphas) {
                        const bool passes = eight_bit
                                                ? passes_by_rule(func, int{to_unorm8(alpha)}, int{to_unorm8(reference)})
                                                : passes_by_rule(func, alpha, reference);
                        wrong += sorted.of(pixel++).size() == (passes ? 1u : 0u) ? 0 : 1;
                        killed += passes ? 0 : 1;
                    }
                INFO("function " << static_cast<int>(func) << ", reference " << reference << ", 8 bits " << eight_bit);
                CHECK(wrong == 0);
                CHECK(sorted.alpha_killed() == killed);
            }
}

TEST_CASE("a batch's alphas lie between its ends, which are not known where one has a sign or is no number") {
    FragmentStore store;
    fill_kinds(store);
    std::size_t number = 0;
    for (const std::vector<float>& alphas : kinds_of_alphas()) {
        const auto [least, greatest] = store.alpha_ends(number++);
        bool is_plain = true;
        for (const float alpha : alphas) is_plain &= !std::signbit(alpha) && !std::isnan(alpha);
        INFO("kind " << number);
        CHECK(std::isnan(least) == !is_plain);
        CHECK(std::isnan(greatest) == !is_plain);
        if (!is_plain) continue;
        CHECK(least == *std::ranges::min_element(alphas));
        CHECK(greatest == *std::ranges::max_element(alphas));
    }
    FragmentStore without_colors;
    without_colors.start({.code = true, .color = false}, std::uint64_t{16} << 20);
    auto batch = std::make_unique<strata::rasterizer::FragmentBatch>();
    batch->count = 1;
    strata::rasterizer::Lanes<std::uint32_t> alive;
    alive.fill(~0u);
    without_colors.append(*batch, alive);
    CHECK(std::isnan(without_colors.alpha_ends(0)[0]));
}
