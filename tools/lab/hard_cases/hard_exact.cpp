// tools/lab/hard_cases/hard_exact.cpp - projects a hard case's triangles in binary64 and sorts their depths at each
// pixel; marks pixels that a small error may change (hard_exact.h).
#include "tools/lab/hard_cases/hard_exact.h"

#include <algorithm>
#include <cmath>

#include "pipeline/vertices/matrix.h"

namespace strata::tools {

using peeling::RealCorner;
using peeling::RealTriangle;
using peeling::RealWeights;

namespace {

constexpr double depth_noise = 0x1p-48, pixel_noise = 0x1p-40;

// The largest change of the determinant of (a, b, p) if its corners move by up to `da` and `db`.
double edge_slack(const RealCorner& a, const RealCorner& b, const std::array<double, 3>& da,
                  const std::array<double, 3>& db, double x, double y) {
    return da[0] * std::fabs(b.y - y) + da[1] * std::fabs(b.x - x) + db[0] * std::fabs(a.y - y) +
           db[1] * std::fabs(a.x - x) + da[0] * db[1] + da[1] * db[0];
}

double edge(const RealCorner& a, const RealCorner& b, double x, double y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

}  // namespace

// A surface's bounding box, and the possible error of each corner.
struct ExactCase::Reach {
    rasterizer::Rect box;
    std::array<Point, 3> off{};
};

ExactCase::ExactCase(const scenes::HardCase& hard, const scenes::Scene& scene, const pipeline::View& view)
    : hard_{hard}, matrix_{pipeline::product(view.projection, view.view)} {
    add(scene.list.meshes[0], transparent_);
    add(scene.list.meshes[1], opaque_);
}

ExactCase::Point ExactCase::project(const Vec3d& p) const {
    std::array<double, 4> v{};
    for (int r = 0; r < 4; ++r)
        v[static_cast<std::size_t>(r)] =
            ((matrix_[0][r] * p[0] + matrix_[1][r] * p[1]) + matrix_[2][r] * p[2]) + matrix_[3][r];
    const double near = hard_.depth_near, far = hard_.depth_far;
    return {(v[0] / v[3] + 1) * hard_.width / 2, (1 - v[1] / v[3]) * hard_.height / 2,
            near + (v[2] / v[3] + 1) / 2 * (far - near)};
}

void ExactCase::add(const pipeline::Mesh& mesh, std::vector<Surface>& surfaces) const {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        std::array<Vec3, 3> given;
        std::array<RealCorner, 3> corner;
        for (std::size_t k = 0; k < 3; ++k) {
            given[k] = mesh.positions[mesh.indices[i + k]];
            const auto [x, y, z] = project({given[k].x, given[k].y, given[k].z});
            corner[k] = {.x = x, .y = y, .z = z};
        }
        surfaces.push_back(
            {given, RealTriangle{corner, static_cast<std::uint32_t>(i / 3), 0}, mesh.colors[mesh.indices[i]]});
    }
}

double ExactCase::depth_at(std::uint32_t primitive, std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(hard_.width);
    const RealTriangle& triangle = transparent_[primitive].triangle;
    return triangle.depth(triangle.weights(static_cast<int>(pixel % width), static_cast<int>(pixel / width)));
}

namespace {

// A pixel's transparent fragment with the data for blending.
struct BlendedFragment {
    double depth;
    std::uint32_t primitive;
    Rgba color;
};

// Depths that are equal in binary64 get the same layer number.
ResultPixel pixel_of(std::vector<BlendedFragment> layers, std::array<double, 3> background) {
    std::stable_sort(layers.begin(), layers.end(),
                     [](const BlendedFragment& a, const BlendedFragment& b) { return a.depth < b.depth; });
    ResultPixel pixel{.fragments = {}, .layers = static_cast<int>(layers.size()), .color = background};
    int layer = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (i > 0 && layers[i].depth - layers[i - 1].depth > depth_noise) ++layer;
        pixel.fragments.push_back({layers[i].primitive, layer, layers[i].depth});
    }
    for (std::size_t i = layers.size(); i-- > 0;)
        for (std::size_t c = 0; c < 3; ++c) {
            const double alpha = layers[i].color[3], value = layers[i].color[static_cast<int>(c)];
            pixel.color[c] = alpha * value + (1 - alpha) * pixel.color[c];
        }
    std::sort(pixel.fragments.begin(), pixel.fragments.end());
    return pixel;
}

}  // namespace

ResultPixels ExactCase::visible_pixels() const {
    const rasterizer::Rect frame{0, 0, hard_.width, hard_.height};
    std::vector<std::vector<BlendedFragment>> layers(frame.area());
    std::vector<BlendedFragment> nearest(frame.area(), {std::max(hard_.depth_near, hard_.depth_far), 0, {0, 0, 0, 1}});
    const auto visit = [&](const Surface& surface, const auto& take) {
        const rasterizer::Rect box = surface.triangle.box(frame);
        for (int y = box.y0; y < box.y1; ++y)
            for (int x = box.x0; x < box.x1; ++x) {
                const RealWeights weights = surface.triangle.weights(x, y);
                const double z = weights.is_inside ? surface.triangle.depth(weights) : -1;
                if (!weights.is_inside || z < hard_.depth_near || z > hard_.depth_far) continue;
                const auto pixel =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(hard_.width) + static_cast<std::size_t>(x);
                take(pixel, BlendedFragment{z, surface.triangle.primitive(), surface.color});
            }
    };
    for (const Surface& surface : opaque_)
        visit(surface, [&](std::size_t p, const BlendedFragment& layer) {
            if (layer.depth < nearest[p].depth) nearest[p] = layer;
        });
    for (const Surface& surface : transparent_)
        visit(surface, [&](std::size_t p, const BlendedFragment& layer) {
            if (layer.depth < nearest[p].depth) layers[p].push_back(layer);
        });
    ResultPixels visible_pixels;
    for (std::size_t p = 0; p < layers.size(); ++p) {
        const Rgba& behind = nearest[p].color;
        visible_pixels.push_back(pixel_of(std::move(layers[p]), {behind[0], behind[1], behind[2]}));
    }
    return visible_pixels;
}

// The extreme window positions of a corner in front of the eye are at the ends of its coordinates' ranges, because x /
// w, y / w and z / w are monotone in each coordinate.
ExactCase::Reach ExactCase::reach_of(const Surface& surface, const Slack& slack) const {
    Reach reach;
    double most = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const RealCorner& corner = surface.triangle.corners()[k];
        const Vec3& p = surface.given[k];
        for (int signs = 0; signs < 8; ++signs) {
            const auto moved = [&](int axis, double v) {
                return v + ((signs >> axis & 1) != 0 ? 1 : -1) * slack.relative * std::fabs(v);
            };
            const Point at = project({moved(0, p.x), moved(1, p.y), moved(2, p.z)});
            reach.off[k][0] = std::max(reach.off[k][0], std::fabs(at[0] - corner.x));
            reach.off[k][1] = std::max(reach.off[k][1], std::fabs(at[1] - corner.y));
            reach.off[k][2] = std::max(reach.off[k][2], std::fabs(at[2] - corner.z));
        }
        for (const std::size_t axis : {0U, 1U}) reach.off[k][axis] += slack.pixels + pixel_noise;
        most = std::max({most, 1 + reach.off[k][0], 1 + reach.off[k][1]});
    }
    const int spare = static_cast<int>(std::ceil(std::min(most, 1e5)));
    const rasterizer::Rect frame{0, 0, hard_.width, hard_.height}, box = surface.triangle.box(frame);
    reach.box = {std::max(box.x0 - spare, 0), std::max(box.y0 - spare, 0), std::min(box.x1 + spare, frame.x1),
                 std::min(box.y1 + spare, frame.y1)};
    return reach;
}

// Marks the pixels that the surface may gain or lose; where it may be, `depths` receives its depth and the bound on its
// error.
void ExactCase::mark_open(const Surface& surface, const Slack& slack,
                          std::vector<std::vector<std::array<double, 2>>>& depths, std::vector<bool>& open) const {
    const Reach reach = reach_of(surface, slack);
    const auto& corner = surface.triangle.corners();
    const double area = edge(corner[0], corner[1], corner[2].x, corner[2].y);
    const double area_slack = edge_slack(corner[0], corner[1], reach.off[0], reach.off[1], corner[2].x, corner[2].y) +
                              reach.off[2][0] * std::fabs(corner[1].y - corner[0].y) +
                              reach.off[2][1] * std::fabs(corner[1].x - corner[0].x);
    const bool has_side = std::fabs(area) > area_slack;
    const double slope_x = ((corner[1].z - corner[0].z) * (corner[2].y - corner[0].y) -
                            (corner[2].z - corner[0].z) * (corner[1].y - corner[0].y)) /
                           area,
                 slope_y = ((corner[2].z - corner[0].z) * (corner[1].x - corner[0].x) -
                            (corner[1].z - corner[0].z) * (corner[2].x - corner[0].x)) /
                           area;
    for (int y = reach.box.y0; y < reach.box.y1; ++y)
        for (int x = reach.box.x0; x < reach.box.x1; ++x) {
            const double px = x + 0.5, py = y + 0.5;
            bool is_outside = false, is_certain = has_side;
            double off = slack.depth + depth_noise;
            for (std::size_t i = 0; i < 3; ++i) {
                const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
                const double value = edge(corner[a], corner[b], px, py) * (area < 0 ? -1 : 1);
                const double spare = edge_slack(corner[a], corner[b], reach.off[a], reach.off[b], px, py);
                is_outside = is_outside || (has_side && value < -spare);
                is_certain = is_certain && value > spare;
                off += 1.25 * std::fabs(value / area) *
                       (std::fabs(slope_x) * reach.off[i][0] + std::fabs(slope_y) * reach.off[i][1] + reach.off[i][2]);
            }
            if (is_outside) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(hard_.width) + static_cast<std::size_t>(x);
            const double z = surface.triangle.depth(surface.triangle.weights(x, y));
            // Outside the range in any case; the depth of a triangle without area is unknown.
            if (has_side && (z < hard_.depth_near - off || z > hard_.depth_far + off)) continue;
            if (!is_certain || z < hard_.depth_near + off || z > hard_.depth_far - off) open[pixel] = true;
            depths[pixel].push_back({z, off});
        }
}

std::vector<bool> ExactCase::open_pixels(const Slack& slack) const {
    const std::size_t pixels = static_cast<std::size_t>(hard_.width) * static_cast<std::size_t>(hard_.height);
    std::vector<bool> open(pixels);
    std::vector<std::vector<std::array<double, 2>>> front(pixels), behind(pixels);
    for (const Surface& surface : opaque_) mark_open(surface, slack, behind, open);
    for (const Surface& surface : transparent_) mark_open(surface, slack, front, open);
    for (std::size_t p = 0; p < pixels; ++p) {
        const auto is_close = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
            return std::fabs(a[0] - b[0]) <= a[1] + b[1];
        };
        for (std::size_t i = 0; i < front[p].size() && !open[p]; ++i) {
            for (std::size_t k = i + 1; k < front[p].size(); ++k)
                if (is_close(front[p][i], front[p][k])) open[p] = true;
            for (const auto& opaque : behind[p])
                if (is_close(front[p][i], opaque)) open[p] = true;
        }
    }
    return open;
}

}  // namespace strata::tools
