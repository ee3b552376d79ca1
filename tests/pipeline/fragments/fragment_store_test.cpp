// Model: the batches themselves, kept by the test.
#include "pipeline/fragments/fragment_store.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::pipeline::FragmentStore;
using strata::rasterizer::batch_capacity;
using strata::rasterizer::FragmentBatch;
using strata::rasterizer::FragmentNeeds;
using strata::rasterizer::Lanes;

struct Shaded {
    FragmentBatch batch{};
    Lanes<std::uint32_t> alive{};
};

Shaded random_batch(Random& random, bool with_dead) {
    Shaded s;
    s.batch.count = random_int(random, 1, batch_capacity - 3);
    s.batch.material = static_cast<std::uint32_t>(random_int(random, 0, 5));
    for (std::size_t i = 0; i < batch_capacity; ++i) {
        s.batch.pixel[i] = static_cast<std::uint32_t>(random());
        s.batch.x[i] = static_cast<std::uint16_t>(random());
        s.batch.y[i] = static_cast<std::uint16_t>(random());
        s.batch.primitive[i] = static_cast<std::uint32_t>(random());
        s.batch.shader_z[i] = random_channel(random);
        s.batch.code[i] = static_cast<std::uint32_t>(random());
        s.batch.exact_code[i] = static_cast<std::uint32_t>(random());
        for (auto& channel : s.batch.color) channel[i] = random_channel(random);
        for (auto& coordinate : s.batch.texcoord) coordinate[i] = random_channel(random);
        s.batch.front_facing[i] = static_cast<std::uint8_t>(random() & 1);
        s.alive[i] = with_dead && random() % 3 == 0 ? 0u : ~0u;
    }
    return s;
}

bool same(const auto& a, const auto& b, int count) { return std::equal(a.begin(), a.begin() + count, b.begin()); }

bool same(const Shaded& a, const Shaded& b, const FragmentNeeds& needs) {
    const int n = a.batch.count;
    bool equal = n == b.batch.count && a.batch.material == b.batch.material && same(a.alive, b.alive, n) &&
                 same(a.batch.pixel, b.batch.pixel, n) && same(a.batch.x, b.batch.x, n) &&
                 same(a.batch.y, b.batch.y, n) && same(a.batch.primitive, b.batch.primitive, n);
    if (needs.shader_z) equal &= same(a.batch.shader_z, b.batch.shader_z, n);
    if (needs.code) equal &= same(a.batch.code, b.batch.code, n);
    if (needs.exact_code) equal &= same(a.batch.exact_code, b.batch.exact_code, n);
    for (std::size_t c = 0; c < 4 && needs.color; ++c) equal &= same(a.batch.color[c], b.batch.color[c], n);
    for (std::size_t c = 0; c < 2 && needs.texcoord; ++c) equal &= same(a.batch.texcoord[c], b.batch.texcoord[c], n);
    if (needs.facing) equal &= same(a.batch.front_facing, b.batch.front_facing, n);
    return equal;
}

FragmentNeeds needs_of(unsigned bits) {
    return {(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0, (bits & 32) != 0};
}

}  // namespace

TEST_CASE("a store gives back every batch in order, with whichever arrays it was told to keep") {
    Random random{31};
    FragmentStore store;
    for (unsigned bits = 0; bits < 64; ++bits) {
        const FragmentNeeds needs = needs_of(bits);
        std::vector<Shaded> batches;
        store.start(needs, std::uint64_t{64} << 20);
        for (int i = 0; i < 40; ++i) {
            batches.push_back(random_batch(random, i % 3 == 0));
            store.append(batches.back().batch, batches.back().alive);
        }
        CHECK_FALSE(store.serves(needs));
        store.finish();
        REQUIRE(store.serves(needs));
        REQUIRE(store.batches() == batches.size());
        std::size_t wrong = 0;
        Shaded found;
        for (std::size_t i = 0; i < batches.size(); ++i) {
            store.recall(i, found.batch, found.alive);
            wrong += same(batches[i], found, needs) ? 0 : 1;
        }
        CHECK(wrong == 0);
        for (unsigned other = 0; other < 64; ++other) CHECK(store.serves(needs_of(other)) == ((other & ~bits) == 0));
    }
}

TEST_CASE("a store that would outgrow its limit forgets everything and says so, and never holds more") {
    Random random{32};
    FragmentStore store;
    const FragmentNeeds needs = needs_of(63);
    constexpr std::uint64_t limit = std::uint64_t{1} << 20;
    store.start(needs, limit);
    for (int i = 0; i < 400; ++i) {
        const Shaded s = random_batch(random, false);
        store.append(s.batch, s.alive);
        CHECK(store.bytes() <= limit);
    }
    store.finish();
    CHECK_FALSE(store.serves({}));
    CHECK_FALSE(store.may_start());
    store.forget();
    CHECK(store.may_start());
}
