// Tests glTF documents that break a rule of glTF 2.0. Each is everything() with one value changed; the table has the
// Khronos validator's code and the JSON pointer of the fault.
#include <catch2/catch.hpp>

#include "tests/scenes/gltf/gltf_file.h"

namespace {

using namespace strata::scenes::test;

struct Change {
    const char *path, *value;  // JSON pointer and JSON text; "" removes the value
    const char *code, *pointer;
};

std::string refusal_after(const Change& change) {
    Json document = everything().document();
    const std::string_view value = change.value;
    const Json operation = value.empty() ? Json{{"op", "remove"}, {"path", change.path}}
                                         : Json{{"op", "add"}, {"path", change.path}, {"value", Json::parse(value)}};
    // "add" on an array element would insert, so an existing value is replaced.
    Json patch = Json::array({operation});
    if (!value.empty() && document.contains(Json::json_pointer(change.path))) patch[0]["op"] = "replace";
    return refusal(to_bytes(document.patch(patch).dump()));
}

const Change changes[]{
    {"/asset", "", "UNDEFINED_PROPERTY", "/"},
    {"/asset", "[]", "TYPE_MISMATCH", "/asset"},
    {"/asset/version", "", "UNDEFINED_PROPERTY", "/asset"},
    {"/asset/version", "2", "TYPE_MISMATCH", "/asset/version"},
    {"/asset/version", "\"two\"", "PATTERN_MISMATCH", "/asset/version"},
    {"/asset/version", "\"1.0\"", "UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version"},
    {"/asset/minVersion", "\"2.1\"", "UNKNOWN_ASSET_MINOR_VERSION", "/asset/minVersion"},
    {"/extensionsRequired", "[\"KHR_draco_mesh_compression\"]", "UNSUPPORTED_EXTENSION", "/extensionsRequired/0"},
    {"/extensionsRequired", "[7]", "TYPE_MISMATCH", "/extensionsRequired/0"},
    {"/extensionsUsed", "{}", "TYPE_MISMATCH", "/extensionsUsed"},
    {"/accessors", "7", "TYPE_MISMATCH", "/accessors"},
    {"/nodes/0", "null", "TYPE_MISMATCH", "/nodes/0"},
    {"/nodes/0/name", "7", "TYPE_MISMATCH", "/nodes/0/name"},

    {"/buffers/0/byteLength", "", "UNDEFINED_PROPERTY", "/buffers/0"},
    {"/buffers/0/byteLength", "0", "VALUE_NOT_IN_RANGE", "/buffers/0/byteLength"},
    {"/buffers/0/byteLength", "-1", "VALUE_NOT_IN_RANGE", "/buffers/0/byteLength"},
    {"/buffers/0/byteLength", "64.0", "TYPE_MISMATCH", "/buffers/0/byteLength"},
    {"/buffers/0/byteLength", "99999", "BUFFER_EXTERNAL_BYTELENGTH_MISMATCH", "/buffers/0/byteLength"},
    {"/buffers/0/byteLength", "18446744073709551615", "VALUE_NOT_IN_RANGE", "/buffers/0/byteLength"},
    {"/buffers/0/byteLength", "10", "BUFFER_VIEW_TOO_LONG", "/bufferViews/0/byteLength"},
    {"/buffers/0/uri", "", "BUFFER_MISSING_GLB_DATA", "/buffers/0"},
    {"/bufferViews/0/buffer", "1", "UNRESOLVED_REFERENCE", "/bufferViews/0/buffer"},
    {"/bufferViews/0/buffer", "-1", "INVALID_INDEX", "/bufferViews/0/buffer"},
    {"/bufferViews/0/byteLength", "100000", "BUFFER_VIEW_TOO_LONG", "/bufferViews/0/byteLength"},
    {"/bufferViews/0/byteOffset", "2147483647", "BUFFER_VIEW_TOO_LONG", "/bufferViews/0/byteLength"},
    {"/bufferViews/0/byteOffset", "18446744073709551612", "VALUE_NOT_IN_RANGE", "/bufferViews/0/byteOffset"},
    {"/bufferViews/0/byteOffset", "1", "ACCESSOR_TOTAL_OFFSET_ALIGNMENT", "/accessors/0"},
    {"/bufferViews/0/byteStride", "8", "ACCESSOR_SMALL_BYTESTRIDE", "/bufferViews/0/byteStride"},
    {"/bufferViews/0/byteStride", "14", "VALUE_MULTIPLE_OF", "/bufferViews/0/byteStride"},
    {"/bufferViews/0/byteStride", "256", "VALUE_NOT_IN_RANGE", "/bufferViews/0/byteStride"},
    {"/bufferViews/0/byteStride", "16", "ACCESSOR_TOO_LONG", "/accessors/0"},
    {"/bufferViews/3/byteStride", "8", "BUFFER_VIEW_INVALID_BYTE_STRIDE", "/accessors/3/sparse/indices"},

    {"/accessors/0/bufferView", "99", "UNRESOLVED_REFERENCE", "/accessors/0/bufferView"},
    {"/accessors/0/byteOffset", "2", "ACCESSOR_OFFSET_ALIGNMENT", "/accessors/0/byteOffset"},
    {"/accessors/0/byteOffset", "4", "ACCESSOR_TOO_LONG", "/accessors/0"},
    {"/accessors/0/byteOffset", "2147483644", "ACCESSOR_TOO_LONG", "/accessors/0"},
    {"/accessors/0/byteOffset", "9223372036854775804", "VALUE_NOT_IN_RANGE", "/accessors/0/byteOffset"},
    {"/accessors/0/count", "5", "ACCESSOR_TOO_LONG", "/accessors/0"},
    {"/accessors/0/count", "2147483647", "ACCESSOR_TOO_LONG", "/accessors/0"},
    {"/accessors/0/count", "4294967297", "VALUE_NOT_IN_RANGE", "/accessors/0/count"},
    {"/accessors/0/count", "0", "VALUE_NOT_IN_RANGE", "/accessors/0/count"},
    {"/accessors/0/count", "3", "MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", "/meshes/0/primitives/0/attributes/POSITION"},
    {"/accessors/0/componentType", "5124", "VALUE_NOT_IN_LIST", "/accessors/0/componentType"},
    {"/accessors/0/type", "\"VEC5\"", "VALUE_NOT_IN_LIST", "/accessors/0/type"},
    {"/accessors/0/type", "\"VEC2\"", "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"/accessors/0/componentType", "5122", "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"/accessors/0/normalized", "true", "ACCESSOR_NORMALIZED_INVALID", "/accessors/0/normalized"},
    {"/accessors/0/normalized", "1", "TYPE_MISMATCH", "/accessors/0/normalized"},
    {"/accessors/3/sparse/count", "5", "ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "/accessors/3/sparse/count"},
    {"/accessors/3/sparse/indices/componentType", "5126", "VALUE_NOT_IN_LIST",
     "/accessors/3/sparse/indices/componentType"},
    {"/accessors/3/sparse/indices/byteOffset", "2", "ACCESSOR_TOO_LONG", "/accessors/3/sparse/indices"},
    {"/accessors/3/sparse/values", "", "UNDEFINED_PROPERTY", "/accessors/3/sparse"},
    {"/accessors/3/sparse/values/bufferView", "3", "ACCESSOR_TOO_LONG", "/accessors/3/sparse/values"},
    {"/accessors/3/sparse/indices/componentType", "5121", "ACCESSOR_SPARSE_INDICES_NON_INCREASING",
     "/accessors/3/sparse/indices"},
    {"/accessors/3/sparse/indices/bufferView", "1", "ACCESSOR_SPARSE_INDICES_NON_INCREASING",
     "/accessors/3/sparse/indices"},

    {"/meshes/0/primitives", "", "UNDEFINED_PROPERTY", "/meshes/0"},
    {"/meshes/0/primitives/0/attributes", "", "UNDEFINED_PROPERTY", "/meshes/0/primitives/0"},
    {"/meshes/0/primitives/0/extensions", "{\"KHR_draco_mesh_compression\":{}}", "", ""},
    {"/meshes/0/primitives/0/attributes/POSITION", "77", "UNRESOLVED_REFERENCE",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"/meshes/0/primitives/0/attributes/POSITION", "\"0\"", "TYPE_MISMATCH",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"/meshes/0/primitives/0/attributes/TEXCOORD_0", "", "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "/meshes/0/primitives/0"},
    {"/meshes/0/primitives/0/attributes/TEXCOORD", "2", "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
     "/meshes/0/primitives/0/attributes/TEXCOORD"},
    {"/meshes/0/primitives/0/attributes/COLOR_01", "3", "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
     "/meshes/0/primitives/0/attributes/COLOR_01"},
    {"/meshes/0/primitives/0/attributes/a~1b", "0", "MESH_PRIMITIVE_INVALID_ATTRIBUTE",
     "/meshes/0/primitives/0/attributes/a~1b"},
    {"/meshes/0/primitives/0/indices", "0", "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT",
     "/meshes/0/primitives/0/indices"},
    {"/meshes/0/primitives/0/indices", "9", "UNRESOLVED_REFERENCE", "/meshes/0/primitives/0/indices"},
    {"/accessors/4/bufferView", "", "UNDEFINED_PROPERTY", "/meshes/0/primitives/0/indices"},
    {"/bufferViews/6/byteStride", "4", "ACCESSOR_TOO_LONG", "/accessors/4"},
    {"/meshes/0/primitives/0/mode", "7", "VALUE_NOT_IN_RANGE", "/meshes/0/primitives/0/mode"},
    {"/meshes/0/primitives/0/material", "1", "UNRESOLVED_REFERENCE", "/meshes/0/primitives/0/material"},
    {"/accessors/4/bufferView", "3", "ACCESSOR_TOO_LONG", "/accessors/4"},
    {"/accessors/4/bufferView", "4", "ACCESSOR_INDEX_OOB", "/accessors/4"},
    {"/accessors/4/componentType", "5121", "", ""},  // bytes 0 0 1 0 2 0: valid

    {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1,1,1]", "ARRAY_LENGTH_NOT_IN_LIST",
     "/materials/0/pbrMetallicRoughness/baseColorFactor"},
    {"/materials/0/pbrMetallicRoughness/baseColorFactor/0", "1.5", "VALUE_NOT_IN_RANGE",
     "/materials/0/pbrMetallicRoughness/baseColorFactor/0"},
    {"/materials/0/pbrMetallicRoughness/baseColorFactor/3", "\"1\"", "ARRAY_TYPE_MISMATCH",
     "/materials/0/pbrMetallicRoughness/baseColorFactor/3"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "5", "UNRESOLVED_REFERENCE",
     "/materials/0/pbrMetallicRoughness/baseColorTexture/index"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "", "UNDEFINED_PROPERTY",
     "/materials/0/pbrMetallicRoughness/baseColorTexture"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", "1", "MESH_PRIMITIVE_TOO_FEW_TEXCOORDS",
     "/meshes/0/primitives/0"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions", "{\"KHR_texture_transform\":{\"offset\":[1]}}",
     "ARRAY_LENGTH_NOT_IN_LIST",
     "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/offset"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions",
     "{\"KHR_texture_transform\":{\"scale\":[1e300,1]}}", "VALUE_NOT_IN_RANGE", "/meshes/0/primitives/0"},
    {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions", "{\"KHR_texture_transform\":{\"rotation\":1e7}}",
     "VALUE_NOT_IN_RANGE",
     "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform/rotation"},
    {"/materials/0/alphaMode", "\"ADD\"", "VALUE_NOT_IN_LIST", "/materials/0/alphaMode"},
    {"/materials/0/alphaCutoff", "-0.5", "VALUE_NOT_IN_RANGE", "/materials/0/alphaCutoff"},
    {"/materials/0/doubleSided", "1", "TYPE_MISMATCH", "/materials/0/doubleSided"},
    {"/textures/0/source", "1", "UNRESOLVED_REFERENCE", "/textures/0/source"},
    {"/textures/0/source", "", "UNDEFINED_PROPERTY", "/textures/0"},
    {"/textures/0/sampler", "1", "UNRESOLVED_REFERENCE", "/textures/0/sampler"},
    {"/samplers/0/wrapS", "10496", "VALUE_NOT_IN_LIST", "/samplers/0/wrapS"},
    {"/samplers/0/magFilter", "9984", "VALUE_NOT_IN_LIST", "/samplers/0/magFilter"},
    {"/images/0/uri", "", "ONE_OF_MISMATCH", "/images/0"},
    {"/images/0/bufferView", "0", "ONE_OF_MISMATCH", "/images/0"},
    {"/images/0", "{\"bufferView\":0}", "UNSATISFIED_DEPENDENCY", "/images/0"},
    {"/images/0", "{\"bufferView\":0,\"mimeType\":\"image/png\"}", "IMAGE_UNRECOGNIZED_FORMAT", "/images/0"},
    {"/images/0/mimeType", "\"image/jpeg\"", "IMAGE_MIME_TYPE_INVALID", "/images/0/uri"},

    {"/cameras/0/type", "\"fisheye\"", "VALUE_NOT_IN_LIST", "/cameras/0/type"},
    {"/cameras/0/perspective", "", "UNDEFINED_PROPERTY", "/cameras/0"},
    {"/cameras/0/perspective/yfov", "0", "VALUE_NOT_IN_RANGE", "/cameras/0/perspective/yfov"},
    {"/cameras/0/perspective/yfov", "3.2", "VALUE_NOT_IN_RANGE", "/cameras/0/perspective/yfov"},
    {"/cameras/0/perspective/znear", "", "UNDEFINED_PROPERTY", "/cameras/0/perspective"},
    {"/cameras/0/perspective/zfar", "1", "CAMERA_ZFAR_LEQUAL_ZNEAR", "/cameras/0/perspective/zfar"},
    {"/cameras/1/orthographic/xmag", "0", "CAMERA_XMAG_YMAG_ZERO", "/cameras/1/orthographic/xmag"},
    {"/cameras/1/orthographic/zfar", "0", "CAMERA_ZFAR_LEQUAL_ZNEAR", "/cameras/1/orthographic/zfar"},

    {"/nodes/1/mesh", "1", "UNRESOLVED_REFERENCE", "/nodes/1/mesh"},
    {"/nodes/2/camera", "-2", "INVALID_INDEX", "/nodes/2/camera"},
    {"/nodes/1/skin", "0", "UNRESOLVED_REFERENCE", "/nodes/1/skin"},
    {"/nodes/0/children", "[1,9]", "UNRESOLVED_REFERENCE", "/nodes/0/children/1"},
    {"/nodes/0/children", "[1,1]", "DUPLICATE_ELEMENTS", "/nodes/0/children/1"},
    {"/nodes/0/children", "[0,1,2]", "NODE_LOOP", "/nodes/0"},
    {"/nodes/3/children", "[1]", "NODE_PARENT_OVERRIDE", "/nodes/3/children/0"},
    {"/nodes/2/children", "[0]", "NODE_LOOP", "/nodes/0"},
    {"/nodes/0/rotation", "[0,0,0,2]", "NODE_ROTATION_NON_UNIT", "/nodes/0/rotation"},
    {"/nodes/0/rotation", "[0,0,0,0]", "NODE_ROTATION_NON_UNIT", "/nodes/0/rotation"},
    {"/nodes/0/scale", "[1,1]", "ARRAY_LENGTH_NOT_IN_LIST", "/nodes/0/scale"},
    {"/nodes/0/scale/0", "null", "ARRAY_TYPE_MISMATCH", "/nodes/0/scale/0"},
    {"/nodes/0/scale", "[1e308,1e308,1e308]", "", ""},
    {"/nodes/0", "{\"children\":[1,2],\"scale\":[1e308,1,1],\"translation\":[1e308,0,0]}", "", ""},
    {"/nodes/3/scale", "[1,1,1]", "NODE_MATRIX_TRS", "/nodes/3/matrix"},
    {"/nodes/3/matrix/3", "0.5", "NODE_MATRIX_NON_TRS", "/nodes/3/matrix"},
    {"/nodes/3/matrix/0", "0", "VALUE_NOT_IN_RANGE", "/nodes/3"},  // the camera then has no direction
    {"/scenes/0/nodes", "[1]", "SCENE_NON_ROOT_NODE", "/scenes/0/nodes/0"},
    {"/scenes/0/nodes", "[0,0]", "DUPLICATE_ELEMENTS", "/scenes/0/nodes/1"},
    {"/scenes/0/nodes", "[4]", "UNRESOLVED_REFERENCE", "/scenes/0/nodes/0"},
    {"/scene", "1", "UNRESOLVED_REFERENCE", "/scene"},
};

}  // namespace

TEST_CASE("Draco data is not read as zeros") {
    GltfFile file = everything();
    file.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
    file.json["accessors"][0].erase("bufferView");
    file.json["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = Json::object();
    CHECK(refusal(to_bytes(file.document().dump())) ==
          "test.gltf: /meshes/0/primitives/0/extensions: expected plain data next to KHR_draco_mesh_compression, found "
          "none "
          "[UNSUPPORTED_EXTENSION]");
}

TEST_CASE("each fault of a glTF document is rejected at its JSON pointer with the validator's code") {
    REQUIRE(refusal(to_bytes(everything().document().dump())) == "");
    for (const Change& change : changes) {
        INFO(change.path << " = " << change.value);
        const std::string message = refusal_after(change), code = change.code;
        if (code.empty()) {
            CHECK(message == "");
            continue;
        }
        CHECK(message.starts_with("test.gltf: " + std::string(change.pointer) + ": expected "));
        // A change may cause two faults: the first reported one is at the changed value.
        CHECK(message.substr(0, message.find(" (and ")).ends_with(" [" + code + "]"));
    }
}
