// Tests the number fields of packs. The expected IEEE 754 bits are written by hand.
#include "scenes/packs/json_fields.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "rasterizer/base/input_error.h"

using namespace strata::scenes;
using Catch::Contains;
using nlohmann::json;

namespace {

enum class Fruit : std::uint8_t { apple, pear };

const std::string fields_file = "m.json";

std::vector<float> floats_of(const std::string& text, std::size_t count) {
    const json document = json::parse(text);
    JsonReader io{document, fields_file, "/place"};
    std::vector<float> values(count);
    io.reals("x", std::span<float>{values});
    io.end();
    return values;
}

}  // namespace

TEST_CASE("numbers are written as decimals and as bits and every bit is read back") {
    JsonWriter writer;
    const float singles[] = {0.1f, -0.0f, 0x1p-149f, 3.4028235e38f, std::numeric_limits<float>::infinity()};
    const double doubles[] = {0.1, 0x1p-1074};
    writer.reals("x", singles);
    writer.reals("y", doubles);
    const json document = json::parse(writer.object.dump());
    CHECK(document["x"]["bits"] == json({"3dcccccd", "80000000", "00000001", "7f7fffff", "7f800000"}));
    CHECK(document["x"]["decimal"][0].get<float>() == 0.1f);
    CHECK(document["x"]["decimal"][4].is_null());
    CHECK(document["y"]["bits"] == json({"3fb999999999999a", "0000000000000001"}));
    JsonReader reader{document, fields_file, ""};
    float back[5];
    double wide[2];
    reader.reals("x", back);
    reader.reals("y", wide);
    for (std::size_t i = 0; i < 5; ++i)
        CHECK(std::bit_cast<std::uint32_t>(back[i]) == std::bit_cast<std::uint32_t>(singles[i]));
    CHECK((wide[0] == doubles[0] && wide[1] == doubles[1]));
}

TEST_CASE("decimals or bits alone are sufficient and together they must agree") {
    CHECK(floats_of(R"({"x": {"bits": ["3f000000"]}})", 1)[0] == 0.5f);
    CHECK(floats_of(R"({"x": {"decimal": [0.5, 2]}})", 2)[1] == 2.0f);
    for (const char* wrong : {R"({"x": {"decimal": [0.5], "bits": ["3f000001"]}})", R"({"x": {"bits": ["3f00000"]}})",
                              R"({"x": {"decimal": [0.0], "bits": ["80000000"]}})", R"({"x": {"bits": ["3f00000g"]}})",
                              R"({"x": {"decimal": [0.5, 1]}})", R"({"x": {}})", R"({"x": 0.5})",
                              R"({"x": {"decimal": ["0.5"]}})", R"({"x": {"decimal": [null]}})"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(floats_of(wrong, 1), Contains("m.json: /place/x: expected 1 numbers"));
    }
}

TEST_CASE("a field that is missing or unknown or of another type or out of range is rejected with its JSON pointer") {
    const json document =
        json::parse(R"({"n": 7, "f": true, "fruit": "peer", "list": [{"n": 1}, {"m": 2}], "big": 1e3})");
    JsonReader io{document, fields_file, ""};
    int n = 0;
    Fruit fruit{};
    CHECK_THROWS_WITH(io.whole("n", n, 0, 6), "m.json: /n: expected a whole number from 0 to 6, found 7");
    CHECK_THROWS_WITH(io.whole("big", n, 0, 6), "m.json: /big: expected a whole number from 0 to 6, found 1000.0");
    CHECK_THROWS_WITH(io.choice("fruit", fruit),
                      Contains("/fruit: expected one of apple, pear, found 'peer' (did you"));
    CHECK_THROWS_WITH(static_cast<void>(io.at("none")), "m.json: /: expected the key 'none', found none");
    CHECK_THROWS_WITH(io.end(), Contains("expected only the keys"));
    std::vector<int> numbers;
    const auto item = [](JsonReader& inner, int& value) { inner.whole("n", value, 0, 9); };
    CHECK_THROWS_WITH(io.list("list", numbers, item), "m.json: /list/1: expected the key 'n', found none");
    CHECK_THROWS_AS(JsonReader(document["list"], fields_file, "/list"), strata::InputError);
}
