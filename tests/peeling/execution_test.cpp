// Nothing that a user sees depends on how a frame was executed: literal execution is the definition.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"
#include "tests/support/difference.h"
#include "tests/support/host_environment.h"
#include "tests/support/random_numbers.h"
#include "tests/support/random_triangles.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::Effects;
using strata::pipeline::Execution;
using strata::pipeline::Termination;
using strata::pipeline::TerminationRule;

struct Ending {
    const char* name;
    Termination termination;
    int max_passes;
};

const std::vector<Ending> endings{{"exact", {}, 0},
                                  {"paper", {.rule = TerminationRule::paper}, 0},
                                  {"any", {.rule = TerminationRule::any}, 0},
                                  {"ratio", {.rule = TerminationRule::ratio, .ratio = 0.125}, 0},
                                  {"a ratio above the first count", {.rule = TerminationRule::ratio, .ratio = 40}, 0},
                                  {"fixed", {.rule = TerminationRule::fixed, .passes = 4}, 0},
                                  {"fixed beyond the last layer", {.rule = TerminationRule::fixed, .passes = 12}, 0},
                                  {"max_passes", {}, 3},
                                  {"the first pass", {}, 1}};

struct Way {
    Execution execution;
    int tile_size, threads;
    Effects effects;
    bool trust_idle;
    std::uint64_t fragment_memory = std::uint64_t{256} << 20;
};

constexpr std::array<Way, 13> ways{{{Execution::literal, 64, 4, Effects::all, false},
                                    {Execution::replay, 8, 1, Effects::needed, true, 0},
                                    {Execution::replay, 16, 4, Effects::all, true, 0},
                                    {Execution::replay, 16, 2, Effects::needed, false, 0},
                                    {Execution::replay, 32, 4, Effects::needed, true, 0},
                                    {Execution::replay, 64, 2, Effects::all, false, 0},
                                    {Execution::replay, 128, 1, Effects::needed, true, 0},
                                    {Execution::replay, 8, 1, Effects::needed, true},
                                    {Execution::replay, 32, 4, Effects::needed, false},
                                    {Execution::replay, 64, 2, Effects::all, true},
                                    {Execution::replay, 128, 2, Effects::needed, true},
                                    {Execution::replay, 64, 1, Effects::needed, true, std::uint64_t{300} << 10},
                                    {Execution::replay, 16, 2, Effects::needed, true, std::uint64_t{4} << 10}}};

RenderOptions with(RenderOptions options, const Way& way) {
    options.execution = way.execution;
    options.tile_size = way.tile_size;
    options.threads = way.threads;
    options.effects = way.effects;
    options.fragment_memory = way.fragment_memory;
    return options;
}

// Every way against literal execution with one thread; the first difference is named.
void check_all_ways(const TriangleScene& scene, const Machine& machine, RenderOptions options,
                    std::span<const Way> chosen = ways) {
    options.execution = Execution::literal;
    options.threads = 1;
    const RenderResult expected = render(scene.list, scene.view, machine, options);
    REQUIRE(expected.outcome == strata::peeling::Outcome::done);
    CHECK(difference(render(scene.list, scene.view, machine, options), expected).empty());  // twice the same
    for (const Way& way : chosen) {
        const RenderResult found =
            render(scene.list, scene.view, machine, with(options, way), {.trust_idle = way.trust_idle});
        INFO(machine.algorithm << " on " << machine.profile << ", tile " << way.tile_size << ", threads " << way.threads
                               << ", literal " << (way.execution == Execution::literal) << ", trusts idle "
                               << way.trust_idle << ", fragment memory " << way.fragment_memory);
        CHECK(difference(found, expected) == "");
    }
}

// A profile that has no name.
RenderResult drawn_on(const strata::pipeline::DeviceProfile& profile, const TriangleScene& scene, const char* algorithm,
                      const RenderOptions& options) {
    strata::peeling::Renderer renderer{scene.list, scene.view, profile, options};
    return renderer.render(*strata::peeling::find_algorithm(algorithm), {}, {});
}

RenderOptions small_frame() {
    RenderOptions options;
    options.width = 76;  // neither is a multiple of a tile
    options.height = 52;
    options.background = {0.1f, 0.2f, 0.3f, 1};
    return options;
}

const std::vector<Machine> machines{{"geforce3", "unsorted"},
                                    {"geforce3", "painter"},
                                    {"geforce3", "depth_units"},
                                    {"geforce3", "shadow_map_depth_replace"},
                                    {"geforce8", "front_to_back"},
                                    {"geforce8", "dual"},
                                    {"geforce8_dx101", "dual_independent"},
                                    {"geforce8", "weighted_average"},
                                    {"geforce8", "weighted_sum"},
                                    {"ideal", "a_buffer"},
                                    {"ideal", "dual"}};

// Every machine, ended in each of these ways.
void check_endings(const FragmentScene& scene, const std::vector<Ending>& chosen) {
    const TriangleScene triangles{draw_list(scene), {}};
    for (const Ending& ending : chosen)
        for (const Machine& machine : machines) {
            RenderOptions options = options_for(scene);
            options.termination = ending.termination;
            options.max_passes = ending.max_passes;
            INFO("ended by " << ending.name);
            check_all_ways(triangles, machine, options);
        }
}

// The algorithms of a partial order, whose queries stand inside an iteration.
const std::vector<Machine> partial_order{{"geforce8", "layer_peel"},
                                         {"geforce8", "hybrid"},
                                         {"geforce8", "coherent_stencil"},
                                         {"geforce8", "coherent_blend"},
                                         {"ideal", "coherent_ideal"},
                                         {"ideal", "k_buffer"},
                                         {"geforce8", "stencil_routed_k_buffer"}};

}  // namespace

TEST_CASE("algorithms of a partial order execute alike, resolved and as published, however their queries end them",
          "[slow]") {
    TriangleScene scene = random_triangles(79, 12);
    scene.list.instances[0].arrives_sorted = true;  // it does not, which changes no execution
    const std::vector<Way> few{ways[0], ways[1], ways[3], ways[8], ways[12]};
    for (const Ending& ending : endings)
        for (const Machine& machine : partial_order)
            for (const auto formulation :
                 {strata::pipeline::Formulation::resolved, strata::pipeline::Formulation::published}) {
                RenderOptions options = small_frame();
                options.termination = ending.termination;
                options.max_passes = ending.max_passes;
                options.formulation = formulation;
                INFO("ended by " << ending.name
                                 << (formulation == strata::pipeline::Formulation::published ? ", as published" : ""));
                if (formulation == strata::pipeline::Formulation::published && machine.algorithm.ends_with("buffer"))
                    continue;
                check_all_ways(scene, machine, options, few);
            }
}

TEST_CASE("tiles, threads, effects and mistrust change nothing of any algorithm, however its queries end it",
          "[slow]") {
    const TriangleScene scene = random_triangles(71, 16);
    for (const Ending& ending : endings)
        for (const Machine& machine : machines) {
            RenderOptions options = small_frame();
            options.termination = ending.termination;
            options.max_passes = ending.max_passes;
            INFO("ended by " << ending.name);
            check_all_ways(scene, machine, options);
        }
}

TEST_CASE("scenes of one corner, of nothing and of opaque surfaces alone execute alike", "[slow]") {
    for (const TriangleScene& scene : {random_triangles(72, 12, 0.25f), random_triangles(73, 0), opaque_only(74, 8)})
        for (const Machine& machine : machines) {
            RenderOptions options = small_frame();
            check_all_ways(scene, machine, options);
            options.termination.rule = TerminationRule::paper;
            check_all_ways(scene, machine, options);
        }
}

TEST_CASE("a tile that ends early, with fragments exactly at its opaque surface, counts like the frame that goes on",
          "[slow]") {
    FragmentScene scene{16, 16};  // four tiles of 8 x 8
    const strata::pipeline::Rgba glass{1, 0.5f, 0.25f, 0.5f};
    scene.pixels[0] = {{{0.5f, glass}}, GivenFragment{0.5f, glass}};
    scene.pixels[3] = {{{0.25f, glass}, {0.5f, glass}, {0.75f, glass}, {0.5f, glass}}, GivenFragment{0.5f, glass}};
    for (const float depth : {0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.625f})
        scene.pixels[255].fragments.push_back({depth, glass});
    check_endings(scene, endings);
}

TEST_CASE("rows of pixels whose fragments all lie behind the opaque surface execute alike", "[slow]") {
    FragmentScene scene{32, 16};
    const strata::pipeline::Rgba glass{1, 0.5f, 0.25f, 0.5f};
    for (std::size_t pixel = 0; pixel < scene.pixels.size(); ++pixel) {
        GivenPixel& given = scene.pixels[pixel];
        const std::size_t row = pixel / 32;
        given.opaque = GivenFragment{0.5f, glass};
        for (std::size_t k = 0; k <= row % 3; ++k)
            given.fragments.push_back({0.5f + 0.125f * static_cast<float>(k), glass});
        if (row % 4 == 3) given.fragments.push_back({0.25f, glass});
    }
    check_endings(scene, {endings[0], endings[1], endings[5], endings[8]});
}

TEST_CASE("kept layers are those of literal execution, wherever max_passes cuts", "[slow]") {
    const TriangleScene scene = random_triangles(75, 24, 0.4f);
    for (const Machine& machine : {Machine{"geforce8", "front_to_back"},
                                   {"geforce3", "depth_units"},
                                   {"geforce3", "shadow_map"},
                                   {"geforce8", "dual"},
                                   {"geforce8_dx101", "dual_independent"}}) {
        RenderOptions options = small_frame();
        options.keep_layers = true;
        const int layers = render(scene.list, scene.view, machine, options).audit.layers_max;
        REQUIRE(layers > 3);
        for (const int max_passes : {0, 1, layers - 1, layers, layers + 1, layers + 2}) {
            options.max_passes = max_passes;
            INFO(layers << " layers, " << max_passes << " passes at most");
            check_all_ways(scene, machine, options);
        }
        options.max_passes = 0;
        options.termination = {.rule = TerminationRule::ratio, .ratio = 0.05};
        check_all_ways(scene, machine, options);
    }
}

TEST_CASE("an algorithm that keeps layers keeps one for each distinct depth of the deepest pixel") {
    const TriangleScene scene = random_triangles(76, 24);
    for (const Machine& machine : {Machine{"geforce8", "front_to_back"}, {"geforce3", "depth_units"}})
        for (const Execution execution : {Execution::literal, Execution::replay}) {
            RenderOptions options = small_frame();
            options.keep_layers = true;
            options.execution = execution;
            options.fragment_memory = 0;
            const RenderResult result = render(scene.list, scene.view, machine, options);
            CHECK(result.frame.layers.size() == static_cast<std::size_t>(result.audit.layers_max));
        }
}

TEST_CASE("alpha for everything, other formats and the whole state of the rasterizer execute alike", "[slow]") {
    const TriangleScene scene = random_triangles(77, 30);
    RenderOptions options = small_frame();
    options.alpha = 0.375f;
    options.color_format = strata::pipeline::Format::rgba16f;
    options.depth = strata::pipeline::DepthFormat::d24;
    options.raster.scissor = strata::rasterizer::Rect{5, 9, 70, 33};
    options.raster.polygon_offset = {true, 1.5f, 2.0f};
    for (const char* algorithm : {"front_to_back", "dual", "dual_independent", "depth_units", "weighted_average"})
        check_all_ways(scene, {"geforce8_dx101", algorithm}, options);
}

// With alphas of 3e-38 many products of colour and alpha are denormal, which the GeForce8 adds as 0: over black that shows.
TEST_CASE("sums execute alike in halves and in binary32, denormal ones too") {
    const TriangleScene scene = random_triangles(79, 12);
    RenderOptions options = small_frame();
    options.width = 40;
    options.height = 28;
    options.background = {0, 0, 0, 1};
    const std::array<Way, 2> chosen{ways[7], ways[8]};
    for (const auto format : {strata::pipeline::Format::rgba8, strata::pipeline::Format::rgba32f})
        for (const float alpha : {0.375f, 3e-38f})
            for (const char* profile : {"geforce8_dx101", "ideal"})
                for (const char* algorithm : {"weighted_average", "weighted_sum"}) {
                    options.color_format = format;
                    options.alpha = alpha;
                    check_all_ways(scene, {profile, algorithm}, options, chosen);
                }
}

// An offset moves most fragments below 0: in fixed point they wrap around and are farther than all others, in D32F nearer.
TEST_CASE("depths beyond the range execute alike: the frame is drawn as a whole, and no tile trusts a bound") {
    using namespace strata::pipeline;
    const std::vector<Way> few{ways[0], ways[1], ways[3], ways[7], ways[8]};
    DeviceProfile wraps = *find_profile("llvmpipe"), clamps = wraps;
    wraps.raster.depth_limits = strata::rasterizer::DepthLimits::wrap;
    for (const DepthFormat format : {DepthFormat::d16, DepthFormat::d24, DepthFormat::d32f})
        for (const char* algorithm : {"front_to_back", "unsorted", "weighted_average", "depth_units"}) {
            const TriangleScene scene = random_triangles(84, 20);
            RenderOptions options = small_frame();
            options.depth = format;
            options.alpha = 0.4f;
            // A unit is two codes, and in D32F a small power of two.
            const float units = format == DepthFormat::d16 ? -2e4f : format == DepthFormat::d24 ? -5e6f : -1e7f;
            options.raster.polygon_offset = {true, 0, units};
            options.execution = Execution::literal;
            options.max_passes = 12;
            const RenderResult expected = drawn_on(wraps, scene, algorithm, options);
            REQUIRE(expected.outcome == strata::peeling::Outcome::done);
            INFO(algorithm << ", format " << static_cast<int>(format));
            if (format != DepthFormat::d32f)
                CHECK(difference(drawn_on(clamps, scene, algorithm, options), expected) != "");
            for (const Way& way : few)
                CHECK(difference(drawn_on(wraps, scene, algorithm, with(options, way)), expected) == "");
        }
}

// Tiles of 64 pixels that share a place in the cache: (5, 0) and (0, 1). Passes that blend a pixel several times.
TEST_CASE("blends in cached tiles execute alike, in frames whose tiles throw one another out and in small ones") {
    using namespace strata::pipeline;
    const std::vector<Way> few{ways[0], ways[1], ways[3], ways[7], ways[8]};
    for (const int width : {40, 330})
        for (const auto format : {Format::rgba8, Format::rgba16f})
            for (const char* algorithm : {"unsorted", "painter", "weighted_average", "weighted_sum", "coherent_stencil",
                                          "coherent_blend", "front_to_back"}) {
                const TriangleScene scene = random_triangles(83, 14);
                RenderOptions options = small_frame();
                options.width = width;
                options.height = 70;
                options.color_format = format;
                options.alpha = 0.3f;
                check_all_ways(scene, {"softpipe", algorithm}, options, few);
            }
}

// Mesa's drivers round each product of a blend and convert by binary32 products; other profiles may mix the rules. Random ones.
TEST_CASE(
    "peels execute alike on devices that blend and convert by every rule, in every format, with ties and under "
    "limits") {
    Random random{81};
    const std::array<Way, 2> chosen{ways[7], ways[10]};
    using namespace strata::pipeline;
    for (const char* base : {"llvmpipe", "llvmpipe_sse", "softpipe", "geforce8_dx101"})
        for (const auto format : {Format::rgba8, Format::rgba16f, Format::rgba32f})
            for (const char* algorithm : {"front_to_back", "dual"})
                for (int trial = 0; trial < 3; ++trial) {
                    TriangleScene scene = random_triangles(82, 12);
                    scene.list.instances.push_back(scene.list.instances[0]);  // every depth twice
                    DeviceProfile profile = *find_profile(base);
                    if (trial > 0) {
                        profile.blend_rounding = static_cast<BlendRounding>(random_int(random, 0, 2));
                        profile.unorm_rounding = static_cast<UnormRounding>(random_int(random, 0, 1));
                        profile.half_rounding = static_cast<HalfRounding>(random_int(random, 0, 1));
                        profile.denormals = static_cast<DenormalRule>(random_int(random, 0, 1));
                        profile.min_max_nan = static_cast<MinMaxNan>(random_int(random, 0, 1));
                        profile.blend_storage = static_cast<BlendStorage>(random_int(random, 0, 1));
                    }
                    RenderOptions options = small_frame();
                    options.width = 40;
                    options.height = 28;
                    options.color_format = format;
                    options.alpha = random_channel(random);
                    options.background = random_color(random);
                    options.execution = Execution::literal;
                    const auto drawn = [&](const RenderOptions& how) {
                        return drawn_on(profile, scene, algorithm, how);
                    };
                    const RenderResult expected = drawn(options);
                    REQUIRE(expected.outcome == strata::peeling::Outcome::done);
                    INFO(algorithm << " on " << base << ", format " << static_cast<int>(format) << ", trial " << trial);
                    for (const Way& way : chosen) {
                        const RenderResult found = drawn(with(options, way));
                        CHECK(difference(found, expected) == "");
                        CHECK(found.frame.work.visited == 0);  // no pass has run
                    }
                }
}

// Rows and closed forms know colours by exact planes alone, even where depth is theirs.
TEST_CASE("colours by the chip's weights execute alike on a device whose depth is an exact plane") {
    strata::pipeline::DeviceProfile profile = *strata::pipeline::find_profile("ideal");
    profile.raster.color = strata::rasterizer::ColorInterpolation::weights_8bit;
    const TriangleScene scene = random_triangles(80, 8);
    for (const char* algorithm : {"weighted_average", "weighted_sum", "front_to_back", "dual"})
        for (const auto format : {strata::pipeline::Format::rgba8, strata::pipeline::Format::rgba32f}) {
            RenderOptions options = small_frame();
            options.color_format = format;
            options.execution = Execution::literal;
            const auto drawn = [&](const RenderOptions& how) { return drawn_on(profile, scene, algorithm, how); };
            const RenderResult expected = drawn(options);
            REQUIRE(expected.outcome == strata::peeling::Outcome::done);
            options.execution = Execution::replay;
            INFO(algorithm);
            CHECK(difference(drawn(options), expected) == "");
        }
}

TEST_CASE("a host with flush-to-zero or another rounding mode gets the same bits, and its environment back", "[slow]") {
    TriangleScene scene = random_triangles(78, 30);
    scene.view.view = {0.95, 0.02, 0.1, 0, -0.03, 0.99, 0.05, 0, -0.1, -0.04, 0.97, 0, 0.01, 0.02, -0.03, 1};
    for (auto& instance : scene.list.instances) instance.model[0][0] = 1.1;  // the matrices' product must be rounded
    for (const Machine& machine : machines) {
        RenderOptions options = small_frame();
        options.threads = 2;
        const RenderResult expected = render(scene.list, scene.view, machine, options);
        for (const unsigned host : host_environments) {
            const HostEnvironment environment{host};
            strata::peeling::Renderer renderer{scene.list, scene.view, *strata::pipeline::find_profile(machine.profile),
                                               options};
            const bool kept_by_constructor = environment.is_in_force();
            const RenderResult found = renderer.render(*strata::peeling::find_algorithm(machine.algorithm));
            const bool kept_by_render = environment.is_in_force();
            const std::size_t fragments =
                renderer.fragments(*strata::peeling::find_algorithm(machine.algorithm)).all.size();
            INFO(machine.algorithm << ", host " << std::hex << host);
            CHECK(kept_by_constructor);
            CHECK(kept_by_render);
            CHECK(environment.is_in_force());
            CHECK(difference(found, expected) == "");
            CHECK(fragments > 100);
        }
    }
}

TEST_CASE(
    "one renderer sorts triangles into the tiles that each algorithm asks for, and every size gives the same bits",
    "[slow]") {
    const TriangleScene scene = random_triangles(79, 20);
    RenderOptions options = small_frame();
    options.width = 1024;
    options.height = 512;
    options.threads = 2;
    options.audit = false;
    const auto renderer = [&] {
        return strata::peeling::Renderer{scene.list, scene.view, *strata::pipeline::find_profile("geforce8_dx101"),
                                         options};
    };
    strata::peeling::Renderer automatic = renderer();
    options.tile_size = 32;
    strata::peeling::Renderer small = renderer();
    for (const auto& [name, tile_size] :
         {std::pair{"weighted_average", 128}, {"front_to_back", 64}, {"weighted_average", 128}}) {
        const auto& algorithm = *strata::peeling::find_algorithm(name);
        const RenderResult found = automatic.render(algorithm), expected = small.render(algorithm);
        CHECK(found.frame.work.tile_size == tile_size);
        CHECK(expected.frame.work.tile_size == 32);
        CHECK(found.frame.color == expected.frame.color);
        CHECK(found.frame.counters == expected.frame.counters);
    }
}
