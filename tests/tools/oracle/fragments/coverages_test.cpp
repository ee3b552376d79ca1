// Tests verdicts on pictures of rasterizers with other tie rules or other snapping, which the renderer draws under
// another profile.
#include "tools/oracle/fragments/coverages.h"

#include <catch2/catch.hpp>
#include <mutex>

#include "tests/tools/oracle/verdict/opened_scene.h"
#include "tools/oracle/verdict/verdict.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

oracle::TargetImage picture_by(OpenedScene scene, const pipeline::DeviceProfile& profile) {
    scene.profile = profile;
    return *scene.picture("front_to_back", pipeline::Format::rgba8);
}

}  // namespace

TEST_CASE("a rasterizer that snaps to sixteenths of a pixel is right and its pixels at edges are counted") {
    OpenedScene opened{"teapot", 48, 36};
    for (pipeline::Material& material : opened.scene.list.materials) material.unlit = true;
    pipeline::DeviceProfile coarse = opened.profile;
    coarse.raster.subpixel_bits = 4;
    const oracle::TargetImage picture = picture_by(opened, coarse);
    const oracle::TargetImage exact = picture_by(opened, opened.profile);
    REQUIRE(picture.codes != exact.codes);
    const Verdict found = judged(opened, picture);
    CHECK(found.is_right);
    CHECK(found.right.at_edges > 0);
    CHECK(judged(opened, exact).right.at_edges == 0);
}

TEST_CASE("a picture of another profile is right because snapping explains its colours and depths and coverage",
          "[long]") {
    for (const char* const name : {"teapot", "showroom"}) {
        const OpenedScene opened{name, 40, 30};
        for (const char* const profile : {"llvmpipe", "softpipe"}) {
            INFO(name << " on " << profile);
            CHECK(judged(opened, picture_by(opened, *pipeline::find_profile(profile))).is_right);
        }
    }
}

// The number of pixels whose nearest two layers may be exchanged.
std::size_t exchangeable(const OpenedScene& opened) {
    SceneFragments fragments = opened.fragments();
    fragments.find_coverages();
    std::size_t pixels = 0;
    std::mutex mutex;
    fragments.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = fragments.at(tile, p);
            if (list.edge == nullptr || list.visible.size() < 2) continue;
            const auto is_exchanged = [&](const OtherList& other) {
                return other.visible.size() == list.visible.size() &&
                       other.visible[0].primitive == list.visible[1].primitive &&
                       other.visible[1].primitive == list.visible[0].primitive;
            };
            const std::scoped_lock lock{mutex};
            pixels += std::ranges::any_of(list.edge->others, is_exchanged) ? 1 : 0;
        }
    });
    return pixels;
}

TEST_CASE("layers that cross may exchange their order next to the line of intersection and parallel layers nowhere") {
    CHECK(exchangeable(OpenedScene{"random:seed=3,triangles=40", 32, 32}) > 0);
    CHECK(exchangeable(OpenedScene{"planes:count=2,gap=4096,cells=1", 32, 32}) == 0);
}

TEST_CASE("a pixel away from all edges has no other coverage") {
    OpenedScene opened{"teapot", 48, 36};
    opened.options.threads = 1;  // the tiles are counted
    SceneFragments fragments = opened.fragments();
    fragments.find_coverages();
    std::size_t at_edges = 0, pixels = 0;
    bool are_all_different = true;
    fragments.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = fragments.at(tile, p);
            ++pixels;
            if (list.edge == nullptr) continue;
            ++at_edges;
            for (const OtherList& other : list.edge->others)
                are_all_different &=
                    !std::ranges::equal(other.visible, list.visible, {}, &Fragment::primitive, &Fragment::primitive) ||
                    !std::ranges::equal(other.hidden, list.hidden, {}, &Fragment::primitive, &Fragment::primitive) ||
                    other.behind != list.behind;
        }
    });
    CHECK(at_edges > 0);
    CHECK(at_edges < pixels / 2);
    CHECK(are_all_different);
}
