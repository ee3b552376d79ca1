// Tests the expansion of invariance plans. The expected cells of small plans and the error messages are written by
// hand.
#include "tools/lab/invariance/invariance_plan.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"

using namespace strata::tools;

namespace {

using Cells = std::vector<std::string>;

// The settings in which the cells of these tests differ.
Cells names(const std::vector<Cell>& cells) {
    Cells names;
    for (const Cell& c : cells)
        names.push_back(c.scene + " " + std::to_string(c.width) + " d" + std::to_string(int(c.format)) + " " +
                        name_of(c.remedy));
    return names;
}

std::string message(const std::string& plan) {
    try {
        static_cast<void>(parse_plan(plan, "p.json", {}));
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE(
    "a grid expands to all combinations of its values with the last key fastest in whatever order the file has them") {
    const Cells expected{"teapot 8 d0 none", "teapot 8 d0 bias:2", "teapot 8 d2 none", "teapot 8 d2 bias:2",
                         "random 8 d0 none", "random 8 d0 bias:2", "random 8 d2 none", "random 8 d2 bias:2"};
    CHECK(names(parse_plan(R"({"grids": [{"scene": ["teapot", "random"], "size": "8x4", "depth_format": ["d16", "d32f"],
                               "remedy": ["none", "bias:2"]}]})",
                           "p.json", {})) == expected);
    CHECK(names(parse_plan(R"({"grids": [{"remedy": ["none", "bias:2"], "depth_format": ["d16", "d32f"], "size": "8x4",
                               "scene": ["teapot", "random"]}]})",
                           "p.json", {})) == expected);
}

TEST_CASE("a value in a grid overrides one in common and that overrides an option and that overrides the default") {
    const KeyValues options{{"scene", {"given"}}, {"size", {"5x5"}}, {"depth_format", {"d32f"}}};
    const auto cells = parse_plan(R"({"common": {"size": "6x6", "depth_format": "d16"},
                                      "grids": [{"depth_format": "d24"}, {"scene": "own"}]})",
                                  "p.json", options);
    CHECK(names(cells) == Cells{"given 6 d1 none", "own 6 d0 none"});
    CHECK(cells[0].profile == "geforce3");
}

TEST_CASE("a repeated cell is kept once at its first index") {
    CHECK(names(parse_plan(R"({"common": {"scene": "s", "size": "1x1", "depth_format": "d24"},
                               "grids": [{"remedy": ["bias:1", "none"]}, {"remedy": ["none", "slope:1", "bias:1"]}]})",
                           "p.json", {})) == Cells{"s 1 d1 bias:1", "s 1 d1 none", "s 1 d1 slope:1"});
}

TEST_CASE("numbers may be given in place of their text and a remedy may have parts") {
    const auto cells =
        parse_plan(R"({"grids": [{"scene": "s", "alpha": 0.25, "subpixel_bits": [8], "depth_format": "d24",
                                      "remedy": "slope:0.5+bias:3+epsilon:2ulp+unquantized"}]})",
                   "p.json", {});
    REQUIRE(cells.size() == 1);
    CHECK(cells[0].alpha == 0.25f);
    CHECK(cells[0].subpixel_bits == 8);
    CHECK(name_of(cells[0].remedy) == "bias:3+slope:0.5+epsilon:2ulp+unquantized");
}

TEST_CASE("a plan accepts every value that the corresponding option accepts up to its limits") {
    const auto cells =
        parse_plan(R"({"grids": [{"scene": "teapot", "orbit": "-400.5,120", "size": "16384x1", "alpha": 1,
                                      "remedy": "epsilon:16777216ulp", "vertex_path": "fused+double", "max_passes": 2000000}]})",
                   "p.json", {});
    REQUIRE(cells.size() == 2);  // the two default depth formats
    CHECK(cells[0].azimuth == -400.5);
    CHECK(cells[0].elevation == 120);
    CHECK(cells[0].width == 16384);
    CHECK(cells[0].alpha == 1.0f);
    CHECK(cells[0].remedy.epsilon.ulps == 16777216);
    CHECK(cells[0].vertex_paths.second == strata::pipeline::VertexPath::double_precision);
    CHECK(cells[0].max_passes == 2000000);
    for (const char* wrong : {R"("size": "16385x1")", R"("alpha": 1.5)", R"("remedy": "epsilon:16777217ulp")",
                              R"("orbit": "30")", R"("vertex_path": "fused+double+nv20")", R"("max_passes": -1)"})
        CHECK_FALSE(message(std::string{R"({"grids": [{"scene": "teapot", )"} + wrong + "}]}").empty());
}

TEST_CASE("every fault of a plan gives one error message with its JSON pointer") {
    CHECK_THAT(message("{"), Catch::StartsWith("p.json: byte 2: expected a plan in JSON, found a syntax error"));
    CHECK(message("[]") == "p.json: /: expected an object with \"grids\", found []");
    CHECK(message(R"({"grid": []})") ==
          "p.json: /: expected keys about, common or grids, found 'grid' (did you mean 'grids'?)");
    CHECK(message(R"({"grids": []})") == "p.json: /grids: expected a list of at least one grid, found []");
    CHECK(message(R"({"grids": [{}]})") ==
          "p.json: /grids/0: expected a scene, here, in /common or on the command line, found none");
    CHECK_THAT(message(R"({"grids": [{"scene": "s"}, {"depth": "d16"}]})"),
               Catch::StartsWith("p.json: /grids/1: expected keys scene, "));
    CHECK(message(R"({"grids": [{"depth_format": ["d16", "d17"]}]})") ==
          "p.json: /grids/0/depth_format/1: expected d16, d24, d32f, d16f or d24f, found 'd17'");
    CHECK_THAT(message(R"({"common": {"near_far": "ratio:1"}, "grids": [{}]})"),
               Catch::StartsWith("p.json: /common/near_far: expected orbit, ratio:R with R from 2.6"));
    CHECK_THAT(message(R"({"grids": [{"alpha": true}]})"),
               Catch::Equals("p.json: /grids/0/alpha: expected a string, a number, or a list of them, found true"));
    CHECK_THAT(message(R"({"grids": [{"size": []}]})"),
               Catch::EndsWith("expected at least one value, found an empty list"));
    for (const char* bad : {"bias", "bias:x", "epsilon:2", "epsilon:-1ulp", "slope:nan", "none+", "biass:1"}) {
        INFO(bad);
        CHECK_THAT(message(R"({"grids": [{"remedy": ")" + std::string(bad) + "\"}]}"),
                   Catch::Contains("/grids/0/remedy: expected none, bias:UNITS"));
    }
}
