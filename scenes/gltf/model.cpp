// scenes/gltf/model.cpp - reduces the checked JSON to what the scene needs and passes it to tinygltf (model.h).
#include "scenes/gltf/model.h"

namespace strata::scenes {
namespace {

void erase(Json& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys) object.erase(key);
}

// Erases all of a material except name, alpha mode, cutoff and doubleSided; its colour: base_color.h.
void reduce_material(Json& material) {
    erase(material, {"extras", "extensions", "normalTexture", "occlusionTexture", "emissiveTexture", "emissiveFactor",
                     "pbrMetallicRoughness"});
}

// A copy with the kinds and members that the scene reads. Buffers and images are left out, so that tinygltf
// never opens a uri; the views keep their indices into the document's own buffers.
Json reduced(const Json& document) {
    Json kept{{"asset", {{"version", "2.0"}}}};
    for (const char* kind :
         {"accessors", "bufferViews", "cameras", "materials", "meshes", "nodes", "samplers", "scenes", "textures"}) {
        if (!document.contains(kind)) continue;
        kept[kind] = document[kind];
        for (Json& object : kept[kind]) {
            if (kind == std::string_view("materials"))
                reduce_material(object);
            else
                erase(object, {"extras", "extensions", "min", "max", "skin", "weights"});
        }
    }
    if (kept.contains("meshes"))
        for (Json& mesh : kept["meshes"])
            for (Json& primitive : mesh["primitives"]) erase(primitive, {"extras", "extensions", "targets"});
    if (kept.contains("cameras"))
        for (Json& camera : kept["cameras"])
            for (const char* type : {"perspective", "orthographic"})
                if (camera.contains(type) && camera[type].is_object()) erase(camera[type], {"extras", "extensions"});
    if (document.contains("scene")) kept["scene"] = document["scene"];
    return kept;
}

}  // namespace

tinygltf::Model to_model(const Document& document) {
    // Converted back to text, because tinygltf reads only text. The text is below 2^32 bytes: a number grows to at most
    // a few times its length in the document's 2^28 bytes.
    const std::string text = reduced(document.json).dump();
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string error, warning;
    if (!parser.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned int>(text.size()), ""))
        FileLocation{document.file, ""}.fail("INVALID_JSON", "a document that tinygltf reads", in_quotes(error));
    return model;
}

}  // namespace strata::scenes
