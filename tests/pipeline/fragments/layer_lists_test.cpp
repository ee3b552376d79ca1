// Model: a depth buffer at every pixel, which fragments meet in the order of arrival, pass after pass: what passes a test LESS against the
// surface, of keys in the range and behind what the pass before left.
#include "pipeline/fragments/layer_lists.h"

#include <catch2/catch.hpp>

#include "tests/pipeline/fragments/stored_columns.h"

namespace {

using namespace strata::testing;
using strata::pipeline::LayerLists;
using strata::pipeline::SortedFragments;

constexpr std::uint64_t much = std::uint64_t{64} << 20;

// What a pass leaves at all pixels.
struct PassModel {
    std::vector<std::uint32_t> left;               // depths
    std::vector<std::vector<std::uint64_t>> kept;  // words of the least key, in the order of arrival
    std::uint64_t inside = 0, passed = 0;
};

PassModel pass_of(const SortedFragments& sorted, const LayerLists::Peel& peel,
                  const std::vector<std::uint32_t>* bound) {
    PassModel model;
    for (std::size_t p = 0; p < column_pixels; ++p) {
        std::uint32_t depth = peel.surface[p];
        std::vector<std::uint64_t> kept, inside;
        for (const std::uint64_t word : in_order_of_arrival(sorted.of(p))) {
            const std::uint64_t key = word >> 32;
            if (key < peel.least || key >= peel.end || (bound != nullptr && key <= (*bound)[p])) continue;
            inside.push_back(word);
            if (key >= depth || (peel.is_float && depth > 0x7f800000u)) continue;
            depth = static_cast<std::uint32_t>(key);
            ++model.passed;
            kept.assign(1, word);
        }
        model.inside += inside.size();
        for (const std::uint64_t word : inside)
            if (!kept.empty() && word >> 32 == kept[0] >> 32 && word != kept[0]) kept.push_back(word);
        model.kept.push_back(kept);
        model.left.push_back(depth);
    }
    return model;
}

// Whether the layer that was gone on to last, and what is tied with it, is what the model keeps.
bool keeps(const LayerLists& lists, const PassModel& model) {
    std::vector<std::vector<std::uint64_t>> found(column_pixels);
    const auto [key, place, pixel] = lists.layer();
    bool rises = true;
    for (std::size_t k = 0; k < pixel.size(); ++k) {
        found[pixel[k]].push_back(std::uint64_t{key[k]} << 32 | place[k]);
        rises &= k == 0 || pixel[k - 1] < pixel[k];
    }
    std::vector<std::uint32_t> last_of_rank(column_pixels, 0);
    for (const LayerLists::Tied& tied : lists.tied()) {
        rises &= found[tied.pixel].size() == tied.rank && last_of_rank[tied.rank] <= tied.pixel;
        last_of_rank[tied.rank] = tied.pixel;
        found[tied.pixel].push_back(tied.word);
    }
    return rises && found == model.kept;
}

std::vector<std::uint32_t> any_surface(Random& random, int codes, bool is_float) {
    std::vector<std::uint32_t> surface;
    for (std::size_t p = 0; p < column_pixels; ++p) {
        const int kind = random_int(random, 0, is_float ? 4 : 2);
        const std::uint32_t foreign = kind == 3 ? 0xbf800000u : 0x7fc00000u;  // -1 and NaN
        const auto code = static_cast<std::uint32_t>(random_int(random, 0, codes));
        surface.push_back(kind > 2 ? foreign : kind == 2 ? code : static_cast<std::uint32_t>(codes));
    }
    return surface;
}

SortedFragments sorted_of(Random& random, int codes) {
    StoredColumns given;
    fill_columns(random, 40, codes, given);
    SortedFragments sorted;
    REQUIRE(sorted.sort(given.store, {}, column_pixels, much));
    return sorted;
}

}  // namespace

TEST_CASE("lists of layers hold what every pass of a peel keeps, counts and leaves") {
    Random random{2083};
    for (int round = 0; round < 60; ++round) {
        const int codes = std::array{2, 9, 60, 1'000'000}[static_cast<std::size_t>(round % 4)];
        SortedFragments sorted = sorted_of(random, codes);
        const bool is_float = round % 3 == 0;
        const std::vector<std::uint32_t> surface = any_surface(random, codes, is_float);
        LayerLists::Peel peel{0, std::uint64_t{1} << 32, surface.data(), is_float};
        if (round % 5 == 0) peel.least = static_cast<std::uint64_t>(random_int(random, 0, codes));
        if (round % 5 < 2) peel.end = static_cast<std::uint64_t>(random_int(random, 0, codes));
        LayerLists lists;
        REQUIRE(lists.begin(sorted, peel, much));
        std::uint64_t wrong = 0;
        std::vector<std::uint32_t> bound;
        int empty = 0;
        for (int pass = 0; empty < 4; ++pass) {
            const PassModel model = pass_of(sorted, peel, pass == 0 ? nullptr : &bound);
            std::vector<std::uint32_t> depths = surface;
            lists.advance(depths.data());
            wrong += keeps(lists, model) ? 0 : 1;
            wrong += lists.inside() == model.inside && lists.passed() == model.passed ? 0 : 1;
            wrong += depths == model.left && lists.is_left(model.left.data()) ? 0 : 1;
            bound = model.left;
            ++bound[static_cast<std::size_t>(random_int(random, 0, column_pixels - 1))];
            wrong += lists.is_left(bound.data()) ? 1 : 0;
            bound = model.left;
            empty += model.passed == 0 ? 1 : 0;
        }
        INFO("round " << round << ", " << codes << " codes");
        CHECK(wrong == 0);
    }
}

TEST_CASE("lists of layers say whether a fragment has the code of its surface, in or out of the range") {
    Random random{2084};
    SortedFragments sorted = sorted_of(random, 50);
    std::vector<std::uint32_t> surface(column_pixels, 50);
    LayerLists lists;
    REQUIRE(lists.begin(sorted, {.surface = surface.data()}, much));
    CHECK_FALSE(lists.has_any_at_surface());
    for (const std::uint64_t word : {sorted.of(7).front(), sorted.of(7).back()}) {
        surface[7] = static_cast<std::uint32_t>(word >> 32);
        for (const std::uint64_t least : {0, 49}) {
            REQUIRE(lists.begin(sorted, {.least = least, .surface = surface.data()}, much));
            CHECK(lists.has_any_at_surface());
        }
    }
}

TEST_CASE("lists of layers are made anew for another range, surface or limit, and for nothing else") {
    Random random{2085};
    SortedFragments sorted = sorted_of(random, 50);
    std::vector<std::uint32_t> surface(column_pixels, 50);
    LayerLists lists;
    CHECK_FALSE(lists.begin(sorted, {.surface = surface.data()}, 1000));
    CHECK_FALSE(lists.is_of({.surface = surface.data()}));
    CHECK(lists.bytes() == 0);
    REQUIRE(lists.begin(sorted, {.surface = surface.data()}, much));
    CHECK(lists.bytes() > 0);
    CHECK(lists.is_of({.surface = surface.data()}));
    CHECK(lists.begin(sorted, {.surface = surface.data()}, 0));  // what is there takes no more memory
    CHECK_FALSE(lists.is_of({.least = 1, .surface = surface.data()}));
    CHECK_FALSE(lists.is_of({.end = 1, .surface = surface.data()}));
    ++surface[3];
    CHECK_FALSE(lists.is_of({.surface = surface.data()}));
    --surface[3];
    lists.forget();
    CHECK_FALSE(lists.is_of({.surface = surface.data()}));
}
