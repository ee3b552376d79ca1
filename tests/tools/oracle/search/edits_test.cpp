// Tests the mistakes found at single pixels, on pictures of ports that lose known layers (wrong_ports.h).
#include "tools/oracle/search/edits.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/verdict/wrong_ports.h"

using namespace strata;
using namespace strata::oracle::verdict;
using namespace strata::test;

namespace {

constexpr int side = 32;

// A picture without the second layer of each list in its left half and without the nearest one in its right half, and
// the number of layers of each pixel.
struct TwoMistakes {
    OpenedScene opened{"showroom", side, side};
    std::vector<std::size_t> layers{};  // per pixel: the number of its layers
    oracle::TargetImage picture{};

    TwoMistakes() {
        const auto change = [&](PortList& l) {
            const std::size_t x = layers.size() % side;
            layers.push_back(l.visible.size());
            const std::size_t lost = x < side / 2 ? 1 : 0;
            if (lost < l.visible.size()) l.visible.erase(l.visible.begin() + static_cast<std::ptrdiff_t>(lost));
        };
        picture = picture_of_port(opened, port_of_codes(Order::over), change);
    }
};

bool says(const std::vector<Rule>& rules, RuleKind kind) {
    return std::ranges::find(rules, kind, &Rule::kind) != rules.end();
}

}  // namespace

TEST_CASE("the map of edits distinguishes two mistakes by the pixels at which each is visible", "[long]") {
    const TwoMistakes port;
    SceneFragments fragments = port.opened.fragments();
    const Colors colors{port.picture};
    const Verdict verdict = judge(fragments, colors);
    REQUIRE_FALSE(verdict.is_right);
    const EditMap map = edit_map(fragments, colors, verdict);
    REQUIRE(map.of_pixel.size() == side * side);
    REQUIRE(map.edits.size() >= 2);
    std::size_t changed = 0, wrong = 0, counted = map.not_explained;
    for (const EditCount& edit : map.edits) counted += edit.pixels;
    for (std::size_t p = 0; p < map.of_pixel.size(); ++p) {
        const bool is_changed = port.layers[p] > (p % side < side / 2 ? 1u : 0u);
        changed += is_changed ? 1 : 0;
        wrong += map.of_pixel[p] != EditMap::right ? 1 : 0;
        if (!is_changed) CHECK(map.of_pixel[p] == EditMap::right);
    }
    CHECK(wrong == counted);
    CHECK(wrong > changed * 9 / 10);  // some lost layers are hardly visible
    CHECK(map.not_explained * 5 < wrong);
}

TEST_CASE("the edits of a pixel name the layer that it lacks and are empty where the pixel is right", "[long]") {
    const TwoMistakes port;
    SceneFragments fragments = port.opened.fragments();
    const Colors colors{port.picture};
    const Verdict verdict = judge(fragments, colors);
    std::size_t named = 0, asked = 0;
    for (std::size_t p = 0; p < port.layers.size(); p += 7) {
        const int x = static_cast<int>(p) % side, y = static_cast<int>(p) / side;
        const PixelEdits found = edits_at(fragments, colors, verdict, x, y);
        CHECK(found.pixel.list.visible.size() == port.layers[p]);
        CHECK(found.is_right == found.edits.empty());
        if (found.is_right || x < side / 2 || port.layers[p] < 2) continue;
        ++asked;
        named += std::ranges::any_of(found.edits, [](const PixelEdit& e) {
            return says(e.rules, RuleKind::lost) || says(e.rules, RuleKind::nearest_lost) ||
                   says(e.rules, RuleKind::farthest_alone) || says(e.rules, RuleKind::lost_from_far) ||
                   says(e.rules, RuleKind::last_submitted) || says(e.rules, RuleKind::first_submitted);
        });
    }
    CHECK(asked > 0);
    CHECK(named == asked);
}

TEST_CASE("for a pixel that no rule explains a subset and an order of its layers is found") {
    const OpenedScene opened{"random:seed=3,triangles=40", side, side};
    constexpr std::size_t most_permuted = 6;  // layers whose orders are all tried
    std::vector<std::size_t> layers;
    const auto rotate = [&](PortList& l) {  // of the nearest three layers: the third, the nearest, the second
        layers.push_back(l.visible.size());
        if (l.visible.size() >= 3) std::rotate(l.visible.begin(), l.visible.begin() + 2, l.visible.begin() + 3);
    };
    const oracle::TargetImage picture = picture_of_port(opened, port_of_codes(Order::over), rotate);
    SceneFragments fragments = opened.fragments();
    const Colors colors{picture};
    const Verdict verdict = judge(fragments, colors);
    std::size_t asked = 0, found_edits = 0;
    for (std::size_t p = 0; p < layers.size(); ++p) {
        if (layers[p] < 3 || layers[p] > most_permuted) continue;
        const PixelEdits found =
            edits_at(fragments, colors, verdict, static_cast<int>(p) % side, static_cast<int>(p) / side);
        asked += found.is_right ? 0 : 1;
        found_edits += !found.is_right && !found.edits.empty() ? 1 : 0;
    }
    CHECK(asked > 0);
    CHECK(found_edits == asked);
}
