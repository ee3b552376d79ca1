// Tests chains from the machine's picture to the exact one. A chain without exact links, or with only exact blending,
// must be bit-identical to a picture of the emulated machine; a chain whose links become exact one after the other must
// end at the truth.
#include "peeling/truth/chain.h"

#include <catch2/catch.hpp>

#include "peeling/truth/truth.h"
#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"
#include "tests/peeling/truth/chain_scene.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;
using strata::rasterizer::DepthPath;

RenderOptions chain_options() {
    RenderOptions options;
    options.width = 96;
    options.height = 80;
    options.threads = 1;
    options.background = {0.25f, 0.5f, 0.125f, 1};
    return options;
}

ChainSceneParts parts_of(std::uint64_t seed) {
    return {.transparent = 30, .opaque = 6, .has_texture = seed % 2 == 1, .has_mask = seed % 4 >= 2};
}

// Every triangle twice, the second one a little behind in other colours, so that depths are close together at every
// pixel.
void double_surfaces(Mesh& mesh) {
    const auto count = mesh.positions.size();
    for (std::size_t i = 0; i < count; ++i) {
        const strata::Vec3 p = mesh.positions[i];
        mesh.positions.push_back({p[0], p[1], p[2] - 3e-5f});
        mesh.colors.push_back(mesh.colors[count - 1 - i]);
        mesh.texcoords.push_back(mesh.texcoords[i]);
        mesh.indices.push_back(static_cast<std::uint32_t>(count + i));
    }
}

// The picture of a chain, and that of an algorithm on the same machine.
struct Both {
    RealImage chain, machine;
};
Both both(const DrawList& list, const std::string& profile, const RenderOptions& options, const Chain& chain,
          const std::string& algorithm) {
    const DeviceProfile& device = *find_profile(profile);
    const RenderResult result = render(list, chain_view, {profile, algorithm}, options);
    INFO((result.refusal ? result.refusal->message(device) : std::string{}));
    REQUIRE(result.outcome == Outcome::done);
    return {render_chain({list, chain_view, device, options}, chain), real_image(result.frame.color)};
}

}  // namespace

TEST_CASE("a chain without an exact link is bit-identical to the picture of sequential depth units", "[slow]") {
    for (const char* profile : {"geforce3", "geforce8", "ideal"})
        for (std::uint64_t seed = 0; seed < 4; ++seed) {
            INFO(profile << ", seed " << seed);
            const DrawList list = random_chain_list(seed, parts_of(seed));
            const Both seen = both(list, profile, chain_options(), device_chain, "depth_units");
            CHECK(seen.chain == seen.machine);
        }
}

TEST_CASE("render_chain rejects devices without exact planes and snapped edges and a guard band") {
    const DrawList list = random_chain_list(0, parts_of(0));
    for (const char* profile : {"llvmpipe", "llvmpipe_sse", "softpipe", "swiftshader"})
        CHECK_THROWS_WITH(
            render_chain({list, chain_view, *find_profile(profile), chain_options()}, device_chain),
            Catch::Contains("expected exact planes, snapped edges and a guard band") && Catch::Contains(profile));
}

TEST_CASE("a chain without an exact link equals depth_units for every depth path and depth format and colour format",
          "[slow]") {
    const DrawList list = random_chain_list(11, parts_of(11));
    RenderOptions options = chain_options();
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24})
        for (const DepthPath path : {DepthPath::window_z, DepthPath::depth_replace, DepthPath::float32,
                                     DepthPath::float32_plane, DepthPath::exact}) {
            options.depth = format;
            options.depth_path = path;
            const Both seen = both(list, "geforce3", options, device_chain, "depth_units");
            INFO(static_cast<int>(path));
            CHECK(seen.chain == seen.machine);
        }
    options = chain_options();
    for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f}) {
        options.color_format = format;
        const Both seen = both(list, "geforce8", options, device_chain, "depth_units");
        CHECK(seen.chain == seen.machine);
    }
}

TEST_CASE("exact blending alone on exact depths is bit-identical to the picture of the A-buffer", "[slow]") {
    RenderOptions options = chain_options();
    options.depth_path = DepthPath::exact;
    Chain chain = device_chain;
    chain.blend = true;
    for (const char* profile : {"geforce3", "geforce8", "ideal"})
        for (std::uint64_t seed = 20; seed < 24; ++seed) {
            INFO(profile << ", seed " << seed);
            const Both seen = both(random_chain_list(seed, parts_of(seed)), profile, options, chain, "a_buffer");
            CHECK(seen.chain == seen.machine);
        }
}

TEST_CASE(
    "making the links exact one by one ends at the exact picture and every link but the transform changes a picture",
    "[slow]") {
    RenderOptions options = chain_options();
    options.depth = DepthFormat::d16;
    const DeviceProfile& device = *find_profile("geforce3");
    std::array<int, links.size()> moved{};
    for (std::uint64_t seed = 30; seed < 33; ++seed) {
        DrawList list = random_chain_list(seed, {.transparent = 40, .opaque = 8, .has_texture = true});
        double_surfaces(list.meshes[0]);
        const ChainScene scene{list, chain_view, device, options};
        RealImage before = render_chain(scene, exact_up_to(0));
        for (std::size_t i = 0; i < links.size(); ++i) {
            const RealImage after = render_chain(scene, exact_up_to(i + 1));
            moved[i] += after != before ? 1 : 0;
            before = after;
        }
        CHECK(before == render_chain(scene, exact_chain));
        CHECK(exact_up_to(links.size()) == exact_chain);
    }
    // The transform need not change a picture: its binary32 errors vanish when geforce3 snaps to 1/16 pixel, unless a
    // vertex lies almost on a rounding boundary.
    for (std::size_t i = 1; i < links.size(); ++i) {
        INFO(links[i].name);
        CHECK(moved[i] > 0);
    }
}

TEST_CASE("the exact chain gives the same picture for every device and format") {
    const DrawList list = random_chain_list(40, {.transparent = 30, .opaque = 6, .has_texture = true});
    RenderOptions options = chain_options();
    const RealImage truth = render_chain({list, chain_view, *find_profile("geforce3"), options}, exact_chain);
    options.depth = DepthFormat::d24;
    options.color_format = Format::rgba16f;
    options.threads = 3;
    CHECK(render_chain({list, chain_view, *find_profile("llvmpipe"), options}, exact_chain) == truth);
}

TEST_CASE("render_chain rejects a scene with lines") {
    DrawList list = random_chain_list(42, {});
    list.meshes[1].indices = {0, 0, 1};
    list.meshes[1].primitive = Primitive::lines;
    const RenderOptions options = chain_options();
    CHECK_THROWS_WITH(
        render_chain({list, chain_view, *find_profile("ideal"), options}, exact_chain),
        "scene: primitives: expected triangles alone, whose exact picture is known, found lines or points");
}

TEST_CASE("render_chain rejects a scene with a shadow light") {
    DrawList list = random_chain_list(41, {});
    list.light = ShadowLight{};
    const RenderOptions options = chain_options();
    CHECK_THROWS_AS(render_chain({list, chain_view, *find_profile("ideal"), options}, exact_chain), strata::InputError);
}
