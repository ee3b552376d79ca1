// Tests stored depths against a value that another draw returns unrounded (reference_z, shader_z), or that rationals
// give, clamped to the depth range and converted by the format's definition.
#include <catch2/catch.hpp>

#include "rasterizer/values/fragment_values.h"
#include "tests/rasterizer/rational.h"
#include "tests/rasterizer/scene.h"

namespace {

using namespace strata::rasterizer;

struct DepthRange {
    float near, far;
};
constexpr std::array depth_ranges{DepthRange{0, 1}, DepthRange{0.25f, 0.75f}, DepthRange{0.8f, 0.1f},
                                  DepthRange{0.5f, 0.5f}, DepthRange{-3.0f, 7.0f}};

[[nodiscard]] Rational held_in(const DepthRange& range, const Rational& v) {
    const Rational near = std::clamp(Rational{range.near}, Rational{0}, Rational{1}),
                   far = std::clamp(Rational{range.far}, Rational{0}, Rational{1});
    return std::clamp(v, std::min(near, far), std::max(near, far));
}

[[nodiscard]] std::uint32_t fixed_code(const Rational& depth, DepthFormat format, DepthRounding rounding) {
    const Rational max = format == DepthFormat::d16 ? 65535 : 16777215;
    return floor(depth * max + (rounding == DepthRounding::nearest ? Rational{1, 2} : Rational{0}))
        .convert_to<std::uint32_t>();
}

// Triangles of 14 x 14 pixels whose depths, and quotients r/q, range from -0.4 to 1.4 of the buffer.
[[nodiscard]] Geometry deep_triangles(std::uint64_t seed, const RasterRules& rules, DepthFormat format,
                                      const DepthRange& range, double units, int outside = 3) {
    Random random{seed};
    std::vector<SetupTriangle> triangles;
    VertexExtras extras{.stride = 2, .has_rq = true, .values = {}};
    while (triangles.size() < 12) {
        std::array<SubpixelPoint, 3> p;
        for (SubpixelPoint& c : p) c = random_point(random, 14, 14, rules.subpixel_bits, outside);
        if (abs(doubled_area(p[0], p[1], p[2])) < 64) continue;
        std::array<double, 3> z{};
        std::array<float, 3> w{};
        for (std::size_t i = 0; i < 3; ++i) {
            z[i] = double{random_float(random, -0.4f, 1.4f) * static_cast<float>(units)};
            const float q = random_float(random, 0.5f, 2);
            w[i] = 1 / q;
            extras.values.insert(extras.values.end(), {static_cast<float>(z[i]) * q, q});
        }
        triangles.push_back(window_triangle(p, rules.subpixel_bits, z, w));
    }
    Geometry g = window_geometry(triangles, 14, 14, rules);
    g.extras = std::move(extras);
    g.state.depth_format = format;
    g.state.depth_near = range.near, g.state.depth_far = range.far;
    return g;
}

constexpr FragmentNeeds depth_and_reference{.color = false, .reference = true};

}  // namespace

TEST_CASE("a depth value is stored clamped to the depth range and rounded by its format on devices of either unit",
          "[slow]") {
    std::uint64_t wrong = 0, fragments = 0, clamped = 0;
    for (const DepthPath path : {DepthPath::perspective_rq, DepthPath::float32_plane})
        for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
            for (const DepthRounding rounding : {DepthRounding::floor, DepthRounding::nearest})
                for (const WindowZ convention : {WindowZ::unit_interval, WindowZ::buffer_units})
                    for (const DepthRange& range : depth_ranges) {
                        const bool is_float = format == DepthFormat::d32f;
                        const std::uint32_t max = is_float ? 1 : max_code(format);
                        const double units = convention == WindowZ::buffer_units ? static_cast<double>(max) : 1.0;
                        const RasterRules rules{.subpixel_bits = 4, .window_z = convention, .depth_rounding = rounding};
                        const Geometry g = deep_triangles(661, rules, format, range, units);
                        for (const Fragment& f : draw(g, {path, format}, depth_and_reference).fragments) {
                            const Rational depth = Rational{f.reference_z} / max, held = held_in(range, depth);
                            const std::uint32_t expected = is_float ? std::bit_cast<std::uint32_t>(nearest_float(held))
                                                                    : fixed_code(held, format, rounding);
                            ++fragments;
                            clamped += held != depth ? 1 : 0;
                            wrong += f.code != expected || f.reference_code != f.code ? 1 : 0;
                        }
                    }
    CHECK(wrong == 0);
    CHECK(fragments > 20000);
    CHECK(clamped > 5000);
}

TEST_CASE("depth replace keeps exactly the fragments whose quotient is in the depth range inclusive") {
    for (const WindowZ convention : {WindowZ::unit_interval, WindowZ::buffer_units})
        for (const DepthRange& range : depth_ranges) {
            const RasterRules rules{.subpixel_bits = 4, .window_z = convention, .depth_rounding = DepthRounding::floor};
            const double units = convention == WindowZ::buffer_units ? 65535 : 1;
            Geometry g = deep_triangles(662, rules, DepthFormat::d16, range, units);
            std::vector<std::array<int, 3>> expected, found;
            for (const Fragment& f :
                 draw(g, {DepthPath::perspective_rq, DepthFormat::d16}, depth_and_reference).fragments) {
                const Rational depth = Rational{f.reference_z} / 65535;
                // The range's ends are binary32 and are compared as such, times 65535 exactly.
                if (held_in(range, depth) == depth) expected.push_back({f.x, f.y, static_cast<int>(f.primitive)});
            }
            for (const Fragment& f :
                 draw(g, {DepthPath::depth_replace, DepthFormat::d16}, depth_and_reference).fragments)
                found.push_back({f.x, f.y, static_cast<int>(f.primitive)});
            CHECK(found == expected);
            g.state.depth_clamp = true;
            CHECK(draw(g, {DepthPath::depth_replace, DepthFormat::d16}, depth_and_reference).fragments.size() >
                  found.size());
        }
}

TEST_CASE("per-fragment z clip keeps the depths between near and far whether or not they are reversed") {
    std::uint64_t below = 0, above = 0;
    for (const DepthRange& range : depth_ranges) {
        const RasterRules rules{.subpixel_bits = 4, .z_clip = ZClip::per_fragment};
        // One triangle crosses only the near plane, one only the far plane.
        for (const auto& z : {std::array{-0.5, 0.5, 0.5}, std::array{0.5, 0.5, 1.5}, std::array{-0.5, 0.5, 1.5}}) {
            const SetupTriangle t = window_triangle({{{0, 0}, {14 << 4, 0}, {0, 14 << 4}}}, 4, z);
            Geometry g = window_geometry({t}, 14, 14, rules);
            g.state.depth_near = range.near, g.state.depth_far = range.far;
            std::vector<std::array<int, 2>> expected, found;
            for (const Fragment& f : draw(window_geometry({t}, 14, 14, {.subpixel_bits = 4})).fragments) {
                const Rational depth{f.shader_z}, held = held_in(range, depth);
                below += depth < held ? 1 : 0;
                above += depth > held ? 1 : 0;
                if (held == depth) expected.push_back({f.x, f.y});
            }
            for (const Fragment& f : draw(g).fragments) found.push_back({f.x, f.y});
            CHECK(found == expected);
            found.clear();  // a pass that uses no depth has the same fragments
            for (const Fragment& f : draw(g, {}, coverage_only).fragments) found.push_back({f.x, f.y});
            CHECK(found == expected);
        }
    }
    CHECK(below > 100);
    CHECK(above > 100);
}

TEST_CASE("a 16-bit float buffer stores the plane truncated to its mantissa within the depth range reversed or not",
          "[slow]") {
    const auto value_of = [](std::uint32_t code) {
        return code < 4096 ? Rational{0}
                           : power(static_cast<int>(code / 4096) - 7) * Rational{4096 + code % 4096, 4096};
    };
    const Rational hair = power(-22);  // relative error of the binary32 roundings before the truncation
    std::uint64_t wrong = 0, fragments = 0, clamped = 0;
    for (const DepthPath path : {DepthPath::float32, DepthPath::exact})
        for (const DepthRange& range : depth_ranges) {
            const RasterRules rules{.subpixel_bits = 4, .window_z = WindowZ::buffer_units};
            const Geometry g = deep_triangles(663, rules, DepthFormat::d16f, range, 511.9375, 200);
            // Without a compared depth a kernel may use its fast path, which must support the format, too.
            for (const FragmentNeeds& needs : {depth_and_reference, FragmentNeeds{.color = false}})
                for (const Fragment& f : draw(g, {path, DepthFormat::d16f}, needs).fragments) {
                    const SetupTriangle t = g.triangle(f.primitive);
                    const Rational z = plane_value(barycentric(t.p, f.x, f.y, 4), t.z) / Rational{8191, 16};
                    const Rational held = held_in(range, z) * Rational{8191, 16};
                    const Rational stored = value_of(f.code), next = value_of(f.code == 0 ? 4096 : f.code + 1);
                    ++fragments;
                    clamped += held_in(range, z) != z ? 1 : 0;
                    wrong += stored <= held * (1 + hair) && (held * (1 - hair) < next || f.code == 0xffff) ? 0 : 1;
                }
        }
    CHECK(wrong == 0);
    CHECK(fragments > 1000);
    CHECK(clamped > 300);
}

TEST_CASE("the chip's own sum is stored in a 16-bit float buffer without rounding down so fractions of a unit count") {
    const RasterRules rules{
        .subpixel_bits = 4, .window_z = WindowZ::buffer_units, .depth_rounding = DepthRounding::floor};
    const Geometry g = deep_triangles(664, rules, DepthFormat::d16f, {0, 1}, 6.0);
    std::uint64_t wrong = 0, fragments = 0, with_fraction = 0;
    for (const Fragment& f : draw(g, {DepthPath::window_z, DepthFormat::d16f}, {.color = false}).fragments) {
        const SetupTriangle t = g.triangle(f.primitive);
        const Rational exact = plane_value(barycentric(t.p, f.x, f.y, 4), t.z);
        const Rational found{d16f_value(f.code)};
        ++fragments;
        with_fraction += found != floor(found) ? 1 : 0;
        if (exact < Rational{1, 32}) continue;  // near 0 the buffer's code becomes 0
        wrong += found > exact + power(-18) || found < exact * (1 - power(-12)) - power(-18) ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(fragments > 200);
    CHECK(with_fraction > fragments / 2);
}
