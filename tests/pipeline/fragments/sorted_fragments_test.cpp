// Models: every pixel's fragments in a list of its own, sorted by std::stable_sort; bounds counted one by one; a depth buffer
// that is a single number, for the fragments that pass it.
#include "pipeline/fragments/sorted_fragments.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>

#include "tests/pipeline/fragments/stored_columns.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::batch_capacity;

const SortRequest without_faint{.alpha = {.enabled = true, .func = CompareFunc::gequal, .ref = 0.25f},
                                .eight_bit_alpha = false};

// What the sorting of some batches leaves: it needs their store no longer.
SortedFragments sorted_columns(Random& random) {
    StoredColumns given;
    fill_columns(random, 60, 40, given);
    SortedFragments sorted;
    REQUIRE(sorted.sort(given.store, {}, column_pixels, std::uint64_t{64} << 20));
    return sorted;
}

// Those of `arrived` that are nearer than all before them.
std::vector<std::uint64_t> updates_by(const std::vector<std::uint64_t>& arrived) {
    std::vector<std::uint64_t> updates;
    for (const std::uint64_t word : arrived)
        if (updates.empty() || word >> 32 < updates.back() >> 32) updates.push_back(word);
    return updates;
}

std::uint32_t passing_one_by_one(std::span<const std::uint64_t> words, std::uint32_t first, std::uint32_t last) {
    return static_cast<std::uint32_t>(updates_by(in_order_of_arrival(words.subspan(first, last - first))).size());
}

}  // namespace

TEST_CASE("sorted fragments are each pixel's by key and arrival, without those that MASK or the alpha test killed") {
    for (const int codes : {1, 7, 1'000'000}) {
        Random random{17};
        StoredColumns given;
        fill_columns(random, 60, codes, given);
        SortedFragments sorted;
        REQUIRE(sorted.sort(given.store, without_faint, column_pixels, std::uint64_t{64} << 20));
        CHECK(sorted.rasterized() == given.rasterized);
        CHECK(sorted.masked() == given.masked);
        CHECK(sorted.alpha_killed() == given.faint);
        CHECK(sorted.size() == given.rasterized - given.masked - given.faint);
        std::uint64_t wrong = 0;
        auto one = std::make_unique<strata::rasterizer::FragmentBatch>();
        for (std::size_t p = 0; p < column_pixels; ++p) {
            const auto words = sorted.of(p);
            REQUIRE(words.size() == given.columns[p].size());
            for (std::size_t k = 0; k < words.size(); ++k) {
                const auto place = static_cast<std::uint32_t>(words[k]);
                given.store.fetch({&place, 1}, {.code = true, .color = true},
                                  strata::pipeline::FragmentStore::Numbers::no, *one);
                const SortedArrival& expected = given.columns[p][k];
                wrong +=
                    one->code[0] == expected.key && one->color[0][0] == expected.red && words[k] >> 32 == expected.key
                        ? 0
                        : 1;
            }
        }
        INFO(codes << " codes");
        CHECK(wrong == 0);
    }
}

TEST_CASE("bounds are found wherever their cursors stood, and as many fragments pass as a depth buffer lets through") {
    Random random{18};
    StoredColumns given;
    fill_columns(random, 60, 40, given);
    SortedFragments sorted;
    REQUIRE(sorted.sort(given.store, without_faint, column_pixels, std::uint64_t{64} << 20));
    const auto occupied = sorted.occupied();
    REQUIRE(occupied.size() > column_pixels / 2);
    std::vector<std::uint64_t> low(occupied.size()), high(occupied.size()), surface(occupied.size());
    std::uint64_t wrong_bounds = 0, wrong_counts = 0;
    for (int look = 0; look < 150; ++look) {
        // Anywhere, or a little behind where they were.
        const auto move = [&](std::uint64_t& bound) {
            const int key = look % 3 == 0 ? random_int(random, 0, 41)
                                          : std::min<int>(41, static_cast<int>(bound) + random_int(random, 0, 1));
            bound = static_cast<std::uint64_t>(key);
        };
        std::ranges::for_each(low, move);
        std::ranges::for_each(high, move);
        const auto below = [&](std::vector<std::uint64_t> bounds, SortedFragments::Cursor which) {
            for (std::uint64_t& bound : bounds) bound = bound == 41 ? std::uint64_t{1} << 32 : bound;
            return sorted.numbers_below(0, bounds, which);
        };
        const auto first = below(low, SortedFragments::Cursor::low);
        const auto last = below(high, SortedFragments::Cursor::high);
        for (std::size_t k = 0; look % 4 == 0 && k < surface.size(); ++k)
            surface[k] = static_cast<std::uint64_t>(random_int(random, 0, 41));
        const auto before = below(surface, SortedFragments::Cursor::surface);
        for (std::size_t k = 0; k < occupied.size(); ++k) {
            const auto words = sorted.column(k);
            REQUIRE(words.data() == sorted.of(occupied[k]).data());
            const auto count = [&](std::uint64_t key) {
                return std::count_if(words.begin(), words.end(), [&](std::uint64_t w) { return w >> 32 < key; });
            };
            wrong_bounds += first[k] == count(low[k]) && last[k] == count(high[k]) ? 0 : 1;
            const std::uint32_t expected = first[k] < last[k] ? passing_one_by_one(words, first[k], last[k]) : 0;
            wrong_counts += sorted.passing(occupied[k], first[k], last[k]) == expected ? 0 : 1;
            wrong_bounds += before[k] == count(surface[k]) ? 0 : 1;
        }
    }
    CHECK(wrong_bounds == 0);
    CHECK(wrong_counts == 0);
}

TEST_CASE("the updates of a depth buffer are found one by one from the nearest back") {
    Random random{20};
    SortedFragments sorted = sorted_columns(random);
    int wrong = 0;
    for (std::size_t p = 0; p < column_pixels; ++p) {
        const auto words = sorted.of(p);
        const auto size = static_cast<std::uint32_t>(words.size());
        const std::uint32_t first = size / 4;
        const std::vector<std::uint64_t> updates = updates_by(in_order_of_arrival(words.subspan(first)));
        for (std::uint32_t n = 1; n <= updates.size(); ++n)
            wrong += words[sorted.update(p, first, size, n)] == updates[n - 1] ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("an update is the same one wherever its finger stood, and what arrived after it is counted") {
    Random random{23};
    SortedFragments sorted = sorted_columns(random);
    int wrong = 0, looked = 0;
    for (int look = 0; look < 20'000; ++look) {
        const auto p = static_cast<std::size_t>(random_int(random, 0, column_pixels - 1));
        const auto words = sorted.of(p);
        const auto size = static_cast<std::uint32_t>(words.size());
        const auto first = static_cast<std::uint32_t>(random_int(random, 0, static_cast<int>(size)));
        const std::uint32_t passing = passing_one_by_one(words, first, size);
        if (passing == 0) continue;
        const auto n = std::min(passing, static_cast<std::uint32_t>(random_int(random, 1, 3)));
        const std::vector<std::uint64_t> arrived = in_order_of_arrival(words.subspan(first));
        const std::vector<std::uint64_t> updates = updates_by(arrived);
        const std::uint32_t found = sorted.update(p, first, size, n);
        wrong += words[found] == updates[n - 1] ? 0 : 1;
        const auto later = std::count_if(arrived.begin(), arrived.end(),
                                         [&](std::uint64_t word) { return place_of(word) > place_of(updates[n - 1]); });
        wrong += sorted.arrived_after(p, first, size, found) == later ? 0 : 1;
        ++looked;
    }
    CHECK(wrong == 0);
    CHECK(looked > 10'000);
}

TEST_CASE("of any piece of the columns the first arrival is found, and the next one before a place") {
    Random random{24};
    SortedFragments sorted = sorted_columns(random);
    const EarliestIndex& index = sorted.earliest();
    const auto all = static_cast<int>(sorted.begin(column_pixels - 1) + sorted.of(column_pixels - 1).size());
    int wrong = 0;
    for (int look = 0; look < 20'000; ++look) {
        const int reach = look % 2 == 0 ? 70 : all;
        const auto first = static_cast<std::size_t>(random_int(random, 0, all));
        const auto last =
            std::min(static_cast<std::size_t>(all), first + static_cast<std::size_t>(random_int(random, 0, reach)));
        std::uint32_t least = ~0u;
        for (std::size_t k = first; k < last; ++k) least = std::min(least, place_of(sorted.word(k)));
        wrong += index.earliest(first, last) == least ? 0 : 1;
        const auto place = static_cast<std::uint32_t>(random_int(random, 0, 1 << 12));
        std::size_t found = first;
        while (found < last && place_of(sorted.word(found)) >= place) ++found;
        wrong += index.first_before(first, last, place) == found ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("without its first arrivals a range passes as a depth buffer lets the others through") {
    Random random{25};
    SortedFragments sorted = sorted_columns(random);
    int wrong = 0;
    for (int look = 0; look < 20'000; ++look) {
        const auto p = static_cast<std::size_t>(random_int(random, 0, column_pixels - 1));
        const auto words = sorted.of(p);
        const auto size = static_cast<int>(words.size());
        const auto first = static_cast<std::uint32_t>(random_int(random, 0, size));
        const auto last = static_cast<std::uint32_t>(random_int(random, static_cast<int>(first), size));
        std::vector<std::uint32_t> dead(last - first);
        for (std::uint32_t k = 0; k < dead.size(); ++k) dead[k] = first + k;
        std::sort(dead.begin(), dead.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return place_of(words[a]) < place_of(words[b]); });
        dead.resize(static_cast<std::size_t>(random_int(random, 0, static_cast<int>(dead.size()))));
        std::sort(dead.begin(), dead.end());
        std::vector<std::uint64_t> left;
        for (std::uint32_t k = first; k < last; ++k)
            if (!std::ranges::binary_search(dead, k)) left.push_back(words[k]);
        const std::uint32_t expected = passing_one_by_one(left, 0, static_cast<std::uint32_t>(left.size()));
        wrong += sorted.passing_without(p, first, last, dead) == expected ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a part of the primitives is sorted as if there were no others") {
    Random random{21};
    StoredColumns given;
    fill_columns(random, 60, 40, given);
    const SortRequest part{.primitives = {{3, 9}, {12, 13}, {40, 48}}};
    SortedFragments all;
    SortedFragments sorted;
    REQUIRE(all.sort(given.store, {}, column_pixels, std::uint64_t{64} << 20));
    REQUIRE(sorted.sort(given.store, part, column_pixels, std::uint64_t{64} << 20));
    auto one = std::make_unique<strata::rasterizer::FragmentBatch>();
    bool is_same = true;
    for (std::size_t p = 0; p < column_pixels; ++p) {
        std::vector<std::uint64_t> expected;
        for (const std::uint64_t word : all.of(p)) {
            const auto place = static_cast<std::uint32_t>(word);
            given.store.fetch({&place, 1}, {}, strata::pipeline::FragmentStore::Numbers::yes, *one);
            const std::uint32_t n = one->primitive[0];
            if ((n >= 3 && n < 9) || n == 12 || (n >= 40 && n < 48)) expected.push_back(word);
        }
        is_same = is_same && std::ranges::equal(expected, sorted.of(p));
    }
    CHECK(is_same);
    CHECK(sorted.rasterized() == given.of_part);
    CHECK(sorted.size() == given.of_part - given.masked_of_part);
    CHECK(sorted.size() > 100);
}

TEST_CASE("behind a compared depth, the stored codes are tested as a depth buffer tests them one by one") {
    using Case = std::pair<int, int>;  // batches and codes; columns of few are counted by the rule itself
    for (const auto& [batches, codes] : {Case{6, 5}, Case{60, 3}, Case{60, 40}, Case{60, 1'000'000}}) {
        Random random{22};
        StoredColumns given;
        fill_columns(random, batches, codes, given);
        auto one = std::make_unique<strata::rasterizer::FragmentBatch>();
        int wrong = 0;
        SortedFragments sorted;
        const DepthCompare compare{.format = strata::rasterizer::DepthFormat::d24, .has_reference = true};
        REQUIRE(sorted.sort(given.store, {.compared = compare}, column_pixels, std::uint64_t{64} << 20));
        for (std::size_t number = 0; number < sorted.occupied().size(); ++number) {
            struct Arrival {
                std::uint32_t place, compared, code;
            };
            std::vector<Arrival> arrivals;
            for (const std::uint64_t word : sorted.column(number)) {
                const auto place = static_cast<std::uint32_t>(word);
                given.store.fetch({&place, 1}, {.code = true, .color = false, .reference = true},
                                  strata::pipeline::FragmentStore::Numbers::no, *one);
                arrivals.push_back({place, one->reference_code[0], one->code[0]});
                wrong += word >> 32 == one->code[0] ? 0 : 1;
            }
            wrong += std::ranges::is_sorted(arrivals, {}, &Arrival::compared) ? 0 : 1;
            const auto surface = static_cast<std::uint32_t>(codes - codes / 3);
            std::vector<Arrival> in_order = arrivals;
            std::ranges::sort(in_order, {}, &Arrival::place);
            for (std::uint32_t first = 0; first < arrivals.size(); ++first) {
                if (first > 0 && arrivals[first].compared == arrivals[first - 1].compared) continue;
                std::uint32_t stored = surface, passed = 0, last_place = 0;
                for (const Arrival& a : in_order) {
                    if (a.compared < arrivals[first].compared || a.code >= stored) continue;
                    stored = a.code;
                    last_place = a.place;
                    ++passed;
                }
                const auto found =
                    sorted.passing_behind(number, static_cast<double>(arrivals[first].compared) - 0.5, surface);
                wrong += found.passed == passed && found.inside == arrivals.size() - first ? 0 : 1;
                if (passed > 0) wrong += found.word == (std::uint64_t{stored} << 32 | last_place) ? 0 : 1;
            }
        }
        INFO(batches << " batches, " << codes << " codes");
        CHECK(wrong == 0);
    }
}

TEST_CASE("what has no order, or no room, is not sorted") {
    Random random{19};
    StoredColumns given;
    fill_columns(random, 10, 40, given);
    SortedFragments sorted;
    const std::uint64_t needed = given.store.used_bytes() + 17 * (given.rasterized - given.masked) + 72 * column_pixels;
    CHECK_FALSE(sorted.sort(given.store, {}, column_pixels, needed - 1));
    CHECK(sorted.sort(given.store, {}, column_pixels, needed));
    CHECK(sorted.sort(given.store, {.key = DepthKey::shader_z}, column_pixels, needed));
    auto batch = std::make_unique<strata::rasterizer::FragmentBatch>();
    strata::rasterizer::Lanes<std::uint32_t> alive{};
    alive.fill(~0u);
    batch->count = 1;
    batch->pixel[0] = 3;
    batch->code[0] = std::bit_cast<std::uint32_t>(-0.5f);
    batch->shader_z[0] = std::bit_cast<float>(0x7fc00000u);
    given.store.start({.shader_z = true, .code = true, .color = false}, std::uint64_t{64} << 20);
    given.store.append(*batch, alive);
    given.store.finish();
    CHECK_FALSE(sorted.sort(given.store, {.key = DepthKey::shader_z}, column_pixels, std::uint64_t{64} << 20));
    CHECK_FALSE(sorted.sort(given.store, {.is_float = true}, column_pixels, std::uint64_t{64} << 20));
    CHECK(sorted.sort(given.store, {}, column_pixels, std::uint64_t{64} << 20));
}
