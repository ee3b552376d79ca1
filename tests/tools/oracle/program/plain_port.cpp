// tests/tools/oracle/program/plain_port.cpp - the scene and the compositing of plain_port.h.
#include "tests/tools/oracle/program/plain_port.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "tools/oracle/program/fit/fitting.h"

namespace strata::test {

PortScene random_scene(std::uint32_t seed) {
    std::mt19937 engine{seed};
    const auto number = [&] { return static_cast<double>(engine() >> 8) * 0x1p-24; };
    PortScene scene;
    for (int i = 0; i < scene.width * scene.height; ++i) {
        PortList& list = scene.pixels.emplace_back();
        const std::size_t layers = engine() % 7;
        std::vector<std::uint32_t> order(layers);
        std::iota(order.begin(), order.end(), 0u);
        for (std::size_t k = layers; k > 1; --k) std::swap(order[k - 1], order[engine() % k]);
        for (std::size_t k = 0; k < layers; ++k)
            list.push_back({.color = {number(), number(), number()},
                            .alpha = 0.2 + 0.6 * number(),
                            .depth = number(),
                            .submission = order[k],
                            .instance = static_cast<std::uint32_t>(engine() % 5),
                            .material = static_cast<std::uint32_t>(engine() % 3),
                            .is_front = engine() % 2 == 0});
        std::ranges::sort(list, {}, &PortFragment::depth);
    }
    return scene;
}

double in_8_bits(double v) { return std::floor(std::min(std::max(v, 0.0), 1.0) * 255 + 0.5) / 255; }
double in_8_bits_truncated(double v) { return std::floor(std::min(std::max(v, 0.0), 1.0) * 255 + 1e-9) / 255; }
double as_it_is(double v) { return v; }
double in_half(double v) {
    if (v == 0) return 0;
    const double step = std::exp2(std::floor(std::log2(std::fabs(v))) - 10);
    return std::nearbyint(v / step) * step;
}

PortList unchanged(PortList list, int, int) { return list; }

PortColor over(const PortList& list, const PortColor& background, Keep keep) {
    PortColor color{keep(background[0]), keep(background[1]), keep(background[2])};
    for (auto f = list.rbegin(); f != list.rend(); ++f)
        for (std::size_t c = 0; c < 3; ++c) color[c] = keep(f->color[c] * f->alpha + color[c] * (1 - f->alpha));
    return color;
}

PortColor under(const PortList& list, const PortColor& background, Keep keep) {
    PortColor color{};
    double through = 1;
    for (const PortFragment& f : list) {
        for (std::size_t c = 0; c < 3; ++c) color[c] = keep(color[c] + through * f.alpha * f.color[c]);
        through = keep(through * (1 - f.alpha));
    }
    for (std::size_t c = 0; c < 3; ++c) color[c] = keep(color[c] + through * keep(background[c]));
    return color;
}

PortPicture painted(const PortScene& scene, const Change& change, Keep keep) {
    PortPicture picture;
    for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
        const int x = static_cast<int>(i) % scene.width, y = static_cast<int>(i) / scene.width;
        picture.push_back(over(change(scene.pixels[i], x, y), scene.background, keep));
    }
    return picture;
}

oracle::program::Lists lists_of(const PortScene& scene, const PortPicture& picture,
                                oracle::program::PortFormat format) {
    oracle::program::Lists lists;
    lists.width = scene.width;
    lists.height = scene.height;
    lists.format = format;
    for (std::size_t i = 0; i < scene.pixels.size(); ++i) {
        lists.pixels.push_back({.x = static_cast<int>(i) % scene.width,
                                .y = static_cast<int>(i) / scene.width,
                                .first = lists.fragments.size(),
                                .behind = scene.background,
                                .seen = picture[i]});
        for (const PortFragment& f : scene.pixels[i])
            lists.fragments.push_back({.color = f.color,
                                       .alpha = f.alpha,
                                       .depth = f.depth,
                                       .code = static_cast<std::uint32_t>(f.depth * 0x1p24),
                                       .submission = f.submission,
                                       .primitive = static_cast<std::uint32_t>(lists.fragments.size()),
                                       .instance = f.instance,
                                       .material = f.material,
                                       .is_front_facing = f.is_front});
    }
    complete(lists);
    return lists;
}

std::string judged(const PortScene& scene, const PortPicture& picture, oracle::program::PortFormat format) {
    return to_text(fit(lists_of(scene, picture, format)));
}

}  // namespace strata::test
