// Tests golden packs: an intact one, ones with a changed byte, and the pictures and options of an ordinary run.
#include "tools/oracle/pack/golden.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/check.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/files/profile_json.h"
#include "scenes/packs/pack_files.h"
#include "scenes/packs/pack_scene.h"
#include "tests/support/own_folder.h"
#include "tools/oracle/pack/state_json.h"
#include "tools/oracle/pack/target_json.h"

using namespace strata;
using namespace strata::oracle;
using Catch::Contains;

namespace {

namespace files = std::filesystem;

Golden small_golden(const std::string& scene, const std::vector<std::string>& algorithms,
                    const char* profile = "ideal") {
    Golden golden{.scene = scenes::load_scene(scene, {}), .profile = *pipeline::find_profile(profile)};
    golden.options.width = 12;
    golden.options.height = 10;
    golden.options.threads = 1;
    if (!golden.scene.own_view) golden.scene.own_view = scenes::orbit_view(golden.scene.bounds, 30, 20, 1.2);
    for (const std::string& name : algorithms) golden.algorithms.push_back(peeling::find_algorithm(name));
    golden.command = "strata golden";
    return golden;
}

std::string bytes_of_file(const files::path& path) {
    std::ifstream in{path, std::ios::binary};
    return {std::istreambuf_iterator<char>{in}, {}};
}

void put_bytes(const files::path& path, const std::string& bytes) {
    std::ofstream{path, std::ios::binary | std::ios::trunc} << bytes;
}

std::vector<files::path> files_below(const std::string& folder) {
    std::vector<files::path> found;
    for (const auto& entry : files::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
}

}  // namespace

TEST_CASE("an intact pack passes its check and a changed byte is reported with its file and offset and values") {
    const test::OwnFolder folder;
    const std::string pack = folder.path() + "/pack";
    write_pack(small_golden("planes:count=2,cells=1", {"front_to_back", "dual", "stencil_routed_k_buffer"}), pack);
    CHECK(check_pack(pack).empty());
    CHECK(check_pack(pack + "/manifest.json").empty());
    std::size_t step = 0, named = 0, changed = 0;
    for (const files::path& path : files_below(pack)) {
        const std::string whole = bytes_of_file(path), name = files::relative(path, pack).generic_string();
        if (name == "manifest.json" || whole.empty()) continue;
        const std::size_t position = whole.size() - 1 - (step++ * 37) % (whole.size() / 2);
        std::string other = whole;
        other[position] = static_cast<char>(other[position] ^ 0x11);
        put_bytes(path, other);
        const auto faults = check_pack(pack);
        put_bytes(path, whole);
        ++changed;
        INFO(name << " byte " << position);
        REQUIRE_FALSE(faults.empty());
        CHECK(faults[0].file == name);
        CHECK_THAT(faults[0].message,
                   Contains("byte " + std::to_string(position)) &&
                       Contains("expected " + std::to_string(static_cast<unsigned char>(whole[position]))) &&
                       Contains("found " + std::to_string(static_cast<unsigned char>(other[position]))));
        named += faults.size() == 1 ? 1 : 0;
    }
    CHECK(changed > 60);
    CHECK(named == changed);
    CHECK(check_pack(pack).empty());
}

TEST_CASE("a pack whose profile lacks later fields is read and checked with their defaults") {
    const test::OwnFolder folder;
    const std::string pack = folder.path() + "/pack";
    Golden golden = small_golden("planes:count=2", {"dual"}, "geforce8");
    write_pack(golden, pack);
    nlohmann::json profile = nlohmann::json::parse(bytes_of_file(pack + "/profile.json"));
    for (const char* key : {"origin", "clip_depth", "depth_order", "depth24", "blend_storage"})
        REQUIRE(profile.erase(key) == 1);
    for (const char* key : {"y_axis", "equal_colors", "plane_corners"}) REQUIRE(profile["raster"].erase(key) == 1);
    const auto put = [&](const nlohmann::json& changed) {
        scenes::PackFiles listed{
            [&](const std::string& name, const std::string& bytes) { put_bytes(pack + "/" + name, bytes); }};
        listed.add_text("profile.json", changed.dump());
        auto manifest = nlohmann::ordered_json::parse(bytes_of_file(pack + "/manifest.json"));
        manifest["files"]["profile.json"] = listed.list()["profile.json"];
        put_bytes(pack + "/manifest.json", manifest.dump(1) + '\n');
    };
    put(profile);
    CHECK(read_pack(pack).profile == golden.profile);
    CHECK(check_pack(pack).empty());
    // Another value gives other files, and a field of the first version is required.
    profile["raster"]["subpixel_bits"] = 4;
    put(profile);
    CHECK_FALSE(check_pack(pack).empty());
    profile.erase("blend_rounding");
    put(profile);
    CHECK_THROWS_WITH(read_pack(pack), Contains("/blend_rounding: expected one of"));
}

TEST_CASE("a check finds missing or extra files or a changed manifest or two changed bytes of an input") {
    const test::OwnFolder folder;
    const std::string pack = folder.path() + "/pack";
    write_pack(small_golden("planes:count=1,cells=1", {"front_to_back"}), pack);
    const std::string picture = pack + "/expected/front_to_back/picture.npy", whole = bytes_of_file(picture);
    files::remove(picture);
    REQUIRE(check_pack(pack).size() == 1);
    CHECK(check_pack(pack)[0].message == "no such file");
    put_bytes(picture, whole.substr(0, whole.size() - 1));
    CHECK_THAT(check_pack(pack).at(0).message, Contains("several bytes have changed"));
    put_bytes(picture, whole);
    put_bytes(pack + "/expected/notes.txt", "x");
    CHECK(check_pack(pack).at(0).file == "expected/notes.txt");
    files::remove(pack + "/expected/notes.txt");
    const std::string positions = pack + "/scene/mesh.000.positions.npy", corners = bytes_of_file(positions);
    std::string other = corners;
    other[130] = static_cast<char>(other[130] ^ 3);
    other[140] = static_cast<char>(other[140] ^ 5);
    put_bytes(positions, other);
    CHECK(check_pack(pack).at(0).file == "scene/mesh.000.positions.npy");
    put_bytes(positions, corners);
    // Changes a digest, a count and a name of the manifest.
    const std::string manifest = pack + "/manifest.json", text = bytes_of_file(manifest);
    for (const auto& [what, by] : {std::pair{"\"kind\": \"geometry\"", "\"kind\": \"geometries\""},
                                   std::pair{"\"goes_on\": true", "\"goes_on\": false"},
                                   std::pair{"\"passed\": ", "\"passed\": 1"}, std::pair{"{\n", "{\n\n"}}) {
        std::string wrong = text;
        INFO(what);
        REQUIRE(wrong.find(what) != std::string::npos);
        wrong.replace(wrong.find(what), std::string{what}.size(), by);
        put_bytes(manifest, wrong);
        CHECK(check_pack(pack).at(0).file == "manifest.json");
    }
    put_bytes(manifest, text);
    CHECK(check_pack(pack).empty());
    CHECK_THROWS_WITH(write_pack(small_golden("planes:count=1,cells=1", {"dual"}), pack),
                      Contains("is not empty: expected a new or an empty folder"));
    CHECK(check_pack(pack).empty());
    // A rejected algorithm leaves no folder.
    CHECK_THROWS_AS(write_pack(small_golden("planes:count=1", {"dual"}, "geforce3"), folder.path() + "/none"),
                    pipeline::Refused);
    CHECK_FALSE(files::exists(folder.path() + "/none"));
}

TEST_CASE("a pack has the results of an ordinary run for every algorithm and every state") {
    struct State {
        const char* profile;
        void (*set)(peeling::RenderOptions& options);
    };
    const State states[] = {
        {"ideal", [](peeling::RenderOptions&) {}},
        {"geforce3", [](peeling::RenderOptions& o) { o.sort = {.rule = peeling::SortRule::exact}; }},
        {"geforce8",
         [](peeling::RenderOptions& o) {
             o.depth = pipeline::DepthFormat::d24;
             o.color_format = pipeline::Format::rgba16f;
             o.alpha = 0.3f;
             o.background = {0.1f, 0.2f, 0.3f, 1};
             o.termination = {.rule = pipeline::TerminationRule::fixed, .passes = 2};
             o.raster.scissor = rasterizer::Rect{1, 2, 9, 7};
         }},
        {"ideal",
         [](peeling::RenderOptions& o) {
             o.raster.depth_order = rasterizer::DepthOrder::greater;
             o.raster.clip_depth = rasterizer::ClipDepth::zero_to_one;
             o.raster.polygon_offset = {true, 0.5f, 1};
             o.vertex_paths.second = pipeline::VertexPath::fused;
             o.sort = {.rule = peeling::SortRule::shuffle, .fraction = 0.5, .seed = ~std::uint64_t{0}};
             o.sorted = {"plane"};
         }},
    };
    int ran = 0;
    for (const State& state : states)
        for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
            Golden golden = small_golden("random:triangles=12,seed=3", {algorithm.name}, state.profile);
            state.set(golden.options);
            const rasterizer::RasterState& raster = golden.options.raster;
            golden.scene.own_view =
                scenes::with_clip_convention(*golden.scene.own_view, {}, {raster.clip_depth, raster.depth_order});
            peeling::Renderer renderer{golden.scene.list, *golden.scene.own_view, golden.profile, golden.options};
            const peeling::RenderResult usual = renderer.render(algorithm);
            if (usual.refusal) continue;
            ++ran;
            INFO(state.profile << ' ' << algorithm.name);
            const test::OwnFolder folder;
            const std::string pack = folder.path() + "/pack";
            write_pack(golden, pack);
            const nlohmann::json manifest = scenes::read_manifest(pack);
            const nlohmann::json& result = manifest["results"][0];
            const auto target = [&](const nlohmann::json& described, pipeline::Format format) {
                return as_image(scenes::read_npy(pack + "/" + described["file"].get<std::string>()), format,
                                described["samples"].get<int>());
            };
            CHECK(target(result["picture"], usual.frame.color.format) == usual.frame.color);
            CHECK(target(result["depth"], usual.frame.depth.format) == usual.frame.depth);
            CHECK(result["picture"]["digest"] == pipeline::digest(usual.frame.color));
            CHECK(result["geometry_passes"] == usual.frame.passes.geometry);
            CHECK(result["full_screen_passes"] == usual.frame.passes.full_screen);
            CHECK(result["layers"].empty() != algorithm.makes_layers);
            const Golden back = read_pack(pack);
            CHECK(state_json(back.options, back.profile) == state_json(golden.options, golden.profile));
            CHECK(back.algorithms == golden.algorithms);
            CHECK(back.profile == golden.profile);
        }
    CHECK(ran > 40);
}

TEST_CASE("digests of a target's channels and tiles are those of their codes") {
    pipeline::Image image{pipeline::Format::rgba8, 18, 17};
    for (std::size_t i = 0; i < image.codes.size(); ++i) image.codes[i] = static_cast<std::uint32_t>(i * 7 % 256);
    scenes::PackFiles files{[](const std::string&, const std::string&) {}};
    TargetWriter writer{"expected/x", files};
    const auto object = writer.write("", "picture", image);
    std::string green;
    for (std::size_t i = 1; i < image.codes.size(); i += 4) green += static_cast<char>(image.codes[i]);
    CHECK(object["channels"][1] == scenes::digest_of_bytes(green));
    REQUIRE(object["tiles"].size() == 4);
    pipeline::Image corner{pipeline::Format::rgba8, 2, 1};
    for (int x = 0; x < 2; ++x)
        for (int c = 0; c < 4; ++c) corner.codes[corner.index(x, 0, c)] = image.codes[image.index(16 + x, 16, c)];
    CHECK(object["tiles"][3] == pipeline::digest(corner));
    CHECK(object["file"] == "expected/x/picture.npy");
    CHECK(writer.write_once("pass.001/", "picture", image)["file"] == "expected/x/picture.npy");
    image.codes[5] ^= 1;
    CHECK(writer.write_once("pass.002/", "picture", image)["file"] == "expected/x/pass.002/picture.npy");
}
