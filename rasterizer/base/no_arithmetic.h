// rasterizer/base/no_arithmetic.h - deletes GLM's operators and functions for the types of vector.h, so that a call of
// one does not compile. Included by vector.h, and only while Strata itself is built.
//
// Rule     A non-template overload is preferred to GLM's templates and member templates wherever both match. Deleted
//          operators: vector with vector or number; matrix with matrix, number or column vector. Deleted functions:
//          those that the header of the matrix declares, for the arguments that GLM accepts. Only == and != remain:
//          they compare component by component.
// Source   ISO C++ [over.match.best]: a function that is not a template beats a specialisation of one. GLSL 4.60
//          chapter 8 (the names).
// Tests    tests/rasterizer/base/vector_test.cpp; tests/lint/glm.py checks that no function of GLM's headers is missing
//          here.
#pragma once
#ifndef STRATA_GLM_IS_STORAGE
#error "include rasterizer/base/vector.h"
#endif

// Macros, because no template is preferred to GLM's: each operator must be declared for each type. `v += 2` is
// ambiguous between the template and GLM's member, and therefore does not compile either.
#define STRATA_NO_OPERATOR(op, V, Number)          \
    void operator op(const V&, const V&) = delete; \
    void operator op(const V&, Number) = delete;   \
    void operator op(Number, const V&) = delete;   \
    void operator op##=(V&, const V&) = delete;    \
    void operator op##=(V&, Number) = delete;      \
    template <class Other>                         \
    void operator op##=(V&, const Other&) = delete;

#define STRATA_NO_ARITHMETIC(V, Number) \
    STRATA_NO_OPERATOR(+, V, Number)    \
    STRATA_NO_OPERATOR(-, V, Number)    \
    STRATA_NO_OPERATOR(*, V, Number)    \
    STRATA_NO_OPERATOR(/, V, Number)    \
    void operator+(const V&) = delete;  \
    void operator-(const V&) = delete;  \
    void operator++(V&) = delete;       \
    void operator--(V&) = delete;       \
    void operator++(V&, int) = delete;  \
    void operator--(V&, int) = delete;

#define STRATA_NO_MIXTURE(V, W)             \
    void operator+=(V&, const W&) = delete; \
    void operator-=(V&, const W&) = delete; \
    void operator*=(V&, const W&) = delete; \
    void operator/=(V&, const W&) = delete;

#define STRATA_NO_UNARY(name, V) void name(const V&) = delete;
#define STRATA_NO_BINARY(name, V, Number)   \
    void name(const V&, const V&) = delete; \
    void name(const V&, Number) = delete;   \
    void name(Number, const V&) = delete;
#define STRATA_NO_TERNARY(name, V, Number)            \
    void name(const V&, const V&, const V&) = delete; \
    void name(const V&, const V&, Number) = delete;   \
    void name(const V&, Number, Number) = delete;     \
    void name(Number, Number, const V&) = delete;

// clang-format parses the macros as the beginning of one declaration.
// clang-format off
#define STRATA_NO_FUNCTIONS(V, Number)                                                                   \
    STRATA_NO_UNARY(abs, V) STRATA_NO_UNARY(sign, V) STRATA_NO_UNARY(floor, V) STRATA_NO_UNARY(trunc, V) \
    STRATA_NO_UNARY(round, V) STRATA_NO_UNARY(roundEven, V) STRATA_NO_UNARY(ceil, V)                     \
    STRATA_NO_UNARY(fract, V) STRATA_NO_UNARY(isnan, V) STRATA_NO_UNARY(isinf, V)                        \
    STRATA_NO_UNARY(exp, V) STRATA_NO_UNARY(log, V) STRATA_NO_UNARY(exp2, V) STRATA_NO_UNARY(log2, V)    \
    STRATA_NO_UNARY(sqrt, V) STRATA_NO_UNARY(inversesqrt, V) STRATA_NO_UNARY(length, V)                  \
    STRATA_NO_UNARY(normalize, V) STRATA_NO_UNARY(radians, V) STRATA_NO_UNARY(degrees, V)                \
    STRATA_NO_UNARY(sin, V) STRATA_NO_UNARY(cos, V) STRATA_NO_UNARY(tan, V) STRATA_NO_UNARY(asin, V)     \
    STRATA_NO_UNARY(acos, V) STRATA_NO_UNARY(atan, V) STRATA_NO_UNARY(sinh, V) STRATA_NO_UNARY(cosh, V)  \
    STRATA_NO_UNARY(tanh, V) STRATA_NO_UNARY(asinh, V) STRATA_NO_UNARY(acosh, V)                         \
    STRATA_NO_UNARY(atanh, V) STRATA_NO_UNARY(floatBitsToInt, V) STRATA_NO_UNARY(floatBitsToUint, V)     \
    STRATA_NO_BINARY(mod, V, Number) STRATA_NO_BINARY(min, V, Number) STRATA_NO_BINARY(max, V, Number)   \
    STRATA_NO_BINARY(step, V, Number) STRATA_NO_BINARY(pow, V, Number) STRATA_NO_BINARY(atan, V, Number) \
    STRATA_NO_BINARY(distance, V, Number) STRATA_NO_BINARY(dot, V, Number)                               \
    STRATA_NO_BINARY(cross, V, Number) STRATA_NO_BINARY(reflect, V, Number)                              \
    STRATA_NO_BINARY(lessThan, V, Number) STRATA_NO_BINARY(lessThanEqual, V, Number)                     \
    STRATA_NO_BINARY(greaterThan, V, Number) STRATA_NO_BINARY(greaterThanEqual, V, Number)               \
    STRATA_NO_BINARY(equal, V, Number) STRATA_NO_BINARY(notEqual, V, Number)                             \
    STRATA_NO_BINARY(outerProduct, V, Number)                                                            \
    STRATA_NO_TERNARY(clamp, V, Number) STRATA_NO_TERNARY(mix, V, Number)                                \
    STRATA_NO_TERNARY(smoothstep, V, Number) STRATA_NO_TERNARY(fma, V, Number)                           \
    STRATA_NO_TERNARY(faceforward, V, Number) STRATA_NO_TERNARY(refract, V, Number)                      \
    template <class Weight>                                                                              \
    void mix(const V&, const V&, Weight) = delete;                                                       \
    void modf(const V&, V&) = delete;
// clang-format on

namespace glm {

STRATA_NO_ARITHMETIC(vec2, float)
STRATA_NO_ARITHMETIC(vec3, float)
STRATA_NO_ARITHMETIC(vec4, float)
STRATA_NO_ARITHMETIC(dvec2, double)
STRATA_NO_ARITHMETIC(dvec3, double)
STRATA_NO_ARITHMETIC(dvec4, double)
STRATA_NO_ARITHMETIC(dmat4, double)

STRATA_NO_MIXTURE(vec2, dvec2)
STRATA_NO_MIXTURE(vec3, dvec3)
STRATA_NO_MIXTURE(vec4, dvec4)
STRATA_NO_MIXTURE(dvec2, vec2)
STRATA_NO_MIXTURE(dvec3, vec3)
STRATA_NO_MIXTURE(dvec4, vec4)

void operator*(const dmat4&, const dvec4&) = delete;
void operator*(const dvec4&, const dmat4&) = delete;
void operator/(const dmat4&, const dvec4&) = delete;
void operator/(const dvec4&, const dmat4&) = delete;

STRATA_NO_FUNCTIONS(vec2, float)
STRATA_NO_FUNCTIONS(vec3, float)
STRATA_NO_FUNCTIONS(vec4, float)
STRATA_NO_FUNCTIONS(dvec2, double)
STRATA_NO_FUNCTIONS(dvec3, double)
STRATA_NO_FUNCTIONS(dvec4, double)

void matrixCompMult(const dmat4&, const dmat4&) = delete;
void transpose(const dmat4&) = delete;
void determinant(const dmat4&) = delete;
void inverse(const dmat4&) = delete;

}  // namespace glm

#undef STRATA_NO_FUNCTIONS
#undef STRATA_NO_TERNARY
#undef STRATA_NO_BINARY
#undef STRATA_NO_UNARY
#undef STRATA_NO_MIXTURE
#undef STRATA_NO_ARITHMETIC
#undef STRATA_NO_OPERATOR
