// Tests rare options of a renderer: messages of rejections, listed here independently; pictures and counts that an
// option must not change; and diagnostics for invented figures.
#include <catch2/catch.hpp>

#include "peeling/audit/audit_result.h"
#include "peeling/audit/region_trace.h"
#include "peeling/frame/check_options.h"
#include "peeling/frame/prepared_lists.h"
#include "peeling/frame/render_diagnostics.h"
#include "peeling/memory_need.h"
#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;
using strata::rasterizer::DepthPath;

const View parallel_view{};

// Three layers, near to far or far to near, at 4 x 4 pixels.
FragmentScene three_layers(bool near_first) {
    FragmentScene scene{4, 4};
    for (GivenPixel& pixel : scene.pixels)
        for (const int k : {1, 2, 3}) {
            const float depth = static_cast<float>(near_first ? k : 4 - k) / 4.0f;
            pixel.fragments.push_back({depth, {depth, 0.5f, 1 - depth, 0.5f}});
        }
    return scene;
}

std::string refusal_of(const DeviceProfile& profile, const DrawList& list, const RenderOptions& options,
                       const Algorithm& algorithm) {
    Renderer renderer{list, parallel_view, profile, options};
    const RenderResult result = renderer.render(algorithm);
    return result.refusal ? result.refusal->message(profile) : "rendered";
}

std::string error_of(const RenderOptions& options) {
    try {
        check_options(options);
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "accepted";
}

RenderOptions four_by_four() { return options_for(three_layers(true)); }

}  // namespace

TEST_CASE("reports name the tie policies as in keys-and-counts.md and an unknown algorithm is not found") {
    CHECK(name(TiePolicy::none) == "none");
    CHECK(name(TiePolicy::first) == "first");
    CHECK(name(TiePolicy::last) == "last");
    CHECK(name(TiePolicy::unique) == "unique");
    CHECK(name(TiePolicy::merged) == "merged");
    CHECK(name(TiePolicy::first_then_last) == "first_then_last");
    CHECK(find_algorithm("no_such_peel") == nullptr);
}

TEST_CASE("a colour format must be a listed one with colours") {
    RenderOptions options = four_by_four();
    options.color_format = Format::d24;
    CHECK(error_of(options).find("color_format: expected a colour format") != std::string::npos);
    options.color_format = static_cast<Format>(200);
    CHECK(error_of(options).find("color_format: expected a colour format, found 200") != std::string::npos);
    options.color_format = Format::rgba16f;
    CHECK(error_of(options) == "accepted");
    options.result_format = Format::d24;
    CHECK(error_of(options).find("result_format: expected a colour format") != std::string::npos);
    options.result_format.reset();
    options.back_format = Format::d24;
    CHECK(error_of(options).find("back_format: expected a colour format") != std::string::npos);
}

TEST_CASE("the chip's own depths need one of its formats and a compared depth that the device has") {
    DeviceProfile float_depth = *find_profile("geforce3");
    float_depth.has_d32f = true;
    for (const DepthPath path : {DepthPath::window_z, DepthPath::w_buffer}) {
        const auto with = [&](DepthFormat format) {
            const std::optional<Refusal> found = check_depth(float_depth, {path, format});
            return found ? found->message(float_depth) : std::string{"had"};
        };
        CHECK(with(DepthFormat::d24) == "had");
        CHECK(with(DepthFormat::d32f).find(path == DepthPath::window_z ? "depth interpolator window_z" : "w buffer") !=
              std::string::npos);
    }
    const std::optional<Refusal> lacking =
        check_depth(*find_profile("geforce8"), {DepthPath::float32, DepthFormat::d24, DepthPath::depth_replace});
    REQUIRE(lacking);
    CHECK(lacking->message(*find_profile("geforce8")).find("depth replace by texture shaders") != std::string::npos);
}

TEST_CASE("an algorithm is rejected without a body or without enough render targets or for a constant w") {
    const DrawList list = draw_list(three_layers(true));
    Algorithm neither;
    neither.name = "neither";
    CHECK_THROWS_WITH(refusal_of(*find_profile("ideal"), list, four_by_four(), neither),
                      "algorithm 'neither': run: expected a function, or one in body, found neither");
    DeviceProfile two_targets = *find_profile("geforce8");
    two_targets.max_render_targets = 2;
    CHECK(refusal_of(two_targets, list, four_by_four(), *find_algorithm("dual")).find("3 render targets in one pass") !=
          std::string::npos);
    CHECK(refusal_of(two_targets, list, four_by_four(), *find_algorithm("front_to_back")) == "rendered");
    RenderOptions by_w = four_by_four();
    by_w.reference_path = DepthPath::w_buffer;
    CHECK(refusal_of(*find_profile("geforce3"), list, by_w, *find_algorithm("depth_units"))
              .find("w buffer for a parallel projection") != std::string::npos);
}

TEST_CASE("a light's map stores z even where w is stored and is rejected in a format that the device lacks") {
    DrawList list = draw_list(three_layers(true));
    list.light = ShadowLight{};
    RenderOptions options = four_by_four();
    CHECK(refusal_of(*find_profile("geforce8"), list, options, *find_algorithm("unsorted")) == "rendered");
    options.depth = DepthFormat::d16;
    CHECK(refusal_of(*find_profile("geforce8"), list, options, *find_algorithm("unsorted"))
              .find("16-bit depth buffers") != std::string::npos);
    DeviceProfile stores_w = *find_profile("geforce3");
    stores_w.raster.depth_path = DepthPath::w_buffer;
    RenderOptions by_z = four_by_four();
    by_z.depth_path = DepthPath::float32;
    CHECK(refusal_of(stores_w, list, by_z, *find_algorithm("unsorted")) == "rendered");
    RenderOptions reversed = four_by_four();
    reversed.raster.depth_order = strata::rasterizer::DepthOrder::greater;
    CHECK(refusal_of(*find_profile("geforce8"), list, reversed, *find_algorithm("unsorted"))
              .find("reversed depth together with a light") != std::string::npos);
}

TEST_CASE("a depth pass is rejected for its size and for its depth like any frame") {
    const DrawList list = draw_list(three_layers(true));
    RenderOptions large = four_by_four();
    large.width = 16384;
    Renderer too_wide{list, parallel_view, *find_profile("geforce3"), large};
    CHECK(too_wide.depth_pass().refusal.value().message(*find_profile("geforce3")).find("viewport of 16384 x 4") !=
          std::string::npos);
    RenderOptions narrow = four_by_four();
    narrow.depth = DepthFormat::d16;
    Renderer lacks_depth{list, parallel_view, *find_profile("geforce8"), narrow};
    const RenderResult result = lacks_depth.depth_pass();
    CHECK(result.outcome == Outcome::refused);
    CHECK(result.refusal.value().message(*find_profile("geforce8")).find("16-bit depth buffers") != std::string::npos);
}

TEST_CASE("a traced frame keeps its traces and does not change its audit") {
    const DrawList list = draw_list(three_layers(true));
    Renderer renderer{list, parallel_view, *find_profile("geforce8"), four_by_four()};
    std::vector<RegionTrace> traces;
    const RenderResult traced = renderer.render_traced(*find_algorithm("front_to_back"), traces);
    CHECK(traced.audit == AuditResult{});
    std::size_t entries = 0;
    for (const RegionTrace& trace : traces) entries += trace.entries.size();
    CHECK(entries == 3 * 16);
    const RenderResult audited = renderer.render(*find_algorithm("front_to_back"));
    CHECK(audited.audit.layers_max == 3);
    CHECK(audited.frame.color == traced.frame.color);
}

TEST_CASE("a log of passes has those of every loop for any requested execution") {
    const DrawList list = draw_list(three_layers(false));
    for (const auto& algorithm : algorithms()) {
        if (!algorithm.runs_loops) continue;
        RenderOptions options = four_by_four();
        options.tile_size = 8;
        Renderer renderer{list, parallel_view, *find_profile("ideal"), options};
        const RenderResult logged = renderer.render(algorithm, {}, {.log_passes = true});
        INFO(algorithm.name);
        CHECK(logged.frame.work.tile_size == 0);  // as a whole frame
        int transparent = 0;
        for (const auto& pass : logged.frame.pass_log.passes) transparent += pass.is_opaque_priming ? 0 : 1;
        CHECK(transparent >= logged.frame.passes.geometry);
        CHECK(logged.frame.color == renderer.render(algorithm).frame.color);
    }
}

TEST_CASE("fragments of a reversed frame have their depths and not their keys") {
    FragmentScene scene{2, 2};
    for (GivenPixel& pixel : scene.pixels) pixel = {{{0.25f, {1, 1, 1, 0.5f}}, {0.75f, {1, 0, 0, 0.5f}}}, {}};
    const DrawList list = draw_list(scene);
    RenderOptions options = options_for(scene);
    options.raster.depth_order = strata::rasterizer::DepthOrder::greater;
    Renderer renderer{list, parallel_view, *find_profile("geforce8"), options};
    const FrameFragments found = renderer.fragments(*find_algorithm("front_to_back"));
    REQUIRE(found.all.size() == 8);
    for (const CapturedFragment& f : found.all) {
        const float depth = f.primitive < 4 ? 0.25f : 0.75f;
        CHECK(f.shader_z == depth);
        CHECK(f.code == std::bit_cast<std::uint32_t>(depth));
    }
    CHECK(found.opaque == std::vector<std::uint32_t>(4, 0));  // the reversed far plane is 0
}

TEST_CASE("the predicted memory of an algorithm with captured values is that of the function that it calls") {
    const DrawList list = draw_list(three_layers(true));
    const Algorithm& listed = *find_algorithm("front_to_back");
    Algorithm carrying = listed;
    carrying.run = nullptr;
    carrying.resolve_loop = nullptr;
    carrying.body = [&](Region& region) { listed.run(region); };
    Algorithm running = listed;
    running.resolve_loop = nullptr;
    RenderOptions options = four_by_four();
    options.keep_layers = true;
    for (const bool keeps : {false, true}) {
        options.keep_layers = keeps;
        const MemoryNeed one = memory_need({list, parallel_view, *find_profile("geforce8"), options}, carrying);
        const MemoryNeed other = memory_need({list, parallel_view, *find_profile("geforce8"), options}, running);
        CHECK(one.targets == other.targets);
        CHECK(one.fragments == other.fragments);
        CHECK(one.layers == other.layers);
        CHECK((one.layers > 0) == keeps);
    }
}

TEST_CASE(
    "a frame with another window origin on its surface shows the same picture and reports pixels of the surface") {
    const TriangleScene scene = random_triangles(7, 12);
    RenderOptions options;
    options.width = options.height = 32;
    options.threads = 1;
    const auto rendered = [&](std::array<int, 2> origin) {
        options.window_origin = origin;
        return render(scene.list, scene.view, {"geforce8", "front_to_back"}, options);
    };
    const RenderResult first = rendered({0, 0});
    REQUIRE(first.audit.ties.pixels > 0);
    for (const std::array<int, 2> origin : {std::array{0, 64}, std::array{64, 0}, std::array{32, 96}}) {
        const RenderResult moved = rendered(origin);
        CHECK(moved.frame.color == first.frame.color);
        CHECK(moved.audit.ties.pixels == first.audit.ties.pixels);
        CHECK(moved.audit.ties.first_x == first.audit.ties.first_x + origin[0]);
        CHECK(moved.audit.ties.first_y == first.audit.ties.first_y + origin[1]);
    }
}

TEST_CASE("an ordered set is named by its mesh or its material and saves passes of hybrid") {
    const DrawList list = [] {
        DrawList made = draw_list(three_layers(true));
        made.meshes[0].name = "panes";
        return made;
    }();
    const auto passes = [&](std::vector<std::string> sorted) {
        RenderOptions options = four_by_four();
        options.sorted = std::move(sorted);
        const RenderResult result = render(list, parallel_view, {"geforce8", "hybrid"}, options);
        CHECK(result.audit.order_errors == 0u);
        return result.frame.passes.geometry;
    };
    const int without = passes({});
    CHECK(passes({"another user"}) == without);
    CHECK(passes({"panes"}) < without);
    CHECK(passes({"transparent"}) == passes({"panes"}));
}

TEST_CASE("triangles are submitted as listed unless an order is requested and that is a permutation") {
    const DrawList list = draw_list(three_layers(true));
    const DeviceProfile& profile = *find_profile("ideal");
    for (const DepthPath path : {DepthPath::float32, DepthPath::perspective_rq, DepthPath::depth_replace}) {
        RenderOptions options = four_by_four();
        strata::rasterizer::RasterState raster;
        raster.viewport = {0, 0, 4, 4};
        const PreparedLists lists{{.list = list,
                                   .view = parallel_view,
                                   .profile = profile,
                                   .options = options,
                                   .raster = raster,
                                   .depth = {path, DepthFormat::d32f}}};
        CHECK(takes_quotient(lists.settings().depth) == (path != DepthPath::float32));
        CHECK(lists.submission(ListOrder::given).empty());
        // Sixteen triangles per layer, given near first: far first they are the same runs in reverse.
        const std::vector<std::uint32_t> order = lists.submission(ListOrder::back_to_front);
        REQUIRE(order.size() == 48);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < order.size(); ++i) wrong += order[i] / 16 != 2 - i / 16 ? 1 : 0;
        CHECK(wrong == 0);
    }
}

namespace {

std::string diagnosed_as(const Algorithm& algorithm, const RenderOptions& options, const PassDepths& depths,
                         const AuditResult& audit) {
    std::vector<Diagnostic> all;
    add_audit_diagnostics(algorithm, options, depths, audit, all);
    std::string found;
    for (const Diagnostic& one : all) found += std::string{name(one.fault)} + ": " + one.detail + "; ";
    return found;
}

}  // namespace

TEST_CASE("order errors and lost ties are attributed to the first cause that applies") {
    AuditResult audit;
    audit.order_errors = 5;
    audit.lost_by_ties = 2;
    RenderOptions options;
    Algorithm peel;
    peel.exact = true;
    CHECK(diagnosed_as(peel, options, {}, audit).empty());  // a policy that loses no tie, and no other cause
    peel.ties = TiePolicy::unique;
    CHECK(diagnosed_as(peel, options, {}, audit) == "merged_ties: 2 later fragments of equal depth lost; ");
    peel.ties = TiePolicy::merged;
    const std::string mixed = "merged_ties: 2 fragments of equal depth mixed by MAX; ";
    CHECK(diagnosed_as(peel, options, {}, audit) == mixed);
    options.termination.rule = TerminationRule::paper;
    CHECK(diagnosed_as(peel, options, {}, audit) ==
          "early_end: every back layer of a pass had alpha 0 while layers were left (E14); " + mixed);
    peel.ties = TiePolicy::first;
    CHECK(diagnosed_as(peel, options, {}, audit).empty());
    peel.features = {Feature::float_targets};
    CHECK(diagnosed_as(peel, options, {.is_invariant = true, .are_flushed = false}, audit).empty());
    CHECK(diagnosed_as(peel, options, {.is_invariant = true, .are_flushed = true}, audit) ==
          "unlike_depths: 5 layers lost or repeated: blending flushes denormal depths to zero; ");
    CHECK(diagnosed_as(peel, options, {.is_invariant = false, .are_flushed = true}, audit) ==
          "unlike_depths: 5 layers lost, repeated or misplaced; ");
    peel.order = ListOrder::objects;  // exact, so its objects are not a cause
    CHECK(diagnosed_as(peel, options, {.is_invariant = false, .are_flushed = false}, audit) ==
          "unlike_depths: 5 layers lost, repeated or misplaced; ");
    peel.exact = false;
    CHECK(diagnosed_as(peel, options, {.is_invariant = false, .are_flushed = false}, audit) ==
          "out_of_order: objects or their own triangles overlap out of order; ");
    audit.order_errors.reset();
    CHECK(diagnosed_as(peel, options, {}, audit).empty());
}

TEST_CASE("a program that compares fixed-point depths is reported as quantizing if it does or compares its own codes") {
    const auto noted = [](const Algorithm& algorithm, DepthFormat format, bool quantizes) {
        std::vector<Diagnostic> all;
        note_extensions(algorithm, format, quantizes, all);
        return std::ranges::any_of(all, [](const Diagnostic& d) { return d.fault == Fault::depth_quantized; });
    };
    Algorithm programmed;
    programmed.features = {Feature::fragment_programs};
    CHECK(noted(programmed, DepthFormat::d24, true));
    CHECK_FALSE(noted(programmed, DepthFormat::d24, false));
    CHECK_FALSE(noted(programmed, DepthFormat::d32f, true));
    programmed.compares_own_codes = true;
    CHECK(noted(programmed, DepthFormat::d24, false));
}

TEST_CASE("depths that blending flushes end a peel in float targets after six passes per layer and are reported") {
    // The whole depth range is below 2^-126: on a device that flushes, every blended depth becomes 0.
    const DrawList list = draw_list(three_layers(false));
    RenderOptions options = four_by_four();
    options.raster.depth_far = 0x1p-127f;
    for (const char* algorithm : {"coherent_blend", "coherent_stencil"}) {
        const RenderResult result = render(list, parallel_view, {"geforce8", algorithm}, options);
        REQUIRE(result.outcome == Outcome::done);
        INFO(algorithm);
        CHECK(result.frame.passes.geometry <= 6 * (3 + 1));
        CHECK(has_diagnostic(result, Fault::unlike_depths) == (std::string_view{algorithm} == "coherent_blend"));
    }
}
