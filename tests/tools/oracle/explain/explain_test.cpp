// Tests the history of a pixel against frames that are drawn with the depth paths and orders that the history names.
#include <bit>
#include <catch2/catch.hpp>
#include <map>

#include "peeling/render.h"
#include "tests/tools/oracle/explain/explained_scene.h"
#include "tools/oracle/explain/history_report.h"

using namespace strata;
using namespace strata::oracle;
using namespace strata::testing;

TEST_CASE("the history of a dual peel has the pass and the end at which each fragment is peeled and merges ties") {
    const ExplainedScene column = explained_scene("random", 20, 14);
    const auto histories = explain(column.input("geforce8"), *peeling::find_algorithm("dual"), {0, 0, 20, 14});
    int deep = 0, wrong = 0;
    for (const History& history : histories) {
        std::map<float, std::vector<int>> by_depth;
        std::uint32_t opaque_bits = 0x3f800000;  // bits of 1.0: the scene has no opaque surface
        for (std::size_t f = 0; f < history.fragments.size(); ++f)
            if (history.fragments[f].shader_z < std::bit_cast<float>(opaque_bits))
                by_depth[history.fragments[f].shader_z].push_back(static_cast<int>(f));
        std::vector<std::vector<int>> wanted;
        for (const auto& [z, fragments] : by_depth) wanted.push_back(fragments);
        wrong += composited(history) != wanted ? 1 : 0;
        if (wanted.size() < 4) continue;
        ++deep;
        // Pass 1 peels both ends, pass 2 the next one from each side.
        std::vector<int> iterations;
        for (const Line& line : history.lines)
            if (line.kind == LineKind::taken) iterations.push_back(line.side == pipeline::Side::back ? -1 : 1);
        wrong += std::vector<int>(iterations.begin(), iterations.begin() + 4) != std::vector<int>{1, -1, 1, -1} ? 1 : 0;
    }
    CHECK(deep > 10);
    CHECK(wrong == 0);
}

TEST_CASE("a fragment's depth by each path is the code that a frame with that path stores") {
    const ExplainedScene column = explained_scene("planes:gap=4", 20, 14);
    peeling::FrameRequest input = column.input("geforce3");
    input.options.depth = pipeline::DepthFormat::d24;
    const peeling::Algorithm& algorithm = *peeling::find_algorithm("depth_units");
    const auto histories = explain(input, algorithm, {3, 2, 17, 12});
    int compared = 0, wrong = 0, apart = 0, shares = 0;
    for (std::size_t path = 0; path < 7; ++path) {
        peeling::RenderOptions options = input.options;
        options.depth_path = static_cast<rasterizer::DepthPath>(path);
        peeling::Renderer renderer{input.list, input.view, input.profile, options};
        const peeling::RenderResult trial = renderer.render(algorithm);
        if (trial.outcome == peeling::Outcome::refused) continue;
        const auto fragments = renderer.fragments(algorithm);
        for (const auto& fragment : fragments.all) {
            const int x = static_cast<int>(fragment.pixel % 20), y = static_cast<int>(fragment.pixel / 20);
            if (x < 3 || x >= 17 || y < 2 || y >= 12) continue;
            for (const FragmentFact& fact : histories[static_cast<std::size_t>((y - 2) * 14 + x - 3)].fragments)
                if (fact.primitive == fragment.primitive) {
                    ++compared;
                    wrong += fact.path_codes[path] != fragment.code ? 1 : 0;
                }
        }
    }
    for (const History& history : histories)
        for (const FragmentFact& fact : history.fragments) {
            double sum = 0;
            bool is_inside = true;
            for (const double share : fact.barycentric) {
                sum += share;
                is_inside &= share >= 0 && share <= 1;
            }
            shares += is_inside && std::abs(sum - 1) < 1e-12 ? 0 : 1;
            apart += fact.path_codes[0] != fact.path_codes[5] ? 1 : 0;
        }
    CHECK(compared > 500);
    CHECK(wrong == 0);
    CHECK(shares == 0);
    CHECK(apart > 0);  // on nearly equal planes, the chip's interpolator and the exact plane give different codes
}

TEST_CASE("the history of a peel that compares another depth than it stores has both depths") {
    const ExplainedScene column = explained_scene("planes:gap=4", 20, 14);
    peeling::FrameRequest input = column.input("geforce3");
    input.options.depth = pipeline::DepthFormat::d24;
    const auto histories = explain(input, *peeling::find_algorithm("shadow_map"), {8, 6, 12, 9});
    int compared = 0, wrong = 0, apart = 0;
    for (const History& history : histories)
        for (const Line& line : history.lines) {
            if (line.kind != LineKind::fragment || !line.reference_code) continue;
            const FragmentFact& fact = history.fragments[static_cast<std::size_t>(line.fragment)];
            ++compared;
            // shadow_map stores the device's window_z and compares perspective_rq.
            wrong += fact.path_codes[0] != line.depth_code || fact.path_codes[1] != *line.reference_code ? 1 : 0;
            apart += line.depth_code != *line.reference_code ? 1 : 0;
        }
    CHECK(compared > 20);
    CHECK(wrong == 0);
    CHECK(apart > 0);
}

// Expected: the nearest code of the opaque fragments that pass the alpha test, one by one in list order with LESS.
TEST_CASE("opaque and masked fragments have a history that ends with the depth and colour seen by the first pass") {
    ExplainedScene room = explained_scene("showroom", 64, 64);
    REQUIRE(room.scene.own_view);
    room.view = *room.scene.own_view;
    auto& instances = room.scene.list.instances;
    const auto once = instances;  // drawn again at the same depths, which LESS rejects
    instances.insert(instances.end(), once.begin(), once.end());
    const peeling::FrameRequest input = room.input("geforce8");
    int told = 0, cut = 0, wrong = 0, behind = 0;
    for (const History& history : explain(input, *peeling::find_algorithm("front_to_back"), {0, 0, 64, 64})) {
        std::optional<std::uint32_t> depth;
        bool is_over = false;  // opaque lines must come before those of the passes
        for (const Line& line : history.lines) {
            wrong += line.kind == LineKind::opaque && is_over ? 1 : 0;
            is_over |= line.kind != LineKind::opaque;
            if (line.kind != LineKind::opaque) continue;
            ++told;
            wrong += line.pass == -1 ? 0 : 1;
            const FragmentFact& fact = history.opaque.at(static_cast<std::size_t>(line.fragment));
            if (fact.is_masked) {
                ++cut;
                wrong += line.fate == Fate::masked ? 0 : 1;
                continue;
            }
            const bool is_nearer = !depth || line.depth_code < *depth;
            wrong += line.fate == (is_nearer ? Fate::passed : Fate::depth_killed) ? 0 : 1;
            behind += is_nearer ? 0 : 1;
            if (is_nearer) depth = line.depth_code;
        }
    }
    CHECK(wrong == 0);
    CHECK(told > 500);
    CHECK(cut > 10);
    CHECK(behind > 0);
    const auto histories = explain(input, *peeling::find_algorithm("front_to_back"), {0, 0, 64, 64});
    const auto with_surface = std::ranges::find_if(histories, [](const History& h) { return !h.opaque.empty(); });
    REQUIRE(with_surface != histories.end());
    const std::string text = to_text(*with_surface);
    CHECK(text.find(" opaque or masked\n") != std::string::npos);
    CHECK(text.find("  opaque.0 ") != std::string::npos);
    CHECK(text.find("  before: fragment opaque.0 ") != std::string::npos);
}

TEST_CASE("the point where algorithms differ is described in a sentence and drawn") {
    const ExplainedScene column = explained_scene("random", 20, 14);
    const rasterizer::Rect centre{10, 7, 11, 8};
    std::vector<History> histories;
    for (const char* name : {"front_to_back", "dual", "weighted_average"})
        histories.push_back(explain(column.input("geforce8"), *peeling::find_algorithm(name), centre).at(0));
    const auto descriptions = first_differences(histories);
    REQUIRE(descriptions.size() == 2);
    CHECK(descriptions[0].starts_with("dual composites the same "));
    CHECK(descriptions[1].starts_with(
        "weighted_average parts from front_to_back at layer 0: no further layer against #"));
    const std::string svg = to_svg(histories);
    CHECK(svg.starts_with("<svg "));
    CHECK(svg.find(">dual</text>") != std::string::npos);
    CHECK(svg.find("near") != std::string::npos);
    const std::string text = to_text(histories[1]);
    CHECK(text.find("window_z none") != std::string::npos);
    CHECK(text.find("takes #") != std::string::npos);
    CHECK_THROWS(explain(column.input("geforce8"), *peeling::find_algorithm("dual"), {20, 0, 21, 1}));
}

TEST_CASE("fragments of lines and points are called so and a reversed depth is a key without a number") {
    const auto text_of = [](const char* scene, std::string_view what, bool is_reversed) {
        const ExplainedScene column = explained_scene(scene, 20, 14);
        peeling::FrameRequest input = column.input("ideal");
        input.options.raster.line_width_px = 5;
        input.options.raster.point_size_px = 5;
        if (is_reversed) input.options.raster.depth_order = rasterizer::DepthOrder::greater;
        for (const History& history : explain(input, *peeling::find_algorithm("front_to_back"), {0, 0, 20, 14}))
            for (const FragmentFact& f : history.fragments)
                if (std::string text = to_text(history); text.find(what) != std::string::npos && f.triangle >= 0)
                    return text;
        return std::string{};
    };
    for (const auto& [scene, noun] :
         {std::pair{"hair:strands=20", " strands line "}, {"splats:points=40", " point "}}) {
        const std::string text = text_of(scene, noun, false);
        CHECK(text.find(noun) != std::string::npos);
        CHECK(text.find("barycentric") == std::string::npos);
        CHECK(text.find("float32_plane none") != std::string::npos);
        CHECK(text.find("; z 0.") != std::string::npos);
    }
    const std::string reversed = text_of("planes:gap=4", " triangle ", true);
    CHECK(reversed.find("; z key ") != std::string::npos);
    CHECK(reversed.find("barycentric") != std::string::npos);
}
