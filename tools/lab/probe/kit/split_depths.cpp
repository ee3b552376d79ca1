// tools/lab/probe/kit/split_depths.cpp - finds triangles whose 24-bit depths differ between two hypotheses about a
// device's reciprocal (its bits, and the units that it lacks), by drawing random ones, so that a picture of a device
// decides between them (split_depths.h). The order of the random numbers fixes the probe's scenes: a change of it
// changes the digest of the kit.
#include "tools/lab/probe/kit/split_depths.h"

#include <cmath>
#include <utility>

#include "rasterizer/chip/window_z.h"

namespace strata::probe {

namespace {

using rasterizer::DepthHypothesis;
using rasterizer::EdgeValues;

constexpr int most_triangles = 4000;
constexpr int cell = 8;  // pixels per side

std::int64_t twice_area(const SplitDepths& t) {
    return std::int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) - std::int64_t{t.y[1] - t.y[0]} * (t.x[2] - t.x[0]);
}

// At the centre of a pixel; empty outside.
std::optional<EdgeValues> edges_of(const SplitDepths& t, int pixel_x, int pixel_y) {
    const int x = 16 * pixel_x + 8, y = 16 * pixel_y + 8;
    EdgeValues e{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        e[k] = std::int64_t{t.x[b] - t.x[a]} * (y - t.y[a]) - std::int64_t{t.y[b] - t.y[a]} * (x - t.x[a]);
        if (e[k] <= 0) return std::nullopt;
    }
    return e;
}

// In the units of a 24-bit buffer.
rasterizer::WindowZ24 window_z(const SplitDepths& t, std::int64_t area, const DepthHypothesis& hypothesis) {
    std::array<double, 3> z{};
    for (std::size_t k = 0; k < 3; ++k) z[k] = (double{t.z[k]} * 0.5 + 0.5) * 16777215.0;
    return {z, area, hypothesis};
}

bool is_split(const SplitDepths& t, std::int64_t area, const TwoReciprocals& two) {
    const rasterizer::WindowZ24 one = window_z(t, area, two.first), other = window_z(t, area, two.second);
    for (int y = 0; y < cell; ++y)
        for (int x = 0; x < cell; ++x) {
            const std::optional<EdgeValues> e = edges_of(t, x, y);
            if (e && std::floor(one.value(*e)) != std::floor(other.value(*e))) return true;
        }
    return false;
}

}  // namespace

std::vector<TwoReciprocals> neighbouring_reciprocals() {
    std::vector<TwoReciprocals> all;
    for (int bits = 24; bits <= 30; ++bits) {
        DepthHypothesis one;
        one.reciprocal_bits = bits;
        for (one.reciprocal_deficit = 0; one.reciprocal_deficit < 8; ++one.reciprocal_deficit) {
            DepthHypothesis other = one;
            ++other.reciprocal_deficit;
            all.emplace_back(one, other);
        }
        one.weights = rasterizer::WeightRule::area;
        one.reciprocal_deficit = 0;
        DepthHypothesis other = one;
        ++other.reciprocal_bits;
        if (bits < 30) all.emplace_back(one, other);
    }
    return all;
}

std::optional<SplitDepths> split_depths(RandomGenerator& random, const TwoReciprocals& two) {
    for (int i = 0; i < most_triangles; ++i) {
        SplitDepths t;
        for (std::size_t k = 0; k < 3; ++k) {
            t.x[k] = random.below(16 * cell);
            t.y[k] = random.below(16 * cell);
            // Very different depths: a weight's last bit is about one code.
            t.z[k] = k == 0 ? random.between(-0.99f, -0.9f) : random.between(0.7f, 0.99f);
        }
        if (twice_area(t) < 0) {
            std::swap(t.x[1], t.x[2]);
            std::swap(t.y[1], t.y[2]);
        }
        const std::int64_t area = twice_area(t);
        if (area == 0) continue;
        const auto sum = static_cast<double>(area);
        if (rasterizer::truncated_reciprocal(sum, two.first) == rasterizer::truncated_reciprocal(sum, two.second))
            continue;
        if (is_split(t, area, two)) return t;
    }
    return std::nullopt;
}

}  // namespace strata::probe
