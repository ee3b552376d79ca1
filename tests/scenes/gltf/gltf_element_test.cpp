// Tests accessor elements against glTF 2.0's table of sizes (3.6.2.4, with its alignment of matrix columns) and its
// formulas of 3.6.2.2. A quotient is correct if no neighbouring binary32 is nearer, which is decided in integers.
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "scenes/gltf/element.h"

namespace {

using namespace strata::scenes;

constexpr ComponentType all_types[] = {ComponentType::i8,  ComponentType::u8,  ComponentType::i16,
                                       ComponentType::u16, ComponentType::u32, ComponentType::f32};

// True if `value` is the binary32 nearest to code / scale. value * scale is exact in binary64: 24 + 16 bits.
bool is_nearest_quotient(float value, int code, int scale) {
    const auto off = [&](float v) { return std::fabs(double{v} * scale - code); };
    return off(value) <= off(std::nextafter(value, 2.0f)) && off(value) <= off(std::nextafter(value, -2.0f));
}

}  // namespace

TEST_CASE("an element has the size of the specification with columns of matrices padded to four") {
    struct Row {
        ElementType type;
        std::uint64_t bytes1, bytes2, bytes4;  // bytes for components of 1, 2 and 4 bytes
    };
    constexpr Row rows[] = {{ElementType::scalar, 1, 2, 4}, {ElementType::vec2, 2, 4, 8},
                            {ElementType::vec3, 3, 6, 12},  {ElementType::vec4, 4, 8, 16},
                            {ElementType::mat2, 8, 8, 16},  {ElementType::mat3, 12, 24, 36},
                            {ElementType::mat4, 16, 32, 64}};
    for (const Row& row : rows) {
        CHECK(element_bytes(row.type, ComponentType::i8) == row.bytes1);
        CHECK(element_bytes(row.type, ComponentType::u8) == row.bytes1);
        CHECK(element_bytes(row.type, ComponentType::i16) == row.bytes2);
        CHECK(element_bytes(row.type, ComponentType::u16) == row.bytes2);
        CHECK(element_bytes(row.type, ComponentType::u32) == row.bytes4);
        CHECK(element_bytes(row.type, ComponentType::f32) == row.bytes4);
    }
}

TEST_CASE("six codes are component types and seven words are element types and nothing else") {
    int known = 0;
    for (std::uint64_t code = 0; code < 70'000; ++code) known += to_component_type(code) ? 1 : 0;
    CHECK(known == 6);
    constexpr std::uint64_t codes[] = {5120, 5121, 5122, 5123, 5125, 5126};
    for (std::size_t i = 0; i < 6; ++i) CHECK(to_component_type(codes[i]) == all_types[i]);
    CHECK_FALSE(to_component_type((std::uint64_t{1} << 32) + 5120));
    const char* const words[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    for (std::size_t i = 0; i < 7; ++i) CHECK(to_element_type(words[i]) == static_cast<ElementType>(i));
    for (const char* word : {"", "scalar", "VEC", "VEC5", "VEC22", "MAT1"}) CHECK_FALSE(to_element_type(word));
}

TEST_CASE("indices are unsigned integers") {
    for (const ComponentType type : all_types)
        CHECK(is_index_type(type) ==
              (type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32));
}

TEST_CASE("every code of 8 and 16 bits means its integer or the nearest quotient by the type's largest value") {
    struct Kind {
        ComponentType type;
        int lowest, highest;
    };
    const Kind kinds[] = {{ComponentType::i8, -128, 127},
                          {ComponentType::u8, 0, 255},
                          {ComponentType::i16, -32768, 32767},
                          {ComponentType::u16, 0, 65535}};
    for (const Kind& kind : kinds) {
        int wrong = 0, first = 0;
        for (int code = kind.lowest; code <= kind.highest; ++code) {
            const auto bits = static_cast<std::uint32_t>(code) & (kind.highest < 256 ? 0xffu : 0xffffu);
            const float plain = component_value(bits, kind.type, false),
                        quotient = component_value(bits, kind.type, true);
            const int clamped = std::max(code, -kind.highest);
            const bool right =
                plain == static_cast<float>(code) && is_nearest_quotient(quotient, clamped, kind.highest);
            if (!right && wrong++ == 0) first = code;
        }
        INFO("first wrong code " << first << " of highest " << kind.highest);
        CHECK(wrong == 0);
        CHECK(component_value(0, kind.type, true) == 0);
    }
}

TEST_CASE("32-bit components are a float's bits or an integer rounded to binary32") {
    for (const bool normalized : {false, true}) {
        CHECK(component_value(0x3f800000, ComponentType::f32, normalized) == 1);
        CHECK(std::bit_cast<std::uint32_t>(component_value(0x7fc12345, ComponentType::f32, normalized)) == 0x7fc12345);
        CHECK(std::signbit(component_value(0x80000000, ComponentType::f32, normalized)));
        CHECK(component_value(0xffffffff, ComponentType::u32, normalized) == 0x1p32f);
        CHECK(component_value(16777217, ComponentType::u32, normalized) == 16777216);
    }
}
