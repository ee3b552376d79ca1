// Tests Git LFS pointers in place of each kind of file. The text is that which git-lfs writes.
#include "scenes/lfs_pointer.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "scenes/scene.h"
#include "tests/support/own_folder.h"

using namespace strata::scenes;

namespace {

constexpr const char* pointer =
    "version https://git-lfs.github.com/spec/v1\n"
    "oid sha256:4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\n"
    "size 12345\n";

// A triangle whose 36 bytes are in a separate file in the same folder.
constexpr const char* triangle =
    R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "triangle.bin"}]})";

}  // namespace

TEST_CASE(
    "a Git LFS pointer in place of a model or its buffer or triangles is reported with the command that fetches it") {
    const strata::test::OwnFolder folder;
    const auto file = [&](const char* name, const char* text) {
        const std::string path = folder.path() + "/" + name;
        std::ofstream{path} << text;
        return path;
    };
    file("triangle.bin", pointer);
    for (const std::string& path :
         {file("model.glb", pointer), file("triangle.gltf", triangle), file("triangles.json", pointer)}) {
        INFO(path);
        try {
            static_cast<void>(load_scene(path, {}));
            FAIL("was read");
        } catch (const strata::InputError& error) {
            const std::string message = error.what();
            CHECK(message.find("Git LFS pointer, run git lfs pull") != std::string::npos);
            CHECK((path.find(".gltf") == path.npos || message.find("'triangle.bin'") != std::string::npos));
        }
    }
    CHECK_FALSE(is_lfs_pointer("version 2"));
}
