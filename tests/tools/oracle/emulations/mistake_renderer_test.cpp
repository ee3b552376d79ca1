// Tests that mistakes are made as described: against options with the same effect, a plain loop over the pixels for
// mistakes in the finished picture, and a loop over a stack of planes for blending.
#include "tools/oracle/emulations/mistake_renderer.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/sample_points.h"
#include "pipeline/formats/resolve.h"
#include "scenes/camera.h"
#include "tests/tools/oracle/diagnosis/scenes_of_test.h"

using namespace strata;
using namespace strata::oracle;
using strata::test::SceneFixture;

namespace {

Picture rendered(const OpenScene& opened) {
    peeling::Renderer renderer{opened.scene.list, opened.view, opened.profile, opened.options};
    return {.file = "", .targets = {as_target(renderer.render(*opened.algorithm).frame.color, "color")}};
}

bool is_equal(const Picture& a, const Picture& b) { return a.targets[0].codes == b.targets[0].codes; }

}  // namespace

TEST_CASE("the picture without a mistake is that of an ordinary run") {
    for (const char* name : {"showroom.dual", "showroom.weighted_average", "two_layers.front_to_back"}) {
        const SceneFixture bench{name};
        CHECK(is_equal(bench.mistake_renderer.right(), rendered(bench.opened)));
    }
}

TEST_CASE("a mistake that is a choice of options makes the picture of those options") {
    const SceneFixture bench{"showroom.front_to_back"};
    const auto by_options = [&](auto change) {
        OpenScene other = open(*find_suite_scene("showroom.front_to_back"));
        change(other);
        return rendered(other);
    };
    CHECK(is_equal(bench.with("depth_24"),
                   by_options([](OpenScene& o) { o.options.depth = pipeline::DepthFormat::d24; })));
    CHECK(is_equal(bench.with("background_lost"), by_options([](OpenScene& o) {
                       o.options.background = {0, 0, 0, 1};
                   })));
    CHECK(is_equal(bench.with("ties_of_rows"),
                   by_options([](OpenScene& o) { o.profile.raster.tie_rule = rasterizer::TieRule::bottom_left; })));
    CHECK(is_equal(bench.with("order_reversed"), by_options([](OpenScene& o) {
                       std::ranges::reverse(o.scene.list.instances);
                       for (pipeline::Mesh& mesh : o.scene.list.meshes) {
                           const auto given = mesh.indices;
                           const std::size_t triangles = given.size() / 3;
                           for (std::size_t t = 0; t < triangles; ++t)
                               for (std::size_t c = 0; c < 3; ++c)
                                   mesh.indices[3 * t + c] = given[3 * (triangles - 1 - t) + c];
                       }
                   })));
    const int enough = bench.mistake_renderer.right_run().enough_passes;
    CHECK(
        is_equal(bench.with("one_pass_too_few"), by_options([&](OpenScene& o) { o.options.max_passes = enough - 1; })));
    CHECK(is_equal(bench.mistake_renderer.right(), by_options([&](OpenScene& o) { o.options.max_passes = enough; })));
    CHECK_FALSE(is_equal(bench.mistake_renderer.right(), bench.with("one_pass_too_few")));
}

TEST_CASE("a mistake of the finished picture moves or changes its pixels and nothing else") {
    const SceneFixture bench{"showroom.dual"};
    const TargetImage& right = bench.mistake_renderer.right().targets[0];
    const Picture flipped = bench.with("flipped_rows"), blue = bench.with("red_for_blue"),
                  moved = bench.with("one_pixel_right");
    int wrong = 0;
    for (int y = 0; y < right.height; ++y)
        for (int x = 0; x < right.width; ++x)
            for (int c = 0; c < 4; ++c) {
                const auto at = [&](const TargetImage& t, int px, int py, int channel) {
                    return t.codes[static_cast<std::size_t>((py * right.width + px) * 4 + channel)];
                };
                wrong += at(flipped.targets[0], x, y, c) != at(right, x, right.height - 1 - y, c);
                wrong += at(blue.targets[0], x, y, c) != at(right, x, y, c == 3 ? 3 : 2 - c);
                wrong += at(moved.targets[0], x, y, c) != at(right, x == 0 ? 0 : x - 1, y, c);
            }
    CHECK(wrong == 0);
}

TEST_CASE("layers blended without transmittance add up") {
    // Six planes that face the eye, alpha 1/8, over black: the sum of colour times alpha, in binary32.
    OpenScene opened = open(*find_suite_scene("float.dual"));
    opened.algorithm = peeling::find_algorithm("front_to_back");
    opened.scene = scenes::load_scene("planes:count=6,gap=65536,cells=1", {});
    opened.view = scenes::orbit_view(opened.scene.bounds, 0, 0, 1);
    float sum[3] = {};
    for (pipeline::Mesh& mesh : opened.scene.list.meshes)
        for (pipeline::Rgba& color : mesh.colors) color = {0.5f, 0.25f, 1.0f, 0.125f};
    for (pipeline::Material& material : opened.scene.list.materials)
        material.front = material.back = {0.5f, 0.25f, 1.0f, 0.125f};
    const pipeline::Rgba once = opened.scene.list.meshes[0].colors.empty()
                                    ? opened.scene.list.materials[0].front
                                    : pipeline::Rgba{0.25f, 0.0625f, 1.0f, 0.015625f};
    for (int layer = 0; layer < 6; ++layer)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += once[c] * once[3];
    const MistakeRenderer mistake_renderer{opened.input(), *opened.algorithm};
    const Picture picture = mistake_renderer.with(*find_mistake("under_without_transmittance")).value();
    const TargetImage& colors = picture.targets[0];
    const std::size_t centre = static_cast<std::size_t>(colors.height / 2 * colors.width + colors.width / 2);
    for (int c = 0; c < 3; ++c) CHECK(colors.value_at(centre, c) == double{sum[c]});
}

TEST_CASE("a mistake that a scene cannot have makes no picture") {
    const SceneFixture average{"showroom.weighted_average"}, random{"random.dual"};
    CHECK_FALSE(average.mistake_renderer.with(*find_mistake("one_pass_too_few")));
    CHECK_FALSE(random.mistake_renderer.with(*find_mistake("texture_upside_down")));
    CHECK_FALSE(random.mistake_renderer.with(*find_mistake("one_pass_too_many")));
}

TEST_CASE("every mistake can be tried in a scene of lines and of points") {
    for (const char* scene : {"hair:strands=20", "splats:points=40"})
        for (const char* algorithm : {"dual", "weighted_blended", "a_buffer"}) {
            const OpenScene opened = open({.scene = scene, .algorithm = algorithm, .profile = "ideal"});
            const MistakeRenderer renderer{opened.input(), *opened.algorithm};
            std::size_t made = 0;
            for (const Mistake& mistake : catalogue()) {
                INFO(scene << " " << algorithm << " " << mistake.name);
                CHECK_NOTHROW(made += renderer.with(mistake).has_value() ? 1 : 0);
            }
            CHECK(made > 10);
        }
}

TEST_CASE("of two mistakes both are made and that of the finished picture is made last") {
    const SceneFixture bench{"showroom.dual"};
    const Picture both = bench.with("premultiplied_twice", "flipped_rows");
    CHECK(is_equal(both, changed(bench.with("premultiplied_twice"), *find_mistake("flipped_rows"))));
    CHECK_FALSE(is_equal(both, bench.with("flipped_rows")));
}

TEST_CASE("a peel that never ends is stopped") {
    const SceneFixture bench{"showroom.front_to_back"};
    CHECK(bench.with("peels_again").targets[0].pixels() == 64 * 64);
}

namespace {

constexpr int samples = 4;

peeling::FrameRequest of_samples(const OpenScene& opened) {
    peeling::FrameRequest input = opened.input();
    input.options.sampling.samples = samples;
    return input;
}

// The mean of the pictures that mistake renderers of one sample each make.
Picture mean_of_samples(const OpenScene& opened, const Mistake& mistake) {
    pipeline::ColorResolve resolve{samples, opened.profile.resolve, opened.profile.color_rounding()};
    for (std::size_t number = 0; number < samples; ++number) {
        peeling::FrameRequest input = opened.input();
        pipeline::set_sample(input.options.raster, opened.profile.sample_positions, samples, number);
        resolve.add(color_image(MistakeRenderer{input, *opened.algorithm}.with(mistake).value()));
    }
    return {.file = "", .targets = {as_target(std::move(resolve).picture(), "color")}};
}

}  // namespace

TEST_CASE("a mistake in a step of several samples is made in each of them") {
    for (const char* name : {"showroom.front_to_back", "showroom.dual"}) {
        const OpenScene opened = open(*find_suite_scene(name));
        const MistakeRenderer mistake_renderer{of_samples(opened), *opened.algorithm};
        for (const char* mistake :
             {"opaque_depth_lost", "premultiplied_twice", "flipped_rows", "texture_upside_down"}) {
            INFO(name << ' ' << mistake);
            const Mistake& made = *find_mistake(mistake);
            CHECK(is_equal(mistake_renderer.with(made).value(), mean_of_samples(opened, made)));
            CHECK_FALSE(is_equal(mistake_renderer.with(made).value(), mistake_renderer.right()));
        }
    }
}

TEST_CASE("a mistake with samples makes the picture of the multisampling that it describes") {
    const OpenScene opened = open(*find_suite_scene("showroom.front_to_back"));
    const MistakeRenderer mistake_renderer{of_samples(opened), *opened.algorithm};
    const auto by = [&](const peeling::Multisampling& sampling, auto change) {
        peeling::RenderOptions options = opened.options;
        change(options.raster);
        if (sampling.samples == 1) options.max_passes = 2 * mistake_renderer.right_run().passes + 8;
        options.sampling = sampling;
        peeling::Renderer renderer{opened.scene.list, opened.view, opened.profile, options};
        return Picture{.file = "", .targets = {as_target(renderer.render(*opened.algorithm).frame.color, "color")}};
    };
    const auto same = [](rasterizer::RasterState&) {};
    const auto at = [](rasterizer::Interpolation place) {
        return [place](rasterizer::RasterState& raster) { raster.interpolation = place; };
    };
    using enum pipeline::LoadedSample;
    using enum rasterizer::Interpolation;
    const auto with = [&](const char* name) { return mistake_renderer.with(*find_mistake(name)).value(); };
    CHECK(is_equal(mistake_renderer.right(), by({.samples = samples}, same)));
    CHECK(is_equal(with("no_samples"), by({.samples = 1}, same)));
    CHECK(is_equal(with("resolve_before_compositing"), by({.samples = samples, .composites = resolved}, same)));
    CHECK(is_equal(with("sample_0_for_all"), by({.samples = samples, .loads = zero, .composites = zero}, same)));
    CHECK(is_equal(with("peel_loads_sample_0"), by({.samples = samples, .loads = zero}, same)));
    CHECK(is_equal(with("peel_loads_resolved"), by({.samples = samples, .loads = resolved}, same)));
    CHECK(is_equal(with("pixel_shading"), by({.samples = samples}, at(centre))));
    CHECK(is_equal(with("pixel_shading_loads_sample_0"), by({.samples = samples, .loads = zero}, at(centre))));
    CHECK(is_equal(with("pixel_shading_loads_resolved"), by({.samples = samples, .loads = resolved}, at(centre))));
    CHECK(is_equal(with("centroid_shading"), by({.samples = samples}, at(centroid))));
    CHECK(is_equal(with("centroid_shading_loads_sample_0"), by({.samples = samples, .loads = zero}, at(centroid))));
    CHECK(is_equal(with("alpha_to_coverage_on"), by({.samples = samples}, [](rasterizer::RasterState& raster) {
                       raster.sample_coverage.by_alpha = true;
                   })));
}

TEST_CASE("a picture that is resolved wrongly is sample 0 or the mean of decoded values and a mask draws half of all") {
    const OpenScene opened = open(*find_suite_scene("samples.front_to_back"));
    const MistakeRenderer mistake_renderer{opened.input(), *opened.algorithm};
    peeling::RenderOptions options = opened.options;
    options.sampling.samples = samples;
    options.keep_samples = true;
    peeling::Renderer renderer{opened.scene.list, opened.view, opened.profile, options};
    const peeling::RenderResult drawn = renderer.render(*opened.algorithm);
    const std::vector<pipeline::Image>& images = drawn.frame.samples;
    const TargetImage right = as_target(drawn.frame.color, "color");
    const TargetImage shown = mistake_renderer.with(*find_mistake("sample_0_shown")).value().targets[0];
    const TargetImage linear = mistake_renderer.with(*find_mistake("resolved_in_linear_light")).value().targets[0];
    CHECK(shown.codes == as_target(images[0], "color").codes);
    int lighter = 0, darker = 0, wrong = 0;
    for (std::size_t i = 0; i < right.codes.size(); ++i) {
        double sum = 0;
        bool are_equal = true;
        for (const pipeline::Image& image : images) {
            const double v = image.codes[i] / 255.0;
            sum += i % 4 == 3 ? v : v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
            are_equal &= image.codes[i] == images[0].codes[i];
        }
        const double mean = sum / samples;
        const double encoded = i % 4 == 3          ? mean
                               : mean <= 0.0031308 ? 12.92 * mean
                                                   : 1.055 * std::pow(mean, 1 / 2.4) - 0.055;
        wrong += std::fabs(linear.codes[i] - 255 * encoded) > 0.501 ? 1 : 0;
        wrong += are_equal && linear.codes[i] != images[0].codes[i] ? 1 : 0;
        lighter += linear.codes[i] > right.codes[i] ? 1 : 0;
        darker += linear.codes[i] < right.codes[i] ? 1 : 0;
    }
    CHECK(wrong == 0);
    CHECK(lighter > 100);
    CHECK(darker == 0);
    peeling::FrameRequest masked = opened.input();
    masked.options.raster.sample_coverage.mask = 0b0011;
    CHECK(is_equal(mistake_renderer.with(*find_mistake("sample_mask_left_set")).value(),
                   MistakeRenderer{masked, *opened.algorithm}.right()));
}

TEST_CASE("a picture of one sample has no mistakes of samples and no edges") {
    const SceneFixture bench{"showroom.front_to_back"};
    for (const Mistake& mistake : mistakes_of_samples()) CHECK_FALSE(bench.mistake_renderer.with(mistake));
    CHECK(bench.mistake_renderer.edges().empty());
}
