// Tests the audit on algorithms with deliberate mistakes: it must report the expected number of errors and the pixel.
#include "peeling/audit/audit.h"

#include <catch2/catch.hpp>

#include "peeling/programs/programs.h"
#include "peeling/programs/tie_order.h"
#include "tests/peeling/rendering.h"
#include "tests/support/composite_model.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

enum class Mistake { none, wrong_order, loses_second, blends_first_twice };

void composite(Region& region, Target layer, Target depth, Target result, Side side) {
    PassState state;
    state.color[0] = result;
    state.blend[0] = blend_mode::over;
    state.reads = {layer, depth, region.opaque_depth()};
    static_cast<void>(region.full_screen(state, [side](const FragmentBatch& in, const Loads& loads, Outputs& out) {
        out.color[0] = loads.color(0);
        out.traced = true;
        for (std::size_t i = 0; i < lanes(in); ++i) {
            out.side[i] = loads.depth(1)[i] != loads.depth(2)[i] ? side : Side::none;
            out.key[i] = loads.depth(1)[i];
        }
    }));
}

// Peels layers from the nearest, and composites them with the given mistake. OVER from the nearest composites in
// reverse order.
template <Mistake mistake>
void peel(Region& region) {
    const Target result = region.make_color(), layer = region.make_color();
    Target peeled = region.make_depth(), nearest = region.make_depth();
    region.copy(region.opaque_color(), result);
    for (int number = 0; !region.limit_reached(); ++number) {
        region.begin_iteration();
        region.clear(layer, {});
        region.copy(region.opaque_depth(), nearest);
        PassState state;
        state.depth = {.enabled = true, .func = CompareFunc::less, .write = true};
        state.depth_target = nearest;
        state.color[0] = layer;
        if (number > 0) state.reads[0] = peeled;
        const DrawCounts drawn =
            region.draw(state, [number](const FragmentBatch& in, const Loads& loads, Outputs& out) {
                out.color[0] = in.color;
                for (std::size_t i = 0; number > 0 && i < lanes(in); ++i)
                    if (in.code[i] <= loads.depth(0)[i]) out.discard(static_cast<int>(i));
            });
        const Side side = mistake == Mistake::wrong_order ? Side::back : Side::front;
        if (mistake != Mistake::loses_second || number != 1) composite(region, layer, nearest, result, side);
        if (mistake == Mistake::blends_first_twice && number == 0) composite(region, layer, nearest, result, side);
        if (!region.any(drawn.passed, Idle::yes)) break;
        std::swap(peeled, nearest);
    }
    region.publish(result);
}

Algorithm algorithm(void (*run)(Region&), TiePolicy ties = TiePolicy::unique) {
    Algorithm a = *find_algorithm("front_to_back");
    a.name = "broken";
    a.run = run;
    a.run_with = nullptr;
    a.ties = ties;
    return a;
}

RenderResult broken_frame(const FragmentScene& scene, const Algorithm& broken, Execution execution) {
    const DrawList list = draw_list(scene);
    RenderOptions options = options_for(scene);
    options.execution = execution;
    options.fragment_memory = 0;  // otherwise replay would run the correct resolve
    options.tile_size = 8;
    Renderer renderer{list, {}, *find_profile("geforce8"), options};
    return renderer.render(broken);
}

// Pixels (12, 3), (4, 9) and (5, 9) have 1, 4 and 5 layers, farthest first.
FragmentScene three_pixels() {
    FragmentScene scene{16, 16};
    for (const auto& [pixel, layers] : {std::pair{3 * 16 + 12, 1}, {9 * 16 + 4, 4}, {9 * 16 + 5, 5}})
        for (int i = layers; i > 0; --i)
            scene.pixels[static_cast<std::size_t>(pixel)].fragments.push_back(
                {static_cast<float>(i) / 8.0f, {1, 1, 0, 0.5f}});
    return scene;
}

struct Expected {
    std::uint64_t errors;
    PixelCount misordered;
};

void check(void (*run)(Region&), const Expected& expected) {
    for (const Execution execution : {Execution::literal, Execution::replay}) {
        const RenderResult result = broken_frame(three_pixels(), algorithm(run), execution);
        CHECK(result.audit.order_errors == expected.errors);
        CHECK(result.audit.misordered == expected.misordered);
        CHECK(result.audit.layers_max == 5);
        CHECK(result.audit.lost_by_ties == 0);
    }
}

// A fragment's index in a policy's order, found by counting over all other fragments; -1 if it is not kept.
int place(const std::vector<std::uint32_t>& keys, std::size_t own, TiePolicy policy) {
    int nearer = 0, earlier = 0, later = 0, nearer_keys = 0, keys_in_all = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool first_of_its_key =
            std::find(keys.begin(), keys.end(), keys[i]) == keys.begin() + static_cast<std::ptrdiff_t>(i);
        keys_in_all += first_of_its_key ? 1 : 0;
        nearer_keys += first_of_its_key && keys[i] < keys[own] ? 1 : 0;
        nearer += keys[i] < keys[own] ? 1 : 0;
        earlier += keys[i] == keys[own] && i < own ? 1 : 0;
        later += keys[i] == keys[own] && i > own ? 1 : 0;
    }
    const bool in_front_half = 2 * nearer_keys < keys_in_all;  // the middle one of an odd number counts as near
    switch (policy) {
        case TiePolicy::none:
        case TiePolicy::first: return nearer + earlier;
        case TiePolicy::last: return nearer + later;
        case TiePolicy::unique:
        case TiePolicy::merged: return earlier == 0 ? nearer_keys : -1;
        case TiePolicy::first_then_last: return nearer + (in_front_half ? earlier : later);
    }
    return -1;
}

}  // namespace

TEST_CASE("an algorithm without a mistake has no order errors") { check(peel<Mistake::none>, {0, {}}); }

TEST_CASE("layers composited in reverse are errors at every index except the middle one") {
    check(peel<Mistake::wrong_order>, {4 + 4, {2, 4, 9}});
}

TEST_CASE("a lost layer shifts all that follow") {
    // Found 1 3 4 for 1 2 3 4: two places differ and one is missing; 1 3 4 5 for 1 2 3 4 5: three and one.
    check(peel<Mistake::loses_second>, {3 + 4, {2, 4, 9}});
}

TEST_CASE("a layer blended twice shifts all that follow also in the shallow pixel") {
    // Found 1 1: one too many; 1 1 2 3 4: three places and one; 1 1 2 3 4 5: four and one.
    check(peel<Mistake::blends_first_twice>, {1 + 4 + 5, {3, 12, 3}});
}

TEST_CASE("fragments of equal depth in the wrong submission order are errors although their keys agree") {
    FragmentScene scene{8, 8};
    // Back to front: OVER in this order puts the last submitted of equal depths in front.
    for (const float depth : {0.75f, 0.75f, 0.5f, 0.25f, 0.25f, 0.25f})
        scene.pixels[10].fragments.push_back({depth, {1, 0, 0, 0.5f}});
    CHECK(broken_frame(scene, algorithm(find_algorithm("unsorted")->run, TiePolicy::last), Execution::replay)
              .audit.order_errors == 0u);
    CHECK(broken_frame(scene, algorithm(find_algorithm("unsorted")->run, TiePolicy::first), Execution::replay)
              .audit.order_errors == 4u);  // 2 of 2, 2 of 3
    const RenderResult unique =
        broken_frame(scene, algorithm(find_algorithm("unsorted")->run, TiePolicy::unique), Execution::replay);
    CHECK(unique.audit.order_errors == 6u);  // three indices differ, three fragments are too many
    CHECK(unique.audit.lost_by_ties == 3);
    CHECK(unique.audit.ties == PixelCount{1, 2, 1});
}

TEST_CASE("unsorted fragments are misordered unless they are submitted back to front") {
    FragmentScene scene{8, 8};
    for (const float depth : {0.25f, 0.5f, 0.75f}) scene.pixels[10].fragments.push_back({depth, {1, 0, 0, 0.5f}});
    const RenderResult result =
        broken_frame(scene, algorithm(find_algorithm("unsorted")->run, TiePolicy::last), Execution::literal);
    CHECK(result.audit.order_errors == 2u);
    CHECK(result.audit.misordered == PixelCount{1, 2, 1});
}

TEST_CASE("every tie policy places every fragment as counting the others does") {
    Random random{301};
    std::size_t wrong = 0;
    for (int round = 0; round < 3000; ++round) {
        std::vector<KeyedFragment> fragments(static_cast<std::size_t>(random_int(random, 0, 9)));
        std::vector<std::uint32_t> keys;
        for (std::size_t i = 0; i < fragments.size(); ++i) {
            fragments[i].key = static_cast<std::uint32_t>(random_int(random, 0, 5)) * 0x30000000u;
            fragments[i].primitive = static_cast<std::uint32_t>(i);
            keys.push_back(fragments[i].key);
        }
        for (const TiePolicy policy :
             {TiePolicy::first, TiePolicy::last, TiePolicy::unique, TiePolicy::merged, TiePolicy::first_then_last}) {
            FragmentOrder ordered;
            sort_by(&KeyedFragment::key, fragments, ordered);
            apply(policy, ordered);
            std::size_t kept = 0;
            for (std::size_t i = 0; i < keys.size(); ++i) {
                const int at = place(keys, i, policy);
                kept += at >= 0 ? 1 : 0;
                if (at >= 0 && (static_cast<std::size_t>(at) >= ordered.size() ||
                                submission_index(ordered[static_cast<std::size_t>(at)]) != i))
                    ++wrong;
            }
            wrong += kept != ordered.size() ? 1 : 0;
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the largest difference is that of the picture from all fragments in binary64 with and without ties") {
    FragmentScene scene{16, 16};
    Random random{302};
    for (GivenPixel& pixel : scene.pixels)
        for (int i = random_int(random, 0, 6); i > 0; --i)
            pixel.fragments.push_back({static_cast<float>(random_int(random, 1, 20)) / 32.0f, random_color(random)});
    const RenderResult result = strata::testing::render(scene, {"geforce8", "front_to_back"});
    double all = 0, without_ties = 0;
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        const DepthGroups groups = groups_of(scene.pixels[p].fragments);
        const auto truth = exact_composite(groups, {0, 0, 0, 1});
        for (std::size_t c = 0; c < 3; ++c) {
            const double difference = std::fabs(result.frame.color.codes[4 * p + c] - 255.0 * truth[c]);
            all = std::max(all, difference);
            if (groups.size() == scene.pixels[p].fragments.size()) without_ties = std::max(without_ties, difference);
        }
    }
    CHECK(without_ties > 0);
    CHECK(all > without_ties);
    CHECK(result.audit.max_difference == Approx(all).epsilon(1e-12));
    CHECK(result.audit.max_difference_without_ties == Approx(without_ties).epsilon(1e-12));
}

TEST_CASE("a float key orders like the float and -0 like 0") {
    const std::vector<float> ascending{-1.0f, -0x1p-149f, 0.0f, 0x1p-149f, 0x1p-126f, 0.5f, 1.0f, 2.0f};
    for (std::size_t i = 1; i < ascending.size(); ++i)
        CHECK(ordered_code(ascending[i - 1]) < ordered_code(ascending[i]));
    CHECK(ordered_code(-0.0f) == ordered_code(0.0f));
}
