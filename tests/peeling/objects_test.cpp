// Tests the passes and fragments of object_sorted and batched on objects with known order and depths. The expected
// counts are made by hand.
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tests/peeling/rendering.h"

namespace {

using namespace strata::testing;
using strata::peeling::RenderOptions;
using strata::peeling::RenderResult;
using strata::pipeline::DrawList;
using strata::pipeline::Fault;

// One instance per list of depths: at every pixel of `all` a fragment at each depth, in this order.
DrawList objects_at(const std::vector<std::vector<float>>& depths, FragmentScene& all) {
    DrawList list;
    list.materials = draw_list(all).materials;
    for (const auto& own : depths) {
        strata::pipeline::Mesh mesh;
        for (std::size_t p = 0; p < all.pixels.size(); ++p)
            for (const float depth : own) {
                all.pixels[p].fragments.push_back({depth, {0.5f, 0.25f, 1, 0.5f}});
                add_fragment(mesh, all, p, all.pixels[p].fragments.back());
            }
        list.instances.push_back({.mesh = static_cast<std::uint32_t>(list.meshes.size()), .material = 0});
        list.meshes.push_back(std::move(mesh));
    }
    return list;
}

}  // namespace

TEST_CASE("an object of two layers before another is queried once because its own fragments do not occlude it") {
    FragmentScene all{4, 4};
    const DrawList list = objects_at({{0.125f, 0.25f}, {0.5f}}, all);
    const RenderResult result = render(list, {}, {"geforce8", "object_sorted"}, options_for(all));
    CHECK(result.audit.order_errors == 0u);
    CHECK(result.frame.iterations == 2);
    CHECK(result.frame.passes.geometry == 4);  // two queries, and one pass for each object
    CHECK_FALSE(has_diagnostic(result, Fault::out_of_order));
}

// Four objects per batch with disjoint bounds: each batch takes a pass for each of its layers and one that finds none,
// and each of these passes draws only the batch's own objects.
TEST_CASE("a batch draws only the objects whose depth intervals overlap its own") {
    FragmentScene all{4, 4};
    std::vector<std::vector<float>> depths;
    for (int i = 1; i <= 8; ++i) depths.push_back({static_cast<float>(i) / 16.0f});
    const DrawList list = objects_at(depths, all);
    for (const Running& running : all_ways_of_running) {
        RenderOptions options = options_for(all);
        running.apply(options);
        const RenderResult result = render(list, {}, {"geforce8", "batched"}, options);
        CHECK(result.audit.order_errors == 0u);
        CHECK(result.frame.passes.geometry == 2 * 5);
        options.counters = true;
        const RenderResult counted = render(list, {}, {"geforce8", "batched"}, options);
        CHECK(counted.frame.counters->fragments_rasterized == 2u * 5 * 4 * all.pixels.size());
    }
}

TEST_CASE("a limit that no tile reaches runs no tile again") {
    FragmentScene all{16, 16};
    std::vector<std::vector<float>> depths;
    for (int i = 1; i <= 8; ++i) depths.push_back({static_cast<float>(i) / 16.0f});
    const DrawList list = objects_at(depths, all);
    RenderOptions options = options_for(all);
    options.tile_size = 8;
    options.max_passes = 100;
    const RenderResult result = render(list, {}, {"geforce8", "batched"}, options);
    CHECK(result.frame.passes.geometry == 2 * 5);
    CHECK(result.frame.work.reruns == 0);
}

// One tile of 64 has a fragment. Tiles equal to another are copied, and count as done.
TEST_CASE("progress reaches 1 where most tiles are copies of an empty one") {
    FragmentScene scene{64, 64};
    scene.pixels[100].fragments = {{0.5f, {1, 1, 1, 0.5f}}};
    RenderOptions options = options_for(scene);
    options.tile_size = 8;
    double most = 0.0;
    const auto list = draw_list(scene);
    strata::peeling::Renderer renderer{list, {}, *strata::pipeline::find_profile("geforce8"), options};
    static_cast<void>(renderer.render(*strata::peeling::find_algorithm("front_to_back"),
                                      [&](double share) { most = std::max(most, share); }));
    CHECK(most == 1.0);
}

// A renderer prepares an algorithm's lists when it is drawn, so its draw list must outlive it: no temporary.
static_assert(!std::is_constructible_v<strata::peeling::Renderer, strata::pipeline::DrawList, strata::pipeline::View,
                                       strata::pipeline::DeviceProfile, RenderOptions>);
static_assert(std::is_constructible_v<strata::peeling::Renderer, strata::pipeline::DrawList&, strata::pipeline::View,
                                      strata::pipeline::DeviceProfile, RenderOptions>);

// Its bounds are a single number, which is a valid interval.
TEST_CASE("an object that is flat on the near plane is drawn in its batch") {
    FragmentScene all{4, 4};
    const DrawList list = objects_at({{0.0f}, {0.5f}}, all);
    const RenderResult result = render(list, {}, {"geforce8", "batched"}, options_for(all));
    CHECK(result.audit.layers_max == 2);
    CHECK(result.audit.order_errors == 0u);
}

// A layer is found by one pass and composited by the next; a limit may end the frame between the two.
TEST_CASE("layer_peel uses exactly the number of passes of its limit") {
    FragmentScene scene{4, 4};
    for (int i = 1; i <= 4; ++i) scene.pixels[5].fragments.push_back({static_cast<float>(i) / 8.0f, {1, 1, 1, 0.5f}});
    for (int most = 1; most <= 12; ++most) {
        RenderOptions options = options_for(scene);
        options.max_passes = most;
        INFO("at most " << most << " passes");
        CHECK(render(scene, {"geforce8", "layer_peel"}, options).frame.passes.geometry == std::min(most, 2 * 4 + 1));
    }
}
