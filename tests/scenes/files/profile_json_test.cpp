// Tests profiles in JSON by a round trip of all fields; the expected error messages are written by hand.
#include "scenes/files/profile_json.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/device/profile_fields.h"
#include "rasterizer/base/input_error.h"
#include "tests/scenes/scenes_support.h"
#include "tests/support/own_folder.h"

using namespace strata::pipeline;
using strata::InputError;
using strata::scenes::load_profile;
using strata::scenes::parse_profile;
using strata::scenes::to_json;

namespace {

std::string error_of(const std::string& text) {
    try {
        (void)parse_profile(text, "my.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

// JSON of a profile that differs from geforce8 by one line.
std::string changed(const std::string& line) { return R"({"name": "mine", "base": "geforce8", )" + line + "}"; }

}  // namespace

TEST_CASE("every built-in profile is unchanged after a JSON round trip") {
    for (const DeviceProfile& profile : builtin_profiles()) CHECK(parse_profile(to_json(profile), "x.json") == profile);
}

TEST_CASE("a profile with every field at its lowest or highest value is unchanged after a JSON round trip") {
    DeviceProfile profile;
    profile.name = "odd \"name\"";
    profile.description = "tabs\tand \xc3\xa4";
    for (const bool highest : {false, true}) {
        for (const ProfileField& field : profile_fields()) field.set(profile, highest ? field.highest : field.lowest);
        // Span coverage excludes the chip's interpolation weights, which the highest colour rules require.
        if (highest) profile.raster.coverage = strata::rasterizer::CoverageRule::snapped_edges;
        if (highest) profile.has_signed_blend = false;  // these equations exist only for codes
        CHECK(parse_profile(to_json(profile), "x.json") == profile);
    }
}

TEST_CASE("a profile that names a base lists only the fields that differ") {
    const DeviceProfile mine = parse_profile(
        R"({"base": "geforce8", "name": "mine", "has_d16": true, "raster": {"snap": "toward_zero", "subpixel_bits": 12}})",
        "my.json");
    DeviceProfile expected = *find_profile("geforce8");
    expected.name = "mine";
    expected.has_d16 = true;
    expected.raster.snap = strata::rasterizer::Snap::toward_zero;
    expected.raster.subpixel_bits = 12;
    CHECK(mine == expected);
}

TEST_CASE("for an unknown key or name the nearest one is suggested") {
    CHECK(error_of(changed(R"("has_d61": true)")) ==
          "my.json: /: expected a key of a profile, found 'has_d61' (did you mean 'has_d16'?)");
    CHECK(error_of(changed(R"("raster": {"snapp": "toward_zero"})")) ==
          "my.json: /raster: expected a key of a profile, found 'snapp' (did you mean 'snap'?)");
    CHECK(error_of(changed(R"("denormals": "flsh")")) ==
          "my.json: /denormals: expected one of flush, keep, found 'flsh' (did you mean 'flush'?)");
    CHECK(error_of(R"({"name": "mine", "base": "geforce9"})") ==
          "my.json: /base: expected one of geforce3, geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, "
          "softpipe, swiftshader, direct3d11, found 'geforce9' (did "
          "you mean "
          "'geforce3'?)");
}

TEST_CASE("a field that another one rules out is rejected with the name of that field") {
    CHECK(error_of(R"({"name": "mine", "base": "geforce3", "raster": {"coverage": "float_spans"}})") ==
          "my.json: /raster/coverage: expected snapped_edges with raster.color weights_8bit, found float_spans");
    CHECK(error_of(R"({"name": "mine", "base": "softpipe", "raster": {"depth_path": "window_z"}})") ==
          "my.json: /raster/coverage: expected snapped_edges with raster.depth_path window_z, found float_spans");
    CHECK(error_of(R"({"name": "mine", "base": "softpipe", "raster": {"depth_path": "w_buffer"}})") ==
          "my.json: /raster/coverage: expected snapped_edges with raster.depth_path w_buffer, found float_spans");
    CHECK(error_of(R"({"name": "mine", "base": "softpipe", "raster": {"depth_path": "exact"}})") == "no error");
}

TEST_CASE("a value of the wrong type or out of range is rejected with file and JSON pointer and the valid range") {
    CHECK(error_of(changed(R"("max_samples": 9)")) ==
          "my.json: /max_samples: expected a whole number from 1 to 8, found 9");
    CHECK(error_of(changed(R"("max_samples": -1)")) ==
          "my.json: /max_samples: expected a whole number from 1 to 8, found -1");
    CHECK(error_of(changed(R"("max_samples": 2.0)")) ==
          "my.json: /max_samples: expected a whole number from 1 to 8, found 2.0");
    CHECK(error_of(changed(R"("max_samples": 99999999999999999999)"))
              .starts_with("my.json: /max_samples: expected a whole number"));
    CHECK(error_of(changed(R"("has_d16": 1)")) == "my.json: /has_d16: expected true or false, found 1");
    CHECK(error_of(changed(R"("has_d16": null)")) == "my.json: /has_d16: expected true or false, found null");
    CHECK(error_of(changed(R"("raster": {"subpixel_bits": 13})")) ==
          "my.json: /raster/subpixel_bits: expected a whole number from 0 to 12, found 13");
    CHECK(error_of(changed(R"("raster": [])")) == "my.json: /raster: expected an object, found an array of 0");
    CHECK(error_of(changed(R"("denormals": 1)")) == "my.json: /denormals: expected one of flush, keep, found 1");
}

TEST_CASE("without a base every key of the first packs is required") {
    CHECK(error_of(R"({"name": "mine", "description": ""})") ==
          "my.json: /raster/subpixel_bits: expected a whole number from 0 to 12, found nothing, and no \"base\" "
          "to take it from");
    CHECK(error_of(R"({"base": "ideal"})") == "my.json: /name: expected a string of at most 64 bytes, found nothing");
    CHECK(error_of(R"({"base": "ideal", "name": ""})") ==
          "my.json: /name: expected a name without control characters, found \"\"");
    CHECK(error_of(R"({"base": "ideal", "name": "a\nb"})") ==
          "my.json: /name: expected a name without control characters, found \"a\\nb\"");
}

// The fields of profiles in the first packs of format 1; later fields are missing.
TEST_CASE("missing later fields have the values of the behaviour before them singly and all together") {
    const std::set<std::string_view> later{"alpha_to_coverage",
                                           "blend_storage",
                                           "centroid",
                                           "clip_depth",
                                           "depth24",
                                           "depth_order",
                                           "fog",
                                           "has_d24f",
                                           "has_logic_op",
                                           "has_unordered_access",
                                           "lighting",
                                           "min_samples",
                                           "origin",
                                           "raster.area_sign",
                                           "raster.depth_limits",
                                           "raster.equal_colors",
                                           "raster.lines",
                                           "raster.offset_rule",
                                           "raster.plane_corners",
                                           "raster.points",
                                           "raster.perspective_coordinates",
                                           "raster.reciprocal_deficit",
                                           "raster.sample_divisor",
                                           "raster.w_signs",
                                           "raster.w_slope",
                                           "raster.weights",
                                           "raster.y_axis",
                                           "resolve",
                                           "sample_coverage",
                                           "sample_positions"};
    DeviceProfile before;
    before.name = "old";
    nlohmann::json all = nlohmann::json::parse(to_json(before));
    for (const ProfileField& field : profile_fields()) {
        nlohmann::json without = nlohmann::json::parse(to_json(before));
        const bool is_raster = field.key.starts_with("raster.");
        const std::string leaf{is_raster ? field.key.substr(7) : field.key};
        (is_raster ? without["raster"] : without).erase(leaf);
        INFO(field.key);
        if (!later.contains(field.key)) {
            CHECK(error_of(without.dump()).find("found nothing") != std::string::npos);
            continue;
        }
        CHECK(parse_profile(without.dump(), "x.json") == before);
        (is_raster ? all["raster"] : all).erase(leaf);
    }
    CHECK(all.size() + all["raster"].size() == 3 + profile_fields().size() - later.size());
    CHECK(parse_profile(all.dump(), "x.json") == before);
}

TEST_CASE("a profile lists its open fields and they are read back") {
    DeviceProfile profile;
    profile.name = "found";
    const std::vector<std::string> open{"raster.snap", "has_d16"};
    const std::string text = to_json(profile, open);
    CHECK(parse_profile(text, "x.json") == profile);
    const strata::test::OwnFolder folder;
    const std::string path = folder.path() + "/found.json";
    std::ofstream{path} << text;
    CHECK(strata::scenes::open_fields(path) == open);
    CHECK(strata::scenes::open_fields("geforce8").empty());
    CHECK(error_of(changed(R"("open": ["raster.snapp"])")) ==
          "my.json: /open/0: expected a key of a profile, found 'raster.snapp' (did you mean 'raster.snap'?)");
    CHECK(error_of(changed(R"("open": [1])")) == "my.json: /open/0: expected a key of a profile, found 1");
    CHECK(error_of(changed(R"("open": {})")) ==
          "my.json: /open: expected an array of keys of a profile, such as raster.snap, found an object");
}

TEST_CASE("text that is not a JSON object is rejected with its position") {
    CHECK(error_of("") == "my.json: byte 1: expected a profile in JSON, found a syntax error");
    CHECK(error_of("{\"name\": }") == "my.json: byte 10: expected a profile in JSON, found a syntax error");
    CHECK(error_of("[1]") == "my.json: /: expected an object, found an array of 1");
    CHECK(error_of("{\"name\": 1e999}") == "my.json: /: expected a profile in JSON, found a number out of range");
    CHECK(error_of(std::string(100000, '[')) ==
          "my.json: /: expected at most 64 levels of arrays and objects, found deeper nesting");
}

TEST_CASE("a profile is loaded by name or from a file and for an unknown name the nearest is suggested") {
    CHECK(load_profile("ideal") == *find_profile("ideal"));
    const strata::test::TemporaryFolder folder;
    std::ofstream{folder / "mine.json"} << changed(R"("max_samples": 2)");
    CHECK(load_profile(folder / "mine.json").max_samples == 2);
    CHECK_THROWS_WITH(load_profile("gefroce8"),
                      "--profile: name: expected geforce3, geforce8, geforce8_dx101, ideal, llvmpipe, llvmpipe_sse, "
                      "softpipe, swiftshader, direct3d11, or a JSON file, "
                      "found 'gefroce8' (did you mean 'geforce8'?)");
    CHECK_THROWS_WITH(load_profile("missing.json"), Catch::Contains("missing.json"));
}
