// scenes/gltf/check.cpp - checks of the whole document: asset, extensions, unsupported features. See check.h.
#include "scenes/gltf/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace strata::scenes {
namespace {

// Extensions that a file may require. An extension that is used without being required is ignored with a warning.
constexpr std::array<std::string_view, 8> implemented{
    "EXT_mesh_gpu_instancing", "KHR_lights_punctual",    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_unlit",     "KHR_materials_variants", "KHR_mesh_quantization",
    "KHR_node_visibility",     "KHR_texture_transform"};

bool is_implemented(const std::string& name) {
    return std::find(implemented.begin(), implemented.end(), name) != implemented.end();
}

// What a file looks like without an extension; "" if that is not known.
std::string effect_of(const std::string& extension) {
    constexpr std::pair<std::string_view, std::string_view> effects[]{
        {"KHR_materials_emissive_strength", ": what glows is darker"},
        {"KHR_materials_volume", ": nothing is tinted by the way of light through it"},
        {"KHR_materials_ior", ": nothing is refracted"},
        {"KHR_materials_dispersion", ": nothing is refracted"},
        {"KHR_materials_diffuse_transmission", ": surfaces let no light through to their other side"},
        {"KHR_animation_pointer", ": everything stays as written"},
        {"MSFT_lod", ": the finest level is drawn"}};
    for (const auto& [name, effect] : effects)
        if (name == extension) return std::string(effect);
    for (const std::string_view part : {"clearcoat", "sheen", "specular", "iridescence", "anisotropy"})
        if (extension == "KHR_materials_" + std::string(part)) return ": highlights differ, alpha does not";
    return "";
}

struct Version {
    std::uint64_t major = 0, minor = 0;
};

Version version(const JsonAt& at) {  // ^[0-9]+\.[0-9]+$, in range of an int
    const std::string text = at.string();
    const std::size_t dot = text.find('.');
    const auto is_number = [](const std::string& s) {
        return !s.empty() && s.size() < 6 &&
               std::all_of(s.begin(), s.end(), [](char c) { return c >= '0' && c <= '9'; });
    };
    if (dot == text.npos || !is_number(text.substr(0, dot)) || !is_number(text.substr(dot + 1)))
        at.fail("PATTERN_MISMATCH", "a version like 2.0");
    return {std::stoul(text.substr(0, dot)), std::stoul(text.substr(dot + 1))};
}

// glTF 2.0, 3.2: the major version must be 2; a higher minor version is read as 2.0 unless minVersion is higher.
void check_asset(const JsonAt& root) {
    const JsonAt asset = root.member("asset").object();
    const JsonAt written = asset.member("version");
    if (version(written).major != 2) written.fail("UNKNOWN_ASSET_MAJOR_VERSION", "glTF version 2.x");
    const auto least = asset.find("minVersion");
    if (!least) return;
    const Version needed = version(*least);
    if (needed.major != 2) least->fail("UNKNOWN_ASSET_MAJOR_VERSION", "glTF version 2.x");
    if (needed.minor > 0) least->fail("UNKNOWN_ASSET_MINOR_VERSION", "2.0, the version that strata reads");
}

void check_every_name(const JsonAt& root, Faults& faults) {  // of the objects that are used in the scene
    for (const char* kind : {"accessors", "bufferViews", "buffers", "cameras", "images", "materials", "meshes", "nodes",
                             "samplers", "scenes", "textures"})
        faults.collect_each(root, kind, [](const JsonAt& object) {
            if (const auto name = object.find("name")) (void)name->string();
        });
}

}  // namespace

std::string way_out_of(const std::string& extension) {
    if (extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression")
        return " (gltf-transform copy IN.glb OUT.glb unpacks it)";
    if (extension == "KHR_texture_basisu") return " (gltf-transform ktxdecompress IN.glb OUT.glb unpacks it)";
    if (extension == "EXT_texture_webp" || extension == "EXT_texture_avif")
        return " (gltf-transform png --formats \"*\" IN.glb OUT.glb converts it)";
    if (extension == "KHR_materials_transmission")
        return " (make the material alphaMode BLEND in its editor: transmission is not alpha)";
    return "";
}

bool uses_extension(const JsonAt& root, const char* name) {
    const auto used = root.elements("extensionsUsed");
    return std::any_of(used.begin(), used.end(), [&](const JsonAt& e) { return e.json() == name; });
}

std::optional<std::size_t> check_reference(const JsonAt& owner, const char* key, const JsonAt& root,
                                           const char* target) {
    const auto reference = owner.find(key);
    if (!reference) return std::nullopt;
    return reference->index(root.size(target));
}

void check_extensions(const JsonAt& root, Warnings& warnings, Faults& faults) {
    faults.collect_each(root, "extensionsRequired", [](const JsonAt& required) {
        if (!is_implemented(required.string()))
            required.fail("UNSUPPORTED_EXTENSION",
                          fmt::format("no required extension but {}{}", fmt::join(implemented, ", "),
                                      way_out_of(required.string())));
    });
    faults.collect_each(root, "extensionsUsed", [&](const JsonAt& used) {
        // Each material that transmits light has a warning of its own (material.cpp).
        if (!is_implemented(used.string()) && used.string() != "KHR_materials_transmission")
            warnings.add(used.location().pointer,
                         "extension " + one_line(used.string()) + " is ignored" + effect_of(used.string()));
    });
    const auto extensions = root.find("extensions");
    if (const auto variants = extensions ? extensions->find("KHR_materials_variants") : std::nullopt)
        warnings.add(variants->location().pointer, "the default materials are drawn, not a variant");
}

// Each check relies on the previous ones: accessors on the lengths of the views, meshes on the formats of the
// accessors.
void check_document(const JsonAt& root, Warnings& warnings) {
    (void)root.object();
    Faults faults, of_data;
    faults.collect([&] { check_asset(root); });
    check_extensions(root, warnings, faults);
    check_every_name(root, faults);
    check_buffers(root, of_data);
    check_accessors(root, of_data);
    check_images(root, of_data);
    check_materials(root, warnings, of_data);
    // A primitive is compared with its accessors and its material.
    if (of_data.empty()) {
        check_meshes(root, warnings, of_data);
        check_skins(root, of_data);
    }
    faults.add(of_data);
    check_cameras(root, faults);
    check_nodes(root, warnings, faults);
    check_lights(root, faults);
    faults.report();
    if (root.size("animations") > 0)
        warnings.add("/animations", "animations are ignored: nodes, joints and morph weights stay as written");
}

}  // namespace strata::scenes
