// Tests how the cost of Carr's algorithms grows with the number of slices, on slices and a cone. The expected passes
// and fragments are those of the paper's section 8; no times are compared.
#include <catch2/catch.hpp>

#include "peeling/render.h"
#include "scenes/camera.h"
#include "tests/tools/program.h"

using namespace strata;

namespace {

peeling::RenderResult render(int slices, const char* algorithm, int size) {
    const scenes::Scene scene = scenes::load_scene("volume-beam:slices=" + std::to_string(slices) + ",order=near", {});
    peeling::RenderOptions options;
    options.width = options.height = size;
    options.threads = 1;
    options.counters = true;
    peeling::Renderer renderer{scene.list, scenes::orbit_view(scene.bounds, 30, 20, 1.0),
                               *pipeline::find_profile("geforce8"), options};
    peeling::RenderResult result = renderer.render(*peeling::find_algorithm(algorithm));
    CHECK(result.audit.order_errors == 0u);
    return result;
}

double work(int slices, const char* algorithm) {
    return static_cast<double>(render(slices, algorithm, 24).frame.counters->fragments_rasterized);
}

}  // namespace

TEST_CASE("on 256 slices and a cone of two layers layer_peel takes 259 iterations and hybrid 3 and coherent 4") {
    const auto layer_peel = render(256, "layer_peel", 24);
    CHECK(layer_peel.audit.layers_max == 258);
    CHECK(layer_peel.frame.iterations == 259);
    CHECK(render(256, "hybrid", 24).frame.iterations == 3);
    // The cone is submitted last and splits the slices into three runs, one of which is longer than 128.
    CHECK(render(256, "coherent_stencil", 24).frame.iterations == 4);
    CHECK(render(256, "coherent_blend", 24).frame.iterations == 4);
}

TEST_CASE("hybrid takes 3 iterations and linear work for any number of slices and layer_peel quadratic work") {
    for (const int slices : {16, 64}) {
        CHECK(render(slices, "hybrid", 24).frame.iterations == 3);
        CHECK(render(slices, "layer_peel", 24).frame.iterations == slices + 3);
        CHECK(render(slices, "coherent_stencil", 24).frame.iterations == 3);
    }
    CHECK(work(64, "hybrid") / work(16, "hybrid") < 4.0);
    CHECK(work(64, "coherent_blend") / work(16, "coherent_blend") < 4.0);
    CHECK(work(64, "layer_peel") / work(16, "layer_peel") > 12.0);
}

TEST_CASE("hybrid grows linearly and layer_peel quadratically from 16 to 1024 slices", "[exhaustive]") {
    for (const int slices : {128, 256, 512, 1024}) {
        CHECK(render(slices, "hybrid", 24).frame.iterations == 3);
        CHECK(render(slices, "layer_peel", 24).frame.iterations == slices + 3);
        CHECK(work(slices, "hybrid") / work(slices / 2, "hybrid") == Approx(2).margin(0.1));
        CHECK(work(slices, "layer_peel") / work(slices / 2, "layer_peel") == Approx(4).margin(0.2));
    }
}

TEST_CASE("the order of triangles and the formulation are part of the command stored in a picture") {
    using namespace strata::test;
    const Folder folder;
    const CommandResult ended = run_strata(
        folder, {"render", "volume-beam:slices=2", "--size", "16x16", "--algorithm", "hybrid", "--formulation",
                 "published", "--sorted", "planes", "--sort", "shuffle:0.5,7", "-o", "out.exr"});
    CHECK(ended.status == 0);
    CHECK(content_of(folder / "out.exr").find("--formulation published --sorted planes --sort shuffle:0.5,7") !=
          std::string::npos);
}
