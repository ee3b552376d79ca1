// Tests w buffers of the NV2A against rasterizer/reference/depth.md 4.8 in rational arithmetic, with the roundings to
// 53 bits that the rule has; coverage is decided by a comparison of signs at every centre.
#include "rasterizer/chip/w_buffer.h"

#include <catch2/catch.hpp>

#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/support.h"

namespace {

using namespace strata::rasterizer;

constexpr int w_bits = 4;

// v rounded to 53 bits, to nearest, ties to even.
[[nodiscard]] Rational nearest_53(const Rational& v) {
    if (v == 0) return v;
    const Rational unit = power(floor_log2(abs(v)) - 52), scaled = abs(v) / unit;
    Integer code = floor(scaled);
    const Rational rest = scaled - Rational{code};
    if (rest > Rational{1, 2} || (rest == Rational{1, 2} && (code & 1) != 0)) ++code;
    return v < 0 ? Rational{-Rational{code} * unit} : Rational{Rational{code} * unit};
}

using Three = std::array<Rational, 3>;

// The corner of the largest exponent; ties {0,1} -> 0, {0,2} -> 2, {1,2} -> 1, all -> 2.
[[nodiscard]] std::size_t corner_of_the_rest(const Three& b) {
    std::array<int, 3> k;
    for (std::size_t i = 0; i < 3; ++i) k[i] = b[i] == 0 ? -9999 : floor_log2(b[i]);
    const int most = std::max({k[0], k[1], k[2]});
    const int who = (k[0] == most ? 1 : 0) + (k[1] == most ? 2 : 0) + (k[2] == most ? 4 : 0);
    return who == 1 || who == 3 ? 0 : who == 2 || who == 6 ? 1 : 2;
}

[[nodiscard]] Rational model_w(const EdgeValues& e, const std::array<float, 3>& w) {
    Three b;
    int largest = -9999;
    for (std::size_t i = 0; i < 3; ++i) {
        b[i] = truncate_to_bits(Rational{e[i]}, 24) * truncate_to_bits(1 / Rational{w[i]}, 24);
        if (b[i] != 0) largest = std::max(largest, floor_log2(b[i]));
    }
    // The adder aligns complete products to 29 bits of the largest; the weights use 25 bits of each.
    const Rational sum = truncate(b[0], largest - 28) + truncate(b[1], largest - 28) + truncate(b[2], largest - 28);
    const Rational inverse = nearest_53(1 / sum);
    const bool is_power = sum == power(floor_log2(sum));
    const Rational r = is_power ? inverse : truncate_to_bits(nearest_53(inverse * (1 - power(-31))), 29);
    for (Rational& each : b) each = truncate_to_bits(truncate_to_bits(each, 25) * r, 24);
    const std::size_t rest = corner_of_the_rest(b);
    b[rest] = nearest_53(1 - nearest_53(b[(rest + 1) % 3] + b[(rest + 2) % 3]));
    const Rational base{w[1]}, p0 = nearest_53(b[0] * (Rational{w[0]} - base)),
                               p2 = nearest_53(b[2] * (Rational{w[2]} - base));
    int ex = floor_log2(base);
    for (const Rational& p : {p0, p2})
        if (p != 0) ex = std::max(ex, floor_log2(abs(p)));
    return truncate_to_bits(base + truncate(p0, ex - 28) + truncate(p2, ex - 28), 24);
}

[[nodiscard]] Geometry w_geometry(const SetupTriangle& t, DepthFormat format, float scale) {
    RasterRules rules{.subpixel_bits = w_bits,
                      .window_z = WindowZ::buffer_units,
                      .depth_rounding = DepthRounding::floor,
                      .offset_rule = OffsetRule::fragments};
    Geometry g = window_geometry({t}, 16, 16, rules);
    for (std::size_t i = 0; i < 3; ++i) g.vertices[i].w = t.w[i];
    g.state.depth_format = format;
    g.state.w_scale = scale;
    return g;
}

[[nodiscard]] SetupTriangle with_w(Random& random, int n) {
    while (true) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 16, 16, w_bits, n % 3 == 0 ? 3000 : 4);
        if (doubled_area(p[0], p[1], p[2]) == 0) continue;
        SetupTriangle t = window_triangle(p, w_bits);
        for (std::size_t i = 0; i < 3; ++i) t.w[i] = random_float(random, 1, n % 2 == 0 ? 4.0f : 300.0f);
        if (n % 5 == 0) t.w[2] = t.w[0];
        return t;
    }
}

// The code that a 24-bit buffer stores for v.
[[nodiscard]] std::uint32_t d24_code(const Rational& v) {
    const Integer whole = v < 0 ? Integer{0} : floor(v);
    return whole > 0xffffff ? 0xffffffu : whole.convert_to<std::uint32_t>();
}

constexpr FragmentNeeds w_codes{.shader_z = false, .color = false};

}  // namespace

TEST_CASE("a w buffer stores the w of the corners by truncated perspective weights and scaled regardless of z",
          "[slow]") {
    Random random{881};
    std::uint64_t fragments = 0, wrong = 0, inside = 0;
    for (int n = 0; n < 90; ++n) {
        const SetupTriangle t = with_w(random, n);
        constexpr float scale = 40000.0f;
        const std::array<float, 3> w{t.w[0] * scale, t.w[1] * scale, t.w[2] * scale};
        const auto [low, high] = std::minmax({w[0], w[1], w[2]});
        const TriangleEdges edges{t.p, TieRule::top_left};
        for (const Fragment& f :
             draw(w_geometry(t, DepthFormat::d24, scale), {DepthPath::w_buffer, DepthFormat::d24}, w_codes).fragments) {
            const Rational model = model_w(edges.at(pixel_centre(f.x, f.y, w_bits)), w);
            wrong += f.code != d24_code(model) ? 1 : 0;
            inside += model >= Rational{low} - 2 && model <= Rational{high} + 2 ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(fragments > 2000);
    CHECK(wrong == 0);
    CHECK(inside == fragments);
}

TEST_CASE("where every corner has the same w a w buffer stores that number in all its formats") {
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d16f, DepthFormat::d24f}) {
        SetupTriangle t = window_triangle({{{-64, -64}, {1600, -64}, {-64, 1600}}}, w_bits, {9, 70, 100});
        t.w = {6.5f, 6.5f, 6.5f};
        const std::uint32_t expected = format == DepthFormat::d16f   ? (9u << 12 | 0xa00)  // 1.625 * 2^2
                                       : format == DepthFormat::d24f ? (129u << 16 | 0xa000)
                                                                     : 6;
        const auto found = draw(w_geometry(t, format, 1.0f), {DepthPath::w_buffer, format}, w_codes).fragments;
        CHECK(found.size() == 256);
        for (const Fragment& f : found) CHECK(f.code == expected);
    }
}

TEST_CASE("the chip adds its offset to the 24-bit value in buffer units and then converts to the code") {
    // Large values, in units of 1. 8388609 + 2.75 is truncated to 8388611. In a float format the bias is in the
    // format's values.
    const SetupTriangle flat =
        window_triangle({{{-64, -64}, {1600, -64}, {-64, 1600}}}, w_bits, {8388609.0, 8388609.0, 8388609.0});
    Geometry g = w_geometry(flat, DepthFormat::d24, 1.0f);
    g.state.polygon_offset = {true, 0.0f, 2.75f};
    for (const Fragment& f : draw(g, {DepthPath::window_z, DepthFormat::d24}, w_codes).fragments)
        CHECK(f.code == 8388611);
    const SetupTriangle low = window_triangle({{{-64, -64}, {1600, -64}, {-64, 1600}}}, w_bits, {4, 4, 4});
    Geometry small = w_geometry(low, DepthFormat::d16f, 1.0f);
    small.state.polygon_offset = {true, 0.0f, 16.0f};
    for (const Fragment& f : draw(small, {DepthPath::window_z, DepthFormat::d16f}, w_codes).fragments)
        CHECK(f.code == (11u << 12 | 0x400));  // 20 = 1.25 * 2^4
}

TEST_CASE("the chip's slope is that of the steeper axis per pixel and its product with the factor is truncated",
          "[slow]") {
    Random random{883};
    std::uint64_t wrong = 0, fragments = 0, moved = 0;
    for (int n = 0; n < 60; ++n) {
        SetupTriangle t = with_w(random, n);
        for (double& z : t.z) z = random_int(random, 1000, 9000000);
        const Rational area{doubled_area(t.p[0], t.p[1], t.p[2])};
        const auto gradient = [&](bool by_x) -> Rational {
            Rational sum;
            for (std::size_t i = 0; i < 3; ++i) {
                const SubpixelPoint a = t.p[(i + 1) % 3], b = t.p[(i + 2) % 3];
                sum += Rational{by_x ? a.y - b.y : b.x - a.x} * Rational{t.z[i]};
            }
            return abs(Rational{sum * 16 / area});
        };
        const Rational slope = std::max(gradient(true), gradient(false));
        Geometry g = w_geometry(t, DepthFormat::d24, 1.0f);
        const auto plain = draw(g, {DepthPath::window_z, DepthFormat::d24}, w_codes).fragments;
        g.state.polygon_offset = {true, 3.0f, -7.5f};
        g.state.depth_clamp = true;
        const auto found = draw(g, {DepthPath::window_z, DepthFormat::d24}, w_codes).fragments;
        REQUIRE(found.size() == plain.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            const Rational o = slope * 3 - Rational{15, 2}, expected = Rational{plain[i].code} + o;
            if (expected < 2 || expected > 16777213) continue;
            const Rational off = Rational{found[i].code} - expected;
            wrong += off > 1 + abs(o) * power(-22) || off < -1 - abs(o) * power(-22) ? 1 : 0;
            moved += found[i].code != plain[i].code ? 1 : 0;
            ++fragments;
        }
    }
    CHECK(fragments > 1000);
    CHECK(moved > 500);
    CHECK(wrong == 0);
}

TEST_CASE("a w buffer's slope is the difference of w between the two pixels of the first quad along the steeper axis") {
    // w = 1 / (1 - y / 32) down the window; corner values at y = 0 and at y = 48 of a triangle that covers it.
    SetupTriangle t = window_triangle({{{-256, 0}, {512, 0}, {-256, 768}}}, w_bits);
    t.w = {1.0f, 1.0f, -2.0f};  // 1 / w = 1 - y / 32, which is -1/2 at y = 48: behind the eye, used only to define the
                                // plane
    const auto w_of_row = [](double y) { return 1.0 / (1.0 - y / 32.0); };
    const double first = w_slope(t, t.w, {0, 0, 16, 16}, {.subpixel_bits = w_bits});
    CHECK(first == Approx(w_of_row(1.5) - w_of_row(0.5)).epsilon(1e-6));
    RasterRules last{.subpixel_bits = w_bits};
    last.hypothesis.w_slope = WSlope::last_quad;
    CHECK(w_slope(t, t.w, {0, 4, 16, 16}, last) == Approx(w_of_row(7.5) - w_of_row(6.5)).epsilon(1e-6));
    CHECK(w_slope(t, t.w, {0, 0, 0, 0}, last) == 0.0);
}

TEST_CASE("the depth range removes fragments by the chip's value after the offset and by w in a w buffer", "[slow]") {
    Random random{885};
    std::uint64_t wrong = 0, removed = 0;
    for (int n = 0; n < 40; ++n) {
        SetupTriangle t = with_w(random, n);
        for (double& z : t.z) z = random_int(random, 0, 16777215);
        for (float& w : t.w) w *= 50000.0f;
        for (const DepthPath path : {DepthPath::window_z, DepthPath::w_buffer}) {
            Geometry g = w_geometry(t, DepthFormat::d24, 1.0f);
            g.rules.z_clip = ZClip::per_fragment;
            g.state.polygon_offset = {true, 0.0f, 100000.0f};
            g.state.depth_near = 0.25f;
            g.state.depth_far = 0.5f;
            const auto kept = draw(g, {path, DepthFormat::d24}, w_codes).fragments;
            g.state.depth_clamp = true;
            const auto all = draw(g, {path, DepthFormat::d24}, w_codes).fragments;
            std::vector<Fragment> expected;
            constexpr std::uint32_t near = 16777215u / 4, far = 16777215u / 2;
            for (const Fragment& f : all)
                if (f.code > near && f.code < far) expected.push_back(f);
            removed += all.size() - expected.size();
            // A fragment whose code is on a limit may have a value beyond it.
            for (const Fragment& f : kept) wrong += f.code < near || f.code > far ? 1 : 0;
            wrong += kept.size() < expected.size() ? 1 : 0;
        }
    }
    CHECK(removed > 1000);
    CHECK(wrong == 0);
}
