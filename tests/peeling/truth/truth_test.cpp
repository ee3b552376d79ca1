// Tests the truth against rational arithmetic from the matrices and positions to the pixel, in homogeneous coordinates:
// a pixel's point solves v = b0 v0 + b1 v1 + b2 v2 for the ray through its centre, so nothing is divided by w, clipped
// or snapped.
#include "peeling/truth/truth.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/truth/real_texture.h"
#include "tests/peeling/truth/chain_scene.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;
using strata::components;
using Rational = boost::multiprecision::cpp_rational;
using RationalVector = std::array<Rational, 4>;

constexpr int frame_width = 16, frame_height = 12;

RationalVector clip_position(const View& view, const strata::Vec3& p) {
    RationalVector v;
    for (std::size_t r = 0; r < 4; ++r) {
        v[r] = Rational(view.projection[3][r]);
        for (std::size_t c = 0; c < 3; ++c) v[r] += Rational(view.projection[c][r]) * Rational(double{p[c]});
    }
    return v;
}

struct RationalFragment {
    Rational depth;  // z / w
    std::array<Rational, 4> color;
};

// The weights b of the point at the pixel, times the determinant; inside they have the sign of the determinant.
std::array<Rational, 3> ray_weights(const std::array<RationalVector, 3>& v, const Rational& x, const Rational& y) {
    std::array<Rational, 3> b;
    for (std::size_t i = 0; i < 3; ++i) {
        const RationalVector &p = v[(i + 1) % 3], &q = v[(i + 2) % 3];
        b[i] = x * (p[1] * q[3] - p[3] * q[1]) + y * (p[3] * q[0] - p[0] * q[3]) + (p[0] * q[1] - p[1] * q[0]);
    }
    return b;
}

// The sides of random triangles do not pass through pixel centres, so there are no ties.
void add_fragment_of(const Mesh& mesh, const Material& material, std::size_t triangle, int px, int py,
                     std::vector<RationalFragment>& out) {
    std::array<RationalVector, 3> v;
    for (std::size_t i = 0; i < 3; ++i) v[i] = clip_position(chain_view, mesh.positions[3 * triangle + i]);
    const Rational x = Rational(2 * px + 1, frame_width) - 1, y = 1 - Rational(2 * py + 1, frame_height);
    const auto b = ray_weights(v, x, y);
    Rational w = 0, z = 0, whole = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        w += b[i] * v[i][3];
        z += b[i] * v[i][2];
        whole += b[i];
    }
    if (whole == 0) return;
    // The point is in front of the eye: all b have the sign of their sum, and of w.
    const bool all_up = b[0] >= 0 && b[1] >= 0 && b[2] >= 0, all_down = b[0] <= 0 && b[1] <= 0 && b[2] <= 0;
    if (!(all_up || all_down)) return;
    if (w / whole <= 0 || z / w < -1 || z / w > 1) return;
    // Counterclockwise where the determinant is positive: single-sided materials show that side only.
    if (!material.double_sided && !all_up) return;
    RationalFragment fragment{z / w, {}};
    const auto tint = components(all_up ? material.front : material.back);
    for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t i = 0; i < 3; ++i) {
            const float color = components(mesh.colors[3 * triangle + i])[c] * tint[c];  // the vertex stage's binary32
            fragment.color[c] += b[i] / whole * Rational(double{color});
        }
    out.push_back(fragment);
}

std::array<Rational, 3> rational_pixel(const DrawList& list, const Rgba& background, int x, int y) {
    Rational limit = 1;
    std::array<Rational, 3> color;
    for (std::size_t c = 0; c < 3; ++c) color[c] = Rational(double{components(background)[c]});
    std::vector<RationalFragment> opaque, glass;
    for (std::size_t t = 0; t < list.meshes[1].indices.size() / 3; ++t)
        add_fragment_of(list.meshes[1], list.materials[1], t, x, y, opaque);
    for (std::size_t t = 0; t < list.meshes[0].indices.size() / 3; ++t)
        add_fragment_of(list.meshes[0], list.materials[0], t, x, y, glass);
    for (const RationalFragment& f : opaque)
        if (f.depth < limit) {
            limit = f.depth;
            for (std::size_t c = 0; c < 3; ++c) color[c] = f.color[c];
        }
    std::stable_sort(glass.begin(), glass.end(), [](const auto& a, const auto& b) { return a.depth > b.depth; });
    for (const RationalFragment& f : glass) {
        if (!(f.depth < limit)) continue;
        for (std::size_t c = 0; c < 3; ++c) color[c] = f.color[3] * f.color[c] + (1 - f.color[3]) * color[c];
    }
    return color;
}

}  // namespace

TEST_CASE("the truth agrees with rational arithmetic at every pixel to 2^-40", "[slow]") {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const DrawList list = random_chain_list(seed, {.transparent = 10, .opaque = 4});
        RenderOptions options;
        options.width = frame_width;
        options.height = frame_height;
        options.threads = 1;
        options.background = {0.5f, 0.25f, 0.75f, 1};
        const RealImage truth =
            render_chain({list, chain_view, *find_profile("geforce3"), options}, strata::peeling::exact_chain);
        std::size_t wrong = 0, covered = 0;
        for (int y = 0; y < frame_height; ++y)
            for (int x = 0; x < frame_width; ++x) {
                const auto expected = rational_pixel(list, options.background, x, y);
                for (std::size_t c = 0; c < 3; ++c) {
                    const auto model = expected[c].convert_to<double>();
                    const double found = truth.rgb[3 * static_cast<std::size_t>(y * frame_width + x) + c];
                    wrong += std::fabs(found - model) > 0x1p-40 ? 1 : 0;
                    covered += model != double{components(options.background)[c]} ? 1 : 0;
                }
            }
        INFO("seed " << seed);
        CHECK(wrong == 0);
        CHECK(covered > 80);
    }
}

namespace {

// The exact side of p for the line from a to b, in rationals: 1 is right of it with y down.
int rational_side(const RealCorner& a, const RealCorner& b, double x, double y) {
    const Rational e = (Rational(b.x) - Rational(a.x)) * (Rational(y) - Rational(a.y)) -
                       (Rational(b.y) - Rational(a.y)) * (Rational(x) - Rational(a.x));
    return e.sign();
}

// By definition: right of every side of a clockwise triangle, or on a side that runs right or up.
bool is_covered(std::array<RealCorner, 3> corner, double x, double y) {
    if (rational_side(corner[0], corner[1], corner[2].x, corner[2].y) < 0) std::swap(corner[1], corner[2]);
    for (std::size_t i = 0; i < 3; ++i) {
        const RealCorner &from = corner[i], &to = corner[(i + 1) % 3];
        const int side = rational_side(from, to, x, y);
        const bool is_top_or_left = to.y < from.y || (to.y == from.y && to.x > from.x);
        if (side < 0 || (side == 0 && !is_top_or_left)) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("a centre on or next to a side is where rational arithmetic has it and belongs to one of two triangles",
          "[slow]") {
    // Every third side passes through the centre exactly; the others miss it by what binary64 drops of the products.
    Random random{5};
    std::size_t wrong = 0, shared = 0;
    for (int i = 0; i < 3000; ++i) {
        const double cx = random_int(random, 0, 7) + 0.5;
        const double cy = random_int(random, 0, 7) + 0.5;
        const double tiny = i % 3 == 0 ? 0.0 : 0x1p-50;
        const double dx = double{random_float(random, -3, 3)} + tiny;
        const double dy = random_float(random, -3, 3);
        const double stretch = i % 3 == 0 ? 1 : 1 + double{random_float(random, 0, 1)};
        const RealCorner p{.x = cx + dx, .y = cy + dy}, q{.x = cx - stretch * dx, .y = cy - stretch * dy};
        const RealCorner r{.x = cx - 9 * dy, .y = cy + 9 * dx}, s{.x = cx + 9 * dy, .y = cy - 9 * dx};
        const int x = static_cast<int>(cx), y = static_cast<int>(cy);
        const bool one = RealTriangle{{p, q, r}, 0, 0}.weights(x, y).is_inside;
        const bool other = RealTriangle{{q, p, s}, 1, 0}.weights(x, y).is_inside;
        wrong += one != is_covered({p, q, r}, cx, cy) || other != is_covered({q, p, s}, cx, cy) ? 1 : 0;
        shared += int{one} + int{other} == 1 ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(shared == 3000);
}

TEST_CASE("an exact bilinear lookup weights four texels by untruncated fractions") {
    Texture texture;
    texture.width = 2;
    texture.wrap_s = TextureWrap::clamp_to_edge;
    texture.texels = {0, 0, 0, 255, 255, 51, 0, 255};
    const double third = 1.0 / 3;
    CHECK(unquantized_sample(texture, 0.25 + third / 2, 0.5)[0] == Approx(third).epsilon(1e-14));
    CHECK(unquantized_sample(texture, 0.25 + third / 2, 0.5)[1] == Approx(third / 5).epsilon(1e-14));
    CHECK(unquantized_sample(texture, -3, 0.5)[0] == 0);
    CHECK(unquantized_sample(texture, 7, 0.5)[0] == 1);
    texture.wrap_s = TextureWrap::repeat;
    CHECK(unquantized_sample(texture, 0, 0.5)[0] == Approx(0.5));
    texture.filter = TextureFilter::nearest;
    CHECK(unquantized_sample(texture, 0.5, 0.5)[0] == 1);
    CHECK(unquantized_sample(texture, std::nextafter(0.5, 0.0), 0.5)[0] == 0);
}
