// Model: words below a bound counted one by one, and the rule of the header: as far as no cursor moves by more than one.
#include "pipeline/fragments/cursor_steps.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "rasterizer/base/simd.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata;
using namespace strata::testing;

// Sorted columns in one piece, a word of ones before the first and behind each.
struct SteppedColumns {
    std::vector<std::uint64_t> words{~std::uint64_t{0}};
    std::vector<std::uint32_t> begin, height;

    [[nodiscard]] std::uint32_t below(std::size_t column, std::uint64_t bound) const {
        std::uint32_t found = 0;
        for (std::uint32_t n = 0; n < height[column]; ++n) found += words[begin[column] + n] >> 32 < bound ? 1 : 0;
        return found;
    }
};

constexpr std::uint64_t greatest_key = 0xffffffff;

SteppedColumns random_columns(Random& random, int columns) {
    SteppedColumns made;
    for (int c = 0; c < columns; ++c) {
        std::vector<std::uint64_t> column;
        for (int n = random_int(random, 1, 6); n-- > 0;) {
            const int kind = random_int(random, 0, 9);
            const std::uint64_t key = kind == 0 ? greatest_key : static_cast<std::uint64_t>(random_int(random, 0, 7));
            column.push_back(key << 32 | (random() & 0xffffff));
        }
        std::sort(column.begin(), column.end());
        made.begin.push_back(static_cast<std::uint32_t>(made.words.size()));
        made.height.push_back(static_cast<std::uint32_t>(column.size()));
        made.words.insert(made.words.end(), column.begin(), column.end());
        made.words.push_back(~std::uint64_t{0});
    }
    return made;
}

void check_steps(Random& random) {
    int wrong = 0, moved = 0, stopped = 0;
    for (int round = 0; round < 3000; ++round) {
        const SteppedColumns made = random_columns(random, random_int(random, 0, 40));
        const std::size_t count = made.begin.size();
        std::vector<std::uint64_t> bounds;
        std::vector<std::uint32_t> cursors, expected;
        const bool has_far = random_int(random, 0, 2) == 0;
        for (std::size_t k = 0; k < count; ++k) {
            const int kind = random_int(random, 0, 9);
            bounds.push_back(kind == 0   ? greatest_key + 1
                             : kind == 1 ? greatest_key
                                         : static_cast<std::uint64_t>(random_int(random, 0, 8)));
            expected.push_back(made.below(k, bounds.back()));
            const bool is_far = has_far && random_int(random, 0, 15) == 0;
            const int to_go = is_far ? random_int(random, -2, 3) : random_int(random, 0, 1);
            cursors.push_back(static_cast<std::uint32_t>(
                std::clamp(static_cast<int>(expected.back()) - to_go, 0, static_cast<int>(made.height[k]))));
        }
        const auto is_near = [&](std::size_t k) { return expected[k] - cursors[k] <= 1; };
        std::size_t first_far = 0;
        while (first_far < count && is_near(first_far)) ++first_far;
        const std::vector<std::uint32_t> before = cursors;
        const std::size_t done =
            pipeline::step_cursors({made.words.data(), made.begin.data(), count}, bounds.data(), cursors.data(), 0);
        wrong += done <= first_far && first_far - done < 8 ? 0 : 1;
        wrong += first_far == count && done != count ? 1 : 0;
        for (std::size_t k = 0; k < count; ++k) {
            wrong += cursors[k] == (k < done ? expected[k] : before[k]) ? 0 : 1;
            moved += cursors[k] != before[k] ? 1 : 0;
        }
        stopped += done < count ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(moved > 1000);
    CHECK(stopped > 100);
}

}  // namespace

TEST_CASE(
    "cursors are stepped on every instruction set to the words below their bounds, up to one that moves farther") {
    Random random{31};
    for (const Simd simd : available_simd()) {
        const SimdScope kernels{simd};
        INFO("instruction set " << static_cast<int>(simd));
        check_steps(random);
    }
}
