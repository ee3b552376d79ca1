// Tests the notes on glTF files of one triangle whose material is opaque, masked or blended.
#include <catch2/catch.hpp>
#include <fstream>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

void write_triangle(const std::string& path, const std::string& alpha_mode) {
    std::ofstream(path) << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],"materials":[{"alphaMode":")"
                        << alpha_mode << R"(","doubleSided":true}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]})";
}

}  // namespace

TEST_CASE("a scene in which nothing is transparent is reported with the option to use") {
    const auto mode = GENERATE(as<std::string>{}, "OPAQUE", "MASK", "BLEND");
    const Folder folder;
    write_triangle(folder / "a.gltf", mode);
    const CommandResult plain = run_strata(folder, {"render", "a.gltf", "--size", "16x16"});
    CHECK(plain.status == 0);
    CHECK(plain.err == (mode == "BLEND"
                            ? ""
                            : "strata: warning: a.gltf: nothing is transparent, so there is nothing to peel; "
                              "--alpha 0.5 draws everything as half transparent, --alpha MATERIAL=0.5 one material\n"));
    CHECK(run_strata(folder, {"render", "a.gltf", "--size", "16x16", "--alpha", "0.5"}).err.empty());
}

TEST_CASE("a scene file without triangles is reported with the options to use") {
    const Folder folder;
    const CommandResult ended = run_strata(folder, {"render", "random:triangles=0", "--size", "16x16"});
    CHECK(ended.status == 0);
    CHECK(ended.err ==
          "strata: warning: random:triangles=0: nothing is drawn, because the scene has no triangles; strata scene "
          "lists the file's scenes, --scene N chooses one\n");
}

TEST_CASE("scene lists the materials of each alpha mode and the alpha that OPAQUE ignores") {
    const Folder folder;
    std::ofstream(folder / "a.gltf") << R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[
{"attributes":{"POSITION":0,"COLOR_0":1},"material":0},{"attributes":{"POSITION":0},"material":1},
{"attributes":{"POSITION":0},"material":2},{"attributes":{"POSITION":0},"material":3},
{"attributes":{"POSITION":0},"material":4},{"attributes":{"POSITION":0},"material":5}]}],"materials":[
{"name":"pane","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}},{"name":"glass","alphaMode":"BLEND"},{"name":"wall"},
{"name":"leaf","alphaMode":"MASK","alphaCutoff":0.25},{"name":"chain","alphaMode":"MASK"},
{"name":"plant","alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]}}],
"accessors":[{"componentType":5126,"count":3,"type":"VEC3"},{"componentType":5126,"count":3,"type":"VEC4"}]})";
    const CommandResult found = run_strata(folder, {"scene", "a.gltf"});
    CHECK(found.status == 0);
    for (const std::string line :
         {"  OPAQUE    2 (pane, wall)\n", "  BLEND     1 (glass)\n",
          "alpha lost  pane (factor, vertex colours): drawn with alpha 1, because the mode is "
          "OPAQUE; MASK or BLEND in the file keeps the alpha\n",
          "  MASK      3 (leaf from alpha 0.25, chain from alpha 0.5, plant: never drawn)\n"}) {
        INFO(found.out);
        CHECK(found.out.find(line) != std::string::npos);
    }
}
