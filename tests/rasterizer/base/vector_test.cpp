// Tests the vector types. They are storage only, so most of this file checks at compile time which expressions exist.
// Their arithmetic is tested on integers, for which every order of operations is exact, and on one sum whose order
// matters.
#include "rasterizer/base/vector.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstddef>
#include <functional>
#include <new>
#include <type_traits>
#include <utility>

#include "rasterizer/base/vector_arithmetic.h"

namespace {

using namespace strata;

// clang-format 14 does not support requires expressions. clang-format off
template <class A, class B>
constexpr bool operators_exist = requires(A a, B b) {
    a + b;
}
|| requires(A a, B b) { a - b; }
|| requires(A a, B b) { a* b; }
|| requires(A a, B b) { a / b; }
|| requires(A a, B b) { b + a; }
|| requires(A a, B b) { b - a; }
|| requires(A a, B b) { b* a; }
|| requires(A a, B b) { b / a; };

template <class A, class B>
constexpr bool assignments_exist = requires(A a, B b) {
    a += b;
}
|| requires(A a, B b) { a -= b; }
|| requires(A a, B b) { a *= b; }
|| requires(A a, B b) { a /= b; };

template <class A>
constexpr bool steps_exist = requires(A a) {
    +a;
}
|| requires(A a) { -a; }
|| requires(A a) { ++a; }
|| requires(A a) { --a; }
|| requires(A a) { a++; }
|| requires(A a) { a--; };

template <class A, class... B>
constexpr bool any_arithmetic = steps_exist<A> || ((operators_exist<A, B> || assignments_exist<A, B>) || ...) ||
                                requires(A a) {
    std::plus<>{}(a, a);
}
|| requires(A a) { std::multiplies<>{}(a, a); };

template <class V>
constexpr bool any_of_one = requires(V v) {
    abs(v);
}
|| requires(V v) { floor(v); }
|| requires(V v) { round(v); }
|| requires(V v) { sqrt(v); }
|| requires(V v) { inversesqrt(v); }
|| requires(V v) { length(v); }
|| requires(V v) { normalize(v); }
|| requires(V v) { sin(v); }
|| requires(V v) { radians(v); }
|| requires(V v) { exp2(v); };

template <class V>
constexpr bool any_of_more = requires(V v) {
    dot(v, v);
}
|| requires(V v) { cross(v, v); }
|| requires(V v) { distance(v, v); }
|| requires(V v) { min(v, v); }
|| requires(V v) { max(v, 1); }
|| requires(V v) { pow(v, v); }
|| requires(V v) { step(1, v); }
|| requires(V v) { clamp(v, 0, 1); }
|| requires(V v) { clamp(v, v, v); }
|| requires(V v) { mix(v, v, 0.5f); }
|| requires(V v) { mix(v, v, 0.5); }
|| requires(V v) { mix(v, v, true); }
|| requires(V v) { mix(v, v, v); }
|| requires(V v) { smoothstep(0, 1, v); }
|| requires(V v) { fma(v, v, v); }
|| requires(V v) { reflect(v, v); }
|| requires(V v) { refract(v, v, 1); }
|| requires(V v) { outerProduct(v, v); }
|| requires(V v) { lessThan(v, v); };

template <class V>
constexpr bool is_storage = !any_arithmetic<V, V, int, float, double> && !any_of_one<V> && !any_of_more<V>;

static_assert(is_storage<Vec2> && is_storage<Vec3> && is_storage<Vec4> && is_storage<Vec3d> && is_storage<Vec4d>);
static_assert(!any_arithmetic<Vec3, Vec3d> && !any_arithmetic<Vec3d, Vec3> && !any_arithmetic<Vec4, Vec4d>);
static_assert(!any_arithmetic<Matrix, Matrix, int, float, double, Vec4, Vec4d>);

template <class M>
constexpr bool any_of_matrix = requires(M m) {
    transpose(m);
}
|| requires(M m) { inverse(m); }
|| requires(M m) { determinant(m); }
|| requires(M m) { matrixCompMult(m, m); };
// clang-format on
static_assert(!any_of_matrix<Matrix>);

// Proves that the checks above can fail: numbers have the operators that the vectors lack.
static_assert(any_arithmetic<double, int> && any_of_one<double> && operators_exist<float, float> && steps_exist<int>);

static_assert(Vec3{} == Vec3{0, 0, 0} && Vec4{} == Vec4{0, 0, 0, 0} && Vec3d{} == Vec3d{0, 0, 0});
static_assert(std::is_same_v<decltype(Vec3::x), float> && std::is_same_v<decltype(Vec3d::x), double>);

}  // namespace

TEST_CASE("a vector without a value is zero and a matrix the identity for any contents of the memory") {
    alignas(Matrix) std::byte memory[sizeof(Matrix)];
    std::fill(std::begin(memory), std::end(memory), std::byte{0xff});
    CHECK(*::new (memory) Matrix == identity);
    std::fill(std::begin(memory), std::end(memory), std::byte{0xff});
    CHECK(*::new (memory) Vec4d == Vec4d{0, 0, 0, 0});
    std::fill(std::begin(memory), std::end(memory), std::byte{0xff});
    CHECK(*::new (memory) Vec3 == Vec3{0, 0, 0});
}

TEST_CASE("a matrix is stored by columns and its entries are given and listed in that order") {
    std::array<double, 16> entries{};
    for (std::size_t i = 0; i < 16; ++i) entries[i] = static_cast<double>(i);
    const Matrix m = matrix_of(entries);
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 4; ++row) CHECK(m[column][row] == static_cast<double>(4 * column + row));
    CHECK(entries_of(m) == entries);
}

TEST_CASE("the components of a vector are its values in order for reading and writing") {
    Vec3 v{1, 2, 3};
    float sum = 0;
    for (float& x : components(v)) x *= 2;
    for (const float x : components(std::as_const(v))) sum = 10 * sum + x;
    CHECK(v == Vec3{2, 4, 6});
    CHECK(sum == 246);
    CHECK(components(v).size() == 3);
}

TEST_CASE("vectors are added and scaled and multiplied component by component") {
    const Vec3d a{1, -2, 3}, b{5, 7, -11};
    CHECK(plus(a, b) == Vec3d{6, 5, -8});
    CHECK(minus(a, b) == Vec3d{-4, -9, 14});
    CHECK(times(a, 3) == Vec3d{3, -6, 9});
    CHECK(divided(a, 4) == Vec3d{0.25, -0.5, 0.75});
    CHECK(dot_product(a, b) == -42);
    CHECK(cross_product(a, b) == Vec3d{1, 26, 17});
}

TEST_CASE("a sum of three products adds the first two first") {
    CHECK(dot_product({0x1p53, 1, 1}, {1, 1, 1}) == 0x1p53);      // 1 + 1 first would give 2^53 + 2
    CHECK(dot_product({1, 1, 0x1p53}, {1, 1, 1}) == 0x1p53 + 2);  // from the right it would be 2^53
}
