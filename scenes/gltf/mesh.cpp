// scenes/gltf/mesh.cpp - corners in drawing order, the vertices that they use, and their attributes (mesh.h).
#include "scenes/gltf/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "rasterizer/rules/primitive.h"
#include "scenes/flat_normals.h"

namespace strata::scenes {
namespace {

using Indices = std::vector<std::uint32_t>;
using pipeline::Vec3;

// A position, a normal, a colour, a texture coordinate and an index, and indices while they are sorted.
constexpr std::uint64_t bytes_of_a_vertex = 64;

// The vertices in drawing order: the index accessor's elements, or 0, 1, 2 ... The budget is charged first: an accessor
// without a view may claim 2^31 elements in a file of 200 bytes.
Indices drawing_order(const PrimitiveSource& s, std::size_t vertex_count) {
    if (s.primitive.indices < 0) {
        s.budget.pay_elements(vertex_count, bytes_of_a_vertex, s.location);
        Indices order(vertex_count);
        std::iota(order.begin(), order.end(), 0u);
        return order;
    }
    const AccessorReader& reader = s.accessors[s.primitive.indices];
    s.budget.pay_elements(reader.count(), bytes_of_a_vertex, s.location);
    Indices order(reader.count());
    const FileLocation location{s.location.file, "/accessors/" + std::to_string(s.primitive.indices)};
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t index = order[i] = reader.index(i);
        if (index < vertex_count && index != reader.restart_index()) continue;
        const std::string found = std::to_string(index) + " at element " + std::to_string(i);
        if (index == reader.restart_index())
            location.fail("ACCESSOR_INDEX_PRIMITIVE_RESTART", "indices below the type's largest value", found);
        location.fail("ACCESSOR_INDEX_OOB", "indices below " + std::to_string(vertex_count), found);
    }
    return order;
}

// Three indices per line or point (rasterizer/rules/primitive.h).
Indices lines_and_points(const Indices& order, int mode, const PrimitiveSource& s) {
    Indices all;
    all.reserve(3 * order.size());
    if (mode == TINYGLTF_MODE_POINTS) {
        for (const std::uint32_t& vertex : order) rasterizer::append_primitive(all, {&vertex, 1});
        return all;
    }
    const bool is_list = mode == TINYGLTF_MODE_LINE;
    if (order.size() < 2 || (is_list && order.size() % 2 != 0))
        s.warnings.add(s.location.pointer, "vertices that make no whole line are ignored");
    for (std::size_t i = 0; i + 1 < order.size(); i += is_list ? 2 : 1)
        rasterizer::append_primitive(all, {&order[i], 2});
    if (mode == TINYGLTF_MODE_LINE_LOOP && order.size() > 1)
        rasterizer::append_primitive(all, std::array{order.back(), order.front()});
    return all;
}

pipeline::Primitive primitive_of(int mode) {
    if (mode == TINYGLTF_MODE_POINTS) return pipeline::Primitive::points;
    if (mode == TINYGLTF_MODE_LINE) return pipeline::Primitive::lines;
    return mode < TINYGLTF_MODE_TRIANGLES ? pipeline::Primitive::line_strips : pipeline::Primitive::triangles;
}

// Three corners per triangle. Remaining vertices are ignored, as glTF requires.
Indices corners(const Indices& order, int mode, const PrimitiveSource& s) {
    if (primitive_of(mode) != pipeline::Primitive::triangles) return lines_and_points(order, mode, s);
    const std::size_t n = order.size();
    const bool is_list = mode == TINYGLTF_MODE_TRIANGLES;
    if (n < 3 || (is_list && n % 3 != 0))
        s.warnings.add(s.location.pointer, "vertices that make no whole triangle are ignored");
    if (is_list) return {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(n - n % 3)};
    Indices all;
    if (n < 3) return all;
    all.reserve(3 * (n - 2));
    for (std::size_t i = 0; i + 2 < n; ++i) {
        // Every second triangle of a strip has two corners exchanged, so that all have the same winding.
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            all.insert(all.end(), {order[i + 1], order[i + 2], order[0]});
        else
            all.insert(all.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    }
    return all;
}

// The vertices to read, and the corners as indices into them.
struct UsedVertices {
    Indices vertices, indices;
};

// Vertices that triangles use, in the file's order and each once; the corners become indices into that list.
UsedVertices select_used(Indices corners) {
    Indices used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (std::uint32_t& corner : corners)
        corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
    return {std::move(used), std::move(corners)};
}

// Every corner becomes its own vertex, so that each triangle can have its flat normal.
UsedVertices select_unshared(Indices corners) {
    Indices indices(corners.size());
    std::iota(indices.begin(), indices.end(), 0u);
    return {std::move(corners), std::move(indices)};
}

// Calls take(vertex) for each selected vertex of the attribute and rejects values that are not finite.
template <class Take>
void read_finite(const PrimitiveSource& s, const std::string& name, const Indices& vertices, Take&& take) {
    const int accessor = s.primitive.attributes.at(name);
    const MorphedAttribute reader{s.json, name, s.pose.weights, s.accessors, s.budget};
    for (const std::uint32_t vertex : vertices) {
        const std::array<float, 4> value = reader.element(vertex);
        if (!std::all_of(value.begin(), value.end(), [](float f) { return std::isfinite(f); }))
            FileLocation{s.location.file, "/accessors/" + std::to_string(accessor)}.fail(
                "ACCESSOR_INVALID_FLOAT", "finite numbers for " + name,
                "NaN or infinity at element " + std::to_string(vertex));
        take(value, reader.components());
    }
}

std::vector<pipeline::Rgba> read_colors(const PrimitiveSource& s, const Indices& vertices) {
    std::vector<pipeline::Rgba> colors;
    colors.reserve(vertices.size());
    bool is_clamped = false;
    read_finite(s, "COLOR_0", vertices, [&](std::array<float, 4> value, std::size_t components) {
        // A colour without alpha has alpha 1, glTF 2.0, 3.7.2.1; for an opaque material stored alpha is ignored.
        s.ignores_alpha |= components == 4 && s.material.is_opaque && value[3] < 1;
        if (components == 3 || s.material.is_opaque) value[3] = 1;
        is_clamped |= std::any_of(value.begin(), value.end(), [](float f) { return f < 0 || f > 1; });
        colors.push_back(frame_color({value[0], value[1], value[2], value[3]}, s.color_space));
    });
    if (is_clamped) s.warnings.add(s.location.pointer, "vertex colours outside 0 to 1 are clamped");
    return colors;
}

std::vector<pipeline::Vec2> read_texcoords(const PrimitiveSource& s, const Indices& vertices) {
    std::vector<pipeline::Vec2> texcoords;
    texcoords.reserve(vertices.size());
    read_finite(s, "TEXCOORD_" + std::to_string(*s.material.texcoord_set), vertices,
                [&](const std::array<float, 4>& value, std::size_t) {
                    const pipeline::Vec2 written{value[0], value[1]};
                    const pipeline::Vec2 uv = s.material.transform ? s.material.transform->apply(written) : written;
                    if (!std::isfinite(uv[0]) || !std::isfinite(uv[1]))
                        s.location.fail("VALUE_NOT_IN_RANGE", "transformed texture coordinates in range of binary32",
                                        "some beyond it");
                    texcoords.push_back(uv);
                });
    return texcoords;
}

// Moves the vertices to where the joints put them.
void skin(pipeline::Mesh& mesh, const PrimitiveSource& s, const Indices& vertices) {
    s.budget.pay_elements(vertices.size(), sizeof(pipeline::Matrix), s.location);
    const auto matrices = skin_matrices(s.json, s.joints, vertices, s.accessors, s.warnings);
    std::transform(matrices.begin(), matrices.end(), mesh.positions.begin(), mesh.positions.begin(), skinned_position);
    if (!mesh.normals.empty())
        std::transform(matrices.begin(), matrices.end(), mesh.normals.begin(), mesh.normals.begin(), skinned_normal);
}

}  // namespace

std::optional<pipeline::Mesh> load_primitive(const PrimitiveSource& s) {
    const int mode = s.primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : s.primitive.mode;
    const auto& attributes = s.primitive.attributes;
    if (!attributes.contains("POSITION")) return std::nullopt;  // check.h has warned
    const AccessorReader& positions = s.accessors[attributes.at("POSITION")];
    Indices all = corners(drawing_order(s, positions.count()), mode, s);
    if (all.empty()) return std::nullopt;
    if (s.pose.is_mirrored && !s.joints.empty() && primitive_of(mode) == pipeline::Primitive::triangles)
        for (std::size_t i = 0; i < all.size(); i += 3) std::swap(all[i + 1], all[i + 2]);

    // glTF 2.0, 3.7.2.1: without normals a lit surface is flat, and lines and points are unlit. An unlit mesh needs
    // none and keeps its shared vertices.
    const bool has_normals = attributes.contains("NORMAL");
    const bool is_flat = !s.material.is_unlit && !has_normals && primitive_of(mode) == pipeline::Primitive::triangles;
    UsedVertices selection = is_flat ? select_unshared(std::move(all)) : select_used(std::move(all));
    pipeline::Mesh mesh;
    mesh.primitive = primitive_of(mode);
    mesh.indices = std::move(selection.indices);
    mesh.positions.reserve(selection.vertices.size());
    const MorphedAttribute position{s.json, "POSITION", s.pose.weights, s.accessors, s.budget};
    for (const std::uint32_t vertex : selection.vertices) {
        const std::array<float, 4> p = position.element(vertex);
        mesh.positions.push_back({p[0], p[1], p[2]});
    }
    if (!is_flat && !s.material.is_unlit && has_normals)
        read_finite(s, "NORMAL", selection.vertices, [&](const std::array<float, 4>& n, std::size_t) {
            mesh.normals.push_back({n[0], n[1], n[2]});
        });
    if (!s.joints.empty()) skin(mesh, s, selection.vertices);
    if (is_flat) mesh.normals = flat_normals(mesh.positions);
    if (attributes.contains("COLOR_0")) mesh.colors = read_colors(s, selection.vertices);
    if (s.material.texcoord_set) mesh.texcoords = read_texcoords(s, selection.vertices);
    return mesh;
}

}  // namespace strata::scenes
