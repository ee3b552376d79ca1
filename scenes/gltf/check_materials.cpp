// scenes/gltf/check_materials.cpp - images, samplers, textures, materials. See check.h.
#include <cmath>
#include <initializer_list>

#include "scenes/gltf/base_color.h"
#include "scenes/gltf/check.h"
#include "scenes/numbers/elementary.h"

namespace strata::scenes {
namespace {

// An optional integer that must be one of `list`, which are OpenGL enum values.
void check_listed(const JsonAt& owner, const char* key, std::initializer_list<int> list, const char* expected) {
    const auto value = owner.find(key);
    if (!value) return;
    const std::uint64_t code = value->integer(0, max_bytes);
    for (const int known : list)
        if (code == static_cast<std::uint64_t>(known)) return;
    value->fail("VALUE_NOT_IN_LIST", expected);
}

// glTF 2.0, 3.8.3: the image has exactly one of uri and bufferView, and with a bufferView it needs a mimeType.
void check_image(const JsonAt& image, const JsonAt& root) {
    const bool has_uri = image.has("uri"), has_view = image.has("bufferView");
    if (has_uri == has_view)
        image.location().fail("ONE_OF_MISMATCH", "either uri or bufferView", has_uri ? "both" : "neither");
    if (has_uri) (void)image.member("uri").string();
    check_reference(image, "bufferView", root, "bufferViews");
    const auto media_type = image.find("mimeType");
    if (media_type) (void)media_type->string();
    if (has_view && !media_type) image.location().fail("UNSATISFIED_DEPENDENCY", "mimeType next to bufferView", "none");
}

// The limit of the angle is that of scenes/numbers/elementary.h.
void check_texture_transform(const JsonAt& info) {
    const auto extensions = info.find("extensions");
    const auto transform = extensions ? extensions->find("KHR_texture_transform") : std::nullopt;
    if (!transform) return;
    if (const auto offset = transform->find("offset")) offset->numbers(2);
    if (const auto scale = transform->find("scale")) scale->numbers(2);
    if (const auto rotation = transform->find("rotation"); rotation && !(std::abs(rotation->number()) <= max_angle))
        rotation->fail("VALUE_NOT_IN_RANGE", "an angle of at most 10^6 radians");
    if (const auto set = transform->find("texCoord")) (void)set->integer(0, max_bytes);
}

// The base colour texture is the only one that is drawn, and so the only one whose image must be readable.
void check_base_color_texture(const JsonAt& info, const JsonAt& root) {
    const std::size_t texture = info.member("index").index(root.size("textures"));
    if (const auto set = info.find("texCoord")) (void)set->integer(0, max_bytes);
    check_texture_transform(info);
    const JsonAt used{root.json()["textures"][texture], root.location().under("textures").under(texture)};
    if (used.has("source")) return;
    std::string found = "no source";
    if (const auto extensions = used.find("extensions"); extensions && !extensions->json().empty())
        if (const std::string name = extensions->json().items().begin().key(); true)
            found = "an image by " + one_line(name) + " alone" + way_out_of(name);
    used.location().fail("UNDEFINED_PROPERTY", "a PNG or JPEG image as source", found);
}

// glTF 2.0, 3.9.2: linear r g b a, each from 0 to 1. JSON cannot write a NaN.
void check_color(const JsonAt& factor) {
    factor.numbers(4);
    for (const JsonAt& channel : factor.elements())
        if (!(channel.number() >= 0 && channel.number() <= 1))
            channel.fail("VALUE_NOT_IN_RANGE", "a number from 0 to 1");
}

void check_base_color(const JsonAt& material, const JsonAt& root, Warnings& warnings) {
    const auto pbr = material.find("pbrMetallicRoughness");
    if (pbr) (void)pbr->object();
    const BaseColor base = base_color_of(material);
    if (base.factor) check_color(*base.factor);
    if (base.texture) check_base_color_texture(base.texture->object(), root);
    const auto extensions = material.find("extensions");
    const auto old = extensions ? extensions->find("KHR_materials_pbrSpecularGlossiness") : std::nullopt;
    if (old) {
        for (const char* key : {"specularFactor", "glossinessFactor", "specularGlossinessTexture"})
            if (const auto ignored = old->object().find(key))
                warnings.add(ignored->location().pointer, "specular and glossiness are ignored: lighting is diffuse");
        return;
    }
    for (const char* key : {"metallicFactor", "roughnessFactor", "metallicRoughnessTexture"})
        if (const auto ignored = pbr ? pbr->find(key) : std::nullopt)
            warnings.add(ignored->location().pointer, "metallic and roughness are ignored: lighting is diffuse");
}

// Ignored features get a warning and no check: a fault in a normal map does not prevent the scene from being drawn.
void check_material(const JsonAt& material, const JsonAt& root, Warnings& warnings) {
    check_base_color(material, root, warnings);
    if (const auto mode = material.find("alphaMode")) {
        const std::string name = mode->string();
        if (name != "OPAQUE" && name != "MASK" && name != "BLEND")
            mode->fail("VALUE_NOT_IN_LIST", "OPAQUE, MASK or BLEND");
    }
    if (const auto cutoff = material.find("alphaCutoff"); cutoff && !(cutoff->number() >= 0))
        cutoff->fail("VALUE_NOT_IN_RANGE", "a cutoff that is not negative");
    if (const auto sides = material.find("doubleSided")) (void)sides->boolean();
    if (const auto extensions = material.find("extensions")) {
        const auto unlit = extensions->find("KHR_materials_unlit");
        if (unlit) (void)unlit->object();
    }
    if (const auto it = material.find("normalTexture"))
        warnings.add(it->location().pointer,
                     "normal maps are ignored: surfaces are lit by the normals of their vertices");
    if (const auto it = material.find("occlusionTexture"))
        warnings.add(it->location().pointer, "occlusion is ignored: creases are lighter");
    for (const char* key : {"emissiveTexture", "emissiveFactor"})
        if (const auto it = material.find(key))
            warnings.add(it->location().pointer, "emission is ignored: what glows is darker");
}

}  // namespace

void check_images(const JsonAt& root, Faults& faults) {
    faults.collect_each(root, "images", [&](const JsonAt& image) { check_image(image, root); });
    faults.collect_each(root, "samplers", [](const JsonAt& sampler) {
        check_listed(sampler, "magFilter", {9728, 9729}, "9728 or 9729");
        check_listed(sampler, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987}, "9728, 9729 or 9984 to 9987");
        check_listed(sampler, "wrapS", {33071, 33648, 10497}, "33071, 33648 or 10497");
        check_listed(sampler, "wrapT", {33071, 33648, 10497}, "33071, 33648 or 10497");
    });
    faults.collect_each(root, "textures", [&](const JsonAt& texture) {
        check_reference(texture, "sampler", root, "samplers");
        check_reference(texture, "source", root, "images");
    });
}

void check_materials(const JsonAt& root, Warnings& warnings, Faults& faults) {
    faults.collect_each(root, "materials", [&](const JsonAt& material) { check_material(material, root, warnings); });
}

}  // namespace strata::scenes
