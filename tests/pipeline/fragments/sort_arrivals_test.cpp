// Models: std::stable_sort by key of what arrived, and the definition of the three ways in which columns arrive.
#include "pipeline/fragments/sort_arrivals.h"

#include <catch2/catch.hpp>
#include <vector>

#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using strata::pipeline::ColumnArrival;

// A run, then fragments in no order; `codes` different keys. Arrivals have gaps.
std::vector<std::uint64_t> arrived_columns(Random& random, int run, int rest, int codes, bool falls) {
    std::vector<std::uint64_t> keys;
    for (int k = 0; k < run; ++k) keys.push_back(static_cast<std::uint64_t>(random_int(random, 0, codes - 1)));
    std::sort(keys.begin(), keys.end());
    if (falls) std::reverse(keys.begin(), keys.end());
    for (int k = 0; k < rest; ++k) keys.push_back(static_cast<std::uint64_t>(random_int(random, 0, codes - 1)));
    std::vector<std::uint64_t> words;
    std::uint64_t place = 0;
    for (const std::uint64_t key : keys) {
        place += static_cast<std::uint64_t>(random_int(random, 1, 3));
        words.push_back(key << 32 | place);
    }
    return words;
}

ColumnArrival arrival_of(const std::vector<std::uint64_t>& words) {
    bool rises = true, falls = words.size() > 1;
    for (std::size_t k = 1; k < words.size(); ++k) {
        rises = rises && words[k - 1] >> 32 <= words[k] >> 32;
        falls = falls && words[k - 1] >> 32 > words[k] >> 32;
    }
    return rises ? ColumnArrival::near_to_far : falls ? ColumnArrival::far_to_near : ColumnArrival::mixed;
}

}  // namespace

TEST_CASE("a column is sorted by key, equal ones as they arrived, whatever run it begins with and whatever follows") {
    Random random{41};
    int wrong = 0;
    for (int run = 0; run < 80; ++run)
        for (int rest = 0; rest < 40; ++rest) {
            const int codes = random_int(random, 0, 1) == 0 ? 20 : 1'000'000;
            const bool falls = random_int(random, 0, 1) == 0;
            std::vector<std::uint64_t> words = arrived_columns(random, run, rest, codes, falls);
            std::vector<std::uint64_t> expected = words;
            std::stable_sort(expected.begin(), expected.end(),
                             [](std::uint64_t a, std::uint64_t b) { return a >> 32 < b >> 32; });
            const ColumnArrival arrival = arrival_of(words);
            wrong += strata::pipeline::sort_arrivals(words) == arrival ? 0 : 1;
            wrong += words == expected ? 0 : 1;
        }
    CHECK(wrong == 0);
}
