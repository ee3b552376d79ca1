// Tests packs of all samples: results against frames of the samples, reading back, and what a check and a comparison
// say of a changed sample.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/packs/pack_scene.h"
#include "tests/support/own_folder.h"
#include "tools/oracle/pack/compare_packs.h"
#include "tools/oracle/pack/golden.h"
#include "tools/oracle/pack/state_json.h"
#include "tools/oracle/pack/target_json.h"

using namespace strata;
using namespace strata::oracle;
using Catch::Contains;
using nlohmann::json;

namespace {

Golden sampled_golden(const peeling::Multisampling& sampling, const std::string& profile = "geforce8") {
    Golden golden{.scene = scenes::load_scene("random:triangles=12,seed=3", {}),
                  .profile = *pipeline::find_profile(profile)};
    golden.options.width = 12;
    golden.options.height = 10;
    golden.options.threads = 1;
    golden.options.alpha = 0.5f;
    golden.options.sampling = sampling;
    golden.scene.own_view = scenes::orbit_view(golden.scene.bounds, 30, 20, 1.2);
    golden.algorithms = {peeling::find_algorithm("front_to_back")};
    golden.command = "strata golden";
    return golden;
}

pipeline::Image image_in(const std::string& pack, const json& described, pipeline::Format format) {
    const auto image = as_image(scenes::read_npy(pack + "/" + described["file"].get<std::string>()), format,
                                described["samples"].get<int>());
    REQUIRE(image.has_value());
    return *image;
}

}  // namespace

TEST_CASE("a pack of all samples has their passes and the resolved picture and is read back") {
    const auto set = GENERATE(as<int>{}, 0, 1, 2, 3);
    Golden golden = sampled_golden({.samples = set == 0 ? 2 : 4});
    if (set == 1) golden.options.raster.interpolation = rasterizer::Interpolation::centroid;
    if (set == 2) golden.options.sampling.loads = pipeline::LoadedSample::resolved;
    if (set == 2) golden.options.sampling.composites = pipeline::LoadedSample::zero;
    if (set == 3) golden.options.raster.sample_coverage = {.by_alpha = true, .value = 0.75f, .mask = 13};
    const peeling::Algorithm& algorithm = *golden.algorithms[0];
    golden.options.keep_layers = true;
    const peeling::RenderResult usual =
        peeling::Renderer{golden.scene.list, *golden.scene.own_view, golden.profile, golden.options}.render(algorithm);
    golden.options.keep_layers = false;
    const test::OwnFolder folder;
    const std::string pack = folder.path() + "/pack";
    write_pack(golden, pack, Copies::exr);
    const json manifest = scenes::read_manifest(pack);
    const json& result = manifest["results"][0];
    CHECK(image_in(pack, result["picture"], usual.frame.color.format) == usual.frame.color);
    CHECK(image_in(pack, result["depth"], usual.frame.depth.format) == usual.frame.depth);
    REQUIRE(result["layers"].size() == usual.frame.layers.size());
    for (std::size_t k = 0; k < usual.frame.layers.size(); ++k) {
        const pipeline::PeeledLayer& layer = usual.frame.layers[k];
        CHECK(image_in(pack, result["layers"][k]["color"], layer.color.format) == layer.color);
    }
    CHECK(result["geometry_passes"] == usual.frame.passes.geometry);
    for (const json& target : result["passes"][0]["targets"])
        CHECK(target["samples"] == golden.options.sampling.samples);
    const Golden back = read_pack(pack);
    CHECK(state_json(back.options, back.profile) == state_json(golden.options, golden.profile));
    CHECK(back.options.sampling.samples == golden.options.sampling.samples);
    CHECK(back.options.sampling.loads == golden.options.sampling.loads);
    CHECK(back.options.sampling.composites == golden.options.sampling.composites);
    CHECK(back.options.raster.interpolation == golden.options.raster.interpolation);
    CHECK(back.options.raster.sample_coverage == golden.options.raster.sample_coverage);
    CHECK(check_pack(pack).empty());
}

TEST_CASE("a changed sample is named by a check and by a comparison") {
    const test::OwnFolder folder;
    const std::string pack = folder.path() + "/pack", other = folder.path() + "/other";
    write_pack(sampled_golden({.samples = 4}), pack);
    std::filesystem::copy(pack, other, std::filesystem::copy_options::recursive);
    const json pass = scenes::read_manifest(pack)["results"][0]["passes"][1];
    const std::string name = "accumulated", file = "expected/front_to_back/pass.001/" + name + ".npy";
    // Row 2, column 3, sample 3, channel 1 of 12 columns, 4 samples and 4 channels of one byte.
    const std::streamoff position = 128 + (((2 * 12 + 3) * 4 + 3) * 4 + 1);
    {
        std::fstream bytes{other + "/" + file, std::ios::in | std::ios::out | std::ios::binary};
        bytes.seekg(position);
        const char changed = static_cast<char>(bytes.get() ^ 0x10);
        bytes.seekp(position);
        bytes.put(changed);
    }
    const auto faults = check_pack(other);
    REQUIRE(faults.size() == 1);
    CHECK(faults[0].file == file);
    CHECK_THAT(faults[0].message, Contains("row 2, column 3, sample 3, channel 1: expected"));
    const auto compared = compare_packs(expected_pictures(pack), candidate_pictures(pack, other + "/expected"));
    REQUIRE(compared.size() == 1);
    REQUIRE(compared[0].first);
    CHECK(compared[0].first->number == 1);
    CHECK_THAT(to_text(compared), Contains(name + ".sample3 at 1 pixels"));
    const auto same = compare_packs(expected_pictures(pack), candidate_pictures(pack, pack + "/expected"));
    CHECK(same.at(0).equal);
}

TEST_CASE("a manifest with samples that its profile does not have is rejected with the field") {
    const test::OwnFolder folder;
    const std::string pack = folder.path() + "/pack";
    write_pack(sampled_golden({.samples = 2}), pack);
    json manifest = scenes::read_manifest(pack);
    json& sampling = manifest["state"]["sampling"];
    const pipeline::DeviceProfile& profile = *pipeline::find_profile("geforce8");
    const auto rejected = [&](const std::string& message) {
        CHECK_THROWS_WITH(read_state(manifest, "manifest.json", profile), Contains(message));
    };
    CHECK(read_state(manifest, "manifest.json", profile).sampling.samples == 2);
    const json right = sampling;
    sampling["samples"][1]["x"] = 5;
    rejected(
        "/state/sampling/samples: expected the 2, 4 or 8 sample positions of profile geforce8, found 2 other "
        "positions");
    sampling["samples"] = json::array();
    rejected("found 0 other positions");
    sampling = right;
    sampling["number"] = 0;
    rejected("/state/sampling: expected either the field 'number' (of one sample) or the field 'all', found both");
    sampling.erase("number");
    sampling.erase("all");
    rejected("found neither");
    sampling = right;
    manifest["state"]["sample"] = {{"x", 4}, {"y", 4}};
    rejected("expected the field 'number', because the state has the field 'sample', found the field 'all'");
}
