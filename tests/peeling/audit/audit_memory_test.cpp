// Tests the memory of an audit. The expected figures are those of a literal run with memory for everything, which
// audit_test checks; the memory for one pixel follows from the sizes of list and trace entries.
#include <atomic>
#include <catch2/catch.hpp>

#include "peeling/audit/audit.h"
#include "pipeline/region/region_shortcuts.h"
#include "rasterizer/base/input_error.h"
#include "tests/peeling/rendering.h"
#include "tests/pipeline/frames.h"
#include "tests/support/random_numbers.h"

namespace {

using namespace strata::testing;
using namespace strata::peeling;
using namespace strata::pipeline;

struct Way {
    std::uint64_t bytes = std::uint64_t{1} << 30;
    int threads = 1;
    Execution execution = Execution::literal;
    int tile_size = 8;
};

struct Audited {
    AuditResult result;
    std::size_t bodies = 0;  // number of bodies that were run
    std::size_t regions = 0;
};

// A peel that skips every third layer that it should composite, so that the audit finds errors.
Algorithm forgetful() {
    Algorithm a = *find_algorithm("front_to_back");
    a.resolve_loop = nullptr;
    a.run_with = nullptr;
    a.run = [](Region& region) {
        find_algorithm("front_to_back")->run(region);
        Trace& trace = RegionShortcuts{region}.trace();
        for (std::size_t i = 0; i < trace.size(); ++i)
            if (trace[i].key % 3 == 0) trace[i].side = Side::none;
    };
    return a;
}

Audited audit(const FragmentScene& scene, const Algorithm& algorithm, const Way& way) {
    TestFrame test{scene, "geforce8", way.tile_size};
    Frame& frame = test.frame;
    frame.blank_tiles_are_equal = true;
    frame.trace = algorithm.ties != TiePolicy::none;
    frame.key = algorithm.key;
    const int workers = way.execution == Execution::literal ? 1 : way.threads;
    frame.trace_bytes = AuditMemory{way.bytes, workers}.trace_bytes();
    std::atomic<std::size_t> bodies{0};
    const Body body = [&](Region& region) {
        ++bodies;
        algorithm.run(region);
    };
    Audit audit{frame, body, algorithm, way.bytes, way.threads};
    const FrameResult result = run(frame, body, way.execution, way.threads, {}, {}, audit.callbacks());
    return {audit.finish(result), bodies, result.work.regions};
}

// Up to `deepest` fragments per pixel, many of them of equal depth; the right half of the frame is empty.
FragmentScene scene_of(int deepest) {
    FragmentScene scene{64, 32};
    Random random{601};
    for (std::size_t p = 0; p < scene.pixels.size(); ++p) {
        if (p % 64 >= 32 || p < 640) continue;
        for (int i = random_int(random, 0, deepest); i > 0; --i)
            scene.pixels[p].fragments.push_back(
                {static_cast<float>(random_int(random, 1, 31)) / 32.0f, random_color(random)});
        if (random_int(random, 0, 5) == 0) scene.pixels[p].opaque = {0.75f, {0, 1, 0, 1}};
    }
    return scene;
}

FragmentScene deep_pixel(int fragments) {
    FragmentScene scene{16, 16};
    for (int i = 0; i < fragments; ++i)
        scene.pixels[3 * 16 + 5].fragments.push_back(
            {static_cast<float>(i % 512 + 1) / 1024.0f, {0.5f, 0.25f, 1, 0.25f}});
    return scene;
}

std::string message(const FragmentScene& scene, const Algorithm& algorithm, const Way& way) {
    try {
        static_cast<void>(audit(scene, algorithm, way));
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "";
}
std::string message(const FragmentScene& scene, const Algorithm& algorithm, std::uint64_t bytes) {
    return message(scene, algorithm, {.bytes = bytes, .execution = Execution::replay});
}

}  // namespace

TEST_CASE("an audit's figures depend neither on its memory nor on tiles and threads and execution", "[slow]") {
    const FragmentScene scene = scene_of(12);
    const Algorithm algorithm = GENERATE(forgetful(), *find_algorithm("dual"), *find_algorithm("layer_peel"),
                                         *find_algorithm("unsorted"), *find_algorithm("a_buffer"));
    INFO(algorithm.name);
    const AuditResult expected = audit(scene, algorithm, {}).result;
    CHECK(expected.fragments_max > 10);
    CHECK(expected.ties.pixels > 100);
    if (algorithm.run == forgetful().run) CHECK(expected.misordered.pixels > 100);
    for (const std::uint64_t bytes :
         {std::uint64_t{1} << 30, std::uint64_t{1} << 17, std::uint64_t{1} << 14, std::uint64_t{1300}})
        for (const Way& way : {Way{bytes, 1, Execution::literal, 16}, Way{bytes, 1, Execution::replay, 8},
                               Way{bytes, 3, Execution::replay, 32}, Way{bytes, 2, Execution::literal, 8}}) {
            INFO(bytes << " bytes, " << way.threads << " threads, tiles of " << way.tile_size);
            CHECK(audit(scene, algorithm, way).result == expected);
        }
}

TEST_CASE("regions that exceed the memory are run again in parts and none is run again if all fit", "[slow]") {
    const FragmentScene scene = scene_of(12);
    const Algorithm peel = forgetful();
    for (const Execution execution : {Execution::literal, Execution::replay}) {
        const Audited all = audit(scene, peel, {.execution = execution});
        const Audited little = audit(scene, peel, {.bytes = 1300, .execution = execution});
        CHECK(all.bodies <= all.regions);  // empty tiles share one run
        CHECK(little.bodies > all.bodies + 100);
        CHECK(little.result == all.result);
    }
    const Audited unordered =
        audit(scene, *find_algorithm("unsorted"), {.bytes = 1300, .execution = Execution::replay});
    CHECK(unordered.bodies <= unordered.regions);  // without an order there is no trace, so nothing is run again
}

TEST_CASE("errors found in an empty tile are counted in every tile that is equal to it") {
    FragmentScene scene{32, 16};
    scene.pixels[0].fragments.push_back({0.5f, {1, 1, 1, 0.5f}});  // the first tile is not empty
    Algorithm busy = *find_algorithm("front_to_back");
    busy.run_with = nullptr;
    busy.run = [](Region& region) {
        find_algorithm("front_to_back")->run(region);
        if (region.rect().width() > 2) region.trace({2, 7, 0, Side::front, false});  // a layer without a fragment
    };
    const AuditResult found = audit(scene, busy, {.execution = Execution::replay, .tile_size = 8}).result;
    CHECK(found.order_errors == 8u);  // one per tile
    CHECK(found.misordered == PixelCount{8, 2, 0});
}

TEST_CASE("an empty tile whose trace exceeds the memory is audited again at its own position") {
    FragmentScene scene{32, 16};
    scene.pixels[0].fragments.push_back({0.5f, {1, 1, 1, 0.5f}});
    Algorithm busy = *find_algorithm("front_to_back");
    busy.run_with = nullptr;
    busy.run = [](Region& region) {
        find_algorithm("front_to_back")->run(region);
        for (std::uint32_t p = 0; p < region.rect().area(); ++p) region.trace({p, 7, 0, Side::front, false});
    };
    for (const std::uint64_t bytes : {std::uint64_t{1} << 30, std::uint64_t{1300}}) {
        const AuditResult found =
            audit(scene, busy, {.bytes = bytes, .execution = Execution::replay, .tile_size = 8}).result;
        CHECK(found.order_errors == 32u * 16);  // one per pixel
        CHECK(found.misordered == PixelCount{32 * 16, 0, 0});
    }
}

TEST_CASE("if one pixel's fragments exceed the memory the message names the pixel and the sufficient number of bytes",
          "[slow]") {
    constexpr int fragments = 300;
    const FragmentScene scene = deep_pixel(fragments);
    for (const char* name : {"front_to_back", "unsorted"}) {
        const Algorithm& algorithm = *find_algorithm(name);
        const std::uint64_t enough = fragments * 52 * 2;
        const std::string expected =
            "audit: --fragment-memory: expected at least " + std::to_string(enough) +
            " bytes for the audit of pixel (5, 3), which has 300 fragments, or --no-audit, found 16384";
        INFO(name);
        CHECK(message(scene, algorithm, 16384) == expected);
        CHECK(message(scene, algorithm, enough) == "");
    }
}

TEST_CASE("a pixel whose trace is too long is reported with the memory doubled") {
    Algorithm endless = *find_algorithm("front_to_back");
    endless.run_with = nullptr;
    endless.run = [](Region& region) {
        find_algorithm("front_to_back")->run(region);
        for (int i = 0; i < 1000; ++i) region.trace({0, 7, 0, Side::front, false});
    };
    const std::string found = message(deep_pixel(1), endless, 8192);
    CHECK(found.find("at least 16384 bytes for the audit of pixel (") != std::string::npos);
    CHECK(message(deep_pixel(1), endless, 1 << 17) == "");
}

TEST_CASE("a renderer without fragment memory audits with the minimum and rejects a pixel that needs more", "[slow]") {
    const auto refusal = [](int fragments) -> std::string {
        const FragmentScene scene = deep_pixel(fragments);
        RenderOptions options = options_for(scene);
        options.fragment_memory = 0;
        try {
            const RenderResult result = render(scene, {"geforce8", "unsorted"}, options);
            return std::to_string(result.audit.fragments_max);
        } catch (const strata::InputError& error) {
            return error.what();
        }
    };
    CHECK(refusal(161000) == "161000");
    CHECK(refusal(162000).find("pixel (5, 3), which has 162000 fragments, or --no-audit, found 16777216") !=
          std::string::npos);
}

TEST_CASE("capturing all fragments of a frame is rejected in advance if they exceed the memory", "[slow]") {
    const FragmentScene scene = deep_pixel(270000);
    const DrawList list = draw_list(scene);
    const auto fragments = [&](std::uint64_t memory) {
        RenderOptions options = options_for(scene);
        options.fragment_memory = memory;
        Renderer renderer{list, {}, *find_profile("geforce8"), options};
        return renderer.fragments(*find_algorithm("unsorted")).all.size();
    };
    CHECK(fragments(std::uint64_t{18} << 20) == 270000);
    CHECK_THROWS_WITH(fragments(0),
                      "audit: --fragment-memory: expected at least 17280000 bytes for the frame's 270000 fragments "
                      "in total, found 16777216");
}
