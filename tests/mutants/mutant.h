// tests/mutants/mutant.h - one-step changes of a source, all compiled in, of which STRATA_MUTANT chooses one at run
// time. Only the copy that tools/mutate.py makes includes it.
//
// Rule     In a constant expression nothing is changed. Every change that is reached is noted in `reached`.
#pragma once
#include <cstdlib>
#include <type_traits>

namespace strata_mutants {

inline const int chosen = [] {
    const char* const number = std::getenv("STRATA_MUTANT");
    return number == nullptr ? -1 : std::atoi(number);
}();
inline constexpr int most = 1 << 16;
inline unsigned char reached[most] = {};

template <int n>
[[nodiscard]] constexpr bool is() noexcept {
    if (std::is_constant_evaluated()) return false;
    reached[n] = 1;
    return chosen == n;
}

template <int n, class T>
[[nodiscard]] constexpr T one_more(T value) noexcept {
    return is<n>() ? static_cast<T>(value + T{1}) : value;
}

template <int n, int count, class Enum>
[[nodiscard]] constexpr Enum another(Enum value) noexcept {
    return is<n>() ? static_cast<Enum>((static_cast<int>(value) + 1) % count) : value;
}

template <int n, class T>
[[nodiscard]] constexpr bool negated(const T& value) noexcept {
    return is<n>() != static_cast<bool>(value);
}

// `a < Less<n>{} < b`: the first comparison stores a, the second applies the original operator or its neighbour.
template <class A, class Operator>
struct Left {
    const A& value;
};

#define STRATA_MUTANT_OPERATOR(Name, symbol, neighbour)                                           \
    template <int n>                                                                              \
    struct Name {};                                                                               \
    template <class A, int n>                                                                     \
    [[nodiscard]] constexpr Left<A, Name<n>> operator symbol(const A& a, Name<n>) noexcept {      \
        return {a};                                                                               \
    }                                                                                             \
    template <class A, int n, class B>                                                            \
    [[nodiscard]] constexpr auto operator symbol(Left<A, Name<n>> a, const B& b) {                \
        if constexpr (requires { static_cast<decltype(a.value symbol b)>(a.value neighbour b); }) \
            if (is<n>()) return static_cast<decltype(a.value symbol b)>(a.value neighbour b);     \
        return a.value symbol b;                                                                  \
    }

STRATA_MUTANT_OPERATOR(Less, <, <=)
STRATA_MUTANT_OPERATOR(LessEqual, <=, <)
STRATA_MUTANT_OPERATOR(Greater, >, >=)
STRATA_MUTANT_OPERATOR(GreaterEqual, >=, >)
STRATA_MUTANT_OPERATOR(Equal, ==, !=)
STRATA_MUTANT_OPERATOR(NotEqual, !=, ==)
STRATA_MUTANT_OPERATOR(Plus, +, -)
STRATA_MUTANT_OPERATOR(Minus, -, +)

#undef STRATA_MUTANT_OPERATOR

}  // namespace strata_mutants
