// Expected values: ports with another value, fold or peel, written here on plain lists; the judge must say what they
// do.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/oracle/program/plain_port.h"

using namespace strata::test;

namespace {

PortPicture composited(const PortScene& scene, const std::function<PortColor(const PortList&)>& of) {
    PortPicture picture;
    for (const PortList& list : scene.pixels) {
        PortColor color = of(list);
        for (double& c : color) c = in_8_bits(c);
        picture.push_back(color);
    }
    return picture;
}

// A change of every fragment.
PortPicture with_fragments(const PortScene& scene, const std::function<void(PortFragment&)>& change) {
    return painted(
        scene,
        [&](PortList list, int, int) {
            for (PortFragment& f : list) change(f);
            return list;
        },
        in_8_bits);
}

}  // namespace

TEST_CASE("values that a port cuts or fogs are named") {
    const PortScene scene = random_scene(21);
    const auto text =
        judged(scene, with_fragments(scene, [](PortFragment& f) { f.alpha = std::floor(f.alpha * 15) / 15; }));
    INFO(text);
    CHECK(text.starts_with("wrong: all fragments have alpha truncated to 4 bits\n"));
    const auto fog = judged(scene, with_fragments(scene, [](PortFragment& f) {
                                for (double& c : f.color) c += 0.8 * f.depth * (0.6 - c);
                            }));
    INFO(fog);
    CHECK(fog.starts_with("wrong: all fragments are in a fog of colour (0.6"));
}

TEST_CASE("blends that shift instead of dividing are named") {
    const PortScene scene = random_scene(22);
    const auto code = [](double v) { return static_cast<int>(std::floor(v * 255 + 0.5)); };
    const std::string text =
        judged(scene, composited(scene, [&](const PortList& list) {
                   PortColor color;
                   for (std::size_t c = 0; c < 3; ++c) {
                       int below = code(scene.background[c]);
                       for (auto f = list.rbegin(); f != list.rend(); ++f)
                           below = (code(f->color[c]) * code(f->alpha) + below * (255 - code(f->alpha))) >> 8;
                       color[c] = below / 255.0;
                   }
                   return color;
               }));
    INFO(text);
    CHECK(text.starts_with("wrong: blends of 8 bits shift by 8 instead of dividing by 255\n"));
}

TEST_CASE("weights of depth that no equation of the papers has are named with their constant") {
    const PortScene scene = random_scene(23);
    const std::string text = judged(scene, composited(scene, [&](const PortList& list) {
                                        PortColor sum{};
                                        double weights = 0, through = 1;
                                        for (const PortFragment& f : list) {
                                            const double w = f.alpha * std::exp(-f.depth / 0.25);
                                            for (std::size_t c = 0; c < 3; ++c) sum[c] += w * f.color[c];
                                            weights += w;
                                            through *= 1 - f.alpha;
                                        }
                                        PortColor color = scene.background;
                                        for (std::size_t c = 0; c < 3 && weights > 0; ++c)
                                            color[c] = sum[c] / weights * (1 - through) + through * color[c];
                                        return color;
                                    }));
    INFO(text);
    CHECK(text.starts_with(
        "wrong: layers are averaged by weights that depend on depth (weighted sums): e^-(depth / 0.25)\n"));
}

TEST_CASE("a peel with an epsilon, and one whose stored depths have few bits, are named") {
    const PortScene scene = random_scene(24);
    const std::string epsilon = judged(scene, painted(scene, [](PortList list, int, int) {
                                           PortList kept;
                                           for (const PortFragment& f : list)
                                               if (kept.empty() || f.depth - kept.back().depth > 0.05)
                                                   kept.push_back(f);
                                           return kept;
                                       }));
    INFO(epsilon);
    CHECK(epsilon.find("all fragments are lost if they are within 0.05") != epsilon.npos);
    const std::string stored = judged(scene, painted(scene, [](PortList list, int, int) {
                                          PortList kept;
                                          double depth = -1;
                                          for (std::size_t pass = 0; pass < list.size(); ++pass) {
                                              const auto next = std::ranges::find_if(
                                                  list, [&](const PortFragment& f) { return f.depth > depth; });
                                              if (next == list.end()) break;
                                              kept.push_back(*next);
                                              depth = std::round(next->depth * 255) / 255;
                                          }
                                          return kept;
                                      }));
    INFO(stored);
    CHECK(stored.starts_with("wrong: all fragments are peeled by depths that are stored in 8 bits"));
}
