// pipeline/vertices/prepare.cpp - transforms, lights, sets up and bins a draw list (prepare.h).
#include "pipeline/vertices/prepare.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pipeline/device/sample_points.h"
#include "pipeline/vertices/check_list.h"
#include "pipeline/vertices/matrix.h"
#include "pipeline/vertices/quotient_rows.h"
#include "pipeline/vertices/vertex_stage.h"
#include "rasterizer/base/float_environment.h"
#include "rasterizer/base/input_error.h"
#include "rasterizer/base/numerics.h"
#include "rasterizer/base/parallel.h"
#include "rasterizer/set_up/check_input.h"
#include "rasterizer/set_up/depth_bound.h"
#include "rasterizer/set_up/window.h"
#include "rasterizer/values/depth/program_depth.h"

namespace strata::pipeline {

namespace {

bool is_selected(const Material& material, Selection selection) {
    if (selection == Selection::all) return true;
    return (material.alpha_mode == AlphaMode::blend) == (selection == Selection::transparent);
}

// The vertices of a soup before they have values: the mesh of each part, and its transform.
class SoupVertices {
  public:
    void add(const VertexStage& stage, std::size_t count) {
        parts_.push_back({count_, stage});
        count_ += count;
    }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }
    // Writes the vertices from index `begin` on.
    void write(std::size_t begin, std::span<rasterizer::ClipVertex> out) const {
        auto part = std::ranges::upper_bound(parts_, begin, {}, &Part::begin) - 1;
        for (std::size_t done = 0; done < out.size(); ++part) {
            const std::size_t at = begin + done;
            const std::size_t end = part + 1 == parts_.end() ? count_ : (part + 1)->begin;
            const std::size_t count = std::min(end - at, out.size() - done);
            part->stage.run(at - part->begin, out.subspan(done, count));
            done += count;
        }
    }

  private:
    struct Part {
        std::size_t begin;
        VertexStage stage;
    };
    std::vector<Part> parts_;
    std::size_t count_ = 0;
};

constexpr std::size_t chunk = 1024;  // vertices or indices written per task

// Whether a soup copies its meshes' indices or borrows them.
enum class Indices : std::uint8_t { copied, lent };

[[nodiscard]] bool takes_offset(const DrawList& list, const Instance& instance, std::span<const std::string> only) {
    return only.empty() ||
           std::ranges::any_of(only, [&](const std::string& name) { return has_name(list, instance, name); });
}

// Appends an instance's vertices, its indices from soup.indices[first_index] on if they are copied, and its run.
void append(const DrawList& list, const Instance& instance, const View& view, const PrepareOptions& options,
            const std::shared_ptr<const FrameLights>& lights, Indices indices, SoupVertices& vertices,
            std::size_t first_index, rasterizer::TriangleSoup& soup) {
    const Mesh& mesh = list.meshes[instance.mesh];
    const Material& material = list.materials[instance.material];
    const auto base = static_cast<std::uint32_t>(vertices.count());
    const float alpha_scale = material.alpha_mode == AlphaMode::mask ? 1.0f : options.alpha_scale;
    vertices.add({mesh, material, view, instance.model, alpha_scale, lights}, mesh.positions.size());
    const std::size_t copied = indices == Indices::copied ? mesh.indices.size() : 0;
    parallel_for((copied + chunk - 1) / chunk, options.threads, [&](std::size_t c) {
        const std::size_t begin = c * chunk, end = std::min(copied, begin + chunk);
        for (std::size_t i = begin; i < end; ++i) soup.indices[first_index + i] = base + mesh.indices[i];
    });
    // An empty mesh has no indices to borrow.
    soup.runs.push_back({.first_index = static_cast<std::uint32_t>(copied > 0 ? first_index : 0),
                         .index_count = static_cast<std::uint32_t>(mesh.indices.size()),
                         .material = instance.material,
                         .object = static_cast<std::uint32_t>(&instance - list.instances.data()),
                         .double_sided = material.double_sided,
                         .mirrored = linear_determinant(instance.model) < 0,
                         .lent = indices == Indices::lent ? mesh.indices.data() : nullptr,
                         .first_vertex = base,
                         .primitive = mesh.primitive,
                         .without_offset = !takes_offset(list, instance, options.offset_only)});
}

// The soup of the selected instances, whose vertices have no values yet.
rasterizer::TriangleSoup lay_out(const DrawList& list, const View& view, const PrepareOptions& options, Indices indices,
                                 SoupVertices& vertices) {
    rasterizer::TriangleSoup soup;
    const auto for_each_selected = [&](auto visit) {
        for (const Instance& instance : list.instances)
            if (is_selected(list.materials[instance.material], options.selection)) visit(instance);
    };
    std::size_t count = 0;
    for_each_selected([&](const Instance& i) { count += list.meshes[i.mesh].indices.size(); });
    if (indices == Indices::copied) soup.indices.resize(count);
    std::size_t at = 0;
    const std::shared_ptr<const FrameLights> lights = frame_lights(options.lighting, view);
    for_each_selected([&](const Instance& instance) {
        append(list, instance, view, options, lights, indices, vertices, at, soup);
        at += list.meshes[instance.mesh].indices.size();
    });
    soup.vertices.resize(vertices.count());
    return soup;
}

void write_all(const SoupVertices& vertices, int threads, rasterizer::TriangleSoup& soup) {
    parallel_for((vertices.count() + chunk - 1) / chunk, threads, [&](std::size_t c) {
        const std::size_t count = std::min(chunk, vertices.count() - c * chunk);
        vertices.write(c * chunk, std::span{soup.vertices}.subspan(c * chunk, count));
    });
}

[[nodiscard]] bool has_secondary(const PrepareOptions& options) noexcept {
    return options.lighting != nullptr && !options.lighting->lights.empty() &&
           options.lighting->model.separates_specular;
}

// The secondary colours of both faces, each with alpha 0.
void add_secondary_colors(const VertexStage& stage, std::size_t vertex, std::vector<float>& values) {
    const LitVertex lit = stage.lit(vertex);
    for (const LitFace& face : {lit.front, lit.back}) {
        values.insert(values.end(), face.secondary.begin(), face.secondary.end());
        values.push_back(0.0f);
    }
}

// The vertex values that the options request in addition to position and colour, in this order: r and q, fog,
// secondary colours, then texture units.
rasterizer::VertexExtras vertex_extras(const DrawList& list, const View& view, const rasterizer::RasterState& state,
                                       const rasterizer::RasterRules& rules, FogRule fog,
                                       const PrepareOptions& options) {
    rasterizer::VertexExtras extras;
    extras.has_rq = options.depth_quotient;
    extras.has_fog = options.fog.has_value();
    extras.has_secondary = has_secondary(options);
    extras.has_units = std::ranges::any_of(options.units, &CoordinateUnit::enabled);
    extras.stride = (extras.has_rq ? 2u : 0u) + (extras.has_fog ? 1u : 0u) +
                    (extras.has_secondary ? 2u * rasterizer::color_channels : 0u) +
                    (extras.has_units ? 4 * rasterizer::texture_units : 0u);
    const std::shared_ptr<const FrameLights> lights =
        extras.has_secondary ? frame_lights(options.lighting, view) : nullptr;
    for (const Instance& instance : list.instances) {
        if (extras.stride == 0 || !is_selected(list.materials[instance.material], options.selection)) continue;
        const Mesh& mesh = list.meshes[instance.mesh];
        const Matrix to_eye = product(view.view, instance.model);
        const VertexTransform eye{view.vertex_path, to_eye, identity, to_eye};
        const VertexTransform rows = quotient_rows(view, instance.model, state, rules);
        const VertexStage stage{mesh, list.materials[instance.material], view, instance.model, 1.0f, lights};
        const VertexCoordinates coordinates{options.units, view, instance.model};
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const std::array<float, 4> rq =
                mesh.w.empty() ? rows(mesh.positions[i]) : rows(mesh.positions[i], mesh.w[i]);
            if (extras.has_rq) extras.values.insert(extras.values.end(), {rq[2], rq[3]});
            if (extras.has_fog) {
                const std::array<float, 4> e =
                    mesh.w.empty() ? eye(mesh.positions[i]) : eye(mesh.positions[i], mesh.w[i]);
                extras.values.push_back(vertex_fog(*options.fog, fog, std::fabs(e[2])));
            }
            if (extras.has_secondary) add_secondary_colors(stage, i, extras.values);
            if (!extras.has_units) continue;
            for (const auto& unit :
                 coordinates.at(mesh.positions[i], mesh.texcoords.empty() ? Vec2{} : mesh.texcoords[i]))
                extras.values.insert(extras.values.end(), unit.begin(), unit.end());
        }
    }
    return extras;
}

// Bounds of the depths of all fragments of a part (vertices.md 6). With depth clamp a fragment may have any depth of
// the range, and depth_bound has no bound for keys.
DrawPart part_of(const rasterizer::Geometry& geometry, const PrimitiveRange& primitives) {
    DrawPart part{primitives, 1, 0};
    const bool is_reversed = geometry.state.depth_order == rasterizer::DepthOrder::greater;
    if (geometry.state.depth_clamp || is_reversed) return {primitives, 0, 1};
    const double units = z_units(geometry.state, geometry.rules);
    const auto before = [](const rasterizer::TriangleRecord& t, std::uint32_t primitive) {
        return t.primitive < primitive;
    };
    const auto begin = geometry.triangles.begin(), end = geometry.triangles.end();
    const auto first = std::lower_bound(begin, end, primitives.first, before);
    const auto last = std::lower_bound(first, end, primitives.last, before);
    for (auto t = first; t != last; ++t) {
        const auto i = static_cast<std::size_t>(t - begin);
        const auto z = geometry.depths(i);
        const auto [least, most] = std::minmax({z[0] / units, z[1] / units, z[2] / units});
        const double bound = depth_bound(geometry, std::span{geometry.all_triangles}.subspan(i, 1));
        // A fragment may be outside the range of its corners on the near side by as much as the bound allows on the
        // far side.
        part.near = std::min(part.near, least - (bound - most));
        part.far = std::max(part.far, bound);
    }
    return part;
}

// MASK scales its alpha after the test, so that --alpha cannot change which fragments it keeps.
MaterialStage material_stage(const DrawList& list, const Material& material, float alpha_scale) {
    MaterialStage stage;
    if (material.texture >= 0) stage.texture = &list.textures[static_cast<std::size_t>(material.texture)];
    if (material.alpha_mode != AlphaMode::mask) return stage;
    stage.mask = {.enabled = true, .func = CompareFunc::gequal, .ref = material.alpha_cutoff};
    stage.alpha_scale = alpha_scale;
    return stage;
}

// w at the far plane of a projection, where z = w. 0 or infinite if there is no such w.
double far_w(const Matrix& p) {
    const double z = (p[3][3] - p[3][2]) / (p[2][2] - p[2][3]);
    return p[2][3] * z + p[3][3];
}

// Units of a w buffer per unit of clip w (rasterizer/reference/depth.md 4.8): the driver scales the far plane's w to
// depth 1.
float w_scale_of(const View& view, const rasterizer::RasterState& state) {
    if (state.w_scale != 0.0f) return state.w_scale;
    const double far = far_w(view.projection);
    const auto scale = static_cast<float>(rasterizer::buffer_units(state.depth_format) / far);
    return far > 0.0 && std::isfinite(scale) && scale > 0.0f ? scale : 1.0f;
}

}  // namespace

float log_scale_of(const View& view) noexcept { return rasterizer::log_scale_of(far_w(view.projection)); }

bool has_perspective(const View& view) noexcept { return view.projection[2][3] != 0; }

rasterizer::TriangleSoup transform(const DrawList& list, const View& view, const PrepareOptions& options) {
    check(list);
    check(view);
    SoupVertices vertices;
    rasterizer::TriangleSoup soup = lay_out(list, view, options, Indices::copied, vertices);
    write_all(vertices, options.threads, soup);
    return soup;
}

PreparedDraw prepare(const DrawList& list, const View& view, const rasterizer::RasterState& state,
                     const DeviceProfile& profile, const PrepareOptions& options) {
    const FloatEnvironment ours;
    check(profile);
    // Before the transform, because the quotient rows depend on the state.
    check(state);
    if (state.sample && profile.raster.coverage == rasterizer::CoverageRule::float_spans)
        throw InputError("raster state", "sample", "none with raster.coverage float_spans", "one");
    if (!options.is_checked) check(list);
    check(view);
    PreparedDraw prepared;
    prepared.other_samples.resize(static_cast<std::size_t>(options.samples) - 1);
    SoupVertices vertices;
    // Vertices that are not read earlier are written during set-up; the soup then needs no copy of the indices.
    const bool alters = options.alteration != nullptr && options.alteration->vertices;
    const bool is_written = alters || options.order || options.samples > 1;
    rasterizer::TriangleSoup soup =
        lay_out(list, view, options, is_written ? Indices::copied : Indices::lent, vertices);
    if (is_written) write_all(vertices, options.threads, soup);
    if (alters) options.alteration->vertices(soup);
    SubmissionOrder order;
    if (options.order) order = options.order(soup);
    soup.order = std::move(order.triangles);
    rasterizer::RasterRules rules = profile.raster;
    if (view.vertex_path == VertexPath::nv20) rules.w_divide = rasterizer::WDivide::nv20;
    soup.extras = vertex_extras(list, view, state, rules, profile.fog, options);
    rasterizer::RasterState scaled = state;
    scaled.w_scale = w_scale_of(view, state);
    if (state.log_scale == 0.0f) scaled.log_scale = log_scale_of(view);
    rasterizer::VertexSource source;
    if (!is_written) source = [&](std::size_t begin, auto out) { vertices.write(begin, out); };
    for (std::size_t sample = prepared.samples(); sample-- > 0;) {
        if (options.samples > 1) set_sample(scaled, profile.sample_positions, options.samples, sample);
        rasterizer::Geometry& geometry = prepared.of_sample(sample);
        geometry = rasterizer::set_up(sample == 0 ? std::move(soup) : soup, scaled, rules, options.threads, source);
        if (options.alteration != nullptr && options.alteration->corners) options.alteration->corners(geometry);
    }
    if (options.tile_size != 0) bin_triangles(prepared, options.tile_size, options.threads);
    for (const PrimitiveRange& primitives : order.parts) {
        DrawPart& part = prepared.parts.emplace_back(part_of(prepared.geometry, primitives));
        for (const rasterizer::Geometry& other : prepared.other_samples) {
            const DrawPart own = part_of(other, primitives);
            part.near = std::min(part.near, own.near);
            part.far = std::max(part.far, own.far);
        }
    }
    if (options.receives_shadow) prepared.needs.shadow = shadow_coordinates;
    prepared.needs.fog = options.fog.has_value();
    prepared.needs.secondary = has_secondary(options);
    for (const Material& material : list.materials) {
        prepared.materials.push_back(material_stage(list, material, options.alpha_scale));
        if (!is_selected(material, options.selection)) continue;
        prepared.needs.texcoord |= material.texture >= 0;
        prepared.needs.color |= material.alpha_mode == AlphaMode::mask;
    }
    return prepared;
}

std::size_t PreparedDraw::triangles_in(std::size_t tile) const noexcept {
    std::size_t triangles = geometry.bin(tile).size();
    for (const rasterizer::Geometry& other : other_samples) triangles += other.bin(tile).size();
    return triangles;
}

void bin_triangles(PreparedDraw& list, int tile_size, int threads) {
    for (std::size_t sample = 0; sample < list.samples(); ++sample)
        rasterizer::bin_triangles(list.of_sample(sample), tile_size, threads);
}

// Stops as soon as all needs of the list are found.
MaterialNeeds needs_of(const PreparedDraw& list, std::span<const std::uint32_t> triangles, std::size_t sample) {
    MaterialNeeds needs{.shadow = list.needs.shadow, .fog = list.needs.fog, .secondary = list.needs.secondary};
    for (std::size_t i = 0; i < triangles.size() && needs != list.needs; ++i) {
        const MaterialStage& material = list.materials[list.of_sample(sample).triangles[triangles[i]].material];
        needs.texcoord |= material.texture != nullptr;
        needs.color |= material.mask.enabled;
    }
    return needs;
}

}  // namespace strata::pipeline
