// tools/oracle/explain/fragment_facts.cpp - computes a fragment's mesh, barycentric coordinates, and depth by every
// path from its triangle (fragment_facts.h).
#include "tools/oracle/explain/fragment_facts.h"

#include <algorithm>

#include "peeling/frame/prepared_lists.h"
#include "peeling/raster_state.h"
#include "pipeline/device/check.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/walk/tile_rasterizer.h"

namespace strata::oracle {

namespace {

using peeling::ListOrder;
using rasterizer::DepthPath;
using rasterizer::Geometry;

pipeline::View first_view(const peeling::FrameRequest& input) {
    pipeline::View view = input.view;
    view.vertex_path = input.options.vertex_paths.first.value_or(view.vertex_path);
    return view;
}

// The same triangles with r and q, which two of the depth paths need.
peeling::PreparedLists prepared(const peeling::FrameRequest& input, pipeline::DepthFormat format) {
    rasterizer::RasterState raster = peeling::raster_state(input.options, input.profile);
    raster.depth_format = format;
    return peeling::PreparedLists{{.list = input.list,
                                   .view = first_view(input),
                                   .profile = input.profile,
                                   .options = input.options,
                                   .raster = raster,
                                   .depth = {DepthPath::exact, format, DepthPath::perspective_rq}}};
}

// window_z and w_buffer follow the rules of the NV2A chip; a logarithm needs a far plane.
bool has_path(const peeling::FrameRequest& input, DepthPath path, pipeline::DepthFormat format) {
    if (path == DepthPath::logarithmic)
        return pipeline::has_perspective(input.view) && pipeline::log_scale_of(input.view) != 0 &&
               input.options.raster.depth_order == rasterizer::DepthOrder::less;
    const bool has_chip_rule = input.profile.raster.window_z == rasterizer::WindowZ::buffer_units;
    if (path != DepthPath::window_z && path != DepthPath::w_buffer) return true;
    const bool has_w = path == DepthPath::window_z || pipeline::has_perspective(input.view);
    return has_chip_rule && has_w && format != pipeline::DepthFormat::d32f;
}

// Indices of the source triangles in submission order; empty vector: as listed. nullopt if the order is the algorithm's
// own.
std::optional<std::vector<std::uint32_t>> submission(const peeling::FrameRequest& input,
                                                     const peeling::Algorithm& algorithm,
                                                     pipeline::Selection selection) {
    const bool sorts = algorithm.order == ListOrder::given && input.options.sort.rule != peeling::SortRule::none;
    if (algorithm.order == ListOrder::given && !sorts) return std::vector<std::uint32_t>{};
    if (!sorts && algorithm.order != ListOrder::back_to_front) return std::nullopt;
    const auto soup = pipeline::transform(input.list, first_view(input), {.selection = selection});
    const rasterizer::RasterState& raster = input.options.raster;
    const bool is_reversed = raster.depth_order == rasterizer::DepthOrder::greater;
    return peeling::submission_order(
        soup, sorts ? input.options.sort : peeling::Sort{.rule = peeling::SortRule::reverse},
        is_reversed != (raster.depth_near > raster.depth_far) ? peeling::NearerZ::greater : peeling::NearerZ::less);
}

// The name is repeated in each fragment, so a name of a megabyte would be repeated, too.
constexpr std::size_t longest_name = 200;

// Finds a triangle's mesh by counting through the drawn instances.
void add_mesh(const peeling::FrameRequest& input, pipeline::Selection drawn, std::uint32_t source, FragmentFact& fact) {
    for (const pipeline::Instance& instance : input.list.instances) {
        const bool is_blended = input.list.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend;
        if (drawn != pipeline::Selection::all && is_blended != (drawn == pipeline::Selection::transparent)) continue;
        const pipeline::Mesh& mesh = input.list.meshes[instance.mesh];
        const auto triangles = static_cast<std::uint32_t>(mesh.indices.size() / 3);
        if (source < triangles) {
            fact.mesh = mesh.name.substr(0, longest_name);
            if (mesh.name.size() > longest_name) fact.mesh += "...";
            fact.triangle = static_cast<int>(source);
            fact.kind = mesh.primitive;
            return;
        }
        source -= triangles;
    }
}

// Twice the area of a, b, c in subpixels: coordinates have at most 28 bits, so nothing overflows.
std::int64_t doubled_area(const rasterizer::SubpixelPoint& a, const rasterizer::SubpixelPoint& b,
                          const rasterizer::SubpixelPoint& c) {
    return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) -
           (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

// The pieces of a clipped triangle have its index: the pixel's centre is in one of them.
void add_barycentric(const Geometry& geometry, const rasterizer::SubpixelPoint& centre, FragmentFact& fact) {
    const auto before = [](const rasterizer::TriangleRecord& t, std::uint32_t primitive) {
        return t.primitive < primitive;
    };
    auto triangle = std::lower_bound(geometry.triangles.begin(), geometry.triangles.end(), fact.primitive, before);
    for (; triangle != geometry.triangles.end() && triangle->primitive == fact.primitive; ++triangle) {
        const auto p = geometry.points(*triangle);
        const std::int64_t area = doubled_area(p[0], p[1], p[2]);
        std::array<double, 3> share{};
        bool is_inside = area != 0;
        for (std::size_t i = 0; i < 3 && area != 0; ++i) {
            const std::int64_t own = doubled_area(centre, p[(i + 1) % 3], p[(i + 2) % 3]);
            is_inside &= (own >= 0) == (area > 0) || own == 0;
            share[i] = static_cast<double>(own) / static_cast<double>(area);
        }
        if (is_inside) fact.barycentric = share;
    }
}

// Indices of source triangles in submission order; empty vector: as listed. nullopt: only the algorithm knows the
// order.
using Order = std::vector<std::uint32_t>;

// A list that was drawn, and its fragments.
struct DrawnList {
    const Geometry& geometry;
    std::vector<FragmentFact> History::*fragments;
    pipeline::Selection drawn;
    const std::optional<Order>& order;
};

FragmentFact* find(std::vector<FragmentFact>& fragments, std::uint32_t primitive) {
    const auto found = std::ranges::find(fragments, primitive, &FragmentFact::primitive);
    return found == fragments.end() ? nullptr : &*found;
}

void add_depths(const peeling::FrameRequest& input, const DrawnList& list, const rasterizer::Rect& window,
                std::span<History> histories) {
    const pipeline::DepthFormat format = histories[0].depth_format;
    for (std::size_t path = 0; path < depth_path_names.size(); ++path) {
        if (!has_path(input, static_cast<DepthPath>(path), format)) continue;
        auto take = [&](rasterizer::FragmentBatch& batch) {
            for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
                if (FragmentFact* fact = find(histories[batch.pixel[i]].*list.fragments, batch.primitive[i]))
                    fact->path_codes[path] = batch.code[i];
        };
        rasterizer::TileRasterizer walk{window};
        walk.draw(list.geometry, list.geometry.all_triangles, {static_cast<DepthPath>(path), format},
                  {.shader_z = false, .code = true, .color = false}, rasterizer::BatchSink{take});
    }
}

void add_facts_of(const peeling::FrameRequest& input, const DrawnList& list, const rasterizer::Rect& pixels,
                  std::span<History> histories) {
    const auto& [left, top] = input.options.window_origin;
    add_depths(input, list, {pixels.x0 + left, pixels.y0 + top, pixels.x1 + left, pixels.y1 + top}, histories);
    const int one = 1 << list.geometry.rules.subpixel_bits;
    for (History& history : histories) {
        const rasterizer::SubpixelPoint centre{(history.x + left) * one + one / 2, (history.y + top) * one + one / 2};
        for (FragmentFact& fact : history.*list.fragments) {
            if (list.order)
                add_mesh(input, list.drawn, list.order->empty() ? fact.primitive : (*list.order)[fact.primitive], fact);
            add_barycentric(list.geometry, centre, fact);
            if (fact.kind != rasterizer::Primitive::triangles)  // which have an area to divide by
                fact.path_codes[static_cast<std::size_t>(DepthPath::float32_plane)].reset();
        }
    }
}

}  // namespace

void add_facts(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm, const rasterizer::Rect& pixels,
               std::span<History> histories) {
    const FloatEnvironment ours;
    peeling::PreparedLists lists = prepared(input, histories[0].depth_format);
    const auto drawn = input.options.alpha ? pipeline::Selection::all : pipeline::Selection::transparent;
    const auto order = submission(input, algorithm, drawn);
    add_facts_of(input, {lists.transparent(algorithm.order).geometry, &History::fragments, drawn, order}, pixels,
                 histories);
    if (const pipeline::PreparedDraw* opaque = lists.opaque())
        add_facts_of(input, {opaque->geometry, &History::opaque, pipeline::Selection::opaque, Order{}}, pixels,
                     histories);
}

}  // namespace strata::oracle
