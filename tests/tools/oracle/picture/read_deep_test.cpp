// Tests the reader of deep EXR parts on samples written by hand, against a plain search for the k-th smallest depth.
#include "tools/oracle/picture/read_deep.h"

#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <limits>

#include "rasterizer/base/input_error.h"

using namespace strata;
using namespace strata::oracle;

namespace {

using scenes::StoredPart;
using scenes::StoredType;

struct Sample {
    float r = 0, a = 0, z = 0;
};

// Channels A, R and Z, in the order of files.
StoredPart part_of(int width, int height, const std::vector<std::vector<Sample>>& pixels) {
    StoredPart part{.header = {.width = width, .height = height, .is_deep = true}, .is_whole = true};
    for (const char* name : {"A", "R", "Z"}) part.header.channels.push_back({name, StoredType::single});
    for (const auto& samples : pixels) {
        part.samples.push_back(static_cast<std::uint32_t>(samples.size()));
        for (const Sample& s : samples)
            for (const float v : {s.a, s.r, s.z}) {
                const auto bytes = std::bit_cast<std::array<std::byte, 4>>(v);
                part.bytes.insert(part.bytes.end(), bytes.begin(), bytes.end());
            }
    }
    return part;
}

}  // namespace

TEST_CASE("a deep part becomes layers from near to far and pixels with fewer samples have zeros") {
    constexpr float no_number = std::numeric_limits<float>::quiet_NaN();
    const std::vector<std::vector<Sample>> pixels{{{0.1f, 1, 0.9f}, {0.2f, 1, 0.5f}, {0.3f, 1, 0.7f}},
                                                  {},
                                                  {{0.4f, 1, no_number}, {0.5f, 1, 2.0f}},
                                                  {{0.6f, 1, 0}}};
    const auto layers = layers_of_deep(part_of(2, 2, pixels), "deep.exr");
    REQUIRE(layers.size() == 6);
    const float expected[3][4] = {{0.2f, 0, 0.5f, 0.6f}, {0.3f, 0, 0.4f, 0}, {0.1f, 0, 0, 0}};
    for (std::size_t layer = 0; layer < 3; ++layer) {
        const TargetImage &color = layers[2 * layer], &depth = layers[2 * layer + 1];
        CHECK(color.part == "layer.00" + std::to_string(layer));
        CHECK(color.channels == 2);
        CHECK(color.meaning == Meaning::color);
        CHECK(depth.part == color.part);
        CHECK(depth.meaning == Meaning::depth);
        for (std::size_t pixel = 0; pixel < 4; ++pixel) {
            CHECK(color.value_at(pixel, 0) == expected[layer][pixel]);
            CHECK(color.value_at(pixel, 1) == (expected[layer][pixel] != 0 ? 1 : 0));
        }
    }
    CHECK(layers[1].value_at(0, 0) == 0.5f);
    CHECK(layers[5].value_at(0, 0) == 0.9f);
    const auto none = layers_of_deep(part_of(1, 1, {{}}), "deep.exr");
    CHECK(none.size() == 2);
}

TEST_CASE("deep parts without colours or with mixed channels or with too many layers are rejected by name") {
    StoredPart part = part_of(1, 1, {{{1, 1, 1}}});
    part.header.channels[0].type = StoredType::word;
    CHECK_THROWS_WITH(layers_of_deep(part, "d.exr"),
                      "d.exr: deep part: expected channels of one type, HALF or FLOAT, found UINT or several types");
    part.header.channels = {{"X", StoredType::single}, {"Y", StoredType::single}, {"Z", StoredType::single}};
    CHECK_THROWS_WITH(layers_of_deep(part, "d.exr"),
                      "d.exr: deep part: expected a channel R, G, B or A, found none of them");
    StoredPart large = part_of(1, 1, {{}});
    large.samples.assign(std::size_t{1} << 14, 0);
    large.samples[0] = 1u << 13;
    CHECK_THROWS_AS(layers_of_deep(large, "d.exr"), InputError);
}
