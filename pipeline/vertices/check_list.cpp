// pipeline/vertices/check_list.cpp - the checks of check_list.h, field by field.
#include "pipeline/vertices/check_list.h"

#include <algorithm>
#include <limits>

#include "pipeline/device/profile_fields.h"
#include "rasterizer/base/require.h"

namespace strata::pipeline {
namespace {

// The limit of the largest profile; texel addresses are valid up to 2^15 texels per side
// (pipeline/reference/texturing.md 1).
constexpr int greatest_size_px = 16384;

void check_indices(const Requirements& list, const Mesh& mesh, std::size_t number) {
    const FieldName indices{"meshes", number, "indices"};
    if (mesh.indices.size() % 3 != 0) list.fail(indices, "three per primitive", mesh.indices.size());
    list.listed({"meshes", number, "primitive"}, mesh.primitive);
    const bool is_line = mesh.primitive == Primitive::lines || mesh.primitive == Primitive::line_strips;
    const bool is_point = mesh.primitive == Primitive::points;
    for (std::size_t i = 0; (is_line || is_point) && i < mesh.indices.size(); i += 3) {
        if (mesh.indices[i] == mesh.indices[i + 1] && (is_line || mesh.indices[i] == mesh.indices[i + 2])) continue;
        list.fail(indices.text() + "[" + std::to_string(i + 1) + "]",
                  is_line ? "the first end of the line again" : "the vertex of the point three times",
                  mesh.indices[i + 1]);
    }
    // Computes the greatest index in one loop without branches, and searches only if it is too large.
    std::uint32_t greatest = 0;
    for (const std::uint32_t i : mesh.indices) greatest = std::max(greatest, i);
    if (mesh.indices.empty() || greatest < mesh.positions.size()) return;
    const auto wrong = std::ranges::find_if(mesh.indices, [&](std::uint32_t i) { return i >= mesh.positions.size(); });
    list.fail(indices.text() + "[" + std::to_string(wrong - mesh.indices.begin()) + "]",
              "less than " + std::to_string(mesh.positions.size()), *wrong);
}

void check_mesh(const Requirements& list, const Mesh& mesh, std::size_t number) {
    const auto as_many = [&](const char* attribute, std::size_t size) {
        if (size == 0 || size == mesh.positions.size()) return;
        list.fail(FieldName{"meshes", number, attribute}, "none or " + std::to_string(mesh.positions.size()), size);
    };
    as_many("w", mesh.w.size());
    as_many("normals", mesh.normals.size());
    as_many("colors", mesh.colors.size());
    as_many("texcoords", mesh.texcoords.size());
    check_indices(list, mesh, number);
}

void check_material(const Requirements& list, const Material& material, std::size_t number, std::size_t textures) {
    const auto field = [number](const char* name) { return FieldName{"materials", number, name}; };
    list.listed(field("alpha_mode"), material.alpha_mode);
    list.finite(field("alpha_cutoff"), material.alpha_cutoff);
    list.within(field("texture"), std::int64_t{material.texture}, -1, static_cast<std::int64_t>(textures) - 1);
}

void check_texture(const Requirements& list, const Texture& texture, std::size_t number) {
    const auto field = [number](const char* name) { return FieldName{"textures", number, name}; };
    list.within(field("width"), texture.width, 1, greatest_size_px);
    list.within(field("height"), texture.height, 1, greatest_size_px);
    const auto bytes = 4 * static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height);
    if (texture.texels.size() != bytes)
        list.fail(field("texels"), std::to_string(bytes) + " bytes", texture.texels.size());
    list.listed(field("target"), texture.target);
    list.listed(field("filter"), texture.filter);
    list.listed(field("wrap_s"), texture.wrap_s);
    list.listed(field("wrap_t"), texture.wrap_t);
}

// The soup has 32-bit numbers for all vertices and all indices.
void check_instances(const Requirements& its, const DrawList& list) {
    std::uint64_t vertices = 0, indices = 0;
    for (std::size_t i = 0; i < list.instances.size(); ++i) {
        const Instance& instance = list.instances[i];
        if (instance.mesh >= list.meshes.size()) its.below({"instances", i, "mesh"}, instance.mesh, list.meshes.size());
        if (instance.material >= list.materials.size())
            its.below({"instances", i, "material"}, instance.material, list.materials.size());
        vertices += list.meshes[instance.mesh].positions.size();
        indices += list.meshes[instance.mesh].indices.size();
    }
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    its.within("instances: their vertices", vertices, 0, most);
    its.within("instances: their indices", indices, 0, most);
}

void check_light(const Requirements& list, const ShadowLight& light) {
    list.within("light.size_px", light.size_px, 1, greatest_size_px);
    list.finite("light.ambient", light.ambient);
    list.finite("light.offset_factor", light.offset_factor);
    list.finite("light.offset_units", light.offset_units);
}

}  // namespace

void check(const DrawList& list) {
    const Requirements its{"draw list"};
    for (std::size_t i = 0; i < list.meshes.size(); ++i) check_mesh(its, list.meshes[i], i);
    for (std::size_t i = 0; i < list.textures.size(); ++i) check_texture(its, list.textures[i], i);
    for (std::size_t i = 0; i < list.materials.size(); ++i)
        check_material(its, list.materials[i], i, list.textures.size());
    check_instances(its, list);
    if (list.light) check_light(its, *list.light);
    if (const auto fault = fault_of(list.lights))
        throw InputError("draw list", fault->field, fault->expected, fault->found);
}

void check(const View& view) { Requirements{"view"}.listed("vertex_path", view.vertex_path); }

void check(const DeviceProfile& profile) {
    const Requirements its{"profile"};
    for (const ProfileField& field : profile_fields()) {
        const int value = field.value(profile);
        if (value >= field.lowest && value <= field.highest && (value - field.lowest) % field.step == 0) continue;
        std::string expected = std::to_string(field.lowest) + " to " + std::to_string(field.highest);
        if (field.step > 1) expected += " in steps of " + std::to_string(field.step);
        its.fail(std::string{field.key}, expected, value);
    }
    if (const auto conflict = conflict_of(profile))
        throw InputError("profile", std::string{conflict->key}, conflict->expected, conflict->found);
}

}  // namespace strata::pipeline
