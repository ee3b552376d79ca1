// Tests that bugs which users report of their ports are diagnosed. Each picture is computed here from the panes of its
// scene, not by the implementation of the mistake under test. The panes are squares parallel to the image plane,
// blended pixel by pixel in binary64.
#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <functional>

#include "tests/tools/program.h"
#include "tests/tools/strata/diagnose/named.h"

using namespace strata::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

// A square with axis-parallel edges from `low` to `high` in x and y, at depth z; colour not premultiplied, and alpha.
struct Pane {
    double low, high, z;
    std::array<double, 4> color;
    [[nodiscard]] bool covers(int column, int row, int side) const {
        const double x = (column + 0.5) * 2 / side - 1, y = 1 - (row + 0.5) * 2 / side;
        return x > low && x < high && y > low && y < high;
    }
};

void write_scene(const Folder& folder, const std::string& name, const std::vector<Pane>& panes) {
    std::string positions, colors;
    for (const Pane& pane : panes) {
        const double a = pane.low, b = pane.high;
        const double corners[6][2] = {{a, a}, {b, a}, {b, b}, {a, a}, {b, b}, {a, b}};
        for (const auto& corner : corners) {
            const char* const comma = positions.empty() ? "" : ",";
            positions += fmt::format("{}[{},{},{}]", comma, corner[0], corner[1], pane.z);
            colors += fmt::format("{}[{}]", comma, fmt::join(pane.color, ","));
        }
    }
    const char* const identity = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
    const char* const to_clip = "[1,0,0,0,0,1,0,0,0,0,-1,0,0,0,0,1]";
    std::ofstream{folder / name} << fmt::format(
        R"({{"positions": [{}], "colors": [{}], "view": {}, "projection": {}}})", positions, colors, identity, to_clip);
}

using Rgb = std::array<int, 3>;

void write_picture(const Folder& folder, const std::string& name, int side,
                   const std::function<Rgb(int column, int row)>& color) {
    std::ofstream out{folder / name, std::ios::binary};
    out << fmt::format("P6 {} {} 255\n", side, side);
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            for (const int code : color(column, row)) out.put(static_cast<char>(code));
}

// OVER in binary64: only the stored target is rounded to codes.
Rgb blended(const Rgb& behind, const std::array<double, 4>& over) {
    Rgb result{};
    for (std::size_t c = 0; c < 3; ++c)
        result[c] = static_cast<int>(std::floor(over[c] * over[3] * 255 + (1 - over[3]) * behind[c] + 0.5));
    return result;
}

}  // namespace

TEST_CASE("blended surfaces that write depth are diagnosed because surfaces behind an earlier one are lost") {
    const Folder folder;
    constexpr int side = 32;
    // The middle pane, the nearest, the farthest. The farthest fails the depth test wherever one of the others covers
    // it.
    const std::vector<Pane> panes{
        {-0.5, 0.7, 0, {0, 1, 0, 0.5}}, {-0.8, 0.4, 0.5, {1, 0, 0, 0.5}}, {-0.3, 0.9, -0.5, {0, 0, 1, 0.25}}};
    write_scene(folder, "panes.json", panes);
    write_picture(folder, "written.ppm", side, [&](int column, int row) {
        Rgb color{};
        double nearest = -1;
        for (const Pane& pane : panes) {
            if (!pane.covers(column, row, side) || pane.z <= nearest) continue;
            color = blended(color, pane.color);
            nearest = pane.z;
        }
        return color;
    });
    for (const char* algorithm : {"unsorted", "painter", "front_to_back", "dual", "weighted_sum"}) {
        const CommandResult found =
            run_strata(folder, {"diagnose", "panes.json", "written.ppm", "--algorithm", algorithm});
        INFO(algorithm << found.out << found.err);
        CHECK(found.status == 1);
        CHECK_THAT(found.out, StartsWith("wrong: "));
        CHECK_THAT(lines_of(found.out).at(0) + named_emulation(found), Contains("blended surfaces write depth"));
    }
}

TEST_CASE("a pixel centre on an edge that both triangles or neither draw is diagnosed by diagnose and by compare") {
    const Folder folder;
    constexpr int side = 32;
    const Pane pane{-0.75, 0.75, 0, {1, 0.5, 0, 0.5}};
    write_scene(folder, "fade.json", {pane});
    for (const int times : {0, 2}) {
        write_picture(folder, "edge.ppm", side, [&](int column, int row) {
            Rgb color{};
            const int drawn = !pane.covers(column, row, side) ? 0 : column == side - 1 - row ? times : 1;
            for (int i = 0; i < drawn; ++i) color = blended(color, pane.color);
            return color;
        });
        for (const char* command : {"diagnose", "compare"}) {
            const CommandResult found = run_strata(folder, {command, "fade.json", "edge.ppm"});
            INFO(command << times << found.out << found.err);
            CHECK(found.status == 1);
            CHECK_THAT(found.out, StartsWith(fmt::format("wrong: a centre on an edge is drawn by {} triangle",
                                                         times == 0 ? "neither" : "both")));
            CHECK_THAT(found.out, Contains("explains all 24 pixels that it affects"));
        }
    }
}

TEST_CASE("a peel with too few passes is diagnosed with their number") {
    const Folder folder;
    std::vector<Pane> panes;
    for (int i = 0; i < 6; ++i)
        panes.push_back(
            {-0.9 + 0.08 * i, 0.5 + 0.08 * i, -0.6 + 0.2 * ((5 * i) % 6), {0.1 * i, 0.5, 1 - 0.1 * i, 0.4}});
    write_scene(folder, "stack.json", panes);
    for (const std::string passes : {"1", "2", "3", "4", "5"}) {
        REQUIRE(shell(folder,
                      "strata render stack.json --size 24x24 --background 0.2,0.3,0.5 -q --algorithm "
                      "front_to_back --max-passes " +
                          passes + " -o few.png")
                    .status == 0);
        const CommandResult found = run_strata(folder, {"diagnose", "stack.json", "few.png", "--algorithm",
                                                        "front_to_back", "--background", "0.2,0.3,0.5"});
        INFO(found.out);
        CHECK(found.status == 1);
        const std::string layers = passes == "1" ? "layer" : passes + " layers";
        CHECK_THAT(found.out, StartsWith("wrong: "));
        CHECK_THAT(named_emulation(found), StartsWith("only the nearest " + layers + " of 6 (--max-passes "));
    }
    REQUIRE(
        shell(folder, "strata render stack.json --size 24x24 -q --algorithm dual --max-passes 2 -o few.png").status ==
        0);
    const CommandResult dual = run_strata(folder, {"diagnose", "stack.json", "few.png", "--algorithm", "dual"});
    CHECK_THAT(dual.out, StartsWith("wrong: "));
    CHECK_THAT(named_emulation(dual), StartsWith("only the first 2 passes of 4 (--max-passes 2)"));
}

TEST_CASE("passes with two vertex programs are diagnosed with both of them") {
    const Folder folder;
    int different = 0;
    for (const std::string algorithm : {"front_to_back", "dual"})
        for (const std::string paths : {"separate,fused", "separate,double"}) {
            const std::string draw = "strata render teapot --alpha 0.5 --size 64x48 -q --algorithm " + algorithm;
            REQUIRE(
                shell(folder, draw + " -o right.png && " + draw + " --vertex-path " + paths + " -o port.png").status ==
                0);
            if (run_strata(folder, {"compare", "right.png", "port.png"}).status == 0) continue;
            ++different;
            const CommandResult found =
                run_strata(folder, {"diagnose", "teapot", "port.png", "--alpha", "0.5", "--algorithm", algorithm});
            INFO(algorithm << found.out);
            CHECK(found.status == 1);
            CHECK_THAT(found.out, Contains("passes after the first compute other depths: --vertex-path " + paths));
        }
    CHECK(different >= 2);
}

TEST_CASE("a picture of another processor is recognised as that of its profile") {
    const Folder folder;
    REQUIRE(shell(folder, "strata render teapot --size 96x72 --algorithm dual --profile llvmpipe_sse -q -o theirs.png")
                .status == 0);
    const CommandResult found = run_strata(folder, {"diagnose", "teapot", "theirs.png", "--profile", "llvmpipe", "-q"});
    INFO(found.out);
    CHECK(found.status == 0);
    CHECK(named_emulation(found) == "profile llvmpipe_sse");
}

TEST_CASE("a mistake that no list names is fitted by diagnose: every second layer with red and blue exchanged") {
    const Folder folder;
    constexpr int side = 40;
    std::vector<Pane> panes;
    for (int i = 0; i < 6; ++i)
        panes.push_back(
            {-0.9 + 0.08 * i, 0.5 + 0.08 * i, -0.6 + 0.2 * ((5 * i) % 6), {0.15 * i, 0.47, 0.95 - 0.11 * i, 0.37}});
    write_scene(folder, "stack.json", panes);
    std::ranges::sort(panes, std::ranges::greater{}, &Pane::z);
    write_picture(folder, "port.ppm", side, [&](int column, int row) {
        std::vector<Pane> layers;  // the nearest first
        for (const Pane& pane : panes)
            if (pane.covers(column, row, side)) layers.push_back(pane);
        Rgb color{51, 77, 128};
        for (std::size_t i = layers.size(); i-- > 0;) {
            if (i % 2 == 1) std::swap(layers[i].color[0], layers[i].color[2]);
            color = blended(color, layers[i].color);
        }
        return color;
    });
    const CommandResult found =
        run_strata(folder, {"diagnose", "stack.json", "port.ppm", "--background", "0.2,0.3,0.5"});
    INFO(found.out);
    CHECK(found.status == 1);
    CHECK(lines_of(found.out).at(0) == "wrong: fragments of odd ranks from the front have red and blue exchanged");
}

TEST_CASE("blends of sources that are not codes are accepted as another rounding for every algorithm") {
    const Folder folder;
    constexpr int side = 40;
    std::vector<Pane> panes;
    for (int i = 0; i < 6; ++i)
        panes.push_back(
            {-0.9 + 0.08 * i, 0.5 + 0.08 * i, -0.6 + 0.2 * ((5 * i) % 6), {0.15 * i, 0.47, 0.95 - 0.11 * i, 0.37}});
    write_scene(folder, "stack.json", panes);
    const auto picture_of = [&](const std::vector<Pane>& ordered) {
        return [&, ordered](int column, int row) {
            Rgb color{51, 77, 128};
            for (const Pane& pane : ordered)
                if (pane.covers(column, row, side)) color = blended(color, pane.color);
            return color;
        };
    };
    write_picture(folder, "as_it_came.ppm", side, picture_of(panes));
    std::ranges::sort(panes, {}, &Pane::z);
    write_picture(folder, "sorted.ppm", side, picture_of(panes));
    const std::pair<const char*, const char*> right[] = {
        {"unsorted", "as_it_came.ppm"}, {"painter", "sorted.ppm"}, {"dual", "sorted.ppm"}};
    for (const auto& [algorithm, picture] : right) {
        const CommandResult found = run_strata(
            folder, {"diagnose", "stack.json", picture, "--algorithm", algorithm, "--background", "0.2,0.3,0.5"});
        INFO(algorithm << found.out);
        CHECK(found.status == 0);
        CHECK_THAT(found.out, StartsWith("right"));
        CHECK(found.out.find("order of submission") == std::string::npos);
    }
}

namespace {

// A half transparent square at `decal` (base64 of its four corners) on an opaque one at z = 0; a third one is hidden
// behind.
void write_decal(const Folder& folder, const std::string& name, const std::string& decal) {
    constexpr const char* indices = "AAABAAIAAAACAAMA";
    constexpr const char* opaque = "zcxMv83MTL8AAAAAzcxMP83MTL8AAAAAzcxMP83MTD8AAAAAzcxMv83MTD8AAAAA";
    constexpr const char* hidden = "mpmZvpqZmb4AAAC/mpmZPpqZmb4AAAC/mpmZPpqZmT4AAAC/mpmZvpqZmT4AAAC/";
    std::string buffers =
        fmt::format(R"({{"byteLength": 12, "uri": "data:application/octet-stream;base64,{}"}})", indices);
    std::string views = R"({"buffer": 0, "byteLength": 12})", nodes, meshes, materials;
    std::string accessors = R"({"bufferView": 0, "componentType": 5123, "count": 6, "type": "SCALAR"})";
    const std::pair<const char*, std::string> squares[] = {{"OPAQUE", opaque}, {"BLEND", decal}, {"BLEND", hidden}};
    for (int i = 0; i < 3; ++i) {
        const char* const comma = i == 0 ? "" : ",";
        buffers += fmt::format(R"(,{{"byteLength": 48, "uri": "data:application/octet-stream;base64,{}"}})",
                               squares[i].second);
        views += fmt::format(R"(,{{"buffer": {}, "byteLength": 48}})", i + 1);
        accessors += fmt::format(R"(,{{"bufferView": {0}, "componentType": 5126, "count": 4, "type": "VEC3", )"
                                 R"("min": [-1, -1, -1], "max": [1, 1, 1]}})",
                                 i + 1);
        nodes += fmt::format(R"({}{{"mesh": {}}})", comma, i);
        meshes += fmt::format(
            R"({0}{{"primitives": [{{"attributes": {{"POSITION": {1}}}, "indices": 0, "material": {2}}}]}})", comma,
            i + 1, i);
        materials +=
            fmt::format(R"({}{{"alphaMode": "{}", "extensions": {{"KHR_materials_unlit": {{}}}}, "doubleSided": true, )"
                        R"("pbrMetallicRoughness": {{"baseColorFactor": [{}, 0.4, {}, {}]}}}})",
                        comma, squares[i].first, 0.2 + 0.3 * i, 0.9 - 0.3 * i, i == 0 ? 1.0 : 0.5);
    }
    std::ofstream{folder / name} << fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "extensionsUsed": ["KHR_materials_unlit"], "scene": 0, )"
        R"("scenes": [{{"nodes": [0, 1, 2]}}], "nodes": [{}], "meshes": [{}], "materials": [{}], "accessors": [{}], )"
        R"("bufferViews": [{}], "buffers": [{}]}})",
        nodes, meshes, materials, accessors, views, buffers);
}

}  // namespace

TEST_CASE("a blended square at the depth of an opaque one is diagnosed as LEQUAL in place of LESS for every peel") {
    const Folder folder;
    write_decal(folder, "on.gltf", "zczMvs3MzL4AAAAAzczMPs3MzL4AAAAAzczMPs3MzD4AAAAAzczMvs3MzD4AAAAA");
    write_decal(folder, "before.gltf", "zczMvs3MzL4AAIA8zczMPs3MzL4AAIA8zczMPs3MzD4AAIA8zczMvs3MzD4AAIA8");
    std::ofstream{folder / "front.json"}
        << R"({"eye": [0, 0, 3], "center": [0, 0, 0], "up": [0, 1, 0], "fovy_degrees": 36.87, "near": 0.5, "far": 10})";
    REQUIRE(
        shell(folder, "strata render before.gltf --camera front.json --size 48x48 --algorithm dual -q -o lequal.png")
            .status == 0);
    for (const char* algorithm : {"dual", "layer_peel", "hybrid", "coherent_stencil", "stencil_routed_k_buffer"}) {
        const CommandResult found = run_strata(
            folder, {"diagnose", "on.gltf", "lequal.png", "--camera", "front.json", "--algorithm", algorithm, "-q"});
        INFO(algorithm << found.out << found.err);
        CHECK(found.status == 1);
        CHECK_THAT(found.out,
                   StartsWith("wrong: layers at the depth of an opaque surface are composited: LEQUAL for LESS"));
    }
}

TEST_CASE(
    "triangles of one colour that a port keeps unchanged are accepted as an option and not diagnosed as wrong slopes") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "echo '{\"base\": \"llvmpipe\", \"name\": \"uniforms\", \"raster\": {\"equal_colors\": \"kept\"}}' > "
                  "u.json;"
                  "strata render planes:count=5 --orbit 50,30 --size 32x32 --color-format rgba32f --profile u.json "
                  "-q -o flat.exr")
                .status == 0);
    const CommandResult found = run_strata(folder, {"diagnose", "planes:count=5", "flat.exr", "--orbit", "50,30",
                                                    "--color-format", "rgba32f", "--profile", "llvmpipe", "-q"});
    INFO(found.out);
    CHECK(found.status == 0);
    CHECK_THAT(named_emulation(found), StartsWith("triangles of one colour"));
    CHECK(found.out.find("colors_affine") == std::string::npos);
    CHECK(found.out.find("colors_unnormalised") == std::string::npos);
}
