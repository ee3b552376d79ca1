// Tests which depths the depth paths store and compare on whole scenes: with depth replace they are always equal, with
// the device's own paths they are not.
#include <catch2/catch.hpp>
#include <filesystem>

#include "pipeline/vertices/prepare.h"
#include "rasterizer/walk/tile_rasterizer.h"
#include "scenes/camera.h"
#include "tests/support/skip.h"

namespace {

using namespace strata::scenes;
using strata::pipeline::DepthFormat;
using strata::pipeline::DeviceProfile;
using strata::rasterizer::DepthPath;
using strata::rasterizer::DepthRequest;
using strata::rasterizer::FragmentBatch;

struct Machine {
    const char* profile;
    DepthFormat format;
};
constexpr std::array machines{Machine{"geforce3", DepthFormat::d16}, Machine{"geforce3", DepthFormat::d24},
                              Machine{"ideal", DepthFormat::d32f}};

struct Compared {
    std::uint64_t fragments = 0, differing = 0;
};

// The number of fragments of the scene, and of those whose compared depth is not the stored one.
[[nodiscard]] Compared compare(const Scene& scene, const Machine& machine, DepthPath stored, DepthPath reference,
                               int size) {
    strata::rasterizer::RasterState state;
    state.viewport = {0, 0, size, size};
    state.depth_format = machine.format;
    const DeviceProfile& profile = *strata::pipeline::find_profile(machine.profile);
    const auto prepared =
        prepare(scene.list, orbit_view(scene.bounds, 30, 20, 1.0), state, profile, {.depth_quotient = true});
    Compared found;
    auto sink = [&](FragmentBatch& batch) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i)
            found.differing += batch.code[i] != batch.reference_code[i] ? 1 : 0;
        found.fragments += static_cast<std::uint64_t>(batch.count);
    };
    strata::rasterizer::TileRasterizer rasterizer{state.viewport};
    rasterizer.draw(prepared.geometry, prepared.geometry.all_triangles, DepthRequest{stored, machine.format, reference},
                    {.color = false, .reference = true}, strata::rasterizer::BatchSink{sink});
    return found;
}

void check_cure(const std::string& spec, int size, std::uint64_t at_least) {
    const Scene scene = load_scene(spec, {});
    for (const Machine& machine : machines) {
        const Compared found = compare(scene, machine, DepthPath::depth_replace, DepthPath::perspective_rq, size);
        INFO(spec << " on " << machine.profile << ": " << found.fragments << " fragments");
        CHECK(found.fragments >= at_least);
        CHECK(found.differing == 0);
    }
}

// The folder of the shared models, or an empty path if it does not exist.
[[nodiscard]] std::filesystem::path models() {
    const char* const named = std::getenv("STRATA_MODELS_DIR");
    const std::filesystem::path folder = named != nullptr ? named : STRATA_MODELS_DIR;
    if (std::filesystem::is_directory(folder)) return folder;
    strata::test::skip("no models in '" + folder.string() + "'; set STRATA_MODELS_DIR to their folder");
    return {};
}

}  // namespace

TEST_CASE("the depth that depth replace stores is the compared depth on every procedural scene and 10^6 fragments") {
    check_cure("teapot", 256, 20000);
    check_cure("volume-beam:slices=16", 128, 50000);
    check_cure("random:seed=7,triangles=5000", 256, 1000000);
}

TEST_CASE("the depth that depth replace stores is the compared depth on every shared model", "[slow]") {
    const auto folder = models();
    if (folder.empty()) return;
    for (const char* name : {"bunny.glb", "dragon.glb", "AlphaBlendModeTest.glb", "sponza.glb"})
        check_cure((folder / name).string(), 256, 10000);
}

TEST_CASE("the depth that GeForce3 stores is not the depth of its shadow comparison on the teapot and the dragon") {
    const Machine d24{"geforce3", DepthFormat::d24};
    const auto share = [&](const std::string& spec) {
        const Compared found = compare(load_scene(spec, {}), d24, DepthPath::window_z, DepthPath::perspective_rq, 256);
        CHECK(found.fragments > 10000);
        return static_cast<double>(found.differing) / static_cast<double>(found.fragments);
    };
    CHECK(share("teapot") > 0.1);
    const auto folder = models();
    if (!folder.empty()) CHECK(share((folder / "dragon.glb").string()) > 0.1);
}
