// Tests Carr's algorithms, and those that their paper compares them with, on every short sequence of fragments and on
// long ones in every degree of disorder: they must composite the exact A-buffer's list in the order of their tie
// policy.
#include <catch2/catch.hpp>

#include "tests/peeling/rendering.h"
#include "tests/peeling/sequences/disordered_sequences.h"
#include "tests/peeling/sequences/short_sequences.h"
#include "tests/support/partial_order_model.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::DepthFormat;
using strata::pipeline::Execution;
using strata::pipeline::Fault;

constexpr Rgba background{0.25f, 0.5f, 0.8f, 1};

Rgba behind(const GivenPixel& pixel, const TargetModel& target) {
    Rgba color = pixel.opaque && pixel.opaque->depth < 1.0f ? pixel.opaque->color : background;
    for (float& c : strata::components(color)) c = target.stored(c);
    return color;
}

Rgba expected(const std::string& algorithm, const TargetModel& target, const GivenPixel& pixel) {
    const std::vector<GivenFragment> fragments = visible(pixel);
    const Rgba bottom = behind(pixel, target);
    if (algorithm == "batched") return front_to_back_model(target, groups_of(fragments), bottom);
    if (algorithm == "stencil_routed_k_buffer") return routed_model(target, in_first_order(fragments), bottom);
    if (algorithm == "k_buffer") return under_model(target, k_buffer_order(fragments), bottom);
    return under_model(target, in_first_order(fragments), bottom);
}

RenderResult check(const FragmentScene& scene, const Machine& machine, RenderOptions options) {
    INFO(machine.algorithm << " on " << machine.profile);
    options.background = background;
    const RenderResult result = render(scene, machine, options);
    REQUIRE(result.outcome == strata::peeling::Outcome::done);
    const TargetModel target{result.frame.color.format};
    const Differences wrong = differences(result.frame.color, [&](std::size_t p) {
        const Rgba color = expected(machine.algorithm, target, scene.pixels[p]);
        return std::array{target.code(color[0]), target.code(color[1]), target.code(color[2]), target.code(1.0f)};
    });
    INFO(wrong.first);
    CHECK(wrong.pixels == 0);
    if (machine.algorithm != "k_buffer") CHECK(result.audit.order_errors == 0u);
    CHECK(has_diagnostic(result, Fault::buffer_overflow) ==
          (machine.algorithm == "k_buffer" && result.audit.order_errors != 0u));
    return result;
}

const std::vector<Machine> machines{{"geforce8", "layer_peel"},     {"geforce8", "coherent_stencil"},
                                    {"geforce8", "coherent_blend"}, {"ideal", "coherent_ideal"},
                                    {"geforce8", "batched"},        {"geforce8", "stencil_routed_k_buffer"},
                                    {"ideal", "k_buffer"},          {"ideal", "coherent_blend"}};

// `count` instances with a mesh each: object i has a fragment at some pixels, at depths around its own.
strata::pipeline::DrawList objects(Random& random, int count, float spread, FragmentScene& all) {
    strata::pipeline::DrawList list;
    list.materials = draw_list(all).materials;
    std::vector<int> order(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) order[static_cast<std::size_t>(i)] = i;
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random_int(random, 0, static_cast<int>(i) - 1))]);
    for (const int i : order) {
        strata::pipeline::Mesh mesh;
        for (std::size_t p = 0; p < all.pixels.size(); ++p)
            for (int f = random_int(random, 0, 2); f > 0; --f) {
                const float around = spread * static_cast<float>(random_int(random, -32, 32)) / 32.0f;
                const float depth =
                    std::clamp((static_cast<float>(i) + 0.5f + around) / static_cast<float>(count), 0.0f, 1.0f);
                all.pixels[p].fragments.push_back({std::round(depth * 0x1p12f) * 0x1p-12f, random_color(random)});
                add_fragment(mesh, all, p, all.pixels[p].fragments.back());
            }
        list.instances.push_back({.mesh = static_cast<std::uint32_t>(list.meshes.size()), .material = 0});
        list.meshes.push_back(std::move(mesh));
    }
    return list;
}

}  // namespace

TEST_CASE("batches of objects whose depths overlap even at their bounds give the picture of one peel of all of them") {
    Random random{20241106};
    for (const float spread : {0.0f, 0.5f, 3.0f}) {
        FragmentScene all{16, 16};
        const auto list = objects(random, 11, spread, all);
        RenderOptions options = options_for(all);
        options.counters = true;
        const RenderResult batched = render(list, {}, {"geforce8", "batched"}, options);
        const RenderResult whole = render(list, {}, {"geforce8", "front_to_back"}, options);
        INFO("spread " << spread);
        CHECK(batched.frame.color == whole.frame.color);
        CHECK(batched.audit.order_errors == 0u);
        CHECK(batched.audit.lost_by_ties == whole.audit.lost_by_ties);
        CHECK(batched.frame.iterations == batched.frame.passes.geometry);
        CHECK(batched.frame.counters->fragments_rasterized < 2 * whole.frame.counters->fragments_rasterized);
    }
}

TEST_CASE("a limit that counts passes across loops ends a frame of tiles where it ends the whole frame", "[slow]") {
    Random random{20241108};
    FragmentScene all{16, 16};
    const auto list = objects(random, 11, 0.5f, all);
    RenderOptions options = options_for(all);
    for (const int tile_size : {8, 32}) {
        int passes = 0;
        for (int most = 1; most <= passes + 2; ++most) {
            options.max_passes = most;
            options.tile_size = tile_size;
            options.execution = Execution::literal;
            const RenderResult literal = render(list, {}, {"geforce8", "batched"}, options);
            options.execution = Execution::replay;
            const RenderResult tiled = render(list, {}, {"geforce8", "batched"}, options);
            passes = std::max(passes, literal.frame.passes.geometry);
            INFO("tiles of " << tile_size << ", at most " << most << " passes, " << passes << " made");
            CHECK(tiled.frame.color == literal.frame.color);
            CHECK(tiled.frame.passes == literal.frame.passes);
            CHECK(tiled.frame.iterations == literal.frame.iterations);
            CHECK(tiled.frame.diagnostics == literal.frame.diagnostics);
        }
        CHECK(passes > 20);
    }
}

TEST_CASE("objects that do not overlap are ordered by occlusion queries in at most n (n + 2) - 2 passes") {
    Random random{20241107};
    FragmentScene all{16, 16};
    const auto list = objects(random, 6, 0.0f, all);  // each object at one depth
    const RenderResult result = render(list, {}, {"geforce8", "object_sorted"}, options_for(all));
    CHECK(result.audit.order_errors == 0u);
    CHECK(result.frame.iterations == 6);
    CHECK(result.frame.passes.geometry >= 3 * 6 - 2);
    CHECK(result.frame.passes.geometry <= 6 * 8 - 2);
    CHECK_FALSE(has_diagnostic(result, Fault::out_of_order));
}

TEST_CASE("objects that overlap are composited in the wrong order and object_sorted reports it") {
    Random random{20241108};
    FragmentScene all{16, 16};
    const auto list = objects(random, 6, 3.0f, all);
    const RenderResult result = render(list, {}, {"geforce8", "object_sorted"}, options_for(all));
    CHECK(result.audit.order_errors > 0u);
    CHECK(diagnosed(result, Fault::out_of_order) == result.audit.misordered.pixels);
}

TEST_CASE("all 19531 sequences of up to six fragments on five depths are composited in the order of each tie policy",
          "[slow]") {
    const FragmentScene scene = all_short_sequences(20241101, short_depths);
    for (const Machine& machine : machines) {
        const RenderResult result = check(scene, machine, options_for(scene));
        CHECK(result.audit.layers_max == 5);
    }
}

TEST_CASE("with a 24-bit depth buffer programs quantize and report it and order by what the buffer holds") {
    const FragmentScene scene = disordered(20241102, 16, 16, 40);
    for (const Machine& machine : machines) {
        RenderOptions options = options_for(scene);
        options.depth = DepthFormat::d24;
        CHECK(has_diagnostic(check(scene, machine, options), Fault::depth_quantized));
    }
}

TEST_CASE("sequences in every degree of disorder with ties and opaque surfaces are composited in order", "[slow]") {
    const FragmentScene scene = disordered(20241103, 32, 16, 120);
    for (const Machine& machine : machines) check(scene, machine, options_for(scene));
}

TEST_CASE("10240 sequences of 1 to 400 fragments in every degree of disorder are composited in order", "[exhaustive]") {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const FragmentScene scene = disordered(20241110 + seed, 32, 32, 400);
        RenderOptions options = options_for(scene);
        options.tile_size = 8;
        options.threads = 0;
        for (const Machine& machine : machines)
            if (machine.algorithm != "stencil_routed_k_buffer") check(scene, machine, options);
        const FragmentScene captured =
            disordered(20241150 + seed, 32, 32, 248);  // the most that 31 passes of 8 samples hold
        check(captured, {"geforce8", "stencil_routed_k_buffer"}, options);
    }
}

TEST_CASE(
    "with 9 fragments on 8 samples a second pass takes the ninth and after 31 passes the rest is lost and reported") {
    for (const int count : {0, 1, 8, 9, 16, 17, 248, 249}) {
        FragmentScene scene{4, 4};
        Random random{20241104};
        for (int i = 0; i < count; ++i)
            scene.pixels[6].fragments.push_back({static_cast<float>(count - i) / 256.0f, random_color(random)});
        const RenderResult result = render(scene, {"geforce8", "stencil_routed_k_buffer"});
        INFO(count << " fragments");
        CHECK(result.frame.passes.geometry == std::clamp((count + 7) / 8, 1, 31));
        CHECK(diagnosed(result, Fault::buffer_overflow) == (count > 248 ? 1 : 0));
        CHECK((result.audit.order_errors == 0u) == (count <= 248));
        CHECK_FALSE(has_diagnostic(result, Fault::stencil_saturated));  // counting down to 0 is part of the algorithm
    }
}

TEST_CASE(
    "a k-buffer of 4 is exact where no fragment comes after more than 4 deeper ones and reports all other pixels") {
    const FragmentScene scene = disordered(20241105, 32, 16, 40);
    std::uint64_t wrong = 0;
    for (const GivenPixel& pixel : scene.pixels) {
        const auto fragments = visible(pixel);
        bool is_late = false;
        for (std::size_t i = 0; i < fragments.size(); ++i)
            is_late |= std::count_if(fragments.begin(), fragments.begin() + static_cast<std::ptrdiff_t>(i),
                                     [&](const GivenFragment& f) { return f.depth > fragments[i].depth; }) > 4;
        wrong += is_late ? 1 : 0;
    }
    const RenderResult result = render(scene, {"ideal", "k_buffer"});
    CHECK(wrong > 20);
    CHECK(diagnosed(result, Fault::buffer_overflow) == wrong);
    CHECK(result.audit.misordered.pixels <= wrong);  // by key: an exchanged tie is visible only in colours
    CHECK(result.audit.misordered.pixels > 0);
}
