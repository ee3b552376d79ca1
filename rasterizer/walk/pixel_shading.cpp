// rasterizer/walk/pixel_shading.cpp - evaluates fragments at a point of their pixel other than the sample: the triangle
// is moved so that its sample lies there (pixel_shading.h).
#include "rasterizer/walk/pixel_shading.h"

#include <algorithm>
#include <cassert>

#include "rasterizer/values/fragment_values.h"

namespace strata::rasterizer {

namespace {

// The distance of a point from the pixel's centre in subpixels.
[[nodiscard]] SubpixelPoint offset_of(SamplePoint point, int subpixel_bits) noexcept {
    const int sixteenth = 1 << (subpixel_bits - 4);
    return {(point.x - 8) * sixteenth, (point.y - 8) * sixteenth};
}

[[nodiscard]] SubpixelPoint less(SubpixelPoint a, SubpixelPoint b) noexcept { return {a.x - b.x, a.y - b.y}; }

// The change of an edge's value where its corners move so far; a triangle's edges at another point of the pixel.
[[nodiscard]] std::int64_t change(const Edge& edge, SubpixelPoint moved) noexcept {
    return -(edge.step_x() * moved.x + edge.step_y() * moved.y);
}

// What a move of the corners adds to the reach of a triangle's own fragments at most.
[[nodiscard]] double added_reach(const TriangleEdges& edges, SubpixelPoint moved) noexcept {
    const std::int64_t e1 = change(edges.edge(1), moved), e2 = change(edges.edge(2), moved);
    return static_cast<double>((e1 < 0 ? -e1 : e1) + (e2 < 0 ? -e2 : e2)) / static_cast<double>(edges.area()) *
           (1.0 + 0x1p-40);
}

}  // namespace

// A point of the pixel, a geometry of the triangle that is filled, moved to that point, and its values.
struct PixelShading::Point {
    Geometry one;
    FragmentValues values;
    SubpixelPoint moved;  // from the corners of the sample to those of the point
};

struct PixelShading::Few {  // the fragments of one point
    FragmentBatch batch;
    WeightLanes weights{};
};

PixelShading::~PixelShading() = default;

PixelShading::PixelShading(Interpolation at, const Geometry& geometry, const DepthRequest& depth,
                           const FragmentNeeds& needs)
    : geometry_{geometry}, at_{at}, needs_{needs} {
    assert(geometry.state.sample && depth.path != DepthPath::depth_replace);
    FragmentNeeds at_point = needs;  // the codes are the sample's
    at_point.code = at_point.exact_code = false;
    points_.push_back(point_at({}, depth, at_point));
    if (at == Interpolation::centre) return;
    at_point.shader_z = at_point.reference = false;
    for (std::size_t s = 0; s < static_cast<std::size_t>(geometry.state.sample_count); ++s)
        points_.push_back(point_at(geometry.state.samples[s], depth, at_point));
    least_.resize(points_.size() - 1);
    few_ = std::make_unique<Few>();
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
PixelShading::Point PixelShading::point_at(SamplePoint point, const DepthRequest& depth,
                                           const FragmentNeeds& needs) const {
    Geometry one;
    one.state = geometry_.state;
    one.state.sample = point;
    one.state.interpolation = Interpolation::sample;
    one.rules = geometry_.rules;
    one.rules.z_clip = ZClip::per_primitive;
    one.extras.stride = geometry_.extras.stride;
    one.extras.has_rq = geometry_.extras.has_rq;
    one.extras.has_fog = geometry_.extras.has_fog;
    one.extras.has_secondary = geometry_.extras.has_secondary;
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
    FragmentValues values{one, depth, needs};
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
    // The depth is that of the centre everywhere.
    const int fallbacks = fill_at(points_[0], index, first, batch, weights);
    if (at_ == Interpolation::centre) return fallbacks;
    return fallbacks + fill_at_centroids(index, first, batch);
}

// A reference is computed with a code of its own; the stored one is the sample's, and stays.
int PixelShading::fill_at(Point& point, std::uint32_t index, int first, FragmentBatch& batch, WeightLanes& weights) {
    take(index, point);
    DrawnTriangle triangle{point.one, 0};
    triangle.weights.reach += added_reach(triangle.edges(), point.moved);
    if (!needs_.reference) return point.values.fill(triangle, first, batch, weights);
    Lanes<std::uint32_t> code;
    const auto f = static_cast<std::size_t>(first), count = static_cast<std::size_t>(batch.count - first);
    std::copy_n(&batch.code[f], count, code.begin());
    const int fallbacks = point.values.fill(triangle, first, batch, weights);
    std::copy_n(code.begin(), count, &batch.code[f]);
    return fallbacks;
}

// For each sample of the pixel, the least values of the edges at the triangle's own sample where it is covered.
void PixelShading::find_least(std::uint32_t index) {
    const TriangleRecord& record = geometry_.triangles[index];
    edges_.emplace(geometry_.points(record), geometry_.rules.tie_rule, record.negative_w());
    for (std::size_t s = 0; s < least_.size(); ++s)
        for (std::size_t i = 0; i < 3; ++i)
            least_[s][i] = edges_->tie(i) - change(edges_->edge(i), points_[1 + s].moved);
}

std::size_t PixelShading::centroid_of(SubpixelPoint pixel) const noexcept {
    const EdgeValues e{edges_->edge(0).at(pixel), edges_->edge(1).at(pixel), edges_->edge(2).at(pixel)};
    const auto covers = [&](const EdgeValues& least) {
        return e[0] >= least[0] && e[1] >= least[1] && e[2] >= least[2];
    };
    const auto first = std::find_if(least_.begin(), least_.end(), covers);
    return std::all_of(first, least_.end(), covers) && first == least_.begin()
               ? 0
               : 1 + static_cast<std::size_t>(first - least_.begin());
}

void PixelShading::copy_attributes(const FragmentBatch& from, std::size_t i, FragmentBatch& to,
                                   std::size_t k) const noexcept {
    for (std::size_t c = 0; needs_.color && c < to.color.size(); ++c) to.color[c][k] = from.color[c][i];
    for (std::size_t c = 0; needs_.texcoord && c < to.texcoord.size(); ++c) to.texcoord[c][k] = from.texcoord[c][i];
    for (std::size_t u = 0; needs_.units != 0 && u < to.unit.size(); ++u)
        for (std::size_t c = 0; c < 4; ++c)
            if (names(needs_.units, u, c)) to.unit[u][c][k] = from.unit[u][c][i];
    if (needs_.fog) to.fog[k] = from.fog[i];
    for (std::size_t c = 0; needs_.secondary && c < to.secondary.size(); ++c) to.secondary[c][k] = from.secondary[c][i];
}

int PixelShading::fill_at_centroids(std::uint32_t index, int first, FragmentBatch& batch) {
    find_least(index);
    Lanes<std::uint8_t> at;
    unsigned needed = 0;  // bit p: a fragment has its centroid at point p
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(batch.count); ++i) {
        at[i] =
            static_cast<std::uint8_t>(centroid_of(pixel_centre(batch.x[i], batch.y[i], geometry_.rules.subpixel_bits)));
        needed |= 1u << at[i];
    }
    int fallbacks = 0;
    for (std::size_t p = 1; p < points_.size(); ++p) {
        if ((needed >> p & 1u) == 0) continue;
        Lanes<std::uint16_t> lane;
        FragmentBatch& few = few_->batch;
        few.count = 0;
        few.material = batch.material;
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(batch.count); ++i) {
            if (at[i] != p) continue;
            const auto k = static_cast<std::size_t>(few.count++);
            lane[k] = static_cast<std::uint16_t>(i);
            few.pixel[k] = batch.pixel[i], few.primitive[k] = batch.primitive[i];
            few.x[k] = batch.x[i], few.y[k] = batch.y[i];
        }
        fallbacks += fill_at(points_[p], index, 0, few, few_->weights);
        for (std::size_t k = 0; k < static_cast<std::size_t>(few.count); ++k) copy_attributes(few, k, batch, lane[k]);
    }
    return fallbacks;
}

}  // namespace strata::rasterizer
