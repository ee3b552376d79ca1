#include "tools/oracle/pack/draw_json.h"

#include <bit>

#include "peeling/frame/prepared_lists.h"
#include "peeling/raster_state.h"
#include "pipeline/vertices/prepare.h"
#include "rasterizer/base/float_environment.h"

namespace strata::oracle {

namespace {

using nlohmann::ordered_json;
using pipeline::Selection;
using rasterizer::Geometry;
using rasterizer::TriangleSoup;
using scenes::Element;
using scenes::NumberArray;

enum Flag : std::uint32_t { double_sided = 1, mirrored = 2, without_offset = 4 };

// A NumberArray with one row per item; fill(item, put) appends the row's values.
template <class Items, class Fill>
NumberArray rows(Element element, std::size_t columns, const Items& items, Fill fill) {
    NumberArray array{.element = element, .shape = {items.size()}};
    if (columns > 1) array.shape.push_back(columns);
    for (const auto& item : items) fill(item, [&](auto value) { array.append(std::bit_cast<std::uint32_t>(value)); });
    return array;
}

// PreparedLists as in Renderer, but without the light, which affects no position.
peeling::PreparedLists lists_of(const peeling::FrameRequest& input) {
    rasterizer::RasterState raster = peeling::raster_state(input.options, input.profile);
    // Of several samples the draws are those of the pixel's centre.
    if (input.options.sampling.samples > 1)
        raster.interpolation = rasterizer::Interpolation::sample, raster.sample_coverage = {};
    pipeline::View view = input.view;
    view.vertex_path = input.options.vertex_paths.first.value_or(view.vertex_path);
    const rasterizer::DepthRequest depth{input.options.depth_path.value_or(input.profile.raster.depth_path),
                                         raster.depth_format};
    return peeling::PreparedLists{{.list = input.list,
                                   .view = view,
                                   .profile = input.profile,
                                   .options = input.options,
                                   .raster = raster,
                                   .depth = depth}};
}

void add_vertices(const TriangleSoup& soup, const auto& add) {
    using rasterizer::ClipVertex;
    add("clip", rows(Element::f4, 4, soup.vertices, [](const ClipVertex& v, auto put) {
            for (const float value : {v.x, v.y, v.z, v.w}) put(value);
        }));
    add("front", rows(Element::f4, 4, soup.vertices, [](const ClipVertex& v, auto put) {
            for (const float value : v.front) put(value);
        }));
    add("back", rows(Element::f4, 4, soup.vertices, [](const ClipVertex& v, auto put) {
            for (const float value : v.back) put(value);
        }));
    add("texcoords", rows(Element::f4, 2, soup.vertices, [](const ClipVertex& v, auto put) {
            for (const float value : v.texcoord) put(value);
        }));
}

// Calls `add` for the triangles of all runs, concatenated.
void add_triangles(const TriangleSoup& soup, const auto& add) {
    NumberArray corners{.element = Element::u4, .shape = {0, 3}}, materials{.element = Element::u4, .shape = {0}},
        objects = materials, flags{.element = Element::u1, .shape = {0}};
    for (const rasterizer::TriangleRun& run : soup.runs) {
        for (std::uint32_t i = 0; i < run.index_count; ++i) corners.append(soup.indices[run.first_index + i]);
        for (std::uint32_t i = 0; i < run.index_count / 3; ++i) {
            materials.append(run.material);
            objects.append(run.object);
            flags.append((run.double_sided ? double_sided : 0u) | (run.mirrored ? mirrored : 0u) |
                         (run.without_offset ? without_offset : 0u));
        }
        corners.shape[0] += run.index_count / 3;
    }
    materials.shape[0] = objects.shape[0] = flags.shape[0] = corners.shape[0];
    add("triangles", corners);
    add("materials", materials);
    add("objects", objects);
    add("flags", flags);
}

void add_window(const Geometry& geometry, const std::vector<std::uint32_t>& order, const auto& add) {
    using rasterizer::TriangleRecord;
    using rasterizer::WindowCorner;
    add("corners", rows(Element::i4, 2, geometry.corners, [](const WindowCorner& c, auto put) {
            put(static_cast<std::int32_t>(c.p.x));
            put(static_cast<std::int32_t>(c.p.y));
        }));
    add("corner_depths", rows(Element::f4, 1, geometry.corners, [](const WindowCorner& c, auto put) { put(c.z); }));
    add("corner_inverse_w",
        rows(Element::f4, 1, geometry.corners, [](const WindowCorner& c, auto put) { put(c.inverse_w); }));
    add("window_triangles", rows(Element::u4, 3, geometry.triangles, [](const TriangleRecord& t, auto put) {
            for (const std::uint32_t corner : t.vertex) put(corner);
        }));
    add("window_sources", rows(Element::u4, 1, geometry.triangles, [&](const TriangleRecord& t, auto put) {
            put(order.empty() ? t.primitive : order[t.primitive]);
        }));
    add("window_facing", rows(Element::u1, 1, geometry.triangles,
                              [](const TriangleRecord& t, auto put) { put(t.front_facing ? 1u : 0u); }));
}

}  // namespace

ordered_json draws_json(const peeling::FrameRequest& input, scenes::PackFiles& files) {
    const FloatEnvironment ours;
    peeling::PreparedLists lists = lists_of(input);
    ordered_json draws = ordered_json::array();
    for (const bool is_opaque : {true, false}) {
        const pipeline::PreparedDraw* prepared =
            is_opaque ? lists.opaque() : &lists.transparent(peeling::ListOrder::given);
        if (prepared == nullptr) continue;
        const TriangleSoup soup = is_opaque ? lists.opaque_soup() : lists.transparent_soup();
        const std::string list = is_opaque ? "opaque" : "transparent";
        ordered_json draw{{"list", list}, {"subpixel_bits", prepared->geometry.rules.subpixel_bits}};
        const auto add = [&](const std::string& key, const NumberArray& array) {
            draw[key] = files.add("draw/" + list + "." + key + ".npy", array);
        };
        add_vertices(soup, add);
        add_triangles(soup, add);
        const std::vector<std::uint32_t> order =
            is_opaque ? std::vector<std::uint32_t>{} : lists.submission(peeling::ListOrder::given);
        add_window(prepared->geometry, order, add);
        draws.push_back(std::move(draw));
    }
    return draws;
}

std::vector<std::uint32_t> submission_of(const peeling::FrameRequest& input, peeling::ListOrder order) {
    const FloatEnvironment ours;
    return lists_of(input).submission(order);
}

}  // namespace strata::oracle
