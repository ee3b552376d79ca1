// peeling/truth/real_geometry.cpp - transforms, clips and projects triangles in binary64 (real_geometry.h).
#include "peeling/truth/real_geometry.h"

#include <algorithm>
#include <cmath>

#include "pipeline/vertices/matrix.h"
#include "rasterizer/set_up/clip.h"
#include "rasterizer/set_up/window.h"

namespace strata::peeling {

using namespace pipeline;
using rasterizer::ClipVertex;
using rasterizer::RasterState;

namespace {

constexpr std::size_t colors = 4;

// x y z w, then front r g b a, back r g b a, s t: all values that clipping interpolates.
using RealVertex = std::array<double, 4 + 2 * colors + 2>;

[[nodiscard]] RealVertex real_vertex(const ClipVertex& v) {
    RealVertex real{v.x, v.y, v.z, v.w};
    std::copy(v.front.begin(), v.front.end(), real.begin() + 4);
    std::copy(v.back.begin(), v.back.end(), real.begin() + 4 + colors);
    std::copy(v.texcoord.begin(), v.texcoord.end(), real.begin() + 4 + 2 * colors);
    return real;
}

// The vertices of the instances follow each other in the soup.
void transform_in_binary64(const DrawList& list, const View& view, const rasterizer::TriangleSoup& soup,
                           std::vector<RealVertex>& vertices) {
    std::size_t next = 0;
    for (const rasterizer::TriangleRun& run : soup.runs) {
        const Instance& instance = list.instances[run.object];
        const Matrix m = product(product(view.projection, view.view), instance.model);
        const pipeline::Mesh& mesh = list.meshes[instance.mesh];
        for (std::size_t i = 0; i < mesh.positions.size(); ++i, ++next) {
            const Vec3& p = mesh.positions[i];
            const double w = mesh.w.empty() ? 1.0 : double{mesh.w[i]};
            for (std::size_t r = 0; r < 4; ++r)
                vertices[next][r] = ((m[0][r] * p[0] + m[1][r] * p[1]) + m[2][r] * p[2]) + m[3][r] * w;
        }
    }
}

// The signed distance of a clip plane.
using Distance = double (*)(const RealVertex&);

// Sutherland-Hodgman: an edge that crosses is clipped from its inside end.
void cut(Distance distance, std::vector<RealVertex>& polygon) {
    std::vector<RealVertex> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const RealVertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0) kept.push_back(a);
        if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
            const RealVertex &in = da > 0 ? a : b, &out = da > 0 ? b : a;
            const double t = std::max(da, db) / std::fabs(da - db);
            RealVertex corner{};
            for (std::size_t k = 0; k < corner.size(); ++k) corner[k] = in[k] + t * (out[k] - in[k]);
            kept.push_back(corner);
        }
    }
    polygon = std::move(kept);
}

void clip(const RasterState& state, std::vector<RealVertex>& polygon) {
    cut([](const RealVertex& v) { return v[3] - double{rasterizer::least_w}; }, polygon);
    if (state.clip_depth == rasterizer::ClipDepth::minus_one_to_one)
        cut([](const RealVertex& v) { return v[2] + v[3]; }, polygon);
    else
        cut([](const RealVertex& v) { return v[2]; }, polygon);
    cut([](const RealVertex& v) { return v[3] - v[2]; }, polygon);
}

enum class ShownSide : std::uint8_t { front, back };

[[nodiscard]] RealCorner project(const RealVertex& v, const RasterState& state, ShownSide facing) {
    const rasterizer::Rect& port = state.viewport;
    const double half_x = 0.5 * port.width(), half_y = 0.5 * port.height();
    const double up = state.y_direction == rasterizer::YDirection::up ? -1 : 1;
    const double n = state.depth_near, f = state.depth_far, z = v[2] / v[3];
    const bool symmetric = state.clip_depth == rasterizer::ClipDepth::minus_one_to_one;
    RealCorner corner{.x = half_x * (v[0] / v[3]) + (port.x0 + half_x),
                      .y = up * half_y * (v[1] / v[3]) + (port.y0 + half_y),
                      .z = symmetric ? (f - n) * 0.5 * z + (n + f) * 0.5 : (f - n) * z + n,
                      .inverse_w = 1 / v[3]};
    const std::size_t color = facing == ShownSide::front ? 4 : 4 + colors;
    for (std::size_t c = 0; c < colors; ++c) corner.value[c] = v[color + c];
    corner.value[colors] = v[4 + 2 * colors];
    corner.value[colors + 1] = v[4 + 2 * colors + 1];
    return corner;
}

// As setup.cpp decides it, from the sign of the snapped area.
[[nodiscard]] ShownSide facing_of(int winding, const RasterState& state, bool is_mirrored) {
    const bool clockwise = (winding > 0) == (state.y_direction == rasterizer::YDirection::up);
    const bool is_front = (clockwise == (state.front_face == rasterizer::FrontFace::clockwise)) != is_mirrored;
    return is_front ? ShownSide::front : ShownSide::back;
}

[[nodiscard]] bool is_culled(rasterizer::CullFace cull, ShownSide facing) {
    using enum rasterizer::CullFace;
    return cull == front_and_back || cull == (facing == ShownSide::front ? front : back);
}

void add_fan(const std::vector<RealVertex>& polygon, const rasterizer::TriangleRun& run, std::uint32_t primitive,
             const RasterState& state, std::vector<RealTriangle>& triangles) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        const auto made = [&](ShownSide facing) {
            return RealTriangle{{project(polygon[0], state, facing), project(polygon[i - 1], state, facing),
                                 project(polygon[i], state, facing)},
                                primitive,
                                run.material};
        };
        const RealTriangle triangle = made(ShownSide::front);
        const ShownSide facing = facing_of(triangle.winding(), state, run.mirrored);
        if (triangle.winding() == 0 || (!run.double_sided && is_culled(state.cull, facing))) continue;
        triangles.push_back(facing == ShownSide::front ? triangle : made(ShownSide::back));
    }
}

}  // namespace

std::vector<RealTriangle> real_triangles(const DrawList& list, const View& view, const RasterState& state,
                                         const PrepareOptions& options, RealPositions positions) {
    const rasterizer::TriangleSoup soup = transform(list, view, options);
    std::vector<RealVertex> vertices;
    for (const ClipVertex& v : soup.vertices) vertices.push_back(real_vertex(v));
    if (positions == RealPositions::binary64) transform_in_binary64(list, view, soup, vertices);
    std::vector<RealTriangle> triangles;
    std::uint32_t primitive = 0;
    for (const rasterizer::TriangleRun& run : soup.runs)
        for (std::uint32_t i = 0; i < run.index_count; i += 3, ++primitive) {
            const std::uint32_t* const index = &soup.indices[run.first_index + i];
            std::vector<RealVertex> polygon{vertices[index[0]], vertices[index[1]], vertices[index[2]]};
            const bool is_finite = std::ranges::all_of(polygon, [](const RealVertex& v) {
                return std::ranges::all_of(v, [](double d) { return std::isfinite(d); });
            });
            if (!is_finite) continue;
            clip(state, polygon);
            add_fan(polygon, run, primitive, state, triangles);
        }
    return triangles;
}

RealTriangle real_triangle(const rasterizer::Geometry& geometry, std::size_t triangle) {
    const rasterizer::SetupTriangle t = geometry.triangle(triangle);
    const double unit = 1 << geometry.rules.subpixel_bits, depth = z_units(geometry.state, geometry.rules);
    const bool is_snapped = geometry.rules.plane_origin == rasterizer::PlaneOrigin::snapped;
    std::array<RealCorner, 3> corner;
    for (std::size_t i = 0; i < 3; ++i) {
        corner[i] = {.x = is_snapped ? t.p[i].x / unit : double{t.unsnapped[i][0]},
                     .y = is_snapped ? t.p[i].y / unit : double{t.unsnapped[i][1]},
                     .z = t.z[i] / depth,
                     .inverse_w = t.inverse_w[i]};
        std::copy(t.attribute[i].begin(), t.attribute[i].end(), corner[i].value.begin());
    }
    return {corner, t.primitive, t.material};
}

}  // namespace strata::peeling
