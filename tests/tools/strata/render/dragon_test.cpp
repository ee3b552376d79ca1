// Checks every pixel of a large scene: the expected picture is the model of tests/support/composite_model.h applied to
// the per-pixel lists of a_buffer.
#include <bit>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>

#include "peeling/render.h"
#include "scenes/camera.h"
#include "tests/support/composite_model.h"
#include "tests/support/skip.h"

namespace {

using namespace strata;
using testing::DepthGroups;
using testing::TargetModel;

using Model = pipeline::Rgba (*)(const DepthGroups&);
struct Case {
    const char* profile;
    const char* algorithm;
    Model model;
};
constexpr TargetModel bytes{pipeline::Format::rgba8};
constexpr pipeline::Rgba black{0, 0, 0, 1};

const Case cases[] = {
    {"geforce8", "depth_units", [](const DepthGroups& g) { return testing::depth_units_model(bytes, g, black); }},
    {"geforce8", "front_to_back", [](const DepthGroups& g) { return testing::front_to_back_model(bytes, g, black); }},
    {"geforce8", "dual", [](const DepthGroups& g) { return testing::dual_model(bytes, g, black); }},
    {"geforce8_dx101", "dual_independent",
     [](const DepthGroups& g) { return testing::dual_independent_model(bytes, g, black); }},
};

// Number of channels in which the rendered picture differs from the model's result for the same fragments.
std::size_t wrong_channels(const scenes::Scene& scene, const Case& c, const peeling::RenderOptions& options) {
    const peeling::Algorithm& algorithm = *peeling::find_algorithm(c.algorithm);
    const auto view = scenes::orbit_view(scene.bounds, 30, 20, 1.0);
    peeling::Renderer renderer{scene.list, view, *pipeline::find_profile(c.profile), options};
    const pipeline::Image color = renderer.render(algorithm).frame.color;
    std::vector<DepthGroups> pixels(color.codes.size() / 4);
    for (const pipeline::CapturedFragment& f : renderer.fragments(algorithm).all)
        // D32F: the code holds the bits of the shader's depth
        if (f.shader_z < 1.0f) pixels[f.pixel][f.shader_z].push_back(f.color);
    std::size_t wrong = 0;
    for (std::size_t p = 0; p < pixels.size(); ++p) {
        const pipeline::Rgba expected = c.model(pixels[p]);
        for (std::size_t channel = 0; channel < 3; ++channel)
            wrong += color.codes[4 * p + channel] != bytes.code(expected[channel]);
    }
    return wrong;
}

}  // namespace

TEST_CASE("the picture of the dragon on geforce8 is bit-identical to the model's composite of its fragments") {
    const char* const named = std::getenv("STRATA_MODELS_DIR");
    const auto path = std::filesystem::path{named != nullptr ? named : STRATA_MODELS_DIR} / "dragon.glb";
    if (!std::filesystem::exists(path)) {
        strata::test::skip("no dragon.glb in '" + path.parent_path().string() +
                           "'; set STRATA_MODELS_DIR to its folder");
        return;
    }
    const scenes::Scene scene = scenes::load_scene(path.string(), {});
    peeling::RenderOptions options;  // 1024 x 1024
    options.alpha = 0.3f;
    for (const Case& c : cases) {
        INFO(c.algorithm);
        CHECK(wrong_channels(scene, c, options) == 0);
    }
}
