// Tests the record of a tile's fragments against the fragments themselves, which the test keeps one by one.
#include "pipeline/fragments/tile_fragments.h"

#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "tests/pipeline/fragments/recorded_fragments.h"

namespace {

using namespace strata::testing;
using strata::pipeline::TileFragments;
using strata::rasterizer::FragmentBatch;
using strata::rasterizer::FragmentNeeds;
using strata::rasterizer::Lanes;

FragmentNeeds needs_of(unsigned bits) {
    return {.shader_z = (bits & 1) != 0,
            .code = (bits & 2) != 0,
            .exact_code = (bits & 4) != 0,
            .color = (bits & 8) != 0,
            .reference = (bits & 16) != 0};
}

bool is_lane(const FragmentBatch& batch, std::size_t i, const GivenRecord::Fragment& f, const FragmentNeeds& needs) {
    bool same =
        batch.primitive[i] == f.primitive && (!needs.code || batch.code[i] == f.code) &&
        (!needs.exact_code || batch.exact_code[i] == f.exact_code) &&
        (!needs.shader_z || batch.shader_z[i] == f.shader_z) &&
        (!needs.reference || (batch.reference_code[i] == f.reference_code && batch.reference_z[i] == f.reference_z));
    for (std::size_t c = 0; needs.color && c < 4; ++c) same &= batch.color[c][i] == f.color[c];
    return same;
}

// True if a fragment of this colour is plain.
bool is_plain(const std::array<float, 4>& color) {
    TileFragments record;
    record.start({}, 1 << 10);
    auto batch = std::make_unique<FragmentBatch>();
    batch->count = 1;
    for (std::size_t c = 0; c < 4; ++c) batch->color[c][0] = color[c];
    Lanes<std::uint32_t> alive{~0u};
    record.append(*batch, alive);
    record.finish();
    return record.has_plain_colors();
}

}  // namespace

TEST_CASE("a record returns at each index the values of the living fragment with that submission number") {
    Random random{2301};
    const auto batch = std::make_unique<FragmentBatch>();
    for (unsigned bits = 0; bits < 32; ++bits) {
        GivenRecord given;
        const FragmentNeeds needs = needs_of(bits);
        fill_record(random, 9, 300, 50, needs, given);
        REQUIRE(given.record.serves(needs));
        REQUIRE(given.record.size() == given.living.size());
        REQUIRE(given.dead > 0);
        CHECK(given.record.bytes() == given.living.size() * TileFragments::bytes_of(needs));
        std::uint64_t wrong = 0;
        std::vector<std::uint32_t> places(200);
        for (auto& place : places) place = static_cast<std::uint32_t>(random() % given.living.size());
        given.record.fetch(places, needs, *batch);
        for (std::size_t i = 0; i < places.size(); ++i) {
            wrong += is_lane(*batch, i, given.living[places[i]], needs) ? 0 : 1;
            wrong += given.record.pixel()[places[i]] == given.living[places[i]].pixel ? 0 : 1;
        }
        INFO("needs " << bits);
        CHECK(wrong == 0);
    }
}

TEST_CASE("a record serves requests for values that it holds and never texture coordinates or facing") {
    Random random{2302};
    for (unsigned held = 0; held < 32; ++held) {
        GivenRecord given;
        fill_record(random, 1, 30, 5, needs_of(held), given);
        for (unsigned asked = 0; asked < 32; ++asked)
            CHECK(given.record.serves(needs_of(asked)) == ((asked & ~held) == 0));
        for (const FragmentNeeds& more : {FragmentNeeds{.texcoord = true}, {.facing = true}, {.units = 1}}) {
            CHECK_FALSE(TileFragments::records(more));
            CHECK_FALSE(given.record.serves(more));
        }
    }
}

TEST_CASE("a record that would exceed its limit stays empty until it is reset") {
    Random random{2303};
    GivenRecord given;
    fill_record(random, 20, 200, 50, all_values, given);
    const std::uint64_t bytes = given.record.bytes();
    for (const std::uint64_t limit : {bytes, bytes - 1}) {
        GivenRecord again;
        Random same{2303};
        fill_record(same, 20, 200, 50, all_values, again, limit);
        const bool fits = limit == bytes;
        CHECK(again.record.serves(all_values) == fits);
        CHECK(again.record.size() == (fits ? given.living.size() : 0));
        CHECK(again.record.may_start() == fits);
        again.record.forget();
        CHECK(again.record.may_start());
        CHECK_FALSE(again.record.serves({.shader_z = false, .code = false, .color = false}));
    }
}

TEST_CASE("all fragments are read once in submission order and no batch of them has a pixel twice") {
    Random random{2304};
    for (const std::uint32_t pixels : {1u, 7u, 300u, 5000u}) {
        GivenRecord given;
        fill_record(random, 40, pixels, 50, all_values, given);
        TileFragments::Reading reading{0, 0, std::vector<std::uint32_t>(pixels)};
        Lanes<std::uint32_t> memory;
        std::uint32_t next = 0;
        std::uint64_t wrong = 0;
        for (auto places = given.record.next_indices(reading, memory); !places.empty();
             places = given.record.next_indices(reading, memory)) {
            std::set<std::uint32_t> seen;
            for (const std::uint32_t place : places) {
                wrong += place == next++ ? 0 : 1;
                wrong += seen.insert(given.living[place].pixel).second ? 0 : 1;
            }
        }
        CHECK(next == given.living.size());
        CHECK(wrong == 0);
    }
}

TEST_CASE("the lead of compared codes is the most by which one exceeds the code of its fragment") {
    Random random{2305};
    for (const int batches : {0, 1, 6}) {
        GivenRecord given;
        fill_record(random, batches, 100, 1000, all_values, given);
        std::uint32_t lead = 0;
        for (const auto& f : given.living)
            if (f.reference_code > f.code) lead = std::max(lead, f.reference_code - f.code);
        CHECK(given.record.reference_lead() == lead);
    }
}

TEST_CASE("colours are plain from 0 to 1024 and alphas from 0 to 1 but not -0 and NaN") {
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    for (std::size_t channel = 0; channel < 4; ++channel)
        for (const auto& [value, plain] : {std::pair{0.0f, true},
                                           {1.0f, true},
                                           {1024.0f, channel < 3},
                                           {std::nextafter(1024.0f, 2000.0f), false},
                                           {std::nextafter(1.0f, 2.0f), channel < 3},
                                           {-0.0f, false},
                                           {-0.5f, false},
                                           {not_a_number, false},
                                           {std::numeric_limits<float>::infinity(), false}}) {
            std::array<float, 4> color{0.5f, 0.5f, 0.5f, 0.5f};
            color[channel] = value;
            INFO("channel " << channel << ": " << value);
            CHECK(is_plain(color) == plain);
        }
}

TEST_CASE("a record that is filled again has nothing of the previous tile") {
    TileFragments record;
    const auto batch = std::make_unique<FragmentBatch>();
    batch->count = 1;
    batch->code[0] = 7;
    for (const bool plain : {true, false, true}) {
        record.start(all_values, 1 << 10);
        for (std::size_t c = 0; c < 4; ++c) batch->color[c][0] = plain ? 0.5f : -1.0f;
        batch->reference_code[0] = plain ? 7 : 9;
        record.append(*batch, Lanes<std::uint32_t>{~0u});
        record.finish();
        CHECK(record.size() == 1);
        CHECK(record.has_plain_colors() == plain);
        CHECK(record.reference_lead() == (plain ? 0u : 2u));
    }
}
