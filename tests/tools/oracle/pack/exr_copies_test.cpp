// Tests the EXR copies in a pack against the pack's arrays, which are read with a different library.
#include "tools/oracle/pack/exr_copies.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "peeling/registry.h"
#include "scenes/camera.h"
#include "scenes/packs/pack_scene.h"
#include "tests/support/own_folder.h"
#include "tools/oracle/compare/compare.h"

using namespace strata;
using namespace strata::oracle;

namespace {

// A multisampled algorithm, one with layers from both ends, and one with D24 and stencils.
std::string pack_with_copies(const std::string& folder) {
    Golden golden{.scene = scenes::load_scene("random:triangles=10,seed=5", {}),
                  .profile = *pipeline::find_profile("geforce8_dx101")};
    golden.options.width = 14;
    golden.options.height = 11;
    golden.options.threads = 1;
    golden.scene.own_view = scenes::orbit_view(golden.scene.bounds, 30, 20, 1.25);
    for (const char* name : {"front_to_back", "dual", "coherent_stencil", "stencil_routed_k_buffer"})
        golden.algorithms.push_back(peeling::find_algorithm(name));
    write_pack(golden, folder + "/pack", Copies::exr);
    return folder + "/pack";
}

}  // namespace

TEST_CASE("EXR copies have the codes of the arrays and a copy that differs is reported") {
    const test::OwnFolder folder;
    const std::string pack = pack_with_copies(folder.path()), expected = pack + "/expected/";
    CHECK(check_pack(pack).empty());
    for (const char* algorithm : {"front_to_back", "dual"}) {
        const std::string place = expected + algorithm;
        CHECK(compare(read_picture(place + "/picture.npy"), read_picture(place + "/picture.exr")).equal);
        const bool is_dual = std::string_view{algorithm} == "dual";
        const Picture layers = read_picture(place + "/layers.exr");
        CHECK(layers.targets[0].part == (is_dual ? "front.000" : "layer.000"));
        CHECK(layers.targets[0].codes ==
              read_picture(place + (is_dual ? "/front.000.color.npy" : "/layer.000.color.npy")).targets[0].codes);
    }
    CHECK(std::filesystem::exists(expected + "stencil_routed_k_buffer/pass.000.exr"));
    std::filesystem::copy_file(expected + "dual/pass.002.exr", expected + "dual/pass.001.exr",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::copy_file(expected + "dual/pass.002.exr", expected + "dual/pass.777.exr");
    std::filesystem::remove(expected + "dual/picture.exr");  // a missing copy is not an error
    const auto faults = check_pack(pack);
    REQUIRE(faults.size() == 2);
    CHECK(faults[0].file == "expected/dual/pass.001.exr");
    CHECK_THAT(faults[0].message, Catch::EndsWith("its codes are not those of the array"));
    CHECK(faults[1].file == "expected/dual/pass.777.exr");
    CHECK(faults[1].message == "is a copy of no array");
}
