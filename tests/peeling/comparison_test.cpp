// Tests peels that compare another depth than they store: with depth replace they must be exact, with other paths
// errors must be reported, and all executions must be equal. Epsilons are tested against a model of one pixel's list.
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"
#include "tests/support/difference.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::CompareEpsilon;
using strata::pipeline::DepthFormat;
using strata::pipeline::Execution;
using strata::pipeline::Fault;
using strata::pipeline::VertexPath;
using strata::rasterizer::DepthPath;

[[nodiscard]] RenderOptions small() {
    RenderOptions options;
    options.width = options.height = 48;
    options.threads = 1;
    options.alpha = 0.5f;
    return options;
}

[[nodiscard]] RenderOptions with_paths(DepthFormat format, DepthPath stored, DepthPath compared) {
    RenderOptions options = small();
    options.depth = format;
    options.depth_path = stored;
    options.reference_path = compared;
    return options;
}

[[nodiscard]] RenderResult run(const TriangleScene& scene, const Machine& machine, const RenderOptions& options) {
    RenderResult result = render(scene.list, scene.view, machine, options);
    INFO(machine.algorithm << " on " << machine.profile);
    REQUIRE(result.outcome == strata::peeling::Outcome::done);
    return result;
}

}  // namespace

TEST_CASE(
    "a peel that compares the quotient that depth replace stores equals the peel that compares the stored depth") {
    const TriangleScene scene = random_triangles(961, 60);
    const auto same = [&](const Machine& machine, DepthFormat format) {
        RenderOptions cure = with_paths(format, DepthPath::depth_replace, DepthPath::perspective_rq);
        cure.keep_layers = true;
        RenderOptions plain = cure;
        plain.reference_path.reset();
        const RenderResult a = run(scene, machine, cure), b = run(scene, machine, plain);
        CHECK(a.frame.color == b.frame.color);
        CHECK(a.frame.passes.geometry == b.frame.passes.geometry);
        REQUIRE(a.frame.layers.size() == b.frame.layers.size());
        CHECK(a.frame.layers.size() > 5);
        for (std::size_t i = 0; i < a.frame.layers.size(); ++i) {
            CHECK(a.frame.layers[i].color == b.frame.layers[i].color);
            CHECK(a.frame.layers[i].depth == b.frame.layers[i].depth);
        }
        CHECK(a.audit.order_errors == 0u);
        CHECK_FALSE(has_diagnostic(a, Fault::endless));
    };
    same({"geforce3", "depth_units"}, DepthFormat::d16);
    same({"geforce3", "depth_units"}, DepthFormat::d24);
    same({"ideal", "depth_units"}, DepthFormat::d32f);
    same({"ideal", "front_to_back"}, DepthFormat::d32f);
}

TEST_CASE("with stored window_z and compared r/q layers are repeated or lost and the run reports that it did not end") {
    const TriangleScene scene = random_triangles(962, 60);
    const RenderResult right = run(scene, {"geforce3", "depth_units"}, small());
    const RenderResult wrong = run(scene, {"geforce3", "depth_units"},
                                   with_paths(DepthFormat::d24, DepthPath::window_z, DepthPath::perspective_rq));
    CHECK(wrong.audit.order_errors.value() > 0);
    CHECK(has_diagnostic(wrong, Fault::endless));
    CHECK(diagnosed(wrong, Fault::unlike_depths) == wrong.audit.misordered.pixels);
    CHECK(wrong.frame.passes.geometry > right.frame.passes.geometry);
}

TEST_CASE(
    "a compared depth that is not rounded like the stored one never ends a D24 peel six layers deep and is reported") {
    FragmentScene scene{2, 2};
    for (std::size_t p = 0; p < 4; ++p)
        for (int layer = 0; layer < 6; ++layer)
            scene.pixels[p].fragments.push_back(
                {.depth = 0.0625f + 0.140625f * static_cast<float>(layer), .color = {1, 1, 1, 0.5f}});
    RenderOptions options = options_for(scene);
    options.depth = DepthFormat::d24;
    options.quantize_reference = false;
    const RenderResult found = render(scene, {"geforce8", "front_to_back"}, options);
    CHECK(found.frame.passes.geometry == 14);  // 2 * 6 + 2
    REQUIRE(has_diagnostic(found, Fault::endless));
    for (const auto& d : found.frame.diagnostics)
        if (d.fault == Fault::endless) CHECK(d.detail.find("not rounded like the stored one") != std::string::npos);
    CHECK(found.audit.order_errors.value() > 0);
    options.quantize_reference = true;
    const RenderResult right = render(scene, {"geforce8", "front_to_back"}, options);
    CHECK(right.frame.passes.geometry == 7);
    CHECK_FALSE(has_diagnostic(right, Fault::endless));
    auto profile = *strata::pipeline::find_profile("geforce8");  // the device's hypothesis gives the same
    profile.raster.hypothesis.quantize_reference = false;
    const auto list = draw_list(scene);
    strata::peeling::Renderer renderer{list, {}, profile, options};
    CHECK(renderer.render(*strata::peeling::find_algorithm("front_to_back")).frame.passes.geometry == 14);
}

namespace {

// Works on codes of D32F, in which neighbours are one unit in the last place apart.
[[nodiscard]] float raised(float z, int ulps) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(z) + static_cast<std::uint32_t>(ulps));
}

// One pixel's fragments; 2 depth - 1 is exact in binary32 for these.
[[nodiscard]] FragmentScene column(const std::vector<float>& depths) {
    FragmentScene scene{1, 1};
    for (const float z : depths) scene.pixels[0].fragments.push_back({.depth = z, .color = {1, 1, 1, 0.25f}});
    return scene;
}

// Number of layers that a peel with this epsilon finds: each is the nearest one beyond the last layer plus the epsilon.
[[nodiscard]] int model_layers(std::vector<float> depths, const CompareEpsilon& epsilon) {
    std::ranges::sort(depths);
    int layers = 0;
    double peeled = -1;
    for (const float z : depths) {
        if (double{z} <= peeled) continue;
        ++layers;
        peeled = double{raised(z, epsilon.ulps)} + epsilon.absolute;
    }
    return layers;
}

}  // namespace

TEST_CASE("an epsilon in the shader's comparison merges the layers within it from front to back") {
    constexpr float u = 0x1p-24f;  // a unit in the last place of [0.5, 1)
    const std::vector<float> depths{0.5f, 0.5f + u, 0.5f + 2 * u, 0.5f + 4 * u, 0.625f, 0.75f, 0.75f + 6 * u};
    for (const CompareEpsilon epsilon :
         {CompareEpsilon{}, {0, 1}, {0, 2}, {0, 3}, {0, 100}, {0x1p-23, 0}, {1e-5, 0}, {0.125, 0}, {0.2, 1}}) {
        const FragmentScene scene = column(depths);
        RenderOptions options = options_for(scene);
        options.compare_epsilon = epsilon;
        options.audit = false;
        for (const char* algorithm : {"front_to_back", "depth_units"}) {
            INFO(algorithm << ", " << epsilon.absolute << " and " << epsilon.ulps << " ulp");
            const RenderResult found = render(scene, {"geforce8", algorithm}, options);
            CHECK(found.frame.passes.geometry == model_layers(depths, epsilon) + 1);
        }
    }
}

TEST_CASE("dual peeling counts depths within the epsilon of a peeled depth as that depth") {
    constexpr float u = 0x1p-24f;
    struct Case {
        std::vector<float> depths;
        CompareEpsilon epsilon;
        int passes;  // 1 + the number of passes of the list model below
    };
    // Each pass takes the nearest and the farthest depth, and all within the epsilon of either.
    const auto model = [](std::vector<float> left, double epsilon) {
        int passes = 0;
        while (!left.empty()) {
            const double near = *std::ranges::min_element(left), far = *std::ranges::max_element(left);
            std::erase_if(left, [&](float z) { return double{z} <= near + epsilon || double{z} >= far - epsilon; });
            ++passes;
        }
        return 1 + std::max(1, passes);
    };
    const std::vector<float> depths{0.5f, 0.5f + u, 0.5f + 2 * u, 0.5f + 8 * u, 0.625f, 0.75f, 0.75f + 2 * u, 0.875f};
    for (const double ulps : {0.0, 1.0, 2.0, 6.0, 8.0}) {
        const FragmentScene scene = column(depths);
        RenderOptions options = options_for(scene);
        options.audit = false;
        options.compare_epsilon = {0, static_cast<int>(ulps)};
        for (const char* algorithm : {"dual", "dual_independent"}) {
            INFO(algorithm << ", " << ulps);
            const int extra = algorithm == std::string{"dual"} ? 0 : 1;  // its query finds the end one pass later
            const int expected = model(depths, ulps * double{u});
            CHECK(render(scene, {"geforce8_dx101", algorithm}, options).frame.passes.geometry == expected + extra);
            options.compare_epsilon = {ulps * double{u}, 0};
            CHECK(render(scene, {"geforce8_dx101", algorithm}, options).frame.passes.geometry == expected + extra);
        }
    }
}

TEST_CASE("passes that transform by another vertex path see other depths and with the same path the lists are equal") {
    const TriangleScene scene = random_triangles(963, 60);
    RenderOptions options = small();
    const RenderResult plain = run(scene, {"geforce8", "front_to_back"}, options);
    options.vertex_paths = {VertexPath::separate, VertexPath::separate};
    CHECK(difference(run(scene, {"geforce8", "front_to_back"}, options), plain) == "");
    std::uint64_t errors = 0;
    for (const VertexPath second : {VertexPath::fused, VertexPath::reassociated, VertexPath::double_precision,
                                    VertexPath::toward_zero, VertexPath::nv20}) {
        options.vertex_paths.second = second;
        errors += run(scene, {"geforce8", "front_to_back"}, options).audit.order_errors.value();
    }
    CHECK(errors > 0);
    options.vertex_paths = {VertexPath::fused, std::nullopt};  // both passes alike, so there is no error
    CHECK(run(scene, {"geforce8", "front_to_back"}, options).audit.order_errors == 0u);
}

TEST_CASE("a second list with the same or split or clamped triangles is drawn by the passes that peel") {
    const TriangleScene scene = random_triangles(964, 60);
    RenderOptions options = small();
    options.audit = false;
    options.counters = true;
    const RenderResult plain = run(scene, {"geforce8", "front_to_back"}, options);
    options.second_list = &scene.list;
    const RenderResult again = run(scene, {"geforce8", "front_to_back"}, options);
    CHECK(again.frame.color == plain.frame.color);
    CHECK(again.frame.counters == plain.frame.counters);
    strata::pipeline::DrawList empty = scene.list;
    empty.instances.clear();
    options.second_list = &empty;  // only the first pass finds fragments
    CHECK(run(scene, {"geforce8", "front_to_back"}, options).frame.passes.geometry == 2);
    options.second_list = nullptr;
    options.second_depth_clamp = true;
    CHECK(run(scene, {"geforce8", "front_to_back"}, options).frame.color ==
          plain.frame.color);  // nothing crosses the near or far plane
}

TEST_CASE("an algorithm that knows only stored codes is rejected where another depth is to be compared") {
    const TriangleScene scene = random_triangles(967, 8);
    RenderOptions options = small();
    options.compare_epsilon = {0, 1};
    for (const char* algorithm : {"layer_peel", "hybrid", "coherent_stencil", "batched"}) {
        const RenderResult result = render(scene.list, scene.view, {"ideal", algorithm}, options);
        REQUIRE(result.outcome == strata::peeling::Outcome::refused);
        CHECK(result.refusal->message(*strata::pipeline::find_profile("ideal")) ==
              std::string{"algorithm "} + algorithm +
                  " has no other compared depth; use depth_units, front_to_back, dual or dual_independent");
    }
    CHECK(render(scene.list, scene.view, {"ideal", "weighted_sum"}, options).outcome == strata::peeling::Outcome::done);
}

TEST_CASE("a window at another position of its surface shows the same picture with an exact depth path") {
    const TriangleScene scene = random_triangles(965, 60);
    RenderOptions options = small();
    const RenderResult here = run(scene, {"geforce8", "dual"}, options);
    options.window_origin = {1000, 2000};
    const RenderResult there = run(scene, {"geforce8", "dual"}, options);
    CHECK(there.frame.color == here.frame.color);
    CHECK(there.frame.depth == here.frame.depth);
    CHECK(there.audit.order_errors == here.audit.order_errors);
    CHECK(there.audit.max_difference == here.audit.max_difference);
}

TEST_CASE("literal and rasterized and replayed peels are equal for any compared depth", "[slow]") {
    const TriangleScene scene = random_triangles(966, 24);
    struct Setting {
        const char* name;
        Machine machine;
        RenderOptions options;
    };
    std::vector<Setting> settings;
    for (const char* algorithm : {"front_to_back", "depth_units", "dual", "dual_independent"}) {
        settings.push_back({"reference",
                            {"ideal", algorithm},
                            with_paths(DepthFormat::d32f, DepthPath::exact, DepthPath::perspective_rq)});
        RenderOptions epsilon = small();
        epsilon.compare_epsilon = {1e-3, 3};
        settings.push_back({"epsilon", {"ideal", algorithm}, epsilon});
        RenderOptions second = small();
        second.vertex_paths.second = VertexPath::fused;
        settings.push_back({"second list", {"ideal", algorithm}, second});
    }
    settings.push_back({"hazard",
                        {"geforce3", "depth_units"},
                        with_paths(DepthFormat::d24, DepthPath::window_z, DepthPath::perspective_rq)});
    settings.push_back({"replaced",
                        {"geforce3", "depth_units"},
                        with_paths(DepthFormat::d16, DepthPath::depth_replace, DepthPath::perspective_rq)});
    for (Setting& setting : settings) {
        INFO(setting.name << ", " << setting.machine.algorithm);
        setting.options.execution = Execution::literal;
        const RenderResult literal = run(scene, setting.machine, setting.options);
        for (const Running& running : all_ways_of_running)
            for (const auto effects : {strata::pipeline::Effects::needed, strata::pipeline::Effects::all}) {
                running.apply(setting.options);
                setting.options.effects = effects;
                setting.options.tile_size = 16;
                CHECK(difference(run(scene, setting.machine, setting.options), literal) == "");
            }
        setting.options.effects = strata::pipeline::Effects::needed;
    }
}
