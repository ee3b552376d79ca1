// Tests the choice of an instruction set. The kernels are tested against their scalar references elsewhere.
#include "rasterizer/base/simd.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "rasterizer/base/parallel.h"

using namespace strata;

TEST_CASE("every instruction set of the processor can be chosen and best is the last of them") {
    const std::vector<Simd> available = available_simd();
    REQUIRE(available.front() == Simd::scalar);
    CHECK(std::is_sorted(available.begin(), available.end()));
    CHECK(chosen_simd() == available.back());
    for (const Simd simd : available) {
        const SimdScope kernels{simd};
        CHECK(has_simd(simd));
        CHECK(chosen_simd() == simd);
        CHECK(simd_is_scalar() == (simd == Simd::scalar));
        CHECK(available_simd() == available);
    }
    const SimdScope kernels{Simd::best};
    CHECK(chosen_simd() == available.back());
}

TEST_CASE("a choice ends with its scope and the enclosing one applies again") {
    const Simd usual = chosen_simd();
    {
        const SimdScope outer{Simd::scalar};
        {
            const SimdScope inner{Simd::best};
            CHECK(chosen_simd() == usual);
        }
        CHECK(chosen_simd() == Simd::scalar);
    }
    CHECK(chosen_simd() == usual);
}

TEST_CASE(
    "the workers of a loop have their caller's instruction set even if other threads choose another at the same time") {
    std::atomic<int> wrong{0}, ready{0};
    const auto run = [&](Simd simd) {
        const SimdScope kernels{simd};
        const Simd own = chosen_simd();
        for (++ready; ready < 2;) std::this_thread::yield();
        for (int round = 0; round < 200; ++round)
            parallel_for(64, 4, [&](std::size_t) { wrong += chosen_simd() != own ? 1 : 0; });
    };
    std::thread other{run, Simd::scalar};
    run(Simd::best);
    other.join();
    CHECK(wrong == 0);
}
