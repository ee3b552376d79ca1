// Tests the vertex transform against rationals (tests/rasterizer/rational.h) with the roundings of vertex_transform.h
// written out.
#include "pipeline/vertices/vertex_transform.h"

#include <catch2/catch.hpp>

#include "pipeline/vertices/matrix.h"
#include "pipeline/vertices/prepare.h"
#include "pipeline/vertices/quotient_rows.h"
#include "rasterizer/base/nv20_arithmetic.h"
#include "tests/rasterizer/rational.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::pipeline;
using strata::rasterizer::nearest_float;
using strata::rasterizer::Rational;
using strata::rasterizer::truncate_to_bits;

constexpr std::array paths{VertexPath::separate,         VertexPath::fused,       VertexPath::reassociated,
                           VertexPath::double_precision, VertexPath::toward_zero, VertexPath::nv20};

[[nodiscard]] Matrix random_matrix(Random& random) {
    std::array<double, 16> m{};
    for (double& x : m) x = double{random_float(random, -3, 3)} + double{random_float(random, -1, 1)} * 0x1p-30;
    return strata::matrix_of(m);
}

[[nodiscard]] Vec3 random_position(Random& random) {
    return {random_float(random, -2, 2), random_float(random, -2, 2), random_float(random, -2, 2)};
}

[[nodiscard]] float near(const Rational& v) { return nearest_float(v); }
[[nodiscard]] float down(const Rational& v) {
    const Rational size = abs(truncate_to_bits(v, 24));
    return v < 0 ? -nearest_float(size) : nearest_float(size);
}

// v rounded to 53 bits, to nearest, ties to even.
[[nodiscard]] Rational near53(const Rational& v) {
    if (v == 0) return v;
    const int unit = strata::rasterizer::floor_log2(abs(v)) - 52;
    const Rational scaled = abs(v) * strata::rasterizer::power(-unit);
    strata::rasterizer::Integer code = strata::rasterizer::floor(scaled);
    const Rational rest = scaled - Rational{code};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && (code & 1) != 0)) ++code;
    return (v < 0 ? Rational{-code} : Rational{code}) * strata::rasterizer::power(unit);
}

[[nodiscard]] float in_binary64(const std::array<double, 4>& m, const Vec3& p) {
    const auto product = [&](std::size_t i) -> Rational { return near53(Rational{m[i]} * Rational{p[i]}); };
    const Rational xyz = near53(near53(product(0) + product(1)) + product(2));
    return near(near53(xyz + Rational{m[3]}));
}

using Row = std::array<float, 4>;

[[nodiscard]] float in_pairs(const Row& m, const Row& p) {
    const auto product = [&](std::size_t i) { return near(Rational{m[i]} * Rational{p[i]}); };
    const float xy = near(Rational{product(0)} + Rational{product(1)}),
                zw = near(Rational{product(2)} + Rational{product(3)});
    return near(Rational{xy} + Rational{zw});
}

struct Matrices {
    Matrix whole, outer, inner;
    [[nodiscard]] static Row rounded(const Matrix& m, std::size_t r) {
        return {static_cast<float>(m[0][r]), static_cast<float>(m[1][r]), static_cast<float>(m[2][r]),
                static_cast<float>(m[3][r])};
    }
};

[[nodiscard]] float model(VertexPath path, const Matrices& m, std::size_t r, const Vec3& p) {
    const Row row = Matrices::rounded(m.whole, r);
    const auto exact = [&](std::size_t i) -> Rational { return Rational{row[i]} * Rational{p[i]}; };
    switch (path) {
        case VertexPath::separate: {
            const float xy = near(Rational{near(exact(0))} + Rational{near(exact(1))});
            return near(Rational{near(Rational{xy} + Rational{near(exact(2))})} + Rational{row[3]});
        }
        case VertexPath::fused: {
            const float xy = near(Rational{near(exact(0))} + exact(1));
            return near(Rational{near(Rational{xy} + exact(2))} + Rational{row[3]});
        }
        case VertexPath::toward_zero: {
            const float xy = down(Rational{down(exact(0))} + Rational{down(exact(1))});
            return down(Rational{down(Rational{xy} + Rational{down(exact(2))})} + Rational{row[3]});
        }
        case VertexPath::double_precision:
            return in_binary64({m.whole[0][r], m.whole[1][r], m.whole[2][r], m.whole[3][r]}, p);
        case VertexPath::reassociated: {
            Row eye{};
            for (std::size_t i = 0; i < 4; ++i) eye[i] = in_pairs(Matrices::rounded(m.inner, i), {p[0], p[1], p[2], 1});
            return in_pairs(Matrices::rounded(m.outer, r), eye);
        }
        case VertexPath::nv20: {
            using namespace strata::rasterizer::nv20;  // these functions have their own tests
            return sum(std::array{multiply(row[0], p[0]), multiply(row[1], p[1]), multiply(row[2], p[2]), row[3]});
        }
    }
    return 0;
}

}  // namespace

TEST_CASE("every vertex path rounds where its rule says and no two give the same bits throughout", "[slow]") {
    Random random{931};
    std::array<std::uint64_t, paths.size()> wrong{}, unlike_separate{};
    for (int i = 0; i < 300; ++i) {
        const Matrix outer = random_matrix(random), inner = random_matrix(random);
        const Matrices m{product(outer, inner), outer, inner};
        const Vec3 p = random_position(random);
        for (std::size_t k = 0; k < paths.size(); ++k) {
            const auto found = VertexTransform{paths[k], m.whole, outer, inner}(p);
            for (std::size_t r = 0; r < 4; ++r) {
                wrong[k] += found[r] != model(paths[k], m, r, p) ? 1 : 0;
                unlike_separate[k] += found[r] != model(VertexPath::separate, m, r, p) ? 1 : 0;
            }
        }
    }
    for (std::size_t k = 0; k < paths.size(); ++k) {
        INFO(vertex_path_names[k]);
        CHECK(wrong[k] == 0);
        CHECK((k == 0 || unlike_separate[k] > 100));
    }
}

TEST_CASE("a view's vertex path computes its positions and nv20 divides by w as that engine does") {
    const TriangleScene scene = random_triangles(932, 40);
    const DeviceProfile& geforce3 = *find_profile("geforce3");
    strata::rasterizer::RasterState state;
    state.viewport = {0, 0, 64, 64};
    state.depth_format = DepthFormat::d24;
    for (const VertexPath path : paths) {
        View view = scene.view;
        view.vertex_path = path;
        const PreparedDraw prepared = prepare(scene.list, view, state, geforce3, {});
        CHECK(prepared.geometry.rules.w_divide ==
              (path == VertexPath::nv20 ? strata::rasterizer::WDivide::nv20 : strata::rasterizer::WDivide::reciprocal));
        const Instance& first = scene.list.instances.front();
        const Matrix inner = product(view.view, first.model);
        const VertexTransform clip{path, product(product(view.projection, view.view), first.model), view.projection,
                                   inner};
        const auto& positions = scene.list.meshes[first.mesh].positions;
        bool same = true;
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const auto p = clip(positions[i]);
            const auto& v = prepared.geometry.vertices[i];
            same = same && p == std::array{v.x, v.y, v.z, v.w};
            if (path == VertexPath::nv20)
                same = same && prepared.geometry.corners[i].inverse_w == strata::rasterizer::nv20::reciprocal(v.w);
        }
        CHECK(same);
    }
}

TEST_CASE("r over q is the window depth of the vertex in the units of vertex z for every depth range and path") {
    const TriangleScene scene = random_triangles(933, 40);
    for (const char* profile : {"geforce3", "geforce8"})
        for (const VertexPath path : paths)
            for (const auto& [n, f] : {std::pair{0.0f, 1.0f}, std::pair{0.25f, 0.75f}}) {
                strata::rasterizer::RasterState state;
                state.viewport = {0, 0, 64, 64};
                state.depth_format = DepthFormat::d24;
                state.depth_near = n, state.depth_far = f;
                View view = scene.view;
                view.vertex_path = path;
                const auto prepared =
                    prepare(scene.list, view, state, *find_profile(profile), {.depth_quotient = true});
                const auto& g = prepared.geometry;
                REQUIRE((g.extras.has_rq && g.extras.values.size() == 2 * g.vertices.size()));
                const double units = profile == std::string{"geforce3"} ? 16777215.0 : 1.0;
                std::uint64_t far_off = 0;
                for (std::size_t i = 0; i < g.vertices.size(); ++i) {
                    const float* rq = g.extras.of(i);
                    const double depth = double{rq[0]} / double{rq[1]} / units;
                    const double truth = 0.5 * (double{f} - n) * (double{g.vertices[i].z} / double{g.vertices[i].w}) +
                                         0.5 * (double{n} + f);
                    far_off += std::abs(depth - truth) > 0x1p-20 ||
                                       std::abs(rq[1] - g.vertices[i].w) > 0x1p-20f * g.vertices[i].w
                                   ? 1
                                   : 0;
                }
                CHECK(far_off == 0);
            }
}

TEST_CASE("the rows of r and q are Listing 2's matrices multiplied out with row r times 2^n - 1") {
    Random random{934};
    Matrix p, v, m;  // multiples of 2^-6 below 4: every product and sum is exact in binary64
    for (Matrix* each : {&p, &v, &m})
        for (std::size_t i = 0; i < 16; ++i) (*each)[i / 4][i % 4] = random_int(random, -255, 255) / 64.0;
    strata::rasterizer::RasterState state;
    state.depth_format = DepthFormat::d16;
    const View view{.view = v, .projection = p};
    const VertexTransform rows = quotient_rows(view, m, state, find_profile("geforce3")->raster);
    const auto entry = [&](const Matrix& a, std::size_t row, std::size_t column) { return Rational{a[column][row]}; };
    std::array<float, 4> r{}, q{};
    for (std::size_t column = 0; column < 4; ++column) {
        Rational z{0}, w{0};
        for (std::size_t j = 0; j < 4; ++j)
            for (std::size_t k = 0; k < 4; ++k) {
                z += entry(p, 2, j) * entry(v, j, k) * entry(m, k, column);
                w += entry(p, 3, j) * entry(v, j, k) * entry(m, k, column);
            }
        r[column] = nearest_float((z + w) / 2 * 65535);
        q[column] = nearest_float(w);
    }
    const Vec3 at{0.5f, -2.0f, 0.25f};  // powers of two: the products are exact
    const auto sum = [&](const std::array<float, 4>& row) {
        const float xy = row[0] * at[0] + row[1] * at[1];
        const float xyz = xy + row[2] * at[2];
        return xyz + row[3];
    };
    CHECK(rows(at)[2] == sum(r));
    CHECK(rows(at)[3] == sum(q));
}
