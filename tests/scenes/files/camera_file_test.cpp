// Tests camera files by a round trip of their bits; the expected error messages are written by hand.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "rasterizer/base/input_error.h"
#include "scenes/camera.h"
#include "scenes/files/atomic_file.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;
using strata::InputError;
using strata::pipeline::View;

namespace {

bool same_bits(const View& a, const View& b) {
    const auto bits = [](const strata::Matrix& m) {
        return std::bit_cast<std::array<std::uint64_t, 16>>(strata::entries_of(m));
    };
    return bits(a.view) == bits(b.view) && bits(a.projection) == bits(b.projection);
}

constexpr const char* good =
    R"({"eye":[0,0.5,3],"center":[0,0,0],"up":[0,1,0],"fovy_degrees":42,"near":1.9,"far":"0x1.0cccccccccccdp+2"})";

std::string with(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a camera written as JSON is read back with the same bits for numbers from 2^-64 to 2^64") {
    std::mt19937_64 random{4};
    for (int i = 0; i < 1000; ++i) {
        View view;
        for (auto* matrix : {&view.view, &view.projection}) {
            std::array<double, 16> entries{};
            for (double& x : entries) {
                do x = std::bit_cast<double>(random());
                while (!(std::fabs(x) >= 0x1p-64 && std::fabs(x) <= 0x1p64));
            }
            *matrix = strata::matrix_of(entries);
        }
        view.view[0][0] = -0.0;
        view.view[0][1] = 0x1p-1074;
        INFO(to_json(view));
        REQUIRE(same_bits(parse_camera(to_json(view), "camera", 1), view));
    }
}

TEST_CASE("decimals and hexadecimal floats give the same camera as look_at") {
    const LookAt expected{.eye = {0, 0.5, 3}, .fovy_degrees = 42, .near = 1.9, .far = 4.2};
    CHECK(same_bits(parse_camera(good, "c", 1.25), look_at(expected, 1.25)));
    CHECK(same_bits(parse_camera(with(good, "\"0x1.0cccccccccccdp+2\"", "4.2"), "c", 1.25), look_at(expected, 1.25)));
    CHECK(same_bits(parse_camera(with(good, "0.5", "\"+0X0.8p0\""), "c", 1.25), look_at(expected, 1.25)));
}

TEST_CASE("cameras are read and written identically under a locale with decimal commas") {
    const View before = parse_camera(good, "c", 1);
    const std::string text = to_json(before);
    const strata::test::CommaLocale locale;
    INFO("the C library has the locale: " << locale.c_library_has_it);
    CHECK(same_bits(parse_camera(good, "c", 1), before));
    CHECK(to_json(before) == text);
    CHECK_THROWS_WITH(parse_camera(with(good, "1.9", "5.5"), "c", 1),
                      "c: /far: expected a distance beyond near, 5.5, found \"0x1.0cccccccccccdp+2\"");
}

TEST_CASE("a camera file is read from disk and one that is missing or a folder or too long is rejected by name") {
    const strata::test::TemporaryFolder folder;
    write_file(folder / "camera.json", good);
    CHECK(same_bits(load_camera(folder / "camera.json", 1), parse_camera(good, "c", 1)));
    write_file(folder / "long.json", std::string(2'000'000, ' '));
    CHECK_THROWS_WITH(load_camera(folder / "none.json", 1), Catch::Contains("none.json: no such file"));
    CHECK_THROWS_AS(load_camera(folder.path, 1), InputError);
    CHECK_THROWS_WITH(load_camera(folder / "long.json", 1),
                      Catch::Contains("size: expected at most 1048576 bytes, found "));
}

TEST_CASE("every fault of a camera file gives one error message with its JSON pointer and the expected value") {
    const auto message = [](const std::string& text) -> std::string {
        try {
            (void)parse_camera(text, "c", 1);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    CHECK(message("{") == "c: byte 2: expected a camera in JSON, found a syntax error");
    CHECK(message("[]") == "c: /: expected an object, found an array of 0");
    CHECK(message("{\"near\":1e999}") == "c: /: expected a camera in JSON, found a number out of range");
    CHECK(message(with(good, "fovy_degrees", "fovy_degree")) ==
          "c: /: expected only the keys eye, center, up, fovy_degrees, near, far, view, projection, "
          "found 'fovy_degree' (did you mean 'fovy_degrees'?)");
    CHECK(message(with(good, ",\"near\":1.9", "")) == "c: /: expected the key 'near', found none");
    CHECK(message(with(good, "[0,0.5,3]", "[0,0.5]")) ==
          "c: /eye: expected an array of 3 numbers, found an array of 2");
    CHECK(message(with(good, "[0,0.5,3]", "7")) == "c: /eye: expected an array of 3 numbers, found 7");
    CHECK_THAT(message(with(good, "0.5", "\"0.5\"")), Catch::StartsWith("c: /eye/1: expected a finite number"));
    CHECK_THAT(message(with(good, "0.5", "\"0x-1p0\"")), Catch::StartsWith("c: /eye/1: expected a finite number"));
    CHECK_THAT(message(with(good, "0.5", "\"0x1p0 \"")), Catch::StartsWith("c: /eye/1: expected a finite number"));
    CHECK_THAT(message(with(good, "0.5", "\"0x1p9999\"")), Catch::StartsWith("c: /eye/1: expected a finite number"));
    CHECK_THAT(message(with(good, "0.5", std::string(300'000, '[') + std::string(300'000, ']'))),
               Catch::StartsWith("c: /eye: expected at most 64 levels"));
    CHECK(message(with(good, "42", "180")) == "c: /fovy_degrees: expected degrees between 0 and 180, found 180");
    CHECK(message(with(good, "1.9", "0")) == "c: /near: expected a distance above 0, found 0");
    CHECK(message(with(good, "1.9", "7")) ==
          "c: /far: expected a distance beyond near, 7, found \"0x1.0cccccccccccdp+2\"");
    CHECK(message(with(good, "[0,0.5,3]", "[0,0,0]")) ==
          "c: /center: expected a point that differs from eye, found the same point");
    CHECK(message(with(good, "[0,1,0]", "[0,1,6]")) ==
          "c: /up: expected a direction that is not parallel to the line of sight, found a parallel or zero vector");
    CHECK(message(with(good, "[0,1,0]", "[0,0,0]")) ==
          "c: /up: expected a direction that is not parallel to the line of sight, found a parallel or zero vector");
    CHECK(message("{\"view\":[1]}") == "c: /: expected the key 'projection', found none");
    CHECK_THAT(message(with(good, "\"far\"", "\"view\"")),
               Catch::StartsWith("c: /: expected only the keys view, projection"));
}
