// Tests renderers with different instruction sets against the same frames drawn one after the other, and that the host
// program's own choice of Highway targets is preserved.
#include "rasterizer/base/simd.h"

#include <catch2/catch.hpp>
#include <thread>

#include "hwy/targets.h"
#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"
#include "tests/support/difference.h"
#include "tests/support/random_triangles.h"

using namespace strata::testing;
using strata::Simd;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;

namespace {

constexpr const char* names[]{"dual", "front_to_back", "weighted_average", "depth_units"};

std::vector<RenderResult> frames(const TriangleScene& scene, Simd simd) {
    RenderOptions options;
    options.width = 90;
    options.height = 70;
    options.threads = 2;
    options.simd = simd;
    std::vector<RenderResult> all;
    for (const char* name : names) all.push_back(render(scene.list, scene.view, {"ideal", name}, options));
    return all;
}

// A host program that restricts Highway to SSE4, for instance to save power; restores the setting at the end.
class HostOfSse4 {
  public:
    HostOfSse4() { narrow(HWY_SSE4); }
    ~HostOfSse4() { narrow(0); }
    HostOfSse4(const HostOfSse4&) = delete;
    HostOfSse4& operator=(const HostOfSse4&) = delete;

    [[nodiscard]] static std::size_t index() { return hwy::GetChosenTarget().GetIndex(); }

  private:
    static void narrow(std::int64_t targets) {
        hwy::SetSupportedTargetsForTest(targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

}  // namespace

TEST_CASE("two renderers with different instruction sets draw the same bits at the same time", "[slow]") {
    const TriangleScene scene = random_triangles(1207, 40);
    const std::vector<RenderResult> expected = frames(scene, Simd::scalar);
    for (const Simd simd : strata::available_simd()) {
        std::vector<RenderResult> here, there;
        std::thread other{[&] { there = frames(scene, Simd::scalar); }};
        here = frames(scene, simd);
        other.join();
        for (std::size_t i = 0; i < expected.size(); ++i) {
            INFO(names[i] << ", instruction set " << static_cast<int>(simd));
            CHECK(difference(here[i], expected[i]) == "");
            CHECK(difference(there[i], expected[i]) == "");
        }
    }
}

TEST_CASE("the instruction sets of the processor are those that Highway finds") {
    for (const auto& [simd, target] : {std::pair{Simd::avx2, HWY_AVX2}, {Simd::avx512, HWY_AVX3}}) {
        const bool is_compiled = (HWY_TARGETS & target) != 0 && HWY_ARCH_X86;
        CHECK(strata::has_simd(simd) == (is_compiled && (hwy::SupportedTargets() & target) != 0));
    }
}

TEST_CASE("a frame does not change the host program's Highway targets or the thread's own choice") {
    const TriangleScene scene = random_triangles(1208, 12);
    const std::vector<Simd> available = strata::available_simd();  // before the host restricts them
    const HostOfSse4 host;
    const std::size_t before = HostOfSse4::index();
    const Simd own = strata::chosen_simd();
    for (const Simd simd : available) {
        static_cast<void>(frames(scene, simd));
        CHECK(HostOfSse4::index() == before);
        CHECK(strata::chosen_simd() == own);
    }
    CHECK(strata::available_simd() == available);
}

TEST_CASE("a renderer rejects an instruction set that the processor lacks by the name of the option") {
    const TriangleScene scene = random_triangles(1209, 1);
    for (const Simd simd : {Simd::avx2, Simd::avx512}) {
        RenderOptions options;
        options.simd = simd;
        const auto open = [&] {
            return strata::peeling::Renderer{scene.list, scene.view, *strata::pipeline::find_profile("ideal"), options};
        };
        if (strata::has_simd(simd))
            CHECK_NOTHROW(static_cast<void>(open()));
        else
            CHECK_THROWS_AS(open(), strata::InputError);
    }
}
