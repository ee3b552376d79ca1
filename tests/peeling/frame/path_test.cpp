// Tests which execution path a run reports, against a list of the paths that each setting requires.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/peeling/rendering.h"
#include "tests/pipeline/frames.h"

// A separate namespace: models of several tests use the same short names, and a unity build joins their files.
namespace strata::testing::path_model {
namespace {

using namespace pipeline;
using peeling::RenderOptions;

struct Case {
    Machine machine;
    std::function<void(RenderOptions&)> change;
    Path path;
    std::string why;
};

FragmentScene three_layers() {
    FragmentScene scene{16, 16};
    for (auto& pixel : scene.pixels)
        pixel.fragments = {{0.25f, {1, 0, 0, 0.5f}}, {0.5f, {0, 1, 0, 0.5f}}, {0.75f, {0, 0, 1, 0.5f}}};
    return scene;
}

}  // namespace

TEST_CASE("a run reports its path and why it did not use a faster one") {
    const auto as_is = [](RenderOptions&) {};
    const auto literal = [](RenderOptions& o) { o.execution = Execution::literal; };
    const auto counted = [](RenderOptions& o) { o.counters = true; };
    const auto without_memory = [](RenderOptions& o) { o.fragment_memory = 0; };
    const auto all_effects = [](RenderOptions& o) { o.effects = Effects::all; };
    const auto layered = [](RenderOptions& o) { o.keep_layers = true; };
    const auto over_clear = [](RenderOptions& o) { o.background = {0, 0, 0, 0}; };
    const auto in_halves = [](RenderOptions& o) { o.result_format = Format::rgba16f; };
    const auto by_ratio = [](RenderOptions& o) { o.termination = {TerminationRule::ratio, 0.01}; };
    const auto by_epsilon = [](RenderOptions& o) { o.compare_epsilon.ulps = 1; };
    const auto fixed = [](RenderOptions& o) { o.termination.rule = TerminationRule::fixed, o.termination.passes = 2; };
    const Machine dual{"geforce8", "dual"}, front_to_back{"geforce8", "front_to_back"};
    const std::vector<Case> cases{
        {dual, as_is, Path::resolved, ""},
        {dual, fixed, Path::resolved, ""},
        {front_to_back, as_is, Path::resolved, ""},
        {front_to_back, layered, Path::recorded, "layers are kept"},
        {{"geforce8", "front_to_back_ties"}, as_is, Path::recorded, ""},
        {{"geforce3", "depth_units"}, as_is, Path::recorded, ""},
        {{"geforce8", "weighted_average"}, as_is, Path::tiled, ""},
        {{"geforce8", "weighted_average"}, without_memory, Path::tiled, ""},
        {dual, layered, Path::recorded, "layers are kept"},
        {dual, over_clear, Path::recorded, "the background's alpha is not 1"},
        {dual, in_halves, Path::recorded, "the back or the picture has a format of its own"},
        {dual, by_ratio, Path::recorded, "--termination asks after every pass how many are left"},
        {dual, by_epsilon, Path::recorded, "passes compare other depths than they store, or draw other vertices"},
        {dual, without_memory, Path::tiled, "--fragment-memory 0 records nothing"},
        {front_to_back, all_effects, Path::tiled, "--effects all simulates every effect in every pass"},
        {dual, literal, Path::literal, "--execution literal"},
        {dual, counted, Path::literal, "--counters counts in literal execution"},
        {{"geforce8", "object_sorted"}, as_is, Path::literal, "queries nest, so that no tile may end by itself"},
        {{"geforce8", "batched"}, fixed, Path::literal, "a limit of passes counts across loops"}};
    const FragmentScene scene = three_layers();
    for (const Case& c : cases) {
        RenderOptions options = options_for(scene);
        options.audit = false;
        c.change(options);
        const Work work = render(scene, c.machine, options).frame.work;
        INFO(c.machine.algorithm << ", " << work.why);
        CHECK(work.path == c.path);
        CHECK(work.why == c.why);
    }
}

TEST_CASE("of several tiles the slowest determines the frame's path such as one whose fragments exceed the memory") {
    FragmentScene scene = three_layers();
    for (int k = 0; k < 4000; ++k) scene.pixels[0].fragments.push_back({0.5f, {1, 1, 1, 0.5f}});
    RenderOptions options = options_for(scene);
    options.audit = false;
    options.tile_size = 8;
    options.threads = 1;
    options.fragment_memory = 64 << 10;  // too little even for a part of the tile
    const Work work = render(scene, {"geforce8", "front_to_back"}, options).frame.work;
    CHECK(work.path == Path::tiled);
    CHECK(work.why == "a tile's fragments take more than --fragment-memory");
}

}  // namespace strata::testing::path_model
