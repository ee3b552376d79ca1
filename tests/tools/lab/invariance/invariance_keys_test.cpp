// Tests the keys of an invariance plan: values on both sides of every limit, listed here independently, and the names
// of remedies against their parts.
#include <algorithm>
#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "rasterizer/base/input_error.h"
#include "tools/lab/invariance/invariance_plan.h"

namespace {

using namespace strata::tools;
using rasterizer_path = strata::rasterizer::DepthPath;

const PlanKey& key_named(const std::string& name) {
    const auto& keys = plan_keys();
    const auto found = std::find_if(keys.begin(), keys.end(), [&](const PlanKey& key) { return key.name == name; });
    REQUIRE(found != keys.end());
    return *found;
}

// The cell that a value makes, or nothing if the key rejects the value.
std::optional<Cell> cell_with(const std::string& key, const std::string& value) {
    Cell cell;
    return key_named(key).set(cell, value) ? std::optional(cell) : std::nullopt;
}

// The values whose acceptance by the key is not `expected`.
std::string otherwise(const std::string& key, bool expected, const std::vector<std::string>& values) {
    std::string wrong;
    for (const std::string& value : values)
        if (cell_with(key, value).has_value() != expected) wrong += "'" + value + "' ";
    return wrong;
}

}  // namespace

TEST_CASE("the keys of a plan are those listed in this nesting order and every default is a valid value of its key") {
    const std::vector<std::string> expected{
        "scene",      "profile",     "size", "orbit",        "camera",        "alpha",    "algorithm", "split",
        "hypothesis", "vertex_path", "pair", "depth_format", "subpixel_bits", "near_far", "remedy",    "max_passes"};
    std::vector<std::string> names;
    for (const PlanKey& key : plan_keys()) {
        names.push_back(key.name);
        CHECK(key.fallback.empty() == (key.name == "scene"));
        CHECK_FALSE(key.help.empty());
        CHECK_FALSE(key.expected.empty());
        CHECK(key.is_list ==
              (key.name != "scene" && key.name != "orbit" && key.name != "camera"));  // their values contain commas
    }
    CHECK(names == expected);
    const std::vector<Cell> cells = cells_of({{"scene", {"s"}}});
    REQUIRE(cells.size() == 2);  // d16 and d24
    Cell plain = *cell_with("scene", "s");
    plain.algorithm = strata::peeling::find_algorithm("shadow_map");
    plain.vertex_paths.first = strata::pipeline::VertexPath::separate;
    plain.write = rasterizer_path::window_z;
    plain.compare = rasterizer_path::perspective_rq;
    plain.format = strata::pipeline::DepthFormat::d16;
    CHECK(cells[0] == plain);
    plain.format = strata::pipeline::DepthFormat::d24;
    CHECK(cells[1] == plain);
}

TEST_CASE("numbers of a plan are accepted up to their limits inclusive") {
    CHECK(otherwise("size", true, {"1x1", "16384x1", "1x16384"}) == "");
    CHECK(otherwise("size", false, {"0x1", "1x0", "16385x1", "1x16385", "8", "8x8x8", "x8", "8x", "8 x8", "-8x8"}) ==
          "");
    CHECK(otherwise("orbit", true, {"1e6,90", "-1e6,-90", "0,0"}) == "");
    CHECK(otherwise("orbit", false, {"30", "30,20,10", "30,", "nan,0"}) == "");
    CHECK(otherwise("alpha", true, {"0", "1", "0.5"}) == "");
    CHECK(otherwise("alpha", false, {"-0.001", "1.001", "", "nan", "half"}) == "");
    CHECK(otherwise("subpixel_bits", true, {"profile", "1", "4", "7", "8", "12"}) == "");
    CHECK(otherwise("subpixel_bits", false, {"0", "13", "4.5", "16", "", "Profile"}) == "");
    CHECK(otherwise("near_far", true, {"orbit", "ratio:2.6", "ratio:1e12", "1e-12:1e12", "1:1.0000001"}) == "");
    CHECK(otherwise(
              "near_far", false,
              {"ratio:2.5", "ratio:2e12", "ratio:", "1:1", "2:1", "0:1", "1e-13:1", "1:2e12", "1", "1:2:3", ""}) == "");
    CHECK(otherwise("max_passes", true, {"0", "1", "1000000"}) == "");
    CHECK(otherwise("max_passes", false, {"-1", "1.0", ""}) == "");
    for (const char* name : {"scene", "profile", "hypothesis"}) {
        CHECK(otherwise(name, true, {"any thing"}) == "");
        CHECK(otherwise(name, false, {""}) == "");
    }
}

TEST_CASE("parts of a remedy are accepted up to their limits inclusive") {
    CHECK(otherwise("remedy", true,
                    {"bias:1e30", "bias:-1e30", "slope:1024", "slope:-1024", "epsilon:0", "epsilon:1", "epsilon:0ulp",
                     "epsilon:16777216ulp"}) == "");
    CHECK(otherwise("remedy", false,
                    {"bias:1.3e30", "bias:-1.3e30", "slope:1024.1", "slope:-1024.1", "epsilon:1.001", "epsilon:-0.1",
                     "epsilon:16777217ulp", "epsilon:-1ulp", "epsilon:ulp", "epsilon:1.5ulp", "unquantized:1",
                     "depth_replace:", "None", "+", "none+", "+none", "bias:1,slope:1"}) == "");
}

TEST_CASE("the value of a key is stored in its member of the cell and in no other") {
    const auto changes = [](const std::string& key, const std::string& value, auto&& change) {
        const auto cell = cell_with(key, value);
        Cell expected;
        change(expected);
        INFO(key << ' ' << value);
        CHECK((cell && *cell == expected));
    };
    changes("size", "3x5", [](Cell& c) { c.width = 3, c.height = 5; });
    changes("orbit", "-7,11", [](Cell& c) { c.azimuth = -7, c.elevation = 11, c.takes_own_view = false; });
    changes("alpha", "0.25", [](Cell& c) { c.alpha = 0.25f; });
    changes("split", "moved", [](Cell& c) { c.split = Split::moved; });
    changes("hypothesis", "all", [](Cell& c) { c.hypothesis = "all"; });
    changes("pair", "float32:exact",
            [](Cell& c) { c.write = rasterizer_path::float32, c.compare = rasterizer_path::exact; });
    changes("depth_format", "d32f", [](Cell& c) { c.format = strata::pipeline::DepthFormat::d32f; });
    changes("subpixel_bits", "12", [](Cell& c) { c.subpixel_bits = 12; });
    changes("near_far", "ratio:1000", [](Cell& c) { c.range.ratio = 1000; });
    changes("near_far", "2:9", [](Cell& c) { c.range.near = 2, c.range.far = 9; });
    changes("max_passes", "6", [](Cell& c) { c.max_passes = 6; });
    changes("remedy", "bias:3", [](Cell& c) { c.remedy.bias_constant = 3; });
    changes("remedy", "slope:0.5", [](Cell& c) { c.remedy.bias_slope = 0.5f; });
    changes("remedy", "unquantized", [](Cell& c) { c.remedy.quantize_reference = false; });
    changes("remedy", "depth_replace", [](Cell& c) { c.remedy.depth_replace = true; });
    changes("remedy", "epsilon:3ulp", [](Cell& c) { c.remedy.epsilon.ulps = 3, c.remedy.epsilon_text = "3ulp"; });
    changes("remedy", "epsilon:0.125",
            [](Cell& c) { c.remedy.epsilon.absolute = 0.125, c.remedy.epsilon_text = "0.125"; });
}

TEST_CASE("a depth range or a remedy replaces the previous one completely") {
    Cell cell;
    CHECK(key_named("near_far").set(cell, "2:9"));
    CHECK(key_named("near_far").set(cell, "ratio:50"));
    CHECK(cell.range == DepthRange{.ratio = 50});
    CHECK(key_named("near_far").set(cell, "orbit"));
    CHECK(key_named("remedy").set(cell, "bias:3+slope:2+epsilon:1ulp+unquantized+depth_replace"));
    CHECK(key_named("remedy").set(cell, "none"));
    CHECK(cell == Cell{});
    CHECK(key_named("subpixel_bits").set(cell, "4"));
    CHECK(key_named("subpixel_bits").set(cell, "profile"));
    CHECK(cell.subpixel_bits == 0);
}

TEST_CASE("algorithms of a plan must peel and so oracles and those that only blend are rejected") {
    std::string wrong;
    for (const auto& algorithm : strata::peeling::algorithms()) {
        const bool peels = !algorithm.is_oracle && (algorithm.exact || algorithm.makes_layers);
        const auto cell = cell_with("algorithm", algorithm.name);
        if (cell.has_value() != peels || (cell && cell->algorithm != &algorithm)) wrong += algorithm.name + ' ';
    }
    CHECK(wrong == "");
    CHECK(otherwise("algorithm", true, {"front_to_back", "dual", "shadow_map"}) == "");
    CHECK(otherwise("algorithm", false, {"a_buffer", "weighted_average", "", "Dual"}) == "");
}

TEST_CASE("every remedy has the name that a plan would give it and that name makes the same remedy") {
    const std::vector<std::string> parts{"bias:2", "slope:-0.5", "epsilon:4ulp", "unquantized", "depth_replace"};
    int wrong = 0;
    for (unsigned chosen = 0; chosen < 32; ++chosen) {
        std::string forwards, backwards;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if ((chosen >> i & 1) != 0) {
                forwards += (forwards.empty() ? "" : "+") + parts[i];
                backwards = parts[i] + (backwards.empty() ? "" : "+") + backwards;
            }
        if (chosen == 0) forwards = backwards = "none";
        const auto a = cell_with("remedy", forwards), b = cell_with("remedy", backwards);
        wrong += a && b && *a == *b && name_of(a->remedy) == forwards ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(name_of(cell_with("remedy", "none+epsilon:1e-7")->remedy) == "epsilon:1e-7");
    for (const char* split : {"none", "rotated", "diagonal", "moved", "clamped"})
        CHECK(name_of(cell_with("split", split)->split) == split);
    CHECK(otherwise("split", false, {"", "turned", "none+moved"}) == "");
}

TEST_CASE("one vertex path applies to all passes and of two the second to the later passes and three are rejected") {
    std::string wrong;
    for (std::size_t a = 0; a < strata::pipeline::vertex_path_names.size(); ++a) {
        const std::string first{strata::pipeline::vertex_path_names[a]};
        const auto alone = cell_with("vertex_path", first);
        if (!alone ||
            alone->vertex_paths != strata::peeling::VertexPaths{static_cast<strata::pipeline::VertexPath>(a), {}})
            wrong += first + ' ';
        for (std::size_t b = 0; b < strata::pipeline::vertex_path_names.size(); ++b) {
            const std::string text = first + "+" + std::string{strata::pipeline::vertex_path_names[b]};
            const auto both = cell_with("vertex_path", text);
            if (!both || both->vertex_path != text ||
                both->vertex_paths != strata::peeling::VertexPaths{static_cast<strata::pipeline::VertexPath>(a),
                                                                   static_cast<strata::pipeline::VertexPath>(b)})
                wrong += text + ' ';
        }
    }
    CHECK(wrong == "");
    CHECK(otherwise("vertex_path", false, {"", "separate+", "+separate", "separate+separate+separate", "together"}) ==
          "");
    CHECK(otherwise("pair", false, {"", "exact", "exact:", "exact:exact:exact", "window_z:nearest"}) == "");
}

TEST_CASE("options alone make one grid and a missing scene is reported") {
    CHECK(
        cells_of({{"scene", {"s"}}, {"depth_format", {"d24"}}, {"alpha", {"0.1", "0.2"}}, {"split", {"none", "moved"}}})
            .size() == 4);
    CHECK_THROWS_WITH(cells_of({{"alpha", {"0.1"}}}),
                      "strata: SCENE: expected a scene, here, in /common or on the command line, found none");
}
