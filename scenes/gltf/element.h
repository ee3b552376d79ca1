// scenes/gltf/element.h - an accessor's elements: their types and sizes, and the value of a component.
//
// Rule     Normalised integers: c / 255, c / 65535, max(c / 127, -1), max(c / 32767, -1), one correctly rounded
//          division in binary32. Others: the integer itself, which binary32 holds exactly (8 and 16 bits).
// Source   glTF 2.0, 3.6.2.2 and 3.11 (animation's table of the same formulas).
// Tests    tests/scenes/gltf/gltf_accessor_test.cpp
#pragma once
#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string_view>

namespace strata::scenes {

enum class ComponentType : std::uint16_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };
enum class ElementType : std::uint8_t { scalar, vec2, vec3, vec4, mat2, mat3, mat4 };

[[nodiscard]] constexpr std::optional<ComponentType> to_component_type(std::uint64_t code) noexcept {
    if (code < 5120 || code > 5126 || code == 5124) return std::nullopt;
    return static_cast<ComponentType>(code);
}

[[nodiscard]] constexpr std::optional<ElementType> to_element_type(std::string_view name) noexcept {
    constexpr std::string_view names[]{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    const auto found = std::find(std::begin(names), std::end(names), name);
    if (found == std::end(names)) return std::nullopt;
    return static_cast<ElementType>(found - std::begin(names));
}

[[nodiscard]] constexpr std::uint64_t component_bytes(ComponentType type) noexcept {
    switch (type) {
        case ComponentType::i8:
        case ComponentType::u8: return 1;
        case ComponentType::i16:
        case ComponentType::u16: return 2;
        case ComponentType::u32:
        case ComponentType::f32: break;
    }
    return 4;
}

// The size of an element in bytes, without padding at its end; each column of a matrix begins at a multiple of 4.
[[nodiscard]] constexpr std::uint64_t element_bytes(ElementType type, ComponentType component) noexcept {
    const auto n = static_cast<std::uint64_t>(type);
    if (type <= ElementType::vec4) return (n + 1) * component_bytes(component);
    const std::uint64_t side = n - 2;
    return side * ((side * component_bytes(component) + 3) / 4 * 4);
}

[[nodiscard]] constexpr bool is_index_type(ComponentType type) noexcept {
    return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

// The value of a component given by its little-endian bits.
[[nodiscard]] constexpr float component_value(std::uint32_t bits, ComponentType type, bool is_normalized) noexcept {
    const auto i8 = static_cast<float>(static_cast<std::int8_t>(bits & 0xff));
    const auto i16 = static_cast<float>(static_cast<std::int16_t>(bits & 0xffff));
    const auto unsigned_value = static_cast<float>(bits);
    switch (type) {
        case ComponentType::i8: return is_normalized ? std::max(i8 / 127.0f, -1.0f) : i8;
        case ComponentType::u8: return is_normalized ? unsigned_value / 255.0f : unsigned_value;
        case ComponentType::i16: return is_normalized ? std::max(i16 / 32767.0f, -1.0f) : i16;
        case ComponentType::u16: return is_normalized ? unsigned_value / 65535.0f : unsigned_value;
        case ComponentType::u32: return unsigned_value;
        case ComponentType::f32: break;
    }
    return std::bit_cast<float>(bits);
}

}  // namespace strata::scenes
