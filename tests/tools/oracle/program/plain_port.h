// tests/tools/oracle/program/plain_port.h - random lists of fragments, and pictures that plain code composites from
// them: the model of the judge's tests. It uses no compositing code of the judge.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/oracle/program/lists.h"

namespace strata::test {

struct PortFragment {
    std::array<double, 3> color{};
    double alpha = 0, depth = 0;
    std::uint32_t submission = 0, instance = 0, material = 0;
    bool is_front = true;
};
using PortList = std::vector<PortFragment>;  // near to far
using PortColor = std::array<double, 3>;

// 0 to 6 fragments per pixel with colours, alphas and depths of their own.
struct PortScene {
    int width = 60, height = 40;
    PortColor background{0.8, 0.3, 0.1};
    std::vector<PortList> pixels{};
};
[[nodiscard]] PortScene random_scene(std::uint32_t seed);

[[nodiscard]] double in_8_bits(double v);
[[nodiscard]] double in_8_bits_truncated(double v);
[[nodiscard]] double as_it_is(double v);
[[nodiscard]] double in_half(double v);

using Keep = double (*)(double);
// The list that a port composites at a pixel.
using Change = std::function<PortList(PortList list, int x, int y)>;
[[nodiscard]] PortList unchanged(PortList list, int x, int y);

// Back to front over the background; every blend is kept.
[[nodiscard]] PortColor over(const PortList& list, const PortColor& background, Keep keep);
// Front to back with the transmittance.
[[nodiscard]] PortColor under(const PortList& list, const PortColor& background, Keep keep);

using PortPicture = std::vector<PortColor>;
[[nodiscard]] PortPicture painted(const PortScene& scene, const Change& change, Keep keep = in_8_bits);

[[nodiscard]] oracle::program::Lists lists_of(const PortScene& scene, const PortPicture& picture,
                                              oracle::program::PortFormat format = oracle::program::PortFormat::unorm8);
// What the judge says of the picture: its text.
[[nodiscard]] std::string judged(const PortScene& scene, const PortPicture& picture,
                                 oracle::program::PortFormat format = oracle::program::PortFormat::unorm8);

}  // namespace strata::test
