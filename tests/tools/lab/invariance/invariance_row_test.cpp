// Tests the result line and the CSV row of an invariance cell. The expected text for one invented measurement is
// written by hand.
#include "tools/lab/invariance/invariance_row.h"

#include <catch2/catch.hpp>

#include "peeling/registry.h"
#include "tools/lab/invariance/invariance_summary.h"

namespace {

using namespace strata::tools;
using nlohmann::ordered_json;
using strata::peeling::Measurement;

Cell some_cell() {
    Cell cell;
    cell.scene = "planes:gap=64,count=4";
    cell.width = 24;
    cell.height = 16;
    cell.alpha = 0.1f;
    cell.algorithm = strata::peeling::find_algorithm("dual");
    cell.write = strata::rasterizer::DepthPath::float32;
    cell.compare = strata::rasterizer::DepthPath::exact;
    cell.remedy.bias_constant = 2;
    cell.remedy.bias_slope = 0.3f;
    cell.max_passes = 9;
    return cell;
}

CellView some_view() {
    CellView view;
    view.near = 0.1;
    view.far = 8;
    view.subpixel_bits = 4;
    return view;
}

CellResult some_result() {
    CellResult result{.view = some_view(), .measured = {}, .refusal = {}};
    Measurement& m = result.measured;
    m.paths.fragments = 100;
    m.paths.differing = 7;
    m.paths.unmatched = 2;
    m.paths.largest = -5;
    m.paths.where = {.pixel = 49, .primitive = 3, .stored = 0xabc, .reference = 0xab7};
    m.paths.histogram = {{-5, -5, 1}, {0, 0, 93}, {1, 2, 6}};
    m.errors.layers = 60;
    m.errors.layers_max = 4;
    m.errors.duplicated = 5;
    m.errors.lost = 6;
    m.errors.touched = {.pixels = 8, .first_x = 11, .first_y = 13};
    m.passes = 10;
    m.image.max_difference = 0.5;
    m.image.rmse = 0.25;
    m.image.psnr = 12.5;
    m.picture = strata::pipeline::Image(strata::pipeline::Format::rgba8, 1, 1);
    return result;
}

// The field of a row in the column with that title, for fields that need no quotes.
std::string field(const std::string& row, const std::string& title) {
    const auto columns = [](std::string text) {
        std::vector<std::string> parts(1);
        bool is_quoted = false;
        for (const char c : text) {
            if (c == '"') is_quoted = !is_quoted;
            if ((c == ',' && !is_quoted) || c == '\n')
                parts.emplace_back();
            else
                parts.back() += c;
        }
        return parts;
    };
    const auto titles = columns(csv_header()), fields = columns(row);
    REQUIRE(titles.size() == fields.size());
    for (std::size_t i = 0; i < titles.size(); ++i)
        if (titles[i] == title) return fields[i];
    return "no such column";
}

}  // namespace

TEST_CASE("the description of a cell has its number and every setting with file names without folders") {
    Cell cell = some_cell();
    ordered_json expected = ordered_json::parse(R"({"cell":3,"scene":"planes:gap=64,count=4","width":24,"height":16,
        "profile":"geforce3","algorithm":"dual","orbit":[30.0,20.0],"camera":null,"alpha":0.1,"write_path":"float32","compare_path":"exact",
        "depth_format":"d24","subpixel_bits":4,"near":0.1,"far":8.0,"remedy":"bias:2+slope:0.3","bias_constant":2.0,
        "bias_slope":0.3,"compare_epsilon":"0","vertex_path":"separate","quantize_reference":true,"split":"none",
        "hypothesis":"profile","max_passes":9})");
    CHECK(description(3, cell, some_view()).dump() == expected.dump());
    cell.scene = "/some/folder/dragon.glb";
    cell.profile = "mine/chip.json";
    cell.remedy = {};
    cell.remedy.quantize_reference = false;
    cell.remedy.depth_replace = true;
    expected.merge_patch({{"scene", "dragon.glb"},
                          {"profile", "chip.json"},
                          {"write_path", "depth_replace"},
                          {"remedy", "unquantized+depth_replace"},
                          {"bias_constant", 0.0},
                          {"bias_slope", 0.0},
                          {"quantize_reference", false}});
    CHECK(description(3, cell, some_view()).dump() == expected.dump());
}

TEST_CASE("a line has its description followed by its results in one order of keys") {
    const ordered_json line = to_line(3, some_cell(), some_result());
    ordered_json expected = description(3, some_cell(), some_view());
    expected.update(
        ordered_json::parse(R"({"outcome":"done","refusal":"","fragments":100,"differing":7,"unmatched":2,"ulp_max":5,
        "ulp_max_at":{"x":1,"y":2,"primitive":3,"stored":"0x00000abc","reference":"0x00000ab7"},
        "histogram":[[-5,-5,1],[0,0,93],[1,2,6]],"passes":10,"layers_true":4,"layers":60,"duplicated":5,"lost":6,
        "pixels_touched":8,"first_touched":[11,13],"max_difference":0.5,"rmse":0.25,"psnr":12.5})"));
    expected["digest"] = strata::pipeline::digest(some_result().measured.picture);
    for (const char* key : {"safe_epsilon_ulps", "safe_epsilon", "safe_bias"}) expected[key] = nullptr;
    CHECK(line.dump() == expected.dump());
}

TEST_CASE("an outcome is refused or compared or done or never_ends") {
    const auto outcome_of = [](auto&& change) {
        CellResult result = some_result();
        change(result);
        return to_line(0, some_cell(), result).at("outcome").get<std::string>();
    };
    CHECK(outcome_of([](CellResult&) {}) == "done");
    CHECK(outcome_of([](CellResult& r) { r.measured.ended = false; }) == "never_ends");
    CHECK(outcome_of([](CellResult& r) { r.measured.peeled = r.measured.ended = false; }) == "compared");
    CHECK(outcome_of([](CellResult& r) { r.refusal = "no", r.measured.peeled = false; }) == "refused");
    CellResult compared = some_result();
    compared.measured.peeled = false;
    CHECK(to_line(0, some_cell(), compared).at("digest") == "");
}

TEST_CASE("where all fragments agree no fragment is named and equal pictures have no signal-to-noise ratio") {
    CellResult result = some_result();
    result.measured.paths.differing = 0;
    result.measured.image.psnr.reset();
    const ordered_json line = to_line(0, some_cell(), result);
    CHECK(line.at("ulp_max_at").is_null());
    CHECK(line.at("psnr").is_null());
    CHECK(field(to_csv(line), "psnr") == "inf");
    result.measured.peeled = false;
    CHECK(field(to_csv(to_line(0, some_cell(), result)), "psnr") == "");
}

TEST_CASE("a safe range has its ends and the fragments that limit it") {
    CellResult result = some_result();
    strata::peeling::SafeRange range;
    range.lowest = 3;
    range.highest = 8;
    range.repeated = {.pixel = 25, .primitive = 1, .stored = 1, .reference = 2};
    range.front = {.pixel = 49, .primitive = 4, .stored = 3, .reference = 4};
    range.behind = {.pixel = 49, .primitive = 5, .stored = 5, .reference = 6};
    result.measured.advice.epsilon_ulps = range;
    const auto told = to_line(0, some_cell(), result).at("safe_epsilon_ulps");
    CHECK(told.at("safe") == true);
    CHECK(told.at("lowest") == 3);
    CHECK(told.at("highest") == 8);
    CHECK(told.at("repeated_below") ==
          ordered_json::parse(R"({"x":1,"y":1,"primitive":1,"stored":"0x00000001","reference":"0x00000002"})"));
    CHECK(told.at("lost_above").at("primitive") == 5);
    CHECK(told.at("lost_behind").at("primitive") == 4);
    range.behind_opaque = true;
    range.lowest = 9;
    result.measured.advice.epsilon_ulps = range;
    const auto empty = to_line(0, some_cell(), result).at("safe_epsilon_ulps");
    CHECK(empty.at("safe") == false);
    CHECK(empty.at("lost_above").at("primitive") == 4);
    CHECK_FALSE(empty.contains("lost_behind"));
    result.measured.advice.epsilon_ulps = strata::peeling::SafeRange{};
    const auto open = to_line(0, some_cell(), result).at("safe_epsilon_ulps");
    CHECK((open.at("lowest").is_null() && open.at("highest").is_null()));
    CHECK((!open.contains("repeated_below") && !open.contains("lost_above")));
    result.measured.advice.epsilon = strata::peeling::SafeAbsolute{};
    CHECK(to_line(0, some_cell(), result).at("safe_epsilon").at("lowest").is_null());
}

TEST_CASE("a row quotes fields with commas or quotes or line ends and writes numbers as in the line") {
    ordered_json line = to_line(3, some_cell(), some_result());
    const std::string row = to_csv(line);
    CHECK(
        row.starts_with("3,\"planes:gap=64,count=4\",24,16,geforce3,dual,\"30,20\",,0.1,float32,exact,d24,4,0.1,8."
                        "0,bias:2+slope:0.3,"
                        "2.0,0.3,0,separate,true,none,profile,9,100,7,5,10,"));
    CHECK(row.ends_with(",4,5,6,8,0.5,0.25,12.5,,done\n"));
    const std::pair<const char*, const char*> texts[] = {{"plain", "plain"},   {"say \"x\"", "\"say \"\"x\"\"\""},
                                                         {"a,b", "\"a,b\""},   {"a\nb", "\"a\nb\""},
                                                         {"a\rb", "\"a\rb\""}, {"", ""}};
    for (const auto& [text, written] : texts) {
        line["scene"] = text;
        CHECK(to_csv(line).starts_with("3," + std::string(written) + ",24,16,"));
    }
}

TEST_CASE("the planes of a scene's own view are empty fields of a row") {
    CellResult result = some_result();
    result.view = {.view = {}, .near = 0, .far = 0, .subpixel_bits = 4, .is_own = true};
    const std::string row = to_csv(to_line(0, some_cell(), result));
    for (const char* title : {"near", "far", "orbit", "camera"}) CHECK(field(row, title).empty());
}

TEST_CASE("rows and labels of a sweep name every setting that varies and the others are named once") {
    struct Change {
        const char* title;
        void (*make)(Cell&);
    };
    const Change changes[] = {
        {"scene", [](Cell& c) { c.scene = "teapot"; }},
        {"size", [](Cell& c) { c.height = 17; }},
        {"profile", [](Cell& c) { c.profile = "ideal"; }},
        {"algorithm", [](Cell& c) { c.algorithm = strata::peeling::find_algorithm("front_to_back"); }},
        {"orbit", [](Cell& c) { c.azimuth = 31; }},
        {"camera", [](Cell& c) { c.camera = "a/top.json"; }},
        {"alpha", [](Cell& c) { c.alpha = 0.5f; }},
        {"write", [](Cell& c) { c.write = strata::rasterizer::DepthPath::window_z; }},
        {"compare", [](Cell& c) { c.compare = strata::rasterizer::DepthPath::float32; }},
        {"depth", [](Cell& c) { c.format = strata::pipeline::DepthFormat::d16; }},
        {"vertex path", [](Cell& c) { c.vertex_path = "fused"; }},
        {"split", [](Cell& c) { c.split = Split::moved; }},
        {"hypothesis", [](Cell& c) { c.hypothesis = "other"; }},
        {"max passes", [](Cell& c) { c.max_passes = 8; }},
        {"remedy", [](Cell& c) { c.remedy.bias_constant = 4; }}};
    for (const Change& change : changes) {
        INFO(change.title);
        Cell other = some_cell();
        change.make(other);
        const Lines lines{to_line(0, some_cell(), some_result()), to_line(1, other, some_result())};
        const Table table = summary_table(lines);
        CHECK(table.columns.at(1).title == change.title);
        CHECK(table.rows.at(0).at(1) != table.rows.at(1).at(1));
        CHECK(table.columns.at(2).title == "passes");  // nothing else varies
        CHECK(same_everywhere(lines).find(std::string(change.title) + " ") == std::string::npos);
    }
    for (const auto& [title, view] :
         {std::pair{"subpixel bits", CellView{.view = {}, .near = 0.1, .far = 8, .subpixel_bits = 8}},
          {"near", CellView{.view = {}, .near = 0.2, .far = 8, .subpixel_bits = 4}},
          {"far", CellView{.view = {}, .near = 0.1, .far = 9, .subpixel_bits = 4}}}) {
        CellResult result = some_result();
        result.view = view;
        const Lines lines{to_line(0, some_cell(), some_result()), to_line(1, some_cell(), result)};
        CHECK(summary_table(lines).columns.at(1).title == title);
    }
}

TEST_CASE("a sentence counts the outcomes of the cells and a row has the safe interval") {
    CellResult right = some_result(), endless = some_result();
    right.measured.errors.duplicated = right.measured.errors.lost = 0;
    strata::peeling::SafeRange range;
    range.lowest = 3;
    range.highest = 20;
    right.measured.advice.bias = range;
    endless.measured.ended = false;
    const Lines lines{to_line(0, some_cell(), right), to_line(1, some_cell(), some_result()),
                      to_line(2, some_cell(), endless)};
    CHECK(summary_text(lines) == "Of 3 cells, 1 peels every layer once, 1 loses or repeats layers, 1 never ends.");
    CHECK(field(to_csv(lines[0]), "safe_bias") == "3..20");
    const Table table = summary_table(lines);
    const auto safe = table.columns.size() - 2;
    CHECK(table.columns[safe].title == "safe bias");
    CHECK(table.rows[0][safe] == "3..20");
    CHECK(table.rows[1][safe] == "-");
    CHECK(safe_text(nlohmann::ordered_json::parse(R"({"safe":false,"lowest":5,"highest":2})")) == "none");
    CHECK(safe_text(nlohmann::ordered_json::parse(R"({"safe":true,"lowest":null,"highest":2})")) == "..2");
    CHECK(safe_text(nlohmann::ordered_json::parse(R"({"safe":true,"lowest":5,"highest":null})")) == "5..");
}
