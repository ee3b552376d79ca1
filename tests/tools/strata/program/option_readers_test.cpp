// Tests which algorithms read an option against the pictures: an option that changes a picture is read, and one that is
// read changes a picture. Also that options without effect are refused by name.
#include "tools/strata/options/option_readers.h"

#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "peeling/render.h"
#include "pipeline/device/profile.h"
#include "pipeline/vertices/draw_list.h"
#include "scenes/camera.h"
#include "scenes/scene.h"
#include "tests/tools/program.h"
#include "tools/request/option_fields.h"

namespace {

using namespace strata;
using namespace strata::test;
using peeling::RenderOptions;

struct Change {
    std::string_view option;
    void (*make)(RenderOptions& options);
};

// A value of each option that is far from its default.
const std::vector<Change> changes{
    {"--weight", [](RenderOptions& o) { o.algorithm.weight = peeling::Weight::constant; }},
    {"--nodes", [](RenderOptions& o) { o.algorithm.nodes = 1; }},
    {"--tail", [](RenderOptions& o) { o.algorithm.tail = peeling::Tail::weighted; }},
    {"--pixel-nodes", [](RenderOptions& o) { o.algorithm.pixel_nodes = 1; }},
    {"--frame-nodes", [](RenderOptions& o) { o.algorithm.frame_nodes = 5; }},
    {"--list-granularity", [](RenderOptions& o) { o.algorithm.list_granularity = peeling::ListGranularity::pixel; }},
    {"--moments", [](RenderOptions& o) { o.algorithm.moments = 8; }},
    {"--moment-bias", [](RenderOptions& o) { o.algorithm.moment_bias = 0.5f; }},
    {"--overestimation", [](RenderOptions& o) { o.algorithm.overestimation = 0.9f; }},
    {"--stochastic-samples", [](RenderOptions& o) { o.algorithm.stochastic_samples = 1; }},
    {"--stochastic-seed", [](RenderOptions& o) { o.algorithm.stochastic_seed = 7; }}};

}  // namespace

TEST_CASE("exactly the algorithms that are said to read an option draw another picture with it") {
    const scenes::Scene scene = scenes::load_scene("random:triangles=300", {});
    const pipeline::View view = scenes::orbit_view(scene.bounds, 30, 20, 1);
    // No profile runs all algorithms with all options.
    const auto codes = [&](const RenderOptions& options, const peeling::Algorithm& algorithm) {
        std::vector<std::uint32_t> all;
        for (const char* profile : {"ideal", "geforce8", "llvmpipe"}) {
            peeling::Renderer renderer{scene.list, view, *pipeline::find_profile(profile), options};
            const auto picture = renderer.render(algorithm).frame.color.codes;
            all.insert(all.end(), picture.begin(), picture.end());
        }
        return all;
    };
    std::string wrong;
    for (const Change& change : changes)
        for (const peeling::Algorithm& algorithm : peeling::algorithms()) {
            RenderOptions options;
            options.width = options.height = 32;
            options.audit = false;
            options.max_passes = change.option == "--tail" ? 2 : 0;  // the tail of a peel that ends early
            if (change.option == "--list-granularity") {
                options.sampling.samples = 4;
                options.raster.interpolation = rasterizer::Interpolation::centre;
            }
            const auto plain = codes(options, algorithm);
            change.make(options);
            const bool is_changed = codes(options, algorithm) != plain;
            tools::PictureRequest request;
            request.render = options;
            const tools::OptionField& field = *tools::find_option(change.option.substr(2));
            if (is_changed != tools::reads(algorithm, field, request))
                wrong += algorithm.name + " " + std::string{change.option} + (is_changed ? " changes; " : " is idle; ");
        }
    CHECK(wrong == "");
}

TEST_CASE("an option that nothing reads is refused by name") {
    struct Idle {
        std::vector<std::string> words;
        std::string message;
    };
    const auto idle = GENERATE(values<Idle>({
        {{"render", "teapot", "--moments", "6"},
         "--moments has no effect on dual; algorithms that use it: moments, moments_quantized"},
        {{"explain", "teapot", "--pixel", "1,1", "--algorithm", "front_to_back,dual", "--sorted", "x"},
         "--sorted has no effect on front_to_back, dual; algorithms that use it: hybrid"},
        {{"passes", "teapot", "--weight", "eq7", "--tail", "blend", "-o", "p"}, "--weight has no effect on dual; "},
        {{"golden", "teapot", "--formulation", "published", "-o", "p"}, "--formulation has no effect on dual; "},
        {{"report", "teapot", "--algorithm", "dual", "--nodes", "2", "-o", "r"}, "--nodes has no effect on dual; "},
        {{"golden", "--check", "p", "--size", "8x8"}, "--size has no effect with --check"},
        {{"golden", "--suite", "-o", "p", "--alpha", "1"}, "--alpha has no effect with --suite, whose scenes have"},
        {{"compare", "a.png", "b.png", "--exact"}, "--exact has no effect if the reference is a picture"},
        {{"compare", "a.png", "b.png", "--algorithm", "dual"},
         "--algorithm has no effect if the reference is a picture"},
        {{"compare", "a.png", "b.png", "--layout", "8x8:rgba8"}, "--layout has no effect: no file of raw numbers"},
        {{"diagnose", "--list", "teapot"}, "SCENE has no effect with --list"},
        {{"render", "teapot", "-o", "a.png", "--mistake", "over_for_under", "--stats", "-"},
         "--stats has no effect with --mistake"},
        {{"render", "teapot", "--counters"}, "--counters has no effect without --stats"},
        {{"bench", "teapot", "--algorithm", "depth,dual", "--moments", "6"}, "--moments has no effect on dual; "},
        {{"multisampling", "teapot", "--algorithm", "dual", "--nodes", "2"}, "--nodes has no effect on dual; "},
        {{"render", "teapot", "--resolve", "quincunx"},
         "--resolve: expected quincunx with --samples 2, found 1 sample per pixel"},
    }));
    const Folder folder;
    const CommandResult ended = run_strata(folder, idle.words);
    CHECK(ended.err.starts_with("strata: " + idle.message));
    CHECK(ended.status == 2);
    CHECK(folder.files().empty());
}

TEST_CASE("an option of one of several algorithms is accepted and recorded only in the pictures of its readers") {
    const Folder folder;
    REQUIRE(run_strata(folder, {"render", "planes:count=3", "--size", "8x8", "--algorithm", "dual,moments", "--moments",
                                "6", "--weight", "eq10", "-o", "a.png"})
                .status == 2);  // --weight has no effect on either
    REQUIRE(run_strata(folder, {"render", "planes:count=3", "--size", "8x8", "--algorithm", "dual,moments", "--moments",
                                "6", "-o", "a.png"})
                .status == 0);
    CHECK(content_of(folder / "a.moments.png").find("--moments 6") != std::string::npos);
    CHECK(content_of(folder / "a.dual.png").find("--moments") == std::string::npos);
    CHECK(run_strata(folder, {"render", "--from", "a.dual.png", "-o", "b.png"}).status == 0);
    CHECK(content_of(folder / "b.png") == content_of(folder / "a.dual.png"));
}
