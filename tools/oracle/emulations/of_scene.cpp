// tools/oracle/emulations/of_scene.cpp - mistakes in the input of the pipeline: materials, textures, colours, order.
#include <algorithm>
#include <memory>
#include <span>

#include "peeling/frame/prepared_lists.h"
#include "pipeline/vertices/prepare.h"
#include "scenes/numbers/srgb_encode.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

using pipeline::AlphaMode;
using pipeline::DrawList;
using pipeline::Material;
using pipeline::Mesh;
using pipeline::Rgba;
using pipeline::Texture;

// Calls change(x) for all of `values`; true if one of them has changed.
template <class T, class Change>
bool changes(std::vector<T>& values, Change change) {
    bool has_changed = false;
    for (T& value : values) {
        const T before = value;
        change(value);
        has_changed |= !(value == before);
    }
    return has_changed;
}

bool is_textured(const AlteredRun& e) { return !e.list->textures.empty(); }

// Where the vertex of index i stands first in its primitive: the equal indices of a line and of a point remain equal.
std::uint32_t first_in_primitive(std::span<const std::uint32_t> indices, std::size_t i) {
    std::size_t first = i - i % 3;
    while (indices[first] != indices[i]) ++first;
    return static_cast<std::uint32_t>(first);
}

// True if a strip's lines count on, from one to the next by the vertex that they share: without it the stipple is lost.
bool counts_on(const AlteredRun& e) {
    return e.options.raster.line_stipple && std::ranges::any_of(e.list->meshes, [](const Mesh& mesh) {
               return mesh.primitive == pipeline::Primitive::line_strips;
           });
}

// Gives every primitive vertices of its own, with the colour and the normal of its last one.
void flatten(Mesh& mesh) {
    const Mesh from = mesh;
    mesh.positions.clear();
    mesh.w.clear();
    mesh.normals.clear();
    mesh.colors.clear();
    mesh.texcoords.clear();
    for (std::size_t i = 0; i < from.indices.size(); ++i) {
        const std::size_t vertex = from.indices[i], last = from.indices[i - i % 3 + 2];
        mesh.positions.push_back(from.positions[vertex]);
        if (!from.w.empty()) mesh.w.push_back(from.w[vertex]);
        if (!from.normals.empty()) mesh.normals.push_back(from.normals[last]);
        if (!from.colors.empty()) mesh.colors.push_back(from.colors[last]);
        if (!from.texcoords.empty()) mesh.texcoords.push_back(from.texcoords[vertex]);
        mesh.indices[i] = first_in_primitive(from.indices, i);
    }
}

// True if a depth is a quotient of attributes: then not only colours depend on w.
bool has_quotient_depth(const AlteredRun& e) {
    const auto own = e.options.depth_path.value_or(e.profile.raster.depth_path);
    const auto& compared = e.options.reference_path ? e.options.reference_path : e.algorithm->compares;
    return peeling::takes_quotient({.path = e.algorithm->stores.value_or(own), .reference = compared});
}

// Attributes are interpolated linearly over the window; positions and depths do not change by a bit. Clipping is linear
// in clip space, and values times w are linear there if the values are linear over the window. Vertices not made by
// clipping keep their values exactly.
void make_affine(AlteredRun& e) {
    using rasterizer::ClipVertex;
    const auto times = [](ClipVertex& v, float factor) {
        for (float& c : v.front) c *= factor;
        for (float& c : v.back) c *= factor;
        for (float& c : v.texcoord) c *= factor;
    };
    const auto given = std::make_shared<std::vector<ClipVertex>>();
    e.alter_vertices({.vertices =
                          [times, given](rasterizer::TriangleSoup& soup) {
                              given->assign(soup.vertices.begin(), soup.vertices.end());
                              for (ClipVertex& v : soup.vertices) times(v, v.w);
                          },
                      .corners =
                          [times, given](rasterizer::Geometry& geometry) {
                              for (std::size_t i = 0; i < geometry.vertices.size(); ++i) {
                                  ClipVertex& v = geometry.vertices[i];
                                  if (i >= given->size()) {
                                      times(v, 1.0f / v.w);
                                      continue;
                                  }
                                  v.front = (*given)[i].front;
                                  v.back = (*given)[i].back;
                                  v.texcoord = (*given)[i].texcoord;
                              }
                              for (rasterizer::WindowCorner& corner : geometry.corners) corner.inverse_w = 1.0f;
                          }});
}

// True if any triangle has more than one colour: without slopes interpolation cannot be wrong.
bool has_slopes(const AlteredRun& e) {
    if (is_textured(e)) return true;
    const rasterizer::TriangleSoup soup = pipeline::transform(*e.list, e.view, {});
    for (std::size_t i = 0; i + 2 < soup.indices.size(); i += 3) {
        const auto& last = soup.vertices[soup.indices[i + 2]];
        for (std::size_t j = i; j < i + 2; ++j) {
            const auto& vertex = soup.vertices[soup.indices[j]];
            if (vertex.front != last.front || vertex.back != last.back) return true;
        }
    }
    return false;
}

enum class Weighting : std::uint8_t { affine, unnormalised };

// The light at a vertex times its colour, which is what the material was multiplied by. Where the material's colour is
// 0 it cannot be recovered.
Rgba without_material(const rasterizer::ClipVertex& v, const Material& material) {
    Rgba color{0, 0, 0, 0};
    for (std::size_t c = 0; c < 4; ++c)
        if (material.front[c] != 0)
            color[c] = v.front[c] / material.front[c];
        else if (material.back[c] != 0)
            color[c] = v.back[c] / material.back[c];
    return color;
}

// The scene after its vertex stage, with all positions divided by w: all interpolation is then linear over the window.
// Scenes with a corner at or behind the eye have no such form.
bool loses_perspective(AlteredRun& e, Weighting weighting) {
    const rasterizer::TriangleSoup soup = pipeline::transform(*e.list, e.view, {});
    const auto& vertices = soup.vertices;
    const bool has_perspective = std::ranges::any_of(vertices, [&](const auto& v) { return v.w != vertices[0].w; });
    if (!has_perspective || std::ranges::any_of(vertices, [](const auto& v) { return !(v.w > 0); })) return false;
    const DrawList& given = *e.list;
    DrawList flat;
    flat.light = given.light;
    flat.materials = given.materials;
    flat.textures = given.textures;
    for (Material& material : flat.materials) material.unlit = true;
    for (const rasterizer::TriangleRun& run : soup.runs) {
        Mesh mesh;
        mesh.name = given.meshes[given.instances[run.object].mesh].name;
        mesh.primitive = run.primitive;
        const std::span<const std::uint32_t> indices{soup.indices.data() + run.first_index, run.index_count};
        for (std::size_t i = 0; i < run.index_count; ++i) {
            const rasterizer::ClipVertex& v = vertices[indices[i]];
            Rgba color = without_material(v, flat.materials[run.material]);
            if (weighting == Weighting::unnormalised)
                for (std::size_t c = 0; c < 4; ++c) color[c] = std::min(color[c] / v.w, 1.0f);
            mesh.positions.push_back({v.x / v.w, v.y / v.w, v.z / v.w});
            mesh.colors.push_back(color);
            mesh.texcoords.push_back({v.texcoord[0], v.texcoord[1]});
            // A mirrored instance needs the opposite winding to keep its facing.
            const bool is_turned = run.mirrored && run.primitive == pipeline::Primitive::triangles && i % 3 != 0;
            mesh.indices.push_back(first_in_primitive(indices, is_turned ? i - i % 3 + (3 - i % 3) : i));
        }
        flat.instances.push_back({.mesh = static_cast<std::uint32_t>(flat.meshes.size()),
                                  .material = run.material,
                                  .arrives_sorted = given.instances[run.object].arrives_sorted});
        flat.meshes.push_back(std::move(mesh));
    }
    e.scene() = std::move(flat);
    e.view.view = e.view.projection = pipeline::identity;
    return true;
}

const Mistake scene_mistakes[] = {
    {"colors_affine", "colours interpolated linearly over the window, without perspective", ChangedPart::scene,
     [](AlteredRun& e) {
         if (!has_slopes(e)) return false;
         if (has_quotient_depth(e)) return loses_perspective(e, Weighting::affine);
         const bool has_w = std::ranges::any_of(e.list->meshes, [](const auto& mesh) { return !mesh.w.empty(); });
         if (!has_w && !pipeline::has_perspective(e.view)) return false;
         make_affine(e);
         return true;
     }},
    {"colors_unnormalised", "colours over w interpolated and not divided by 1 / w again", ChangedPart::scene,
     [](AlteredRun& e) { return has_slopes(e) && loses_perspective(e, Weighting::unnormalised); }},
    {"colors_flat", "flat colours: each triangle has that of its last corner", ChangedPart::scene,
     [](AlteredRun& e) {
         if (counts_on(e)) return false;
         std::ranges::for_each(e.scene().meshes, flatten);
         // A constant divided by w and then by 1 / w is rounded twice, a flat colour is not.
         if (!is_textured(e) && !has_quotient_depth(e)) make_affine(e);
         return true;
     }},
    {"colors_decoded", "colours blended as linear values, decoded from sRGB, and never encoded again",
     ChangedPart::scene,
     [](AlteredRun& e) {
         const auto decode = [](Rgba& color) {
             for (std::size_t c = 0; c < 3; ++c) color[c] = scenes::decode_srgb(color[c]);
         };
         for (Material& material : e.scene().materials) {
             decode(material.front);
             decode(material.back);
         }
         for (Mesh& mesh : e.scene().meshes) std::ranges::for_each(mesh.colors, decode);
         return true;
     }},
    {"light_lost", "lighting left out", ChangedPart::scene,
     [](AlteredRun& e) { return changes(e.scene().materials, [](Material& m) { m.unlit = true; }); }},
    {"alpha_of_material_lost", "the material's alpha lost: only the vertices' own counts", ChangedPart::scene,
     [](AlteredRun& e) { return changes(e.scene().materials, [](Material& m) { m.front[3] = m.back[3] = 1; }); }},
    {"alpha_of_vertices_lost", "the vertices' own alpha lost: only the material's counts", ChangedPart::scene,
     [](AlteredRun& e) {
         return changes(e.scene().meshes, [](Mesh& mesh) {
             for (Rgba& color : mesh.colors) color[3] = 1;
         });
     }},
    {"one_sided_colors", "back faces in the colour of front faces", ChangedPart::scene,
     [](AlteredRun& e) { return changes(e.scene().materials, [](Material& m) { m.back = m.front; }); }},
    {"culls_nothing", "nothing culled", ChangedPart::scene,
     [](AlteredRun& e) { return changes(e.scene().materials, [](Material& m) { m.double_sided = true; }); }},
    {"culls_all_backs", "back faces culled of two-sided surfaces, too", ChangedPart::scene,
     [](AlteredRun& e) { return changes(e.scene().materials, [](Material& m) { m.double_sided = false; }); }},
    {"mask_ignored", "the alpha test of masked materials left out", ChangedPart::scene,
     [](AlteredRun& e) {
         return changes(e.scene().materials, [](Material& m) {
             if (m.alpha_mode == AlphaMode::mask) m.alpha_cutoff = 0;
         });
     }},
    {"texture_lost", "textures left out", ChangedPart::scene,
     [](AlteredRun& e) { return changes(e.scene().materials, [](Material& m) { m.texture = -1; }); }},
    {"texture_upside_down", "textures upside down: their first row taken for the lowest", ChangedPart::scene,
     [](AlteredRun& e) {
         return is_textured(e) && changes(e.scene().textures, [](Texture& t) {
                    const auto row = static_cast<std::ptrdiff_t>(t.width) * 4;
                    for (int y = 0; y < t.height / 2; ++y)
                        std::swap_ranges(t.texels.begin() + y * row, t.texels.begin() + (y + 1) * row,
                                         t.texels.begin() + (t.height - 1 - y) * row);
                });
     }},
    {"texture_filtered_otherwise", "the nearest texel instead of four weighted ones, or the other way round",
     ChangedPart::scene,
     [](AlteredRun& e) {
         using pipeline::TextureFilter;
         return is_textured(e) && changes(e.scene().textures, [](Texture& t) {
                    t.filter = t.filter == TextureFilter::linear ? TextureFilter::nearest : TextureFilter::linear;
                });
     }},
    {"texture_clamped", "textures clamped to their edge instead of repeated", ChangedPart::scene,
     [](AlteredRun& e) {
         return is_textured(e) && changes(e.scene().textures, [](Texture& t) {
                    t.wrap_s = t.wrap_t = pipeline::TextureWrap::clamp_to_edge;
                });
     }},
    {"opaque_lost", "the opaque surfaces not drawn", ChangedPart::scene,
     [](AlteredRun& e) {
         DrawList& list = e.scene();
         return std::erase_if(list.instances, [&](const pipeline::Instance& i) {
                    return list.materials[i.material].alpha_mode != AlphaMode::blend;
                }) > 0;
     }},
    {"opaque_peeled", "opaque surfaces peeled like transparent ones", ChangedPart::scene,
     [](AlteredRun& e) {
         return changes(e.scene().materials, [](Material& m) {
             if (m.alpha_mode == AlphaMode::opaque) m.alpha_mode = AlphaMode::blend;
         });
     }},
    {"order_reversed", "triangles submitted in the reverse order", ChangedPart::scene,
     [](AlteredRun& e) {
         if (counts_on(e)) return false;
         DrawList& list = e.scene();
         std::ranges::reverse(list.instances);
         for (Mesh& mesh : list.meshes) {
             // Reversed in groups of three: each triangle keeps its first corner and its winding.
             std::ranges::reverse(mesh.indices);
             for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
                 std::swap(mesh.indices[i], mesh.indices[i + 2]);
         }
         return true;
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_scene() { return scene_mistakes; }

}  // namespace strata::oracle
