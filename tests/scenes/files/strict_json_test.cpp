// Tests the JSON reader. The expected error messages and JSON pointers are written by hand.
#include "scenes/files/strict_json.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/device/profile.h"
#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/files/profile_json.h"

using strata::scenes::parse_strict_json;

namespace {

template <class Parse>
std::string sentence_about(Parse parse) {
    try {
        parse();
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "";
}

std::string refusal_of(const std::string& text) {
    return sentence_about([&] { static_cast<void>(parse_strict_json(text, "f", "a thing")); });
}

std::string camera_refusal(const std::string& text) {
    return sentence_about([&] { static_cast<void>(strata::scenes::parse_camera(text, "c", 1)); });
}

// A camera of two matrices, each of which is `entry` times the identity.
std::string diagonal_camera(const std::string& entry) {
    std::string matrix = "[";
    for (int i = 0; i < 16; ++i) matrix += (i == 0 ? "" : ",") + (i % 5 == 0 ? entry : std::string("0"));
    matrix += "]";
    return "{\"view\":" + matrix + ",\"projection\":" + matrix + "}";
}

}  // namespace

TEST_CASE("a key may occur in several objects and a duplicate in one is rejected with its JSON pointer") {
    CHECK(refusal_of(R"({"a":1,"b":{"a":2},"c":[{"a":1},{"a":2}]})") == "");
    CHECK(refusal_of(R"({"a":1,"b":2,"a":1})") == "f: /a: expected each key once, found this key twice");
    CHECK(refusal_of(R"({"a":{"b":1,"c":{},"b":2}})") == "f: /a/b: expected each key once, found this key twice");
    CHECK(refusal_of(R"([{"x":1},{"x":1,"x":1}])") == "f: /x: expected each key once, found this key twice");
    CHECK(refusal_of(R"({"\u0061":1,"a":1})") == "f: /a: expected each key once, found this key twice");
    CHECK(parse_strict_json(R"({"a":[1,{"b":null}]})", "f", "x") == nlohmann::json{{"a", {1, {{"b", nullptr}}}}});
}

TEST_CASE(
    "malformed JSON and numbers out of double range and nesting deeper than 64 levels each give an error message") {
    CHECK(refusal_of("{\"a\":}") == "f: byte 6: expected a thing, found a syntax error");
    CHECK(refusal_of("[1e999]") == "f: /: expected a thing, found a number out of range");
    CHECK(refusal_of(std::string(64, '[') + std::string(64, ']')) == "");
    const std::string deep = "f: /: expected at most 64 levels of arrays and objects, found deeper nesting";
    CHECK(refusal_of(std::string(66, '[') + std::string(66, ']')) == deep);
    CHECK(refusal_of(std::string(1000000, '[')) == deep);
}

TEST_CASE("camera and profile files with duplicate keys are rejected") {
    CHECK(camera_refusal(
              R"({"eye":[0,0,5],"center":[0,0,0],"up":[0,1,0],"fovy_degrees":45,"near":1,"far":10,"far":20})") ==
          "c: /far: expected each key once, found this key twice");
    CHECK(sentence_about([] {
              static_cast<void>(strata::scenes::parse_profile(
                  R"({"base":"ideal","name":"x","raster":{"subpixel_bits":4,"subpixel_bits":8}})", "p"));
          }) == "p: /raster/subpixel_bits: expected each key once, found this key twice");
}

TEST_CASE("singular matrices and entries beyond 2^64 are rejected and extreme but invertible ones are accepted") {
    for (const char* entry : {"1", "-1", "1e-15", "18446744073709551616", "\"0x1p-1000\""})
        CHECK(camera_refusal(diagonal_camera(entry)) == "");
    CHECK(camera_refusal(diagonal_camera("0")) ==
          "c: /view: expected a matrix that can be inverted, found a singular matrix");
    for (const char* entry : {"1e308", "18446744073709555712", "-1e20"})
        CHECK(camera_refusal(diagonal_camera(entry))
                  .starts_with("c: /view/0: expected a number from -2^64 to 2^64, found "));
    // Two equal rows.
    std::string singular = diagonal_camera("1");
    singular.replace(singular.find("[1,0,0,0,0,1"), 12, "[1,0,0,0,1,0");
    CHECK(camera_refusal(singular) == "c: /view: expected a matrix that can be inverted, found a singular matrix");
    // Invertible, but elimination needs a row swap because the first pivot is zero.
    CHECK(camera_refusal(
              R"({"view":[0,1,0,0, 1,0,0,0, 0,0,0,1, 0,0,1,0],"projection":[0,1,0,0, 1,0,0,0, 0,0,0,1, 0,0,1,0]})") ==
          "");
}

TEST_CASE("an angle or a near plane below 2^-64 is rejected") {
    const auto camera = [](const std::string& fovy, const std::string& near) {
        return camera_refusal("{\"eye\":[0,0,5],\"center\":[0,0,0],\"up\":[0,1,0],\"fovy_degrees\":" + fovy +
                              ",\"near\":" + near + ",\"far\":10}");
    };
    CHECK(camera("45", "1") == "");
    CHECK(camera("1e-19", "1e-19") == "");
    CHECK(camera("1e-320", "1").starts_with("c: /fovy_degrees: expected at least 2^-64 degrees, found 1e-320"));
    CHECK(camera("45", "1e-320").starts_with("c: /near: expected a distance of at least 2^-64, found 1e-320"));
    CHECK(camera("45", "0") == "c: /near: expected a distance above 0, found 0");
}
