// Tests that results do not depend on a host program's rounding mode, flush-to-zero or denormals-are-zero, and that its
// settings are restored.
#include "rasterizer/base/float_environment.h"

#include <catch2/catch.hpp>
#include <cfenv>

#include "rasterizer/base/parallel.h"
#include "tests/rasterizer/scene.h"

#if defined(__SSE2__)
#include <xmmintrin.h>

namespace {

using namespace strata::rasterizer;

// Sets the host's environment for the lifetime of a scope: only MXCSR, so that libm is not affected.
class Host {
  public:
    explicit Host(unsigned mxcsr) : saved_{_mm_getcsr()} { _mm_setcsr(mxcsr); }
    ~Host() { _mm_setcsr(saved_); }
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

  private:
    unsigned saved_;
};

constexpr unsigned masked = 0x1f80, flush = 0x8040;  // exceptions masked; FTZ and DAZ
constexpr std::array<unsigned, 5> hosts{masked | flush, masked | 0x2000, masked | 0x4000, masked | 0x6000,
                                        masked | flush | 0x4000};

struct Outcome {
    std::vector<Fragment> fragments;
    SetupCounters counters;
    unsigned after_set_up = 0;
    friend bool operator==(const Outcome&, const Outcome&) = default;
};

// set_up enters the environment itself; draw is called by an executor that has entered it.
[[nodiscard]] Outcome run(const TriangleSoup& soup, const RasterRules& rules, const DepthRequest& depth, int threads) {
    RasterState state = scene_state(48, 40);
    state.depth_format = depth.format;
    state.polygon_offset = {true, 1.25f, 3.0f};
    const Geometry geometry = set_up(soup, state, rules, threads);
    const unsigned after_set_up = _mm_getcsr() & 0xffc0u;  // without the sticky flags
    const strata::FloatEnvironment ours;
    return {draw(geometry, depth, everything).fragments, geometry.counters, after_set_up};
}

}  // namespace

TEST_CASE("set-up and rasterization give the same bits under flush-to-zero and every rounding mode of the host") {
    const TriangleSoup soup = random_soup(61, 60, SoupKind::perspective_with_tiny_values);
    const RasterRules geforce3_like{.subpixel_bits = 4,
                                    .snap = Snap::toward_zero,
                                    .z_clip = ZClip::per_fragment,
                                    .window_z = WindowZ::buffer_units,
                                    .color = ColorInterpolation::weights_8bit};
    for (const auto& [rules, depth] : {std::pair{RasterRules{}, DepthRequest{}},
                                       std::pair{geforce3_like, DepthRequest{DepthPath::window_z, DepthFormat::d24}}}) {
        Outcome expected = run(soup, rules, depth, 1);
        REQUIRE(expected.fragments.size() > 1000);
        for (const unsigned host : hosts)
            for (const int threads : {1, 3}) {
                unsigned after = 0;
                Outcome found;
                {
                    const Host environment{host};
                    found = run(soup, rules, depth, threads);
                    after = _mm_getcsr();
                }
                CHECK((after & 0xffc0u) == (host & 0xffc0u));
                CHECK(found.after_set_up == (host & 0xffc0u));
                expected.after_set_up = found.after_set_up;
                CHECK(found == expected);
            }
    }
}

TEST_CASE("every index of a parallel loop runs in the project's environment and the caller's is restored") {
    const Host environment{masked | flush | 0x4000};
    std::array<unsigned, 64> seen{};
    strata::parallel_for(seen.size(), 4, [&](std::size_t i) { seen[i] = _mm_getcsr() & 0xffc0u; });
    CHECK(std::ranges::all_of(seen, [](unsigned csr) { return csr == masked; }));
    CHECK((_mm_getcsr() & 0xffc0u) == (masked | flush | 0x4000));
}
#endif

TEST_CASE("a rounding mode set through the C library is restored after the scope") {
    REQUIRE(std::fesetround(FE_UPWARD) == 0);
    {
        const strata::FloatEnvironment ours;
        volatile float third = 1.0f / 3.0f;
        CHECK(third == 0x1.555556p-2f);
    }
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    CHECK(after == FE_UPWARD);
}
