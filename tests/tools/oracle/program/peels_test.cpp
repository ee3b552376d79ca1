// Expected values: peels and lookups written here, pass by pass on plain lists; the judge must say what they compare
// and where they read.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/oracle/program/plain_port.h"
#include "tools/oracle/program/drawing/fit_drawings.h"
#include "tools/oracle/program/drawing/lookups.h"

using namespace strata::test;

namespace {

std::string first_line(const PortScene& scene, const PortPicture& picture) {
    const auto lists = lists_of(scene, picture);
    auto others = strata::oracle::program::other_peels(lists);
    for (auto& more : strata::oracle::program::other_lookups(lists)) others.push_back(std::move(more));
    const std::string text = to_text(strata::oracle::program::fit_drawings(lists, others));
    return text.substr(0, text.find('\n'));
}

constexpr std::size_t most_layers = 6;  // of random_scene

// The layers that each pass shows: `shown(pass, n)` of n fragments; n or more is none.
PortPicture peeled(const PortScene& scene, const std::function<std::size_t(std::size_t pass, std::size_t n)>& shown) {
    return painted(scene, [&](const PortList& list, int, int) {
        PortList made;
        for (std::size_t pass = 0; pass < most_layers && !list.empty(); ++pass)
            if (const std::size_t k = shown(pass, list.size()); k < list.size()) made.push_back(list[k]);
        return made;
    });
}

// A peel whose test reads the depth of the pass before at another pixel; at one outside nothing has been stored.
PortPicture peeled_by(const PortScene& scene, const std::function<std::pair<int, int>(int x, int y)>& place) {
    std::vector<double> before(scene.pixels.size(), -1), after(before);
    std::vector<PortList> made(scene.pixels.size());
    for (std::size_t pass = 0; pass < most_layers; ++pass) {
        for (int i = 0; i < static_cast<int>(before.size()); ++i) {
            const auto [x, y] = place(i % scene.width, i / scene.width);
            const bool is_inside = x >= 0 && y >= 0 && x < scene.width && y < scene.height;
            const double limit = is_inside ? before[static_cast<std::size_t>(y * scene.width + x)] : 2;
            const auto at = static_cast<std::size_t>(i);
            const PortList& list = scene.pixels[at];
            const auto next = std::ranges::find_if(list, [&](const PortFragment& f) { return f.depth > limit; });
            after[at] = next == list.end() ? 1 : next->depth;
            if (next != list.end()) made[at].push_back(*next);
        }
        before = after;
    }
    return painted(scene,
                   [&](const PortList&, int x, int y) { return made[static_cast<std::size_t>(y * scene.width + x)]; });
}

}  // namespace

TEST_CASE("a peel whose test is not strict, or is late, or whose layers stay, is named") {
    const PortScene scene = random_scene(31);
    CHECK(first_line(scene, peeled(scene, [](std::size_t, std::size_t) { return 0; })) ==
          "wrong: a peel finds the nearest layer again in every pass: the test is not strict");
    CHECK(first_line(scene, peeled(scene, [](std::size_t, std::size_t n) { return n - 1; })) ==
          "wrong: a peel from the back finds the farthest layer again in every pass: the test is not strict");
    CHECK(first_line(scene, peeled(scene, [](std::size_t pass, std::size_t) { return pass / 2; })) ==
          "wrong: a peel compares with the depth of 2 passes ago");
    CHECK(first_line(scene, peeled(scene, [](std::size_t pass, std::size_t n) { return std::min(pass, n - 1); })) ==
          "wrong: a peel composites the last layer again in every pass that finds none");
    CHECK(first_line(scene, peeled(scene, [](std::size_t pass, std::size_t) { return pass; }))
              .starts_with("wrong: 0 of 2400 pixels"));
}

TEST_CASE("a peel that loses layers of one stored depth is named") {
    const PortScene scene = random_scene(32);
    const std::string text = first_line(
        scene, painted(scene, [](PortList list, int, int) {
            const auto code = [](const PortFragment& f) { return std::floor(f.depth * 255 + 0.5); };
            std::ranges::sort(list, {}, [&](const PortFragment& f) { return std::pair{code(f), f.submission}; });
            PortList kept;
            for (const PortFragment& f : list)
                if (kept.empty() || code(kept.back()) != code(f)) kept.push_back(f);
            return kept;
        }));
    CHECK(text == "wrong: a peel compares depths rounded to 8 bits");
}

TEST_CASE("a peel that reads the depth of another pixel is named with the place") {
    const PortScene scene = random_scene(33);
    CHECK(first_line(scene, peeled_by(scene, [](int x, int y) {
                         return std::pair{x - 1, y};
                     })) == "wrong: a peel compares with the depth of the previous pass read one pixel to the left");
    CHECK(first_line(scene, peeled_by(scene, [](int x, int y) {
                         return std::pair{x, y + 2};
                     })) == "wrong: a peel compares with the depth of the previous pass read two pixels below");
    CHECK(first_line(scene, peeled_by(scene, [&](int x, int y) {
                         return std::pair{x, scene.height - 1 - y};
                     })) == "wrong: a peel compares with the depth of the previous pass read upside down");
}

TEST_CASE("layers that are read at other places are named") {
    const PortScene scene = random_scene(34);
    const auto at = [&](int x, int y) -> const PortList& {
        const int cx = std::clamp(x, 0, scene.width - 1), cy = std::clamp(y, 0, scene.height - 1);
        return scene.pixels[static_cast<std::size_t>(cy * scene.width + cx)];
    };
    CHECK(first_line(scene, painted(scene, [&](const PortList& list, int x, int y) {
                         const PortList& other = at(x, scene.height - 1 - y);
                         PortList made;
                         for (std::size_t k = 0; k < std::max(list.size(), other.size()); ++k) {
                             const PortList& from = k % 2 == 1 ? other : list;
                             if (k < from.size()) made.push_back(from[k]);
                         }
                         return made;
                     })) == "wrong: every second layer, from the second on, is read upside down");
    CHECK(first_line(scene, painted(scene, [&](const PortList&, int x, int y) {
                         PortList made(most_layers);
                         for (std::size_t k = 0; k < most_layers; ++k)
                             for (const PortList* list : {&at(x, y), &at(x - 1, y), &at(x, y - 1), &at(x - 1, y - 1)}) {
                                 if (k >= list->size()) continue;
                                 made[k].alpha += (*list)[k].alpha / 4;
                                 for (std::size_t c = 0; c < 3; ++c)
                                     made[k].color[c] += (*list)[k].color[c] * (*list)[k].alpha / 4;
                             }
                         for (PortFragment& f : made)
                             for (double& c : f.color) c = f.alpha > 0 ? c / f.alpha : 0;
                         return made;
                     })) == "wrong: all layers are read half a texel to the left and up, filtered");
}
