// Tests pixel claims against a set of the pixels in the current batch.
#include "rasterizer/coverage/pixel_claims.h"

#include <catch2/catch.hpp>
#include <set>

#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;
using HeldPixels = std::set<std::array<unsigned, 2>>;  // row, column

}  // namespace

TEST_CASE("neighbouring pixels of a row are claimed exactly if the batch has none of them across every border of 32") {
    Random random{681};
    std::uint64_t wrong = 0, refused = 0, granted = 0;
    for (const int width : {1, 31, 32, 33, 64, 100}) {
        PixelClaims claims{{7, 3, 7 + width, 3 + 5}};
        claims.next_batch();
        HeldPixels held;
        for (int n = 0; n < 3000; ++n) {
            const auto row = static_cast<unsigned>(random_int(random, 0, 4));
            const auto column = static_cast<unsigned>(random_int(random, 0, width - 1));
            const auto count =
                static_cast<unsigned>(random_int(random, 1, std::min(width - static_cast<int>(column), 40)));
            bool is_free = true;
            for (unsigned k = 0; k < count; ++k) is_free = is_free && !held.contains({row, column + k});
            const bool found = claims.claim(row, column, count);
            wrong += found != is_free ? 1 : 0;
            (found ? granted : refused) += 1;
            for (unsigned k = 0; k < count && is_free; ++k) held.insert({row, column + k});
            if (!is_free || n % 37 == 0) {  // a rejected claim may have set some bits, so the batch ends
                claims.next_batch();
                held.clear();
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(refused > 1000);
    CHECK(granted > 1000);
}

TEST_CASE("rows of bits are claimed exactly if the batch has none of them at any start and gaps stay free") {
    Random random{682};
    std::uint64_t wrong = 0, refused = 0, granted = 0;
    for (const int width : {16, 40, 65}) {
        PixelClaims claims{{0, 0, width, 20}};
        claims.next_batch();
        HeldPixels held;
        for (int n = 0; n < 4000; ++n) {
            const auto columns = static_cast<unsigned>(random_int(random, 1, 16)),
                       rows = static_cast<unsigned>(random_int(random, 1, 15));
            const auto left = static_cast<unsigned>(random_int(random, 0, width - static_cast<int>(columns)));
            const auto top = static_cast<unsigned>(random_int(random, 0, 20 - static_cast<int>(rows)));
            std::array<std::uint32_t, 15> bits{};
            HeldPixels wanted;
            for (unsigned r = 0; r < rows; ++r)
                for (unsigned c = 0; c < columns; ++c)
                    if (random() % 4 == 0) {
                        bits[r] |= 1u << c;
                        wanted.insert({top + r, left + c});
                    }
            bool is_free = true;
            for (const auto& pixel : wanted) is_free = is_free && !held.contains(pixel);
            const bool found = claims.claim_rows({top, left}, columns, rows, [&](unsigned r) { return bits[r]; });
            wrong += found != is_free ? 1 : 0;
            (found ? granted : refused) += 1;
            if (is_free)
                held.insert(wanted.begin(), wanted.end());
            else
                claims.next_batch(), held.clear();
        }
    }
    CHECK(wrong == 0);
    CHECK(refused > 1000);
    CHECK(granted > 1000);
}

TEST_CASE("a new batch is empty and the two kinds of claims see each other's pixels") {
    PixelClaims claims{{0, 0, 48, 4}};
    claims.next_batch();
    const auto one_bit = [](unsigned) { return 1u; };
    CHECK(claims.claim(2, 31, 2));
    CHECK_FALSE(claims.claim_rows({2, 32}, 1, 1, one_bit));
    claims.next_batch();
    CHECK(claims.claim_rows({2, 32}, 1, 1, one_bit));
    CHECK(claims.claim(2, 31, 1));
    CHECK(claims.claim(2, 33, 15));
    CHECK_FALSE(claims.claim(2, 32, 1));
    claims.next_batch();
    CHECK(claims.claim(2, 0, 48));
    CHECK(claims.claim(3, 0, 48));
    CHECK_FALSE(claims.claim(3, 47, 1));
}
