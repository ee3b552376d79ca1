#include "rasterizer/cut_coordinates.h"

#include <algorithm>

#include "rasterizer/nv20_arithmetic.h"
#include "rasterizer/window_z.h"

namespace strata::rasterizer {
namespace {

[[nodiscard]] bool is_constant(const std::array<float, 3>& u) noexcept {
    const auto bits = std::bit_cast<std::array<std::uint32_t, 3>>(u);
    return bits[0] == bits[1] && bits[0] == bits[2];
}

[[nodiscard]] WindowZ24 sums(const std::array<float, 3>& u, const TriangleLanes& lanes, const DepthHypothesis& h) noexcept {
    return {{double{u[0]}, double{u[1]}, double{u[2]}}, lanes.edges->area(), h};
}

}  // namespace

void cut_coordinates(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w, const TriangleLanes& lanes,
                     const DepthHypothesis& hypothesis, float* out) noexcept {
    if (is_constant(u)) {
        std::fill_n(out, lanes.count, u[0]);
        return;
    }
    const bool has_w = !is_constant(inverse_w);
    const auto over_w = [&](std::size_t i) { return has_w ? u[i] * inverse_w[i] : u[i]; };
    const WindowZ24 numerator = sums({over_w(0), over_w(1), over_w(2)}, lanes, hypothesis);
    const WindowZ24 denominator = sums(inverse_w, lanes, hypothesis);
    for (int i = 0; i < lanes.count; ++i) {
        const EdgeValues e = lanes.edge_values(i);
        out[i] = cut_to_binary32(numerator.value(e));
        if (has_w) out[i] = cut_to_binary32(double{out[i]} * double{cut_to_binary32(1.0 / denominator.value(e))});
    }
}

}  // namespace strata::rasterizer
