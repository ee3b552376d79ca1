// Tests the sum of colours and secondary colours: binary32 against exact sums rounded once, bytes for every pair.
#include "pipeline/lighting/add_secondary.h"

#include <catch2/catch.hpp>
#include <memory>

#include "tests/rasterizer/support.h"

namespace {

using namespace strata;
using pipeline::LightingRule;
using rasterizer::FragmentBatch;

}  // namespace

TEST_CASE("a secondary colour is added to r, g and b, at most to 1, and alpha stays") {
    rasterizer::Random random{61};
    const auto batch = std::make_unique<FragmentBatch>();
    batch->count = 200;
    for (std::size_t i = 0; i < 200; ++i)
        for (std::size_t c = 0; c < 4; ++c) {
            batch->color[c][i] = rasterizer::random_float(random, 0, 1);
            batch->secondary[c][i] = rasterizer::random_float(random, 0, 1);
        }
    const FragmentBatch before = *batch;
    pipeline::add_secondary(LightingRule::single, *batch);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < 200; ++i) {
        wrong += batch->color[3][i] != before.color[3][i] ? 1 : 0;
        for (std::size_t c = 0; c < 3; ++c) {
            const double sum = double{before.color[c][i]} + double{before.secondary[c][i]};  // exact
            wrong += batch->color[c][i] != static_cast<float>(std::min(sum, 1.0)) ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("bytes are added as codes, at most to 255") {
    const auto batch = std::make_unique<FragmentBatch>();
    std::size_t wrong = 0;
    for (int a = 0; a < 256; ++a) {
        batch->count = 256;
        for (std::size_t b = 0; b < 256; ++b) {
            batch->color[0][b] = static_cast<float>(a) / 255.0f;
            batch->secondary[0][b] = static_cast<float>(b) / 255.0f;
        }
        pipeline::add_secondary(LightingRule::float22, *batch);
        for (std::size_t b = 0; b < 256; ++b) {
            const int sum = std::min(a + static_cast<int>(b), 255);
            wrong += batch->color[0][b] != static_cast<float>(sum) / 255.0f ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}
