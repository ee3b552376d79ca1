// scenes/gltf/check_meshes.cpp - primitives: attributes, their formats, indices, modes. See check.h.
#include "scenes/gltf/base_color.h"
#include "scenes/gltf/check.h"
#include "scenes/gltf/element.h"

namespace strata::scenes {
namespace {

// The fields of an accessor that the rules for primitives use.
struct AccessorFormat {
    ElementType type;
    ComponentType component;
    bool is_normalized;
    std::uint64_t count, offset, stride;  // offset: the accessor's; stride 0: absent
};

AccessorFormat format(const Json& root, std::size_t accessor) {  // for an accessor that check_accessors has accepted
    const Json& a = root["accessors"][accessor];
    const bool has_stride =
        a.contains("bufferView") && root["bufferViews"][a["bufferView"].get<std::size_t>()].contains("byteStride");
    return {
        *to_element_type(a["type"].get<std::string>()),
        *to_component_type(a["componentType"].get<std::uint64_t>()),
        a.value("normalized", false),
        a["count"].get<std::uint64_t>(),
        a.value("byteOffset", std::uint64_t{0}),
        has_stride ? root["bufferViews"][a["bufferView"].get<std::size_t>()]["byteStride"].get<std::uint64_t>() : 0};
}

// The 8- and 16-bit integers that KHR_mesh_quantization allows.
bool is_small_integer(const AccessorFormat& f) {
    return f.component != ComponentType::f32 && f.component != ComponentType::u32;
}
bool is_signed(const AccessorFormat& f) {
    return f.component == ComponentType::i8 || f.component == ComponentType::i16;
}

// The formats of glTF 2.0, 3.7.2.1, and those added by KHR_mesh_quantization. Attributes that are not read are not
// checked.
bool is_allowed(const std::string& name, const AccessorFormat& f, bool is_quantized) {
    const bool is_float = f.component == ComponentType::f32;
    const bool is_unorm = f.is_normalized && is_small_integer(f) && !is_signed(f);
    if (name == "POSITION") return f.type == ElementType::vec3 && (is_float || (is_quantized && is_small_integer(f)));
    if (name == "NORMAL")
        return f.type == ElementType::vec3 && (is_float || (is_quantized && is_signed(f) && f.is_normalized));
    if (name.starts_with("TEXCOORD_"))
        return f.type == ElementType::vec2 && (is_float || is_unorm || (is_quantized && is_small_integer(f)));
    if (name.starts_with("COLOR_"))
        return (f.type == ElementType::vec3 || f.type == ElementType::vec4) && (is_float || is_unorm);
    if (name.starts_with("JOINTS_"))
        return f.type == ElementType::vec4 && is_small_integer(f) && !is_signed(f) && !f.is_normalized;
    if (name.starts_with("WEIGHTS_")) return f.type == ElementType::vec4 && (is_float || is_unorm);
    return true;
}

// POSITION, NORMAL, TANGENT, NAME_n, or an application-specific name with a leading underscore.
bool is_attribute_name(const std::string& name) {
    if (name.starts_with('_') || name == "POSITION" || name == "NORMAL" || name == "TANGENT") return true;
    for (const std::string_view set : {"TEXCOORD_", "COLOR_", "JOINTS_", "WEIGHTS_"}) {
        if (!name.starts_with(set)) continue;
        const std::string_view digits = std::string_view(name).substr(set.size());
        const bool is_plain = digits == "0" || (!digits.empty() && digits[0] != '0');
        return is_plain && digits.size() < 10 && digits.find_first_not_of("0123456789") == digits.npos;
    }
    return false;
}

// `accessors` and `materials` are the lengths of the document's arrays, for checking indices.
struct MeshChecker {
    const JsonAt& root;
    bool is_quantized;
    std::size_t accessors, materials;

    // `count` is that of the previous attributes, empty for the first: all must be equal.
    void check_attribute(const JsonAt& attribute, const std::string& name, std::optional<std::uint64_t>& count) const {
        if (!is_attribute_name(name))
            attribute.location().fail("MESH_PRIMITIVE_INVALID_ATTRIBUTE",
                                      "an attribute that glTF defines, or a name that begins with _", in_quotes(name));
        const AccessorFormat f = format(root.json(), attribute.index(accessors));
        if (!is_allowed(name, f, is_quantized))
            attribute.fail("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
                           "an accessor whose type and componentType " + name + " allows" +
                               (is_quantized ? "" : " without KHR_mesh_quantization"));
        // glTF 2.0, 3.6.2.4: each element of a vertex attribute begins at a multiple of 4 bytes.
        const std::uint64_t step = f.stride ? f.stride : element_bytes(f.type, f.component);
        if (f.offset % 4 != 0 || step % 4 != 0)
            attribute.fail("MESH_PRIMITIVE_ACCESSOR_UNALIGNED",
                           "an accessor whose offset and stride are multiples of 4");
        if (count.value_or(f.count) != f.count)
            attribute.location().fail("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT",
                                      "as many elements as the other attributes: " + std::to_string(*count),
                                      std::to_string(f.count));
        count = f.count;
    }

    // glTF 2.0, 3.7.2.1. The values are compared with the vertex count when they are read (mesh.cpp).
    void check_indices(const JsonAt& indices) const {
        const AccessorFormat f = format(root.json(), indices.index(accessors));
        if (f.type != ElementType::scalar || !is_index_type(f.component) || f.is_normalized)
            indices.fail("MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", "an accessor of unsigned integer scalars");
        if (f.stride != 0)
            indices.fail("MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", "a bufferView without byteStride");
        const std::size_t index = indices.index(accessors);
        if (!root.json()["accessors"][index].contains("bufferView"))
            indices.fail("UNDEFINED_PROPERTY",
                         "an accessor with a bufferView");  // tinygltf does not support indices without a bufferView
    }

    // The texture coordinate set of the material's texture, if it has one.
    [[nodiscard]] std::optional<std::uint64_t> texcoord_set(const JsonAt& primitive) const {
        const auto material = primitive.find("material");
        if (!material) return std::nullopt;
        const std::size_t index = material->index(materials);  // first: without it there may be no such key
        const auto info = base_color_of({root.json()["materials"][index], material->location()}).texture;
        if (!info) return std::nullopt;
        const Json::json_pointer replaced{"/extensions/KHR_texture_transform/texCoord"};
        const Json& texture = info->json();
        return texture.contains(replaced) ? texture[replaced].get<std::uint64_t>()
                                          : texture.value("texCoord", std::uint64_t{0});
    }

    // A file that uses Draco without requiring it must contain plain data, too; without them the accessors would read
    // as zeros.
    void check_draco(const JsonAt& primitive, const JsonAt& attributes) const {
        const auto extensions = primitive.find("extensions");
        if (!extensions || !extensions->find("KHR_draco_mesh_compression")) return;
        for (const Json& accessor : attributes.json())
            if (!root.json()["accessors"][accessor.get<std::size_t>()].contains("bufferView"))
                extensions->location().fail("UNSUPPORTED_EXTENSION", "plain data next to KHR_draco_mesh_compression",
                                            "none");
    }

    // glTF 2.0, 3.7.2.2: a target changes attributes that the primitive has.
    void check_target(const JsonAt& target, const JsonAt& attributes, std::optional<std::uint64_t> count) const {
        for (const auto& item : target.object().json().items()) {
            const JsonAt attribute = target.member(item.key());
            if (!attributes.has(item.key()))
                attribute.location().fail("MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR",
                                          "an attribute that the primitive has", in_quotes(item.key()));
            check_attribute(attribute, item.key(), count);
        }
    }

    void check_primitive(const JsonAt& primitive, Warnings& warnings) const {
        const JsonAt attributes = primitive.member("attributes").object();
        std::optional<std::uint64_t> count;
        for (const auto& item : attributes.json().items())
            check_attribute(attributes.member(item.key()), item.key(), count);
        check_draco(primitive, attributes);
        if (!attributes.has("POSITION"))
            warnings.add(primitive.location().pointer, "a primitive without POSITION is not drawn");
        if (const auto indices = primitive.find("indices")) check_indices(*indices);
        if (const auto mode = primitive.find("mode")) (void)mode->integer(0, 6);
        const auto set = texcoord_set(primitive);
        if (set && attributes.has("POSITION") && !attributes.has("TEXCOORD_" + std::to_string(*set)))
            primitive.location().fail("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS",
                                      "TEXCOORD_" + std::to_string(*set) + " for the material's texture", "none");
        for (const JsonAt& target : primitive.elements("targets")) check_target(target, attributes, count);
        for (const auto& item : attributes.json().items())
            if (item.key().starts_with("COLOR_") && item.key() != "COLOR_0")
                warnings.add(attributes.location().pointer, "vertex colours beyond COLOR_0 are ignored");
    }
};

// All primitives of a mesh have as many targets as the mesh has weights, if it has weights.
void check_target_counts(const JsonAt& mesh) {
    const std::vector<JsonAt> primitives = mesh.elements("primitives");
    for (const JsonAt& primitive : primitives)
        if (primitive.size("targets") != primitives[0].size("targets"))
            primitive.location().fail(
                "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT",
                "as many morph targets as the first primitive: " + std::to_string(primitives[0].size("targets")),
                std::to_string(primitive.size("targets")));
    if (const auto weights = mesh.find("weights"))
        weights->numbers(primitives.empty() ? 0 : primitives[0].size("targets"));
}

}  // namespace

void check_meshes(const JsonAt& root, Warnings& warnings, Faults& faults) {
    const MeshChecker checker{root, uses_extension(root, "KHR_mesh_quantization"), root.size("accessors"),
                              root.size("materials")};
    faults.collect_each(root, "meshes", [&](const JsonAt& mesh) {
        (void)mesh.member("primitives");
        faults.collect_each(mesh, "primitives",
                            [&](const JsonAt& primitive) { checker.check_primitive(primitive, warnings); });
        check_target_counts(mesh);
    });
}

}  // namespace strata::scenes
