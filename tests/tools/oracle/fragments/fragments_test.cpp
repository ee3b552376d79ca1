// Tests the lists of fragments against Renderer::fragments, which returns a frame's fragments in submission order; the
// test hides and sorts them itself.
#include "tools/oracle/fragments/fragments.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <mutex>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "tests/tools/oracle/verdict/opened_scene.h"

using namespace strata;
using namespace strata::oracle::verdict;
using strata::test::OpenedScene;

namespace {

// Per pixel, the primitives of its visible and of its hidden fragments, in the order of a traversal.
struct WalkedPixels {
    std::vector<std::uint32_t> visible{}, hidden{};
    Rgba behind{};
    int visits = 0;
    bool operator==(const WalkedPixels&) const = default;
};
std::vector<WalkedPixels> walked(const SceneFragments& scene) {
    std::vector<WalkedPixels> told(static_cast<std::size_t>(scene.width()) * static_cast<std::size_t>(scene.height()));
    scene.for_each_tile([&](const TileLists& tile) {
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            WalkedPixels& pixel = told[static_cast<std::size_t>(list.y * scene.width() + list.x)];
            ++pixel.visits;
            pixel.behind = list.behind;
            for (const Fragment& f : list.visible) pixel.visible.push_back(f.primitive);
            for (const Fragment& f : list.hidden) pixel.hidden.push_back(f.primitive);
        }
    });
    return told;
}

}  // namespace

TEST_CASE("every pixel is visited once with its visible fragments from near to far followed by its hidden ones") {
    const OpenedScene opened{"showroom", 100, 80};  // more than one tile
    const SceneFragments scene{opened.input(), std::uint64_t{1} << 30};
    peeling::Renderer renderer{opened.scene.list, opened.view, opened.profile, opened.options};
    const peeling::FrameFragments all = renderer.fragments(*peeling::find_algorithm("front_to_back"));
    std::vector<std::vector<pipeline::CapturedFragment>> of_pixel(100 * 80);
    for (const pipeline::CapturedFragment& f : all.all) of_pixel[f.pixel].push_back(f);
    std::size_t wrong = 0, hidden = 0;
    const std::vector<WalkedPixels> told = walked(scene);
    for (std::size_t p = 0; p < told.size(); ++p) {
        WalkedPixels model{.behind = told[p].behind, .visits = 1};
        std::ranges::stable_sort(of_pixel[p], {}, &pipeline::CapturedFragment::code);
        for (const pipeline::CapturedFragment& f : of_pixel[p])
            (f.code < all.opaque[p] ? model.visible : model.hidden).push_back(f.primitive);
        wrong += told[p] == model ? 0 : 1;
        hidden += model.hidden.size();
    }
    CHECK(wrong == 0);
    CHECK(hidden > 0);
    CHECK(scene.count() == all.all.size());
}

TEST_CASE("a traversal without memory renders the scene again and gives the same lists") {
    const OpenedScene opened{"teapot", 150, 150};  // with blank tiles
    CHECK(walked(SceneFragments{opened.input(), 0}) == walked(SceneFragments{opened.input(), std::uint64_t{1} << 30}));
}

TEST_CASE("a fragment has its instance and its facing and a pixel has the opaque colour behind it") {
    const OpenedScene opened{"showroom", 64, 64};
    const SceneFragments scene{opened.input(), std::uint64_t{1} << 30};
    std::map<bool, int> facings;
    std::size_t opaque = 0, strangers = 0, other_backgrounds = 0;
    std::mutex mutex;
    scene.for_each_tile([&](const TileLists& tile) {
        const std::scoped_lock lock{mutex};
        for (std::size_t p = 0; p < tile.rect.area(); ++p) {
            const PixelList list = scene.at(tile, p);
            opaque += list.has_opaque ? 1 : 0;
            other_backgrounds += !list.has_opaque && list.behind != opened.options.background ? 1 : 0;
            for (const Fragment& f : list.visible) {
                ++facings[f.is_front_facing];
                const auto& instance = opened.scene.list.instances.at(f.instance);
                strangers +=
                    opened.scene.list.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend ? 0 : 1;
            }
        }
    });
    CHECK(opaque > 0);
    CHECK(strangers == 0);
    CHECK(other_backgrounds == 0);
    CHECK(facings.size() == 2);
}
