// Tests depths that programs and clears give to a region, inside and outside of the format's range.
#include <bit>
#include <catch2/catch.hpp>

#include "pipeline/region/region.h"
#include "tests/pipeline/frames.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;

struct DepthRegion {
    TestFrame test;
    RegionStatistics statistics;
    Region region;
    DepthRegion(const FragmentScene& scene, const char* profile)
        : test{scene, profile}, region{test.frame, {test.frame.rect()}, statistics} {}
};

}  // namespace

TEST_CASE("depths that a full-screen program replaces are compared and written lane by lane") {
    DepthRegion m{FragmentScene{8, 4}, "geforce8"};
    const Target depth = m.region.make(Format::d32f);
    m.region.clear(depth, {.depth = 0.5f});
    PassState state;
    state.depth = {.enabled = true, .func = CompareFunc::greater, .write = true};
    state.depth_target = depth;
    const DrawCounts drawn = m.region.full_screen(state, [](const FragmentBatch& in, const Loads&, Outputs& out) {
        out.replaces_depth = true;
        for (std::size_t i = 0; i < static_cast<std::size_t>(in.count); ++i)
            out.depth[i] = std::bit_cast<std::uint32_t>(in.pixel[i] == 3 ? 0.75f : 0.25f);
    });
    CHECK(m.region.any(drawn.passed, Idle::no));
    for (std::size_t p = 0; p < 32; ++p)
        CHECK(m.region.storage(depth).depth(0)[p] == std::bit_cast<std::uint32_t>(p == 3 ? 0.75f : 0.5f));
}

TEST_CASE("a depth beyond the range is compared with all its bits and stored with those of the format") {
    TestFrame test{FragmentScene{8, 4}, "softpipe"};
    test.frame.depth.format = DepthFormat::d24;
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    const Target depth = region.make(Format::d24);
    for (const auto& [func, stored] : {std::pair{CompareFunc::less, 0x800000u}, {CompareFunc::greater, 0xffffffu}}) {
        region.clear(depth, {.depth = 0.50000003f});
        PassState state;
        state.depth = {.enabled = true, .func = func, .write = true};
        state.depth_target = depth;
        const DrawCounts drawn = region.full_screen(state, [](const FragmentBatch&, const Loads&, Outputs& out) {
            out.replaces_depth = true;
            out.depth.fill(0xffffffffu);  // one code below 0
        });
        CHECK(region.any(drawn.passed, Idle::no) == (func == CompareFunc::greater));
        CHECK(region.storage(depth).depth(0)[5] == stored);
    }
}

TEST_CASE("depth clears keep -1 in an unclamped D32F buffer and clamp otherwise") {
    const auto cleared = [](const char* profile, Format format, float value) {
        DepthRegion m{FragmentScene{1, 1}, profile};
        const Target depth = m.region.make(format);
        m.region.clear(depth, {.depth = value});
        return m.region.storage(depth).depth(0)[0];
    };
    CHECK(cleared("geforce8", Format::d32f, -1.0f) == std::bit_cast<std::uint32_t>(-1.0f));
    CHECK(cleared("geforce8", Format::d32f, 2.0f) == std::bit_cast<std::uint32_t>(2.0f));
    CHECK(cleared("geforce8", Format::d24, -1.0f) == 0u);
    CHECK(cleared("geforce8", Format::d24, 2.0f) == 0xffffffu);
    CHECK(cleared("geforce3", Format::d16, 0.5f) == 0x7fffu);      // floor of 32767.5
    CHECK(cleared("geforce8", Format::d24s8, 0.5f) == 0x800000u);  // 8388607.5 rounds up
    DeviceProfile clamping = *find_profile("geforce8");
    clamping.has_unclamped_depth_clear = false;
    TestFrame test{FragmentScene{1, 1}, "geforce8"};
    test.frame.profile = &clamping;
    RegionStatistics statistics;
    Region region{test.frame, {test.frame.rect()}, statistics};
    const Target depth = region.make(Format::d32f);
    region.clear(depth, {.depth = -1.0f});
    CHECK(region.storage(depth).depth(0)[0] == 0u);
}
