// Tests the maps of `render --map` on planes whose number at each pixel is known. The expected colours are worked out
// by hand from the legend.
#include <catch2/catch.hpp>
#include <fstream>

#include "scenes/files/image_io.h"
#include "tests/tools/program.h"

using namespace strata::test;

namespace {

strata::pipeline::Image map_image(const Folder& folder, const std::string& scene, const std::string& map,
                                  const std::string& algorithm) {
    const CommandResult ended = run_strata(folder, {"render", scene, "--size", "32x24", "--algorithm", algorithm,
                                                    "--map", map, "-o", "map.png", "--no-audit"});
    INFO(ended.err);
    REQUIRE(ended.status == 0);
    return strata::scenes::read_images(folder / "map.png").at(0).image;
}

// Red, green and blue of a pixel in one number.
std::uint32_t color_at(const strata::pipeline::Image& image, int x, int y) {
    return image.codes[image.index(x, y, 0)] << 16 | image.codes[image.index(x, y, 1)] << 8 |
           image.codes[image.index(x, y, 2)];
}

std::string legend(const Folder& folder, const std::string& scene, const std::string& map,
                   const std::string& algorithm) {
    return run_strata(folder, {"render", scene, "--size", "32x24", "--algorithm", algorithm, "--map", map, "-o",
                               "m.png", "--no-audit"})
        .err;
}

}  // namespace

TEST_CASE("a map of the depth complexity is white where the most fragments are and black where there are none") {
    const Folder folder;
    const auto image = map_image(folder, "planes:count=3", "depth-complexity", "dual");
    CHECK(color_at(image, 16, 12) == 0xffffff);
    CHECK(color_at(image, 0, 0) == 0);
    CHECK(legend(folder, "planes:count=3", "depth-complexity", "dual") == "depth-complexity: black is 0, white is 3\n");
}

// Three fragments of one depth at every pixel, as `strata hard-cases --list` states.
TEST_CASE("a map of ties counts the fragments that share their depth with another one of the pixel") {
    const Folder folder;
    CHECK(legend(folder, "hard:case=coincident", "ties", "dual") == "ties: black is 0, white is 3\n");
    CHECK(legend(folder, "planes:count=4", "ties", "dual") == "ties: black is 0, white is 0\n");
    CHECK(color_at(map_image(folder, "hard:case=coincident", "ties", "dual"), 16, 12) == 0xffffff);
    CHECK(color_at(map_image(folder, "planes:count=4", "ties", "dual"), 16, 12) == 0);
}

// One triangle, drawn opaque and again, at the same position, blended.
TEST_CASE("a map of ties with opaque surfaces counts the fragments at exactly the depth of the surface behind them") {
    const Folder folder;
    std::ofstream(folder / "coplanar.gltf")
        << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0},{"attributes":{"POSITION":0},"material":1}]}],
"materials":[{"doubleSided":true},{"doubleSided":true,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]})";
    CHECK(legend(folder, "coplanar.gltf", "opaque-ties", "dual") == "opaque-ties: black is 0, white is 1\n");
    CHECK(legend(folder, "planes:count=4", "opaque-ties", "dual") == "opaque-ties: black is 0, white is 0\n");
    const auto image = map_image(folder, "coplanar.gltf", "opaque-ties", "dual");
    CHECK(color_at(image, 16, 12) == 0xffffff);
    CHECK(color_at(image, 0, 0) == 0);
    const CommandResult told =
        run_strata(folder, {"render", "coplanar.gltf", "--size", "32x24", "--algorithm", "dual"});
    CHECK_THAT(told.out + told.err, Catch::Contains("LESS hides them, LEQUAL would show them"));
}

TEST_CASE("a map of the error is black for the exact picture and shows the wrong pixels of another one") {
    const Folder folder;
    CHECK(legend(folder, "planes:count=3", "error", "a_buffer") == "error: black is 0, white is 0 of 255\n");
    const auto wrong = map_image(folder, "volume-beam:slices=4,order=near", "error", "unsorted");
    std::size_t lit = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x) lit += color_at(wrong, x, y) != 0 ? 1 : 0;
    CHECK(lit > 20);
    CHECK(lit < 32 * 24);
}

TEST_CASE("the command stored in a map makes it again and a map requires a picture file") {
    const Folder folder;
    static_cast<void>(map_image(folder, "planes:count=3", "ties", "dual"));
    CHECK(lines_of(run_strata(folder, {"info", "map.png"}).out).at(0).ends_with("--map ties"));
    REQUIRE(run_strata(folder, {"render", "--from", "map.png", "-o", "again.png"}).status == 0);
    CHECK(content_of(folder / "again.png") == content_of(folder / "map.png"));
    CHECK(run_strata(folder, {"render", "planes", "--map", "ties"}).err == "strata: --map needs -o FILE.png\n");
    CHECK(run_strata(folder, {"render", "planes", "--map", "ties", "-o", "x.exr"}).status == 2);
}

TEST_CASE("a sheet of layers has a row of colour and depth per layer") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"layers", "planes:count=3", "--size", "64x24", "-o", "sheet.png"}).status == 0);
    const auto three = strata::scenes::read_images(folder / "sheet.png").at(0).image;
    REQUIRE(run_strata(folder, {"layers", "planes:count=5", "--size", "64x24", "-o", "sheet.png"}).status == 0);
    const auto five = strata::scenes::read_images(folder / "sheet.png").at(0).image;
    CHECK(five.width == three.width);
    CHECK(five.height - three.height == 2 * (2 * 24 + 4));
}
