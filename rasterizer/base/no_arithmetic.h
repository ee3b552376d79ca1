// rasterizer/base/no_arithmetic.h - deletes GLM's arithmetic for the types of vector.h, so that an operator between them does not
// compile. Part of vector.h, and of Strata's own build alone.
//
// Rule     An overload that is no template wins over GLM's templates, and over its member templates, wherever both fit. The argument
//          types cover a vector with a vector, a vector with a number, a matrix with a matrix, a number, or a column.
// Source   ISO C++ [over.match.best]: a function that is not a template beats a specialisation of one.
// Tests    tests/rasterizer/base/vector_test.cpp: each operator between each pair of types.
#pragma once
#ifndef STRATA_GLM_IS_STORAGE
#error "include rasterizer/base/vector.h"
#endif

// Macros, because no template can beat GLM's: the operators must be spelled for every type. `v += 2` finds the template and GLM's
// member equally good, which does not compile, either.
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

#define STRATA_NO_MIXTURE(V, W)                \
    void operator+=(V&, const W&) = delete;    \
    void operator-=(V&, const W&) = delete;    \
    void operator*=(V&, const W&) = delete;    \
    void operator/=(V&, const W&) = delete;

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

}  // namespace glm

#undef STRATA_NO_MIXTURE
#undef STRATA_NO_ARITHMETIC
#undef STRATA_NO_OPERATOR
