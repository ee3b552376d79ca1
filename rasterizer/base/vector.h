// rasterizer/base/vector.h - the types in which vectors, colours and matrices are stored and passed. They are GLM's;
// nothing else of GLM is used.
//
// Rule     GLM only stores values. The order of operations in its operators and functions depends on its version and
//          build, so no bit may come from them: arithmetic is Strata's own (vector_arithmetic.h,
//          pipeline/vertices/matrix.h, the loops of each stage). Only this header includes GLM or names its namespace.
//          While Strata itself is built, no_arithmetic.h deletes the operators for the types below; programs that use
//          Strata keep them.
// Numbers  A matrix is stored by columns as in OpenGL: m[column][row]. Default-constructed vectors are zero and
//          matrices the identity (GLM_FORCE_CTOR_INIT); Matrix(0.0) is a matrix of zeros. A single value in braces
//          fills every component.
// Tests    tests/rasterizer/base/vector_test.cpp, tests/lint/glm.py
#pragma once
#include <array>
#include <cstddef>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <span>

#if GLM_CONFIG_CTOR_INIT == GLM_CTOR_INIT_DISABLE
#error "Strata's vectors begin as zero: compile with GLM_FORCE_CTOR_INIT (link the target strata::numerics)"
#endif

namespace strata {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using Vec4 = glm::vec4;
using Rgba = glm::vec4;  // straight (not premultiplied) unless a name says otherwise
using Vec3d = glm::dvec3;
using Vec4d = glm::dvec4;
using Matrix = glm::dmat4;

inline constexpr Matrix identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

// The components of a vector as a span, for loops over them.
template <glm::length_t length, class T>
[[nodiscard]] std::span<T, length> components(glm::vec<length, T>& v) noexcept {
    return std::span<T, length>{&v.x, length};
}
template <glm::length_t length, class T>
[[nodiscard]] std::span<const T, length> components(const glm::vec<length, T>& v) noexcept {
    return std::span<const T, length>{&v.x, length};
}

// Conversion between a matrix and its sixteen entries in file order, column by column.
[[nodiscard]] constexpr Matrix matrix_of(const std::array<double, 16>& m) noexcept {
    return {m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]};
}
[[nodiscard]] constexpr std::array<double, 16> entries_of(const Matrix& m) noexcept {
    std::array<double, 16> entries{};
    for (std::size_t i = 0; i < 16; ++i) entries[i] = m[i / 4][i % 4];
    return entries;
}

// Components are contiguous, so an array of vectors is an array of numbers.
static_assert(sizeof(Vec2) == 8 && sizeof(Vec3) == 12 && sizeof(Vec4) == 16);
static_assert(sizeof(Vec3d) == 24 && sizeof(Vec4d) == 32 && sizeof(Matrix) == 128);

}  // namespace strata

#ifdef STRATA_GLM_IS_STORAGE
#include "rasterizer/base/no_arithmetic.h"
#endif
