// Expected values: ports with another accumulation of alpha, other sums, or two mistakes, written here on plain lists;
// the judge must say what they do.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "tests/tools/oracle/program/plain_port.h"

using namespace strata::test;
using strata::oracle::program::PortFormat;

namespace {

std::string first_line(const PortScene& scene, const std::function<PortColor(const PortList&)>& of,
                       PortFormat format = PortFormat::exact) {
    PortPicture picture;
    for (const PortList& list : scene.pixels) picture.push_back(of(list));
    const std::string text = judged(scene, picture, format);
    return text.substr(0, text.find('\n'));
}

// Front to back; `next` is the alpha that has been reached.
PortColor accumulated(const PortScene& scene, const PortList& list, double (*next)(double reached, double alpha)) {
    PortColor color{};
    double reached = 0;
    for (const PortFragment& f : list) {
        for (std::size_t c = 0; c < 3; ++c) color[c] += (1 - reached) * f.alpha * f.color[c];
        reached = next(reached, f.alpha);
    }
    for (std::size_t c = 0; c < 3; ++c) color[c] += (1 - reached) * scene.background[c];
    return color;
}

double added(double reached, double alpha) { return std::min(reached + alpha, 1.0); }

}  // namespace

TEST_CASE("other accumulations of alpha are named") {
    const PortScene scene = random_scene(41);
    CHECK(first_line(scene, [&](const PortList& list) { return accumulated(scene, list, added); }) ==
          "wrong: the alphas of the layers before are added up, where their transmittances are multiplied");
    CHECK(first_line(scene, [&](const PortList& list) {
              return accumulated(scene, list, [](double reached, double alpha) { return std::max(reached, alpha); });
          }) == "wrong: the alpha reached is the largest one");
    CHECK(first_line(scene, [&](const PortList& list) {
              return accumulated(scene, list, [](double, double alpha) { return alpha; });
          }) == "wrong: the alpha reached is that of the last layer");
}

TEST_CASE("sums that are clamped, and a tail that is not attenuated, are named") {
    const PortScene scene = random_scene(42);
    CHECK(first_line(scene, [&](const PortList& list) {
              PortColor sum{};
              double weights = 0, through = 1;
              for (const PortFragment& f : list) {
                  const double w = f.alpha * f.alpha * std::max(0.01, 3000 * std::pow(1 - f.depth, 3));
                  for (std::size_t c = 0; c < 3; ++c) sum[c] = std::min(sum[c] + w * f.color[c], 4.0);
                  weights = std::min(weights + w, 4.0);
                  through *= 1 - f.alpha;
              }
              for (std::size_t c = 0; c < 3; ++c)
                  sum[c] = (weights > 0 ? sum[c] / weights * (1 - through) : 0) + through * scene.background[c];
              return sum;
          }) == "wrong: weighted sums: alpha max(0.01, 3000 (1 - depth)^3), and sums are clamped to 4");
    CHECK(first_line(scene, [&](const PortList& list) {
              PortColor color{}, tail{};
              double through = 1, of_tail = 1, weights = 0;
              for (std::size_t k = 0; k < list.size(); ++k) {
                  const PortFragment& f = list[k];
                  for (std::size_t c = 0; c < 3; ++c)
                      (k < 2 ? color : tail)[c] += (k < 2 ? through : 1) * f.alpha * f.color[c];
                  (k < 2 ? through : of_tail) *= 1 - f.alpha;
                  weights += k < 2 ? 0 : f.alpha;
              }
              for (std::size_t c = 0; c < 3; ++c)
                  color[c] +=
                      (weights > 0 ? tail[c] / weights * (1 - of_tail) : 0) + through * of_tail * scene.background[c];
              return color;
          }) == "wrong: the average of the layers behind the first 2 is not attenuated by these");
}

TEST_CASE("two mistakes that are made everywhere are named, though neither alone repairs anything") {
    const PortScene scene = random_scene(43);
    const auto code = [](double v) { return static_cast<unsigned>(std::floor(v * 255 + 0.5)); };
    CHECK(first_line(
              scene,
              [&](const PortList& list) {
                  PortColor color{};
                  for (std::size_t c = 0; c < 3; ++c) {
                      unsigned below = code(scene.background[c]);
                      for (auto f = list.rbegin(); f != list.rend(); ++f)
                          below = (code(f->color[c]) + code(below / 255.0 * (1 - f->alpha))) % 256;
                      color[c] = below / 255.0;
                  }
                  return color;
              },
              PortFormat::unorm8)
              .starts_with("wrong: all fragments have colours that are not multiplied by alpha; and blends of 8 bits "
                           "wrap around at 256"));
    CHECK(first_line(scene,
                     [&](PortList list) {
                         std::erase_if(list, [](const PortFragment& f) { return !f.is_front; });
                         return accumulated(scene, list, added);
                     }) ==
          "wrong: the alphas of the layers before are added up, where their transmittances are multiplied; and "
          "fragments of back faces are left out");
}

TEST_CASE("pixels beyond the last whole tile in either direction are named", "[slow]") {
    const PortScene scene = random_scene(44);
    const std::string text =
        judged(scene, painted(scene, [](PortList list, int x, int y) { return x < 48 && y < 32 ? list : PortList{}; }));
    INFO(text);
    CHECK(text.starts_with("wrong: all fragments at pixels with "));
    CHECK(text.find("x at least 48") != text.npos);
    CHECK(text.find("y at least 32") != text.npos);
}

TEST_CASE("layers that are lost by chance are told as that", "[slow]") {
    const PortScene scene = random_scene(45);
    std::mt19937 engine{7};
    const std::string text =
        judged(scene, painted(scene, [&](PortList list, int, int) {
                   if (list.size() > 1 && engine() % 3 == 0)
                       list.erase(list.begin() + static_cast<std::ptrdiff_t>(engine() % list.size()));
                   return list;
               }));
    INFO(text);
    CHECK(text.starts_with("wrong: at "));
    CHECK(text.find("some fragments are left out, and no property separates them") != text.npos);
    // Colours without any relation to the layers are not told as that.
    const std::string noise = judged(scene, painted(scene, [&](PortList list, int, int) {
                                         for (PortFragment& f : list)
                                             for (double& c : f.color) c = static_cast<double>(engine() % 256) / 255;
                                         return list;
                                     }));
    INFO(noise);
    CHECK(noise.find("chance") == noise.npos);
}
