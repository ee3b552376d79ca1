// tests/support/exact_fragments.h - the fragments of a scene in exact arithmetic: nothing is snapped, clipped or
// rounded.
//
// A corner's clip coordinates are rationals. The weights l of a window point (X, Y) solve l0 v0 + l1 v1 + l2 v2 = (X,
// Y, 1) over v = (x, y, w); the point is inside where no weight is negative, which holds only in front of the eye. Its
// depth in normalized device coordinates is l0 z0 + l1 z1 + l2 z2.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "scenes/procedural/hard_cases/hard_case.h"
#include "tests/rasterizer/rational.h"

namespace strata::testing {

using rasterizer::Rational;

struct ExactFragment {
    std::uint32_t triangle = 0;  // index of the triangle in its mesh
    Rational depth{};            // window depth
};

using ExactPixels = std::map<std::size_t, std::vector<ExactFragment>>;

// A linear function of X and Y.
struct Linear {
    std::array<Rational, 3> exact{};
    std::array<double, 3> rounded{};

    explicit Linear(std::array<Rational, 3> coefficients) : exact{std::move(coefficients)} {
        for (std::size_t i = 0; i < 3; ++i) rounded[i] = exact[i].convert_to<double>();
    }
    [[nodiscard]] Rational at(const Rational& x, const Rational& y) const {
        return exact[0] * x + exact[1] * y + exact[2];
    }
    // The sign at a point whose rounded coordinates are given as well. Exact arithmetic runs only where rounding could
    // change the sign.
    [[nodiscard]] int sign(const Rational& x, const Rational& y, double near_x, double near_y) const {
        const double a = rounded[0] * near_x, b = rounded[1] * near_y, sum = a + b + rounded[2];
        if (std::fabs(sum) > 1e-12 * (std::fabs(a) + std::fabs(b) + std::fabs(rounded[2]))) return sum > 0 ? 1 : -1;
        const Rational value = at(x, y);
        return value > 0 ? 1 : value < 0 ? -1 : 0;
    }
    // The top-left rule in coordinates with y up: a left side has its inside on its right, a top side below it.
    [[nodiscard]] bool owns_its_line() const { return exact[0] > 0 || (exact[0] == 0 && exact[1] < 0); }
};

class ExactScene {
  public:
    ExactScene(const scenes::Scene& scene, const scenes::HardCase& hard)
        : hard_{hard},
          transparent_{fragments_of(scene, scene.list.meshes[0])},
          opaque_{fragments_of(scene, scene.list.meshes[1])} {}

    // The visible fragments of each pixel, row by row from the top, in triangle order. Pixels that no triangle covers
    // are omitted.
    [[nodiscard]] ExactPixels visible() const {
        ExactPixels result = transparent_;
        for (auto& [pixel, fragments] : result) {
            Rational limit{1};
            if (const auto surface = opaque_.find(pixel); surface != opaque_.end())
                for (const ExactFragment& f : surface->second) limit = std::min(limit, f.depth);
            std::erase_if(fragments, [&](const ExactFragment& f) { return !(f.depth < limit); });
        }
        return result;
    }

  private:
    static bool all_finite(const auto& v) {
        for (const float value : components(v))
            if (!std::isfinite(value)) return false;
        return true;
    }

    [[nodiscard]] ExactPixels fragments_of(const scenes::Scene& scene, const pipeline::Mesh& mesh) const {
        ExactPixels pixels;
        const Matrix& m = scene.own_view->projection;
        for (std::uint32_t t = 0; 3 * t < mesh.indices.size(); ++t) {
            std::array<std::array<Rational, 4>, 3> clip;
            std::array<std::array<double, 4>, 3> rounded{};
            bool is_sound = true;
            for (std::size_t k = 0; k < 3 && is_sound; ++k) {
                const std::uint32_t v = mesh.indices[3 * t + k];
                is_sound = all_finite(mesh.positions[v]) && all_finite(mesh.colors[v]) &&
                           (mesh.texcoords.empty() || all_finite(mesh.texcoords[v]));
                rounded[k] = clip_position<double>(m, mesh.positions[v]);
            }
            if (!is_sound) continue;
            const Reach reach = reach_of(rounded);
            if (reach.is_empty()) continue;
            for (std::size_t k = 0; k < 3; ++k)
                clip[k] = clip_position<Rational>(m, mesh.positions[mesh.indices[3 * t + k]]);
            add(clip, t, reach, pixels);
        }
        return pixels;
    }

    template <class Number>
    static std::array<Number, 4> clip_position(const Matrix& m, const pipeline::Vec3& p) {
        std::array<Number, 4> result;
        for (int r = 0; r < 4; ++r)
            result[static_cast<std::size_t>(r)] = Number{m[0][r]} * Number{double{p.x}} +
                                                  Number{m[1][r]} * Number{double{p.y}} +
                                                  Number{m[2][r]} * Number{double{p.z}} + Number{m[3][r]};
        return result;
    }

    // Pixels from (x0, y0) inclusive to (x1, y1) exclusive.
    struct Reach {
        int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
        [[nodiscard]] bool is_empty() const { return x0 >= x1 || y0 >= y1; }
    };

    // Pixels whose centres a triangle in front of the eye can cover, with a margin of a millionth of a pixel for
    // rounding in this function; all pixels for any other triangle.
    [[nodiscard]] Reach reach_of(const std::array<std::array<double, 4>, 3>& clip) const {
        double lo_x = 1e300, hi_x = -1e300, lo_y = 1e300, hi_y = -1e300;
        for (const auto& [cx, cy, cz, w] : clip) {
            if (w <= 0) return {0, 0, hard_.width, hard_.height};
            const double x = (cx / w + 1) * hard_.width / 2, y = (1 - cy / w) * hard_.height / 2;
            lo_x = std::min(lo_x, x);
            hi_x = std::max(hi_x, x);
            lo_y = std::min(lo_y, y);
            hi_y = std::max(hi_y, y);
        }
        constexpr double spare = 1e-6;
        const auto first = [](double v, int size) {
            return static_cast<int>(std::clamp(std::ceil(v - 0.5 - spare), 0.0, double(size)));
        };
        const auto end = [](double v, int size) {
            return static_cast<int>(std::clamp(std::floor(v - 0.5 + spare) + 1, 0.0, double(size)));
        };
        return {first(lo_x, hard_.width), first(lo_y, hard_.height), end(hi_x, hard_.width), end(hi_y, hard_.height)};
    }

    void add(const std::array<std::array<Rational, 4>, 3>& clip, std::uint32_t triangle, const Reach& reach,
             ExactPixels& pixels) const {
        // Row k is the cross product of the two other corners over (x, y, w).
        const auto cross = [&](std::size_t a, std::size_t b) -> std::array<Rational, 3> {
            const auto& [ax, ay, az, aw] = clip[a];
            const auto& [bx, by, bz, bw] = clip[b];
            return {ay * bw - aw * by, aw * bx - ax * bw, ax * by - ay * bx};
        };
        std::array<std::array<Rational, 3>, 3> rows{cross(1, 2), cross(2, 0), cross(0, 1)};
        const Rational determinant = rows[0][0] * clip[0][0] + rows[0][1] * clip[0][1] + rows[0][2] * clip[0][3];
        if (determinant == 0) return;
        std::array<Rational, 3> depth;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) {
                rows[k][i] /= determinant;
                depth[i] += rows[k][i] * clip[k][2];
            }
        const std::array<Linear, 3> weights{Linear{rows[0]}, Linear{rows[1]}, Linear{rows[2]}};
        const Linear plane{depth};
        for (int y = reach.y0; y < reach.y1; ++y)
            for (int x = reach.x0; x < reach.x1; ++x) add_pixel(weights, plane, triangle, x, y, pixels);
    }

    void add_pixel(const std::array<Linear, 3>& weights, const Linear& plane, std::uint32_t triangle, int x, int y,
                   ExactPixels& pixels) const {
        const Rational ndc_x = Rational{2 * x + 1, hard_.width} - 1, ndc_y = 1 - Rational{2 * y + 1, hard_.height};
        const double near_x = (2.0 * x + 1) / hard_.width - 1, near_y = 1 - (2.0 * y + 1) / hard_.height;
        for (const Linear& weight : weights) {
            const int sign = weight.sign(ndc_x, ndc_y, near_x, near_y);
            if (sign < 0 || (sign == 0 && !weight.owns_its_line())) return;
        }
        const Rational z = plane.at(ndc_x, ndc_y);
        if (z < -1 || z > 1) return;
        const Rational near{hard_.depth_near}, far{hard_.depth_far};
        const auto pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(hard_.width) + static_cast<std::size_t>(x);
        pixels[pixel].push_back({triangle, near + (z + 1) / 2 * (far - near)});
    }

    const scenes::HardCase& hard_;
    ExactPixels transparent_, opaque_;
};

// The statistics of hard_case.h.
[[nodiscard]] inline scenes::HardAnswer counts_of(const ExactPixels& pixels) {
    scenes::HardAnswer counts;
    for (const auto& [pixel, fragments] : pixels) {
        std::vector<Rational> depths;
        for (const ExactFragment& f : fragments) depths.push_back(f.depth);
        std::sort(depths.begin(), depths.end());
        const auto distinct = static_cast<int>(std::unique(depths.begin(), depths.end()) - depths.begin());
        counts.fragments += fragments.size();
        counts.deepest = std::max(counts.deepest, static_cast<int>(fragments.size()));
        counts.layers = std::max(counts.layers, distinct);
        if (distinct < static_cast<int>(fragments.size())) ++counts.tied_pixels;
    }
    return counts;
}

}  // namespace strata::testing
