// rasterizer/values/depth_paths.cpp - the depth paths that compute a value before its code (depth_paths.h): quotients r
// / q, and planes in binary32 and binary64.
#include "rasterizer/values/depth_paths.h"

#include "rasterizer/set_up/window.h"

namespace strata::rasterizer {
namespace {

// True if planes are divided: if every w is 1, the division would not change a bit (rasterizer/reference/attributes.md
// 1.3).
[[nodiscard]] bool has_w(const std::array<float, 3>& inverse_w) noexcept {
    return !(inverse_w[0] == 1.0f && inverse_w[1] == 1.0f && inverse_w[2] == 1.0f);
}

// u (1/w) at the vertices, in binary32.
[[nodiscard]] RationalPlane over_w(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w) noexcept {
    RationalPlane plane;
    for (std::size_t i = 0; i < 3; ++i) plane.v[i] = double{u[i] * inverse_w[i]};
    return plane;
}

// Rounded to binary32 first and then to the bits of the hypothesis: two roundings, as in depth.md 4.5.
int rounded_plane(const RationalPlane& plane, const TriangleLanes& lanes, int bits, float* out) noexcept {
    const int fallbacks = round_plane(plane, lanes, out);
    for (int i = 0; i < lanes.count; ++i) out[i] = round_mantissa(out[i], bits);
    return fallbacks;
}

// The projective coordinate in binary64: the products u_i * (1 / w_i) of two binary32 are exact, every later operation
// rounds to binary64.
void interpolate_double(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w,
                        const TriangleLanes& lanes, double* out) noexcept {
    if (is_constant(u)) return static_cast<void>(std::fill_n(out, lanes.count, double{u[0]}));
    RationalPlane dividend, divisor;
    for (std::size_t i = 0; i < 3; ++i) {
        dividend.v[i] = double{u[i]} * double{inverse_w[i]};
        divisor.v[i] = double{inverse_w[i]};
    }
    const FilterPlane over{dividend, lanes.reach}, under{divisor, lanes.reach};
    const bool divides = has_w(inverse_w);
    for (int i = 0; i < lanes.count; ++i) {
        const double b1 = lanes.weight1[i], b2 = lanes.weight2[i];
        out[i] = divides ? over.at(b1, b2) / under.at(b1, b2) : over.at(b1, b2);
    }
}

// Computes r and q as attributes in one call; false if a lane is not certain.
[[nodiscard]] bool divided_by_kernel(const QuotientCorners& corners, const TriangleLanes& lanes,
                                     const LaneKernels& kernels, double* out) noexcept {
    alignas(64) Lanes<float> r, q;
    AttributeLanes planes;
    planes.has_w = has_w(corners.inverse_w);
    planes.inverse_w = {{corners.inverse_w[0], corners.inverse_w[1], corners.inverse_w[2]}};
    const auto add = [&](const std::array<float, 3>& u, float* values) {
        if (is_constant(u)) return planes.add(u[0], values);
        std::array<double, 3>& over_w = planes.add(values);
        for (std::size_t i = 0; i < 3; ++i) over_w[i] = double{u[i] * corners.inverse_w[i]};
    };
    add(corners.r, r.data());
    add(corners.q, q.data());
    if (kernels.attributes(planes, lanes)) return false;
    for (int i = 0; i < lanes.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        out[i] = double{r[k] / q[k]};
    }
    return true;
}

}  // namespace

QuotientCorners quotient_corners(const Geometry& geometry, const TriangleRecord& triangle) noexcept {
    QuotientCorners c;
    for (std::size_t i = 0; i < 3; ++i) {
        const float* const rq = geometry.extras.of(triangle.vertex[i]);
        c.r[i] = rq[0];
        c.q[i] = rq[1];
        c.inverse_w[i] = geometry.corners[triangle.vertex[i]].inverse_w;
    }
    return c;
}

int interpolate(const std::array<float, 3>& u, const std::array<float, 3>& inverse_w, const TriangleLanes& lanes,
                const DepthHypothesis& hypothesis, float* out) noexcept {
    if (is_constant(u)) {
        std::fill_n(out, lanes.count, round_mantissa(u[0], hypothesis.interpolant_bits));
        return 0;
    }
    const int bits = hypothesis.interpolant_bits;
    int fallbacks = rounded_plane(over_w(u, inverse_w), lanes, bits, out);
    if (!has_w(inverse_w)) return fallbacks;
    Lanes<float> divisor;
    fallbacks += rounded_plane({{inverse_w[0], inverse_w[1], inverse_w[2]}}, lanes, bits, divisor.data());
    for (int i = 0; i < lanes.count; ++i)
        out[i] = divide(out[i], divisor[static_cast<std::size_t>(i)], hypothesis.divide);
    return fallbacks;
}

int quotient_depth(const QuotientCorners& corners, const TriangleLanes& lanes, const DepthHypothesis& hypothesis,
                   const LaneKernels& kernels, double* out) noexcept {
    const bool is_plain = hypothesis.interpolant_bits == 24 && hypothesis.divide == DivideRule::exact;
    if (is_plain && divided_by_kernel(corners, lanes, kernels, out)) return 0;
    // The hypothesis of binary64 interpolants: the filter's own value is the plane's value, so there are no exact
    // fallbacks.
    if (hypothesis.interpolant_bits == full_double) {
        Lanes<double> q;
        interpolate_double(corners.r, corners.inverse_w, lanes, out);
        interpolate_double(corners.q, corners.inverse_w, lanes, q.data());
        for (int i = 0; i < lanes.count; ++i) out[i] = out[i] / q[static_cast<std::size_t>(i)];
        return 0;
    }
    Lanes<float> r, q;
    const int fallbacks = interpolate(corners.r, corners.inverse_w, lanes, hypothesis, r.data()) +
                          interpolate(corners.q, corners.inverse_w, lanes, hypothesis, q.data());
    for (int i = 0; i < lanes.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        out[i] = double{divide(r[k], q[k], hypothesis.divide)};
    }
    return fallbacks;
}

void float32_plane_depth(const SetupTriangle& t, const RasterRules& rules, const TriangleLanes& lanes,
                         double* out) noexcept {
    const float pixel = 1.0f / static_cast<float>(1 << rules.subpixel_bits);
    const bool snapped = rules.plane_origin == PlaneOrigin::snapped;
    const auto x = [&](std::size_t i) { return snapped ? static_cast<float>(t.p[i].x) * pixel : t.unsnapped[i][0]; };
    const auto y = [&](std::size_t i) { return snapped ? static_cast<float>(t.p[i].y) * pixel : t.unsnapped[i][1]; };
    const auto z = [&](std::size_t i) { return static_cast<float>(t.z[i]); };
    float x0 = x(0), y0 = y(0), z0 = z(0);
    const float x1 = x(1) - x0, y1 = y(1) - y0, z1 = z(1) - z0;
    const float x2 = x(2) - x0, y2 = y(2) - y0, z2 = z(2) - z0;
    const float area = x1 * y2 - x2 * y1;
    const float dx = (z1 * y2 - z2 * y1) / area, dy = (z2 * x1 - z1 * x2) / area;
    if (rules.hypothesis.plane_anchor == PlaneAnchor::window_corner) {
        z0 = (z0 - dx * x0) - dy * y0;
        x0 = y0 = 0.0f;
    }
    for (int i = 0; i < lanes.count; ++i) {
        const float px = static_cast<float>(lanes.x[i]) + 0.5f, py = static_cast<float>(lanes.y[i]) + 0.5f;
        out[i] = double{(z0 + dx * (px - x0)) + dy * (py - y0)};
    }
}

void plane_depth(const SetupTriangle& t, const TriangleLanes& lanes, double* out) noexcept {
    const FilterPlane plane{RationalPlane{t.z}, lanes.reach};
    for (int i = 0; i < lanes.count; ++i) out[i] = plane.at(lanes.weight1[i], lanes.weight2[i]);
}

int rounded_plane_depth(const SetupTriangle& t, const TriangleLanes& lanes, double* out) noexcept {
    Lanes<float> z;
    const int fallbacks = round_plane(RationalPlane{t.z}, lanes, z.data());
    std::copy_n(z.begin(), lanes.count, out);
    return fallbacks;
}

void add_rq(TriangleSoup& soup, const RasterState& state, const RasterRules& rules) {
    const double n = state.depth_near, f = state.depth_far, units = z_units(state, rules);
    const bool symmetric = state.clip_depth == ClipDepth::minus_one_to_one;
    const auto scale = static_cast<float>((symmetric ? (f - n) * 0.5 : f - n) * units);
    const auto offset = static_cast<float>((symmetric ? (n + f) * 0.5 : n) * units);
    soup.extras = {.stride = 2, .has_rq = true, .values = {}};
    for (const ClipVertex& v : soup.vertices) {
        const float scaled = scale * v.z, moved = offset * v.w;
        soup.extras.values.push_back(scaled + moved);
        soup.extras.values.push_back(v.w);
    }
}

}  // namespace strata::rasterizer
