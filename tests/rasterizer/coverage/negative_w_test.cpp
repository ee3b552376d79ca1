// Tests coverage with negative w. A pixel belongs to a triangle of positive area if at its centre the edge value
// opposite every corner has the sign of that corner's w; a centre on a side follows the tie rule, or its opposite where
// w is negative.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>

#include "rasterizer/set_up/window.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int side = 24, sign_bits = 4;

[[nodiscard]] RasterRules sign_rules(WSigns signs) {
    RasterRules rules{.subpixel_bits = sign_bits, .snap = Snap::toward_zero, .z_clip = ZClip::per_fragment};
    rules.w_signs = signs;
    return rules;
}

[[nodiscard]] Geometry sign_geometry(const std::array<ClipVertex, 3>& v, WSigns signs) {
    TriangleSoup soup;
    soup.vertices.insert(soup.vertices.end(), v.begin(), v.end());
    soup.indices = {0, 1, 2};
    soup.runs = {{.index_count = 3}};
    RasterState state;
    state.viewport = {0, 0, side, side};
    state.window_positions = true;
    state.cull = CullFace::none;
    return set_up(std::move(soup), state, sign_rules(signs), 1);
}

using SignedPixels = std::set<std::array<int, 2>>;

[[nodiscard]] SignedPixels covered(const std::array<ClipVertex, 3>& v, WSigns signs = WSigns::by_corner) {
    SignedPixels pixels;
    for (const Fragment& f : draw(sign_geometry(v, signs), {}, coverage_only).fragments) pixels.insert({f.x, f.y});
    return pixels;
}

[[nodiscard]] SignedPixels covered_by_signs(const std::array<ClipVertex, 3>& v) {
    std::array<SubpixelPoint, 3> p;
    for (std::size_t i = 0; i < 3; ++i)
        p[i] = {static_cast<std::int32_t>(v[i].x * 16), static_cast<std::int32_t>(v[i].y * 16)};
    const Integer area = doubled_area(p[0], p[1], p[2]);
    SignedPixels pixels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const SubpixelPoint c = model_centre(x, y, sign_bits);
            bool inside = area != 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const SubpixelPoint a = p[(i + 1) % 3], b = p[(i + 2) % 3];
                Integer e = doubled_area(a, b, c);
                if (area < 0) e = -e;
                // A left side goes up on the clockwise outline, a top one to the right.
                const bool turned = area < 0;
                const int dx = turned ? a.x - b.x : b.x - a.x, dy = turned ? a.y - b.y : b.y - a.y;
                const bool owns = dy != 0 ? dy < 0 : dx > 0, negative = std::signbit(v[i].w);
                inside = inside && (e == 0 ? owns != negative : (e > 0) != negative);
            }
            if (inside) pixels.insert({x, y});
        }
    return pixels;
}

}  // namespace

TEST_CASE("a triangle covers where edge values have the signs of w which is beyond a side or the wedge behind a corner",
          "[slow]") {
    Random random{891};
    std::uint64_t wrong = 0, pixels = 0, unbounded = 0;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int n = 0; n < 400; ++n) {
        std::array<ClipVertex, 3> v{};
        for (ClipVertex& c : v) {
            // Half of them are on pixel centres, for ties.
            c.x = static_cast<float>(random_int(random, -4, side + 4)) + (n % 2 == 0 ? 0.5f : 0.3125f);
            c.y = static_cast<float>(random_int(random, -4, side + 4)) + (n % 2 == 0 ? 0.5f : 0.875f);
            constexpr float values[] = {1, 1, 1, -1, 0.0f, -0.0f, infinity, -infinity, 0x1p-64f, -0x1p64f};
            c.w = values[random_int(random, 0, 9)];
        }
        const SignedPixels found = covered(v), expected = covered_by_signs(v);
        wrong += found != expected ? 1 : 0;
        pixels += found.size();
        unbounded += std::signbit(v[0].w) || std::signbit(v[1].w) || std::signbit(v[2].w) ? found.size() : 0;
    }
    CHECK(wrong == 0);
    CHECK(pixels > 5000);
    CHECK(unbounded > 3000);
}

TEST_CASE(
    "two triangles that share a side and have a corner of opposite w share no pixel and leave none between them") {
    const ClipVertex a{.x = 4.5f, .y = 4.5f}, b{.x = 20.5f, .y = 8.5f}, c{.x = 8.5f, .y = 20.5f};
    ClipVertex behind = a;
    behind.w = -1.0f;
    const SignedPixels triangle = covered({a, b, c}), beyond = covered({behind, b, c});
    for (const auto& pixel : triangle) CHECK(beyond.count(pixel) == 0);
    CHECK(beyond == covered_by_signs({behind, b, c}));
    CHECK(!beyond.empty());
}

TEST_CASE("without the rule a w of zero or infinity drops its triangle and a negative one changes no pixel") {
    const ClipVertex a{.x = 2, .y = 2}, b{.x = 20, .y = 3}, c{.x = 5, .y = 21};
    ClipVertex zero = a, negative = a;
    zero.w = 0.0f;
    negative.w = -3.0f;
    CHECK(covered({zero, b, c}, WSigns::ignored).empty());
    CHECK(covered({negative, b, c}, WSigns::ignored) == covered({a, b, c}));
    CHECK(sign_geometry({zero, b, c}, WSigns::ignored).counters.non_finite == 1);
}

TEST_CASE("a w below 2^-64 is set to 2^-64 and one above 2^64 to 2^64 with its sign") {
    for (const float sign : {1.0f, -1.0f}) {
        for (const float w : {0.0f, 0x1p-149f, 0x1p-126f, 0x1.fffffep-65f, 0x1p-64f})
            CHECK(settled_w(sign * w) == sign * 0x1p-64f);
        for (const float w : {0x1p64f, 0x1.000002p64f, 0x1.fffffep127f, std::numeric_limits<float>::infinity()})
            CHECK(settled_w(sign * w) == sign * 0x1p64f);
        for (const float w : {0x1.000002p-64f, 1.0f, 0x1.fffffep63f}) CHECK(settled_w(sign * w) == sign * w);
    }
    CHECK(std::isnan(settled_w(std::numeric_limits<float>::quiet_NaN())));
}

TEST_CASE("NEARFAR drops a triangle if all its corners are before or all are behind the range and no other") {
    RasterState state;
    state.viewport = {0, 0, side, side};
    state.window_positions = state.range_culls_triangles = state.depth_clamp = true;
    state.cull = CullFace::none;
    state.depth_near = 0.25f;
    state.depth_far = 0.75f;
    const auto kept = [&](float z0, float z1, float z2) {
        TriangleSoup soup;
        for (const auto& [x, y, z] :
             {std::array{2.0f, 2.0f, z0}, std::array{20.0f, 2.0f, z1}, std::array{2.0f, 20.0f, z2}})
            soup.vertices.push_back({.x = x, .y = y, .z = z});
        soup.indices = {0, 1, 2};
        soup.runs = {{.index_count = 3}};
        return set_up(std::move(soup), state, sign_rules(WSigns::by_corner), 1).triangles.size() == 1;
    };
    CHECK_FALSE(kept(0.1f, 0.2f, 0.2f));
    CHECK_FALSE(kept(0.8f, 0.9f, 1.5f));
    CHECK(kept(0.25f, 0.1f, 0.1f));
    CHECK(kept(0.1f, 0.9f, 0.1f));
    CHECK(kept(0.75f, 0.9f, 0.9f));
    state.range_culls_triangles = false;
    CHECK(kept(0.1f, 0.2f, 0.2f));
}
