// Tests sampled frames against each sample's frame drawn separately and the mean of the codes in integers.
#include <array>
#include <catch2/catch.hpp>

#include "peeling/render.h"
#include "pipeline/device/sample_points.h"
#include "pipeline/frame/instruments.h"
#include "pipeline/frame/observer.h"
#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::find_algorithm;
using strata::peeling::Outcome;
using strata::peeling::Renderer;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::find_profile;
using strata::pipeline::Image;
using strata::rasterizer::Interpolation;

[[nodiscard]] RenderOptions sampled_options() {
    RenderOptions options;
    options.width = 61, options.height = 47;
    options.threads = 1;
    return options;
}

[[nodiscard]] RenderResult sampled(const TriangleScene& scene, const Machine& machine, RenderOptions options,
                                   int samples) {
    options.sampling.samples = samples;
    options.keep_samples = true;
    Renderer renderer{scene.list, scene.view, *find_profile(machine.profile), options};
    return renderer.render(*find_algorithm(machine.algorithm));
}

[[nodiscard]] RenderResult own_frame(const TriangleScene& scene, const Machine& machine, RenderOptions options,
                                     int samples, std::size_t number) {
    const auto& profile = *find_profile(machine.profile);
    options.raster.sample = strata::pipeline::sample_points(profile.sample_positions, samples)[number];
    return render(scene.list, scene.view, machine, options);
}

[[nodiscard]] std::uint32_t mean_code(std::uint32_t sum, std::uint32_t samples) {
    return sum / samples + (2 * (sum % samples) >= samples ? 1 : 0);
}

}  // namespace

TEST_CASE("a frame of n samples is n frames at the samples resolved to the mean of their codes") {
    const TriangleScene scene = random_triangles(1201, 40);
    for (const Machine& machine : {Machine{"geforce8", "front_to_back"}, Machine{"geforce8_dx101", "dual"},
                                   Machine{"geforce8", "weighted_average"}, Machine{"geforce3", "depth_units"}})
        for (const int samples : {2, 4, 8}) {
            if (samples == 8 && machine.profile == "geforce3") continue;
            INFO(machine.profile << ' ' << machine.algorithm << ", " << samples << " samples");
            const RenderResult drawn = sampled(scene, machine, sampled_options(), samples);
            const std::vector<Image>& colors = drawn.frame.samples;
            REQUIRE(drawn.outcome == Outcome::done);
            REQUIRE(colors.size() == static_cast<std::size_t>(samples));
            std::vector<std::uint32_t> sum(colors[0].codes.size());
            std::uint64_t wrong = 0, unlike = 0, errors = 0;
            int passes = 0;
            std::vector<std::uint32_t> nearest(sum.size() / 4, ~0u);
            for (std::size_t s = 0; s < colors.size(); ++s) {
                const RenderResult own = own_frame(scene, machine, sampled_options(), samples, s);
                wrong += own.frame.color == colors[s] ? 0 : 1;
                unlike += colors[s] == colors[0] ? 0 : 1;
                passes = std::max(passes, own.frame.passes.geometry);
                errors += own.audit.order_errors.value_or(0);
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += own.frame.color.codes[i];
                for (std::size_t i = 0; i < nearest.size(); ++i)
                    nearest[i] = std::min(nearest[i], own.frame.depth.codes[i]);
            }
            CHECK(wrong == 0);
            CHECK(unlike + 1 == colors.size());
            for (std::size_t i = 0; i < sum.size(); ++i)
                wrong += drawn.frame.color.codes[i] != mean_code(sum[i], static_cast<std::uint32_t>(samples));
            for (std::size_t i = 0; i < nearest.size(); ++i) wrong += drawn.frame.depth.codes[i] != nearest[i];
            CHECK(wrong == 0);
            CHECK(drawn.frame.passes.geometry == passes);
            if (machine.algorithm != "weighted_average") CHECK(drawn.audit.order_errors == errors);
            CHECK(errors == 0);
        }
}

TEST_CASE("a frame of one sample is the frame at the pixel centre as without samples") {
    const TriangleScene scene = random_triangles(1202, 30);
    const Machine machine{"geforce8", "front_to_back"};
    const RenderResult one = sampled(scene, machine, sampled_options(), 1);
    const RenderResult plain = render(scene.list, scene.view, machine, sampled_options());
    CHECK(one.frame.color == plain.frame.color);
    CHECK(one.frame.depth == plain.frame.depth);
}

TEST_CASE("a frame of one sample has no sample coverage") {
    const TriangleScene scene = random_triangles(1202, 20);
    const Machine machine{"geforce8", "front_to_back"};
    RenderOptions options = sampled_options();
    const RenderResult all = sampled(scene, machine, options, 1);
    options.raster.sample_coverage.mask = 0;
    CHECK(sampled(scene, machine, options, 1).frame.color == all.frame.color);
}

TEST_CASE("under reversed depth the depth of a sampled frame is the greatest of its samples") {
    const TriangleScene scene = random_triangles(1203, 40);
    const Machine machine{"geforce8", "front_to_back"};
    RenderOptions options = sampled_options();
    options.raster.depth_order = strata::rasterizer::DepthOrder::greater;
    strata::pipeline::ImageCodes greatest(61 * 47, 0);
    for (std::size_t s = 0; s < 4; ++s) {
        const strata::pipeline::ImageCodes own = own_frame(scene, machine, options, 4, s).frame.depth.codes;
        for (std::size_t i = 0; i < own.size(); ++i) greatest[i] = std::max(greatest[i], own[i]);
    }
    CHECK(sampled(scene, machine, options, 4).frame.depth.codes == greatest);
}

TEST_CASE("every execution and tile size draws the same samples") {
    const TriangleScene scene = random_triangles(1203, 40);
    for (const char* algorithm : {"front_to_back", "dual", "k_buffer"}) {
        const Machine machine{"ideal", algorithm};
        const Image first = sampled(scene, machine, sampled_options(), 4).frame.color;
        for (const Running& running : all_ways_of_running)
            for (const int tile : {8, 64}) {
                RenderOptions options = sampled_options();
                running.apply(options);
                options.tile_size = tile;
                CHECK(sampled(scene, machine, options, 4).frame.color == first);
            }
    }
}

TEST_CASE("every execution shades the same pixels at the centre and centroid") {
    const TriangleScene scene = random_triangles(1204, 40);
    for (const char* algorithm : {"front_to_back", "dual", "depth_units", "weighted_average"})
        for (const auto interpolation : {Interpolation::centre, Interpolation::centroid}) {
            const Machine machine{"ideal", algorithm};
            RenderOptions options = sampled_options();
            options.raster.interpolation = interpolation;
            const RenderResult first = sampled(scene, machine, options, 4);
            for (const Running& running : all_ways_of_running) {
                running.apply(options);
                const RenderResult result = sampled(scene, machine, options, 4);
                CHECK(result.frame.color == first.frame.color);
                CHECK(result.frame.depth == first.frame.depth);
                CHECK(result.audit == first.audit);
            }
        }
}

TEST_CASE("layer k of a sampled frame is the mean of layer k of every sample counted from its own end") {
    const TriangleScene scene = random_triangles(1204, 24);
    for (const Machine& machine : {Machine{"geforce8", "front_to_back"}, Machine{"geforce8_dx101", "dual"}}) {
        RenderOptions options = sampled_options();
        options.keep_layers = true;
        const RenderResult drawn = sampled(scene, machine, options, 4);
        using strata::pipeline::Side;
        std::size_t layers = 0;
        std::uint64_t wrong = 0;
        for (const Side side : {Side::none, Side::front, Side::back}) {
            std::vector<std::vector<std::uint32_t>> sums;
            for (std::size_t s = 0; s < 4; ++s) {
                std::size_t k = 0;
                for (const auto& layer : own_frame(scene, machine, options, 4, s).frame.layers) {
                    if (layer.side != side) continue;
                    if (k == sums.size()) sums.emplace_back(layer.color.codes.size());
                    for (std::size_t i = 0; i < sums[k].size(); ++i) sums[k][i] += layer.color.codes[i];
                    ++k;
                }
            }
            std::size_t k = 0;
            for (const auto& layer : drawn.frame.layers) {
                if (layer.side != side) continue;
                REQUIRE(k < sums.size());
                for (std::size_t i = 0; i < sums[k].size(); ++i)
                    wrong += layer.color.codes[i] != mean_code(sums[k][i], 4);
                ++k;
            }
            CHECK(k == sums.size());
            layers += k;
        }
        CHECK(wrong == 0);
        CHECK(layers > 5);
    }
}

TEST_CASE("Quincunx is available only on GeForce3 with two samples") {
    const TriangleScene scene = random_triangles(1206, 20);
    const auto& algorithm = *find_algorithm("depth_units");
    using strata::pipeline::Resolve;
    strata::pipeline::DeviceProfile geforce3 = *find_profile("geforce3");
    // In memory a pixel's lower corners are those of the next row, which a picture from the lower left shows above.
    for (const auto origin : {strata::pipeline::Origin::upper_left, strata::pipeline::Origin::lower_left}) {
        geforce3.origin = origin;
        const int next = origin == strata::pipeline::Origin::lower_left ? -1 : 1;
        RenderOptions options = sampled_options();
        options.sampling = {2, Resolve::quincunx};
        options.keep_samples = true;
        const RenderResult result = Renderer{scene.list, scene.view, geforce3, options}.render(algorithm);
        const std::vector<Image>& colors = result.frame.samples;
        REQUIRE(colors.size() == 2);
        const Image& corner = colors[0];
        std::uint64_t wrong = 0;
        for (int y = 1; y + 1 < corner.height; ++y)
            for (int x = 0; x + 1 < corner.width; ++x) {
                std::uint32_t sum = 4 * colors[1].codes[corner.index(x, y, 1)] + 4;
                for (const int j : {y, y + next})
                    for (const int i : {x, x + 1}) sum += corner.codes[corner.index(i, j, 1)];
                wrong += result.frame.color.codes[corner.index(x, y, 1)] != sum / 8 ? 1 : 0;
            }
        CHECK(wrong == 0);
    }
    const auto refusal_of = [&](const char* profile, int samples) {
        RenderOptions options = sampled_options();
        options.sampling = {samples, Resolve::quincunx};
        const RenderResult refused =
            Renderer{scene.list, scene.view, *find_profile(profile), options}.render(algorithm);
        return refused.refusal ? refused.refusal->message(*find_profile(profile)) : "";
    };
    CHECK(refusal_of("geforce8", 2) ==
          "profile geforce8 has no Quincunx filter of 2 samples (NV_multisample_filter_hint); "
          "use --profile geforce3 with --samples 2");
    CHECK(refusal_of("geforce3", 4).starts_with("profile geforce3 has no Quincunx filter of 4 samples"));
}

TEST_CASE("features that no device supports with several samples are rejected") {
    const TriangleScene scene = random_triangles(1205, 4);
    const auto refusal_of = [&](const Machine& machine, int samples) {
        const RenderResult result = sampled(scene, machine, sampled_options(), samples);
        return result.refusal ? result.refusal->message(*find_profile(machine.profile)) : "";
    };
    CHECK(refusal_of({"geforce3", "depth_units"}, 8)
              .starts_with("profile geforce3 has no 8 samples per pixel (ARB_multisample)"));
    CHECK(refusal_of({"geforce8", "stencil_routed_k_buffer"}, 2) ==
          "algorithm stencil_routed_k_buffer has no multisampling, because it stores fragments in the samples; use "
          "--samples 1, or k_buffer");
    CHECK(refusal_of({"geforce8", "stencil_routed_k_buffer"}, 1).empty());
    CHECK_THROWS_AS(sampled(scene, {"geforce8", "dual"}, sampled_options(), 3), strata::InputError);
    RenderOptions beside = sampled_options();
    beside.raster.sample = strata::rasterizer::SamplePoint{3, 4};
    CHECK_THROWS_AS(render(scene.list, scene.view, {"softpipe", "dual"}, beside), strata::InputError);
}

TEST_CASE("a frame with an observer makes the passes and the bits of one without at every sample") {
    const TriangleScene scene = random_triangles(1207, 40);
    RenderOptions options = sampled_options();
    options.sampling.samples = 4;
    for (const char* name : {"front_to_back", "dual"}) {
        const Machine machine{"geforce8", name};
        int passes = 0, queries = 0;
        strata::pipeline::Observer observer;
        observer.step = [&](const auto&, const strata::pipeline::StepEvent& event) {
            passes += event.is_counted && event.step == strata::pipeline::Step::geometry ? 1 : 0;
            queries += event.step == strata::pipeline::Step::query ? 1 : 0;
        };
        Renderer renderer{scene.list, scene.view, *find_profile(machine.profile), options};
        const RenderResult result = renderer.render(*find_algorithm(machine.algorithm), {}, {.observer = &observer});
        const RenderResult expected = sampled(scene, machine, options, 4);
        INFO(name);
        CHECK(result.frame.color == expected.frame.color);
        CHECK(result.frame.depth == expected.frame.depth);
        CHECK(result.audit == expected.audit);
        CHECK(passes == static_cast<int>(expected.frame.passes.geometry));
        CHECK(queries > 0);
    }
}

TEST_CASE("a query counts the samples and a ratio is one of all samples") {
    const TriangleScene scene = random_triangles(1207, 40);
    RenderOptions options = sampled_options();
    options.termination = {.rule = strata::pipeline::TerminationRule::ratio, .ratio = 0.25};
    options.sampling.samples = 4;
    const double of_one = 0.25 * 61 * 47, of_all = of_one * 4;
    strata::pipeline::Observer observer;
    int between = 0, wrong = 0;
    observer.step = [&](const auto&, const strata::pipeline::StepEvent& event) {
        if (event.step != strata::pipeline::Step::query) return;
        const auto passed = static_cast<double>(event.passed);
        wrong += event.answer == (passed >= of_all) ? 0 : 1;
        between += passed >= of_one && passed < of_all ? 1 : 0;
    };
    Renderer renderer{scene.list, scene.view, *find_profile("geforce8"), options};
    const RenderResult literal = renderer.render(*find_algorithm("front_to_back"), {}, {.observer = &observer});
    CHECK(wrong == 0);
    CHECK(between == 1);
    CHECK(renderer.render(*find_algorithm("front_to_back")).frame.color == literal.frame.color);
}

// A sample whose own frame would have ended takes part in the later passes of the others, and is rasterized in them.
TEST_CASE("counts of a sampled frame are sums over its samples and its passes are the most of a sample") {
    bool has_greater_before_last = false;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        const TriangleScene scene = random_triangles(1300 + seed, 16, 0.3f);
        const Machine machine{"geforce8", "painter"}, peel{"geforce8", "front_to_back"};
        RenderOptions options = sampled_options();
        options.counters = true;
        for (const Machine& one : {machine, peel}) {
            const RenderResult result = sampled(scene, one, options, 4);
            std::uint64_t order_errors = 0, passed = 0, fragments = 0, visited = 0;
            int iterations = 0, full_screen = 0;
            for (std::size_t s = 0; s < 4; ++s) {
                const RenderResult own = own_frame(scene, one, options, 4, s);
                order_errors += own.audit.order_errors.value_or(0);
                const auto made = static_cast<std::uint64_t>(own.frame.passes.geometry),
                           all = static_cast<std::uint64_t>(result.frame.passes.geometry);
                const std::uint64_t of_pass = own.frame.counters->fragments_rasterized / made;
                passed += of_pass * all;
                fragments += own.frame.work.fragments + of_pass * (all - made);
                visited += own.frame.work.visited + of_pass * (all - made);
                has_greater_before_last |= s == 3 && own.frame.iterations < iterations;
                iterations = std::max(iterations, static_cast<int>(own.frame.iterations));
                full_screen = std::max(full_screen, static_cast<int>(own.frame.passes.full_screen));
            }
            INFO(seed << ' ' << one.algorithm);
            CHECK(result.audit.order_errors == order_errors);
            CHECK(result.frame.counters->fragments_rasterized == passed);
            CHECK(result.frame.work.fragments == fragments);
            CHECK(result.frame.work.visited == visited);
            CHECK(static_cast<int>(result.frame.iterations) == iterations);
            CHECK(static_cast<int>(result.frame.passes.full_screen) == full_screen);
        }
    }
    CHECK(has_greater_before_last);
}
