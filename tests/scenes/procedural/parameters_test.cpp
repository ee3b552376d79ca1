// Tests the parameters of scene names. The expected error messages are written by hand, and each limit is tested from
// both sides.
#include "scenes/procedural/parameters.h"

#include <catch2/catch.hpp>

#include "rasterizer/base/input_error.h"
#include "scenes/scene.h"

namespace {

using strata::scenes::load_scene;
using strata::scenes::Parameters;
using KeyNames = std::vector<std::string_view>;

const KeyNames ab{"a", "b"};

template <class Action>
std::string message_of(Action&& action) {
    try {
        action();
    } catch (const strata::InputError& error) {
        return error.what();
    }
    return "accepted";
}

std::string message_for(const std::string& spec) {
    return message_of([&] { static_cast<void>(Parameters(spec, ab)); });
}

}  // namespace

TEST_CASE("a scene's name ends at the first colon") {
    CHECK(strata::scenes::scene_name("planes") == "planes");
    CHECK(strata::scenes::scene_name("planes:a=1:b") == "planes");
    CHECK(strata::scenes::scene_name(":a=1") == "");
    CHECK(strata::scenes::scene_name("") == "");
}

TEST_CASE("keys are accepted in any order and at most once and a missing key has its default") {
    const Parameters both{"s:b=20,a=10", ab}, one{"s:b=20", ab}, none{"s", ab};
    CHECK(both.integer("a", 0, 99, 7) == 10);
    CHECK(both.integer("b", 0, 99, 7) == 20);
    CHECK(one.integer("a", 0, 99, 7) == 7);
    CHECK(none.integer("b", 0, 99, 8) == 8);
    CHECK(none.integer("b", 0, 5, 8) == 8);  // a default is not checked against the range
    CHECK(message_for("s:a=1,a=1") == "s:a=1,a=1: a: expected one value, found two");
    CHECK(message_for("s:b=1,a=1,b=2") == "s:b=1,a=1,b=2: b: expected one value, found two");
}

TEST_CASE("an item that is not key=value or has an unknown key is rejected with its position") {
    for (const char* spec : {"s:", "s:a=1,", "s:,a=1", "s:a=1,,b=2"})
        CHECK(message_for(spec) == std::string{spec} + ": parameters: expected key=value, found ''");
    CHECK(message_for("s:a=1,b") == "s:a=1,b: parameters: expected key=value, found 'b'");
    CHECK(message_for("s:=1") == "s:=1: parameters: expected one of a, b, found ''");
    CHECK(message_for("s:A=1") == "s:A=1: parameters: expected one of a, b, found 'A'");
    CHECK(message_for("s: a=1") == "s: a=1: parameters: expected one of a, b, found ' a'");
    CHECK(message_of([] { static_cast<void>(Parameters("s:a=1", KeyNames{})); }) ==
          "s:a=1: parameters: expected one of , found 'a'");
}

TEST_CASE("a whole number is accepted from its lowest to its highest value and no other") {
    const auto read = [](const std::string& text, std::uint64_t low, std::uint64_t high) {
        return Parameters{"s:a=" + text, ab}.integer("a", low, high, 0);
    };
    std::string wrong;
    const std::uint64_t ends[] = {0, 1, 2, 9, 10, 255, 256, 65536, UINT64_MAX - 1, UINT64_MAX};
    for (const std::uint64_t low : ends)
        for (const std::uint64_t high : ends)
            for (const std::uint64_t value : ends) {
                const bool fits = low <= value && value <= high;
                const std::string text = std::to_string(value),
                                  range = std::to_string(low) + " to " + std::to_string(high),
                                  message = message_of([&] {
                                      if (read(text, low, high) != value) wrong += text + " changed ";
                                  });
                const std::string refused =
                    "s:a=" + text + ": a: expected a whole number from " + range + ", found '" + text + "'";
                if (message != (fits ? "accepted" : refused)) wrong += text + " in " + range + " ";
            }
    CHECK(wrong == "");
    CHECK(read("007", 0, 9) == 7);
    for (const char* text : {"", "+1", "-0", "1 ", "1e2", "1.0", "0b1", "18446744073709551616", "1=2"})
        CHECK(message_of([&] { static_cast<void>(read(text, 0, UINT64_MAX)); }) ==
              "s:a=" + std::string{text} + ": a: expected a whole number from 0 to 18446744073709551615, found '" +
                  text + "'");
}

TEST_CASE("a choice is its index in the list and the first one if nothing is given") {
    const KeyNames words{"far", "near", "middle"};
    CHECK(Parameters{"s", ab}.choice("a", words) == 0);
    for (std::size_t i = 0; i < words.size(); ++i)
        CHECK(Parameters{"s:a=" + std::string{words[i]}, ab}.choice("a", words) == i);
    CHECK(message_of([&] { static_cast<void>(Parameters("s:a=fat", ab).choice("a", words)); }) ==
          "s:a=fat: a: expected one of far, near, middle, found 'fat' (did you mean 'far'?)");
    CHECK(message_of([&] { static_cast<void>(Parameters("s:a=", ab).choice("a", words)); }) ==
          "s:a=: a: expected one of far, near, middle, found ''");
}

TEST_CASE("each parameter of a built-in scene is accepted at both of its limits and rejected beyond them") {
    struct Range {
        const char *scene, *key, *lowest, *highest, *below, *above;  // below "": no value is below the lowest
    };
    const Range ranges[] = {{"teapot", "tessellation", "1", "64", "0", "257"},
                            {"volume-beam", "slices", "1", "4096", "0", "65537"},
                            {"random", "triangles", "0", "4096", "", "10000001"},
                            {"random:triangles=1", "seed", "0", "18446744073709551615", "", "18446744073709551616"},
                            {"planes:cells=1", "count", "1", "64", "0", "65"},
                            {"planes:count=1", "cells", "1", "256", "0", "257"},
                            {"planes", "gap", "0", "1048576", "", "1048577"}};
    for (const Range& range : ranges) {
        const std::string scene = range.scene, start = scene + (scene.find(':') == std::string::npos ? ":" : ",");
        const auto said = [&](const std::string& value) {
            return message_of([&] { static_cast<void>(load_scene(start + range.key + "=" + value, {})); });
        };
        INFO(scene << ' ' << range.key);
        CHECK(said(range.lowest) == "accepted");
        CHECK(said(range.highest) == "accepted");
        CHECK_THAT(said(range.above), Catch::Contains(": " + std::string{range.key} + ": expected a whole number"));
        if (*range.below != '\0') CHECK_THAT(said(range.below), Catch::Contains(range.key + std::string{": expected"}));
    }
}

TEST_CASE("a scene without parameters takes none and the defaults are those in the list") {
    CHECK_THAT(message_of([] { static_cast<void>(load_scene("shadow-demo:size=1", {})); }),
               Catch::Contains("parameters: expected one of "));
    const std::pair<const char*, const char*> equal[] = {{"teapot", "teapot:tessellation=16"},
                                                         {"volume-beam", "volume-beam:slices=32,order=far"},
                                                         {"random", "random:seed=1,triangles=1000"},
                                                         {"planes", "planes:count=6,gap=65536,cells=8"}};
    for (const auto& [name, spelled] : equal) {
        CHECK(load_scene(name, {}).list.meshes == load_scene(spelled, {}).list.meshes);
        CHECK(load_scene(name, {}).list.instances == load_scene(spelled, {}).list.instances);
    }
}
