// Tests the library's rendering functions: pictures against OVER of full-screen triangles, worked out by hand, and
// results against the same calls on the modules below.
#include <bit>
#include <catch2/catch.hpp>
#include <thread>

#include "peeling/registry.h"
#include "strata/strata.h"

using namespace strata;
using Catch::Matchers::Contains;

namespace {

// Two triangles over the whole frame: a far white one and a near black one, both of alpha 0.5, over black.
Scene far_white_near_black(pipeline::ColorSpace space = pipeline::ColorSpace::encoded) {
    const float far[] = {-1, -1, 0.5f, 3, -1, 0.5f, -1, 3, 0.5f};
    const float near[] = {-1, -1, -0.5f, 3, -1, -0.5f, -1, 3, -0.5f};
    Scene scene{space};
    scene.add({.name = "near", .positions = {near, 3}, .color = {0, 0, 0, 0.5f}});
    scene.add({.name = "far", .positions = {far, 3}, .color = {1, 1, 1, 0.5f}});
    return scene;
}

const RenderOptions small{.width = 6, .height = 5, .color_format = pipeline::Format::rgba32f};

}  // namespace

TEST_CASE("a picture and its layers and its fragments are those of the scene") {
    const Scene scene = far_white_near_black();
    const Rendering picture = render(scene, algorithm("front_to_back"), profile("ideal"), small);
    REQUIRE_FALSE(picture.is_refused());
    CHECK(picture.refusal().empty());
    CHECK(picture.color().codes[0] == 0x3e800000u);  // 0.25
    CHECK(picture.geometry_passes() == 3);
    CHECK(picture.audit().layers_max == 2);
    CHECK(picture.picture().targets.size() == 2);
    for (const char* name : {"front_to_back", "dual"}) {
        const auto taken = layers(scene, algorithm(name), profile("ideal"), small);
        REQUIRE(taken.size() == 2);
        CHECK(taken[0].color.codes[0] == 0);
        CHECK(taken[0].depth.codes[0] < taken[1].depth.codes[0]);
        CHECK(taken[1].is_from_behind == (std::string{name} == "dual"));
    }
    const auto all = fragments(scene, algorithm("a_buffer"), profile("ideal"), small);
    CHECK(all.size() == 2u * 30);
    CHECK(all[0].color[3] == 0.5f);
}

TEST_CASE("a pixel's history has the fragments of that pixel and the last of its passes is the picture") {
    const Scene scene = far_white_near_black();
    const auto history = explain(scene, 5, 4, algorithm("dual"), profile("ideal"), small);
    REQUIRE(history.fragments.size() == 2);
    CHECK(history.fragments[0].mesh == "near");
    CHECK_THAT(oracle::to_text(history), Contains("near") && Contains("far"));
    const auto shown = passes(scene, algorithm("dual"), profile("ideal"), small);
    REQUIRE_FALSE(shown.empty());
    CHECK(shown.back().kind == oracle::ReportedPassKind::published);
}

// The left edge is in the middle of column 2, so it covers the two samples of Direct3D's four that lie right of it.
TEST_CASE("two of four samples of a pixel at an edge give half of the surface's colour") {
    const float left = -1.0f / 6;
    const float quad[] = {left, -3, 0, 2, -3, 0, 2, 3, 0, left, -3, 0, 2, 3, 0, left, 3, 0};
    Scene scene;
    scene.add({.name = "half", .positions = {quad, 6}, .color = {1, 1, 1, 0.5f}});
    const auto value = [](const Image& image, int x) { return std::bit_cast<float>(image.codes[image.index(x, 2)]); };
    const DeviceProfile device = profile("ideal");
    RenderOptions sampled = small;
    sampled.sampling.samples = 4;
    const Rendering picture = render(scene, algorithm("front_to_back"), device, sampled);
    CHECK(value(picture.color(), 1) == 0);
    CHECK(value(picture.color(), 2) == 0.25f);
    CHECK(value(picture.color(), 3) == 0.5f);
    const auto taken = layers(scene, algorithm("front_to_back"), device, sampled);
    REQUIRE(taken.size() == 1);
    CHECK(value(taken[0].color, 2) == 0.25f);
    const auto shown = passes(scene, algorithm("front_to_back"), device, sampled);
    CHECK(shown[0].targets.at(0).image.samples == 4);
    CHECK(shown.back().targets.at(0).image == picture.color());
    const auto history = explain_samples(scene, 2, 2, algorithm("front_to_back"), device, sampled);
    std::size_t covered = 0;
    for (const oracle::History& sample : history.samples) covered += sample.fragments.size();
    CHECK(covered == 2);
    CHECK(history.resolved[0] == std::bit_cast<std::uint32_t>(0.25f));
    const auto single = explain_samples(scene, 3, 2, algorithm("front_to_back"), device, small);
    CHECK(single.samples.size() == 1);
}

TEST_CASE("every algorithm on every device gives a picture or a result that throws Refused when it is read") {
    const Scene scene = far_white_near_black();
    const RenderOptions options{.width = 6, .height = 5};
    int drawn = 0, refused = 0;
    for (const DeviceProfile& device : pipeline::builtin_profiles())
        for (const Algorithm& each : peeling::algorithms()) {
            INFO(device.name << " " << each.name);
            const Rendering picture = render(scene, each, device, options);
            if (!picture.is_refused()) {
                ++drawn;
                CHECK(compare(picture.picture(), picture.picture()).equal);
                continue;
            }
            ++refused;
            CHECK_THAT(picture.refusal(), Contains("profile " + device.name + " has no "));
            CHECK_THROWS_AS(picture.color(), Refused);
            CHECK_THROWS_AS(picture.depth(), Refused);
            CHECK_THROWS_AS(picture.picture(), Refused);
            CHECK_THROWS_AS(picture.digest(), Refused);
            CHECK_THROWS_AS(picture.audit(), Refused);
            CHECK_THROWS_AS(passes(scene, each, device, options), Refused);
            CHECK_THROWS_AS(explain(scene, 0, 0, each, device, options), Refused);
            CHECK_THROWS_AS(layers(scene, each, device, options), Refused);
        }
    CHECK(drawn > 40);
    CHECK(refused > 10);
}

TEST_CASE("invalid options and pixels are rejected by name") {
    const Scene scene = far_white_near_black();
    const auto with = [&](const RenderOptions& options) {
        return render(scene, algorithm("dual"), profile("ideal"), options).digest();
    };
    CHECK_THROWS_WITH(with({.width = 0}), Contains("width: expected 1 to 16384, found 0"));
    CHECK_THROWS_WITH(with({.width = 4, .height = 20000}), Contains("height: expected 1 to 16384"));
    CHECK_THROWS_WITH(with({.width = 4, .height = 4, .tile_size = 7}), Contains("tile_size"));
    CHECK_THROWS_WITH(explain(scene, 6, 0, algorithm("dual"), profile("ideal"), small),
                      Contains("pixel: x: expected 0 to 5, found 6"));
    CHECK_THROWS_WITH(explain(scene, 0, -1, algorithm("dual"), profile("ideal"), small),
                      Contains("pixel: y: expected 0 to 4, found -1"));
    CHECK_THROWS_WITH(render(Scene{}.add({}), algorithm("dual"), profile("ideal"), small), Contains("positions.count"));
}

TEST_CASE("a target that encodes is drawn of a scene in linear light and refused by every function for another") {
    RenderOptions encodes = small;
    encodes.result_format = pipeline::Format::srgb8_alpha8;
    const Algorithm& peel = algorithm("front_to_back");
    const DeviceProfile& device = profile("ideal");
    const Scene linear = far_white_near_black(pipeline::ColorSpace::linear), encoded = far_white_near_black();
    // 0.25 in linear light is the sRGB value 0.5371.
    const auto drawn = render(linear, peel, device, encodes);
    CHECK(drawn.color().codes[0] == 137);
    const Picture picture = drawn.picture();
    const auto said = Contains("scene: color_space: expected linear with a target of srgb8_alpha8");
    CHECK_THROWS_WITH(render(encoded, peel, device, encodes), said);
    CHECK_THROWS_WITH(layers(encoded, peel, device, encodes), said);
    CHECK_THROWS_WITH(fragments(encoded, peel, device, encodes), said);
    CHECK_THROWS_WITH(passes(encoded, peel, device, encodes), said);
    CHECK_THROWS_WITH(explain(encoded, 0, 0, peel, device, encodes), said);
    CHECK_THROWS_WITH(explain_samples(encoded, 0, 0, peel, device, encodes), said);
    CHECK_THROWS_WITH(judge(encoded, picture, device, encodes, &peel), said);
    CHECK_THROWS_WITH(diagnose(encoded, picture, peel, device, encodes, {}), said);
}

TEST_CASE("a scene without triangles is drawn as its background") {
    RenderOptions red = small;
    red.background = {1, 0, 0, 1};
    CHECK(render(Scene{}, algorithm("dual"), profile("ideal"), red).color().codes[0] == 0x3f800000u);
}

TEST_CASE("concurrent calls on several threads give the same result as a single call") {
    const Scene scene{"teapot"};
    const RenderOptions options{.width = 24, .height = 18, .threads = 2};
    const std::string alone = render(scene, algorithm("dual"), profile("geforce8"), options).digest();
    std::vector<std::string> digests(4);
    {
        std::vector<std::jthread> threads;
        for (std::string& digest : digests)
            threads.emplace_back(
                [&] { digest = render(scene, algorithm("dual"), profile("geforce8"), options).digest(); });
    }
    for (const std::string& digest : digests) CHECK(digest == alone);
}

TEST_CASE("options by name are those of the command line and a wrong one is named") {
    DeviceProfile device = profile("geforce8");
    const RenderOptions options =
        options_of({{"samples", "4"}, {"depth_format", "d24"}, {"clip-depth", "zero-to-one"}, {"size", "6x5"}}, device);
    CHECK(options.sampling.samples == 4);
    CHECK(options.depth == pipeline::DepthFormat::d24);
    CHECK(options.raster.clip_depth == rasterizer::ClipDepth::zero_to_one);
    CHECK((options.width == 6 && options.height == 5));
    static_cast<void>(options_of({{"origin", "lower-left"}}, device));
    CHECK(device == with_origin(profile("geforce8"), pipeline::Origin::lower_left));
    CHECK_THROWS_WITH(options_of({{"smaples", "4"}}, device), Contains("did you mean 'samples'"));
    CHECK_THROWS_WITH(options_of({{"samples", "3"}}, device), Contains("options: samples: expected"));
    CHECK_THROWS_WITH(options_of({{"camera", "front"}}, device), Contains("found 'camera'"));
    CHECK_THROWS_WITH(options_of({{"alpha", "glass=1"}}, device), Contains("found alphas of materials"));
    CHECK_THROWS_WITH(options_of({{"shading", "pixel"}}, device), Contains("valid only with --samples"));
}
