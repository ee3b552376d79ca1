#include "rasterizer/walk/pixel_shading.h"

#include <algorithm>
#include <cassert>

namespace strata::rasterizer {

namespace {

// The distance of a point from the pixel's centre in subpixels.
[[nodiscard]] SubpixelPoint offset_of(SamplePoint point, int subpixel_bits) noexcept {
    const int sixteenth = 1 << (subpixel_bits - 4);
    return {(point.x - 8) * sixteenth, (point.y - 8) * sixteenth};
}

[[nodiscard]] SubpixelPoint less(SubpixelPoint a, SubpixelPoint b) noexcept { return {a.x - b.x, a.y - b.y}; }

[[nodiscard]] bool covers(const TriangleEdges& edges, SubpixelPoint centre) noexcept {
    for (std::size_t i = 0; i < 3; ++i)
        if (edges.edge(i).at(centre) < edges.tie(i)) return false;
    return true;
}

// Bounds |b1| + |b2| at the fragments, from above.
[[nodiscard]] double reach_of(const TriangleEdges& edges, int subpixel_bits, int first,
                              const FragmentBatch& batch) noexcept {
    std::int64_t most = edges.area();
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(batch.count); ++i) {
        const EdgeValues e = edges.at(pixel_centre(batch.x[i], batch.y[i], subpixel_bits));
        most = std::max(most, (e[1] < 0 ? -e[1] : e[1]) + (e[2] < 0 ? -e[2] : e[2]));
    }
    return static_cast<double>(most) / static_cast<double>(edges.area()) * (1.0 + 0x1p-40);
}

}  // namespace

PixelShading::PixelShading(const Geometry& geometry, const DepthRequest& depth, const FragmentNeeds& needs)
    : geometry_{geometry}, needs_{needs} {
    assert(geometry.state.sample && depth.path != DepthPath::depth_replace);
    points_.push_back(point_at({}, depth));
    if (geometry.state.interpolation == Interpolation::centre) return;
    for (std::size_t s = 0; s < static_cast<std::size_t>(geometry.state.sample_count); ++s)
        points_.push_back(point_at(geometry.state.samples[s], depth));
}

FragmentNeeds PixelShading::of_sample(const FragmentNeeds& needs) noexcept {
    return {.shader_z = false,
            .code = needs.code || needs.reference,
            .exact_code = needs.exact_code,
            .color = false,
            .texcoord = false,
            .facing = false};
}

// Fragments outside the depth range are dropped by the sample's own depth, before.
PixelShading::Point PixelShading::point_at(SamplePoint point, const DepthRequest& depth) const {
    Geometry one;
    one.state = geometry_.state;
    one.state.sample = point;
    one.state.interpolation = Interpolation::sample;
    one.rules = geometry_.rules;
    one.rules.z_clip = ZClip::per_primitive;
    one.extras.stride = geometry_.extras.stride;
    one.extras.has_rq = geometry_.extras.has_rq;
    one.extras.has_units = geometry_.extras.has_units;
    one.triangles.resize(1);
    one.offset_z.resize(geometry_.offset_z.empty() ? 0 : 1);
    one.given.resize(geometry_.given.empty() ? 0 : 1);
    const std::size_t vertices = geometry_.given.empty() ? 3 : 6;
    one.vertices.resize(vertices);
    one.corners.resize(vertices);
    one.extras.values.resize(vertices * one.extras.stride);
    const int bits = geometry_.rules.subpixel_bits;
    const SubpixelPoint moved = less(offset_of(*geometry_.state.sample, bits), offset_of(point, bits));
    FragmentValues values{one, depth, needs_};
    return {std::move(one), values, moved};
}

void PixelShading::take(std::uint32_t index, Point& point) const {
    Geometry& one = point.one;
    const auto copy = [&](std::uint32_t from, std::size_t to) {
        one.vertices[to] = geometry_.vertices[from];
        one.corners[to] = geometry_.corners[from];
        one.corners[to].p.x += point.moved.x;
        one.corners[to].p.y += point.moved.y;
        std::copy_n(geometry_.extras.values.begin() + static_cast<std::ptrdiff_t>(from * one.extras.stride),
                    one.extras.stride, one.extras.values.begin() + static_cast<std::ptrdiff_t>(to * one.extras.stride));
    };
    one.triangles[0] = geometry_.triangles[index];
    one.triangles[0].vertex = {0, 1, 2};
    for (std::size_t k = 0; k < 3; ++k) copy(geometry_.triangles[index].vertex[k], k);
    if (!one.offset_z.empty()) one.offset_z[0] = geometry_.offset_z[index];
    if (one.given.empty()) return;
    one.given[0] = {3, 4, 5};
    for (std::size_t k = 0; k < 3; ++k) copy(geometry_.given[index][k], 3 + k);
}

int PixelShading::fill(std::uint32_t index, int first, FragmentBatch& batch, WeightLanes& weights) {
    if (geometry_.state.interpolation == Interpolation::centroid)
        return fill_at_centroids(index, first, batch, weights);
    take(index, points_[0]);
    return fill_at(points_[0], first, batch, weights);
}

// The codes are the sample's, and stay.
int PixelShading::fill_at(Point& point, int first, FragmentBatch& batch, WeightLanes& weights) {
    DrawnTriangle triangle{point.one, 0};
    triangle.weights.reach = reach_of(triangle.edges(), point.one.rules.subpixel_bits, first, batch);
    const auto f = static_cast<std::size_t>(first);
    const auto count = static_cast<std::size_t>(batch.count - first);
    Lanes<std::uint32_t> code, exact_code;
    const FragmentNeeds own = of_sample(needs_);
    if (own.code) std::copy_n(&batch.code[f], count, code.begin());
    if (own.exact_code) std::copy_n(&batch.exact_code[f], count, exact_code.begin());
    const int fallbacks = point.values.fill(triangle, first, batch, weights);
    if (own.code) std::copy_n(code.begin(), count, &batch.code[f]);
    if (own.exact_code) std::copy_n(exact_code.begin(), count, &batch.exact_code[f]);
    return fallbacks;
}

std::size_t PixelShading::centroid_of(const FragmentBatch& batch, std::size_t i) const noexcept {
    const SubpixelPoint centre = pixel_centre(batch.x[i], batch.y[i], geometry_.rules.subpixel_bits);
    std::size_t covered = 0, first = edges_.size();
    for (std::size_t s = edges_.size(); s-- > 0;)
        if (covers(edges_[s], centre)) ++covered, first = s;
    return covered == edges_.size() ? 0 : 1 + first;
}

void PixelShading::copy_attributes(const FragmentBatch& from, std::size_t i, FragmentBatch& to,
                                   std::size_t k) const noexcept {
    for (std::size_t c = 0; needs_.color && c < to.color.size(); ++c) to.color[c][k] = from.color[c][i];
    for (std::size_t c = 0; needs_.texcoord && c < to.texcoord.size(); ++c) to.texcoord[c][k] = from.texcoord[c][i];
    for (std::size_t u = 0; needs_.units != 0 && u < to.unit.size(); ++u)
        for (std::size_t c = 0; c < 4; ++c)
            if (names(needs_.units, u, c)) to.unit[u][c][k] = from.unit[u][c][i];
}

int PixelShading::fill_at_centroids(std::uint32_t index, int first, FragmentBatch& batch, WeightLanes& weights) {
    edges_.clear();
    for (Point& point : points_) take(index, point);
    const std::uint8_t negative = points_[0].one.triangles[0].negative_w;
    for (std::size_t s = 1; s < points_.size(); ++s)
        edges_.emplace_back(points_[s].one.points(points_[s].one.triangles[0]), geometry_.rules.tie_rule, negative);
    Lanes<std::uint8_t> at;
    bool is_inside = true;
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(batch.count); ++i) {
        at[i] = static_cast<std::uint8_t>(centroid_of(batch, i));
        is_inside &= at[i] == 0;
    }
    // The depth is that of the centre everywhere.
    int fallbacks = fill_at(points_[0], first, batch, weights);
    for (std::size_t p = 1; !is_inside && p < points_.size(); ++p) {
        Lanes<std::uint16_t> lane;
        few_.count = 0;
        few_.material = batch.material;
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(batch.count); ++i) {
            if (at[i] != p) continue;
            const auto k = static_cast<std::size_t>(few_.count++);
            lane[k] = static_cast<std::uint16_t>(i);
            few_.pixel[k] = batch.pixel[i], few_.primitive[k] = batch.primitive[i];
            few_.x[k] = batch.x[i], few_.y[k] = batch.y[i];
        }
        if (few_.count == 0) continue;
        fallbacks += fill_at(points_[p], 0, few_, few_weights_);
        for (std::size_t k = 0; k < static_cast<std::size_t>(few_.count); ++k) copy_attributes(few_, k, batch, lane[k]);
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
