// Model: none of its own. The kernels are held to their scalar twins where they live; here stands what a choice means.
#include "rasterizer/base/simd.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace strata;

TEST_CASE("every instruction set that the processor has can be chosen, and best is the last of them") {
    const std::vector<Simd> available = available_simd();
    REQUIRE(available.front() == Simd::scalar);
    CHECK(std::is_sorted(available.begin(), available.end()));
    for (const Simd simd : available) {
        CHECK(choose_simd(simd));
        CHECK(chosen_simd() == simd);
        CHECK(simd_is_scalar() == (simd == Simd::scalar));
        CHECK(available_simd() == available);
    }
    CHECK(choose_simd(Simd::best));
    CHECK(chosen_simd() == available.back());
}

TEST_CASE("a set that the processor lacks is refused and the choice stays") {
    const std::vector<Simd> available = available_simd();
    REQUIRE(choose_simd(Simd::scalar));
    for (const Simd simd : {Simd::sse4, Simd::avx2, Simd::avx512}) {
        const bool has = std::find(available.begin(), available.end(), simd) != available.end();
        CHECK(choose_simd(simd) == has);
        CHECK(chosen_simd() == (has ? simd : Simd::scalar));
        REQUIRE(choose_simd(Simd::scalar));
    }
    REQUIRE(choose_simd(Simd::best));
}
