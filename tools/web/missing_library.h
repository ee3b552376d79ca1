// tools/web/missing_library.h - the parts of C++20 that this project uses and libc++ 13, the library of Debian's
// Emscripten, lacks. Only the browser's build includes it, before every source.
//
// Rule     Each name has the meaning of the standard, for ranges that are containers, arrays or spans. To be removed
//          when libc++ has all of them.
#pragma once
#ifdef __cplusplus
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <version>

#ifndef __cpp_lib_bit_cast
namespace std {

template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> && is_trivially_copyable_v<From>)
    [[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

}  // namespace std
#endif

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
namespace std {

// Of the characters of decimal numbers strtod reads as many as from_chars, which takes no leading plus.
template <class Real>
inline from_chars_result strata_real_from_chars(const char* first, const char* last, Real& value) {
    const auto is_foreign = [](char c) { return string_view{"0123456789.eE+-"}.find(c) == string_view::npos; };
    const string text(first, find_if(first, last, is_foreign));
    char* past = nullptr;
    const Real read = is_same_v<Real, float> ? static_cast<Real>(strtof(text.c_str(), &past))
                                             : static_cast<Real>(strtod(text.c_str(), &past));
    const char* const end = first + (past - text.c_str());
    if (end == first || *first == '+') return {first, errc::invalid_argument};
    const string_view used(first, static_cast<size_t>(end - first));
    const bool is_lost = read == 0 && used.find_first_of("123456789") < used.find_first_of("eE");
    if (isinf(read) || is_lost) return {end, errc::result_out_of_range};
    value = read;
    return {end, errc{}};
}
inline from_chars_result from_chars(const char* first, const char* last, float& value) {
    return strata_real_from_chars(first, last, value);
}
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
    return strata_real_from_chars(first, last, value);
}

}  // namespace std
#endif

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 15000
namespace std::ranges {

struct strata_as_is {
    template <class T>
    constexpr T&& operator()(T&& value) const noexcept {
        return std::forward<T>(value);
    }
};
struct strata_less {
    template <class T, class U>
    constexpr bool operator()(const T& a, const U& b) const {
        return a < b;
    }
};

template <class R, class Value, class Of = strata_as_is>
constexpr auto find(R&& r, const Value& value, Of of = {}) {
    return std::find_if(std::begin(r), std::end(r), [&](auto&& e) { return std::invoke(of, e) == value; });
}
template <class R, class Holds>
constexpr auto find_if(R&& r, Holds holds) {
    return std::find_if(std::begin(r), std::end(r), holds);
}
template <class R, class Holds>
constexpr auto adjacent_find(R&& r, Holds holds) {
    return std::adjacent_find(std::begin(r), std::end(r), holds);
}
template <class R, class Holds>
constexpr bool all_of(R&& r, Holds holds) {
    return std::all_of(std::begin(r), std::end(r), [&](auto&& e) { return std::invoke(holds, e); });
}
template <class R, class Holds>
constexpr bool any_of(R&& r, Holds holds) {
    return std::any_of(std::begin(r), std::end(r), [&](auto&& e) { return std::invoke(holds, e); });
}
template <class R, class Holds>
constexpr bool none_of(R&& r, Holds holds) {
    return !ranges::any_of(r, holds);
}
template <class R, class Holds>
constexpr auto count_if(R&& r, Holds holds) {
    return std::count_if(std::begin(r), std::end(r), [&](auto&& e) { return std::invoke(holds, e); });
}
template <class R, class Value>
constexpr void fill(R&& r, const Value& value) {
    std::fill(std::begin(r), std::end(r), value);
}
template <class R, class Out>
constexpr void copy(R&& r, Out out) {
    std::copy(std::begin(r), std::end(r), out);
}
template <class R, class Out>
constexpr void move(R&& r, Out out) {
    std::move(std::begin(r), std::end(r), out);
}
template <class R, class Out, class Of>
constexpr void transform(R&& r, Out out, Of of) {
    std::transform(std::begin(r), std::end(r), out, of);
}
template <class R, class Call>
constexpr void for_each(R&& r, Call call) {
    for (auto&& e : r) std::invoke(call, e);
}
template <class R, class Value>
constexpr void replace(R&& r, const Value& from, const Value& to) {
    std::replace(std::begin(r), std::end(r), from, to);
}
template <class A, class B, class Same = std::equal_to<>, class OfA = strata_as_is, class OfB = strata_as_is>
constexpr bool equal(A&& a, B&& b, Same same = {}, OfA of_a = {}, OfB of_b = {}) {
    return std::equal(std::begin(a), std::end(a), std::begin(b), std::end(b),
                      [&](auto&& x, auto&& y) { return same(std::invoke(of_a, x), std::invoke(of_b, y)); });
}
template <class R>
constexpr void reverse(R&& r) {
    std::reverse(std::begin(r), std::end(r));
}
template <class R, class Less = strata_less, class Of = strata_as_is>
constexpr void sort(R&& r, Less less = {}, Of of = {}) {
    std::sort(std::begin(r), std::end(r),
              [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class Less = strata_less, class Of = strata_as_is>
constexpr void stable_sort(R&& r, Less less = {}, Of of = {}) {
    std::stable_sort(std::begin(r), std::end(r),
                     [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class At, class Less = strata_less, class Of = strata_as_is>
constexpr void nth_element(R&& r, At at, Less less = {}, Of of = {}) {
    std::nth_element(std::begin(r), at, std::end(r),
                     [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class Less = strata_less, class Of = strata_as_is>
constexpr bool is_sorted(R&& r, Less less = {}, Of of = {}) {
    return std::is_sorted(std::begin(r), std::end(r),
                          [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class Value, class Less = strata_less, class Of = strata_as_is>
constexpr auto lower_bound(R&& r, const Value& value, Less less = {}, Of of = {}) {
    return std::lower_bound(std::begin(r), std::end(r), value,
                            [&](auto&& e, const Value& v) { return less(std::invoke(of, e), v); });
}
template <class R, class Value, class Less = strata_less, class Of = strata_as_is>
constexpr auto upper_bound(R&& r, const Value& value, Less less = {}, Of of = {}) {
    return std::upper_bound(std::begin(r), std::end(r), value,
                            [&](const Value& v, auto&& e) { return less(v, std::invoke(of, e)); });
}
template <class R, class Less = strata_less, class Of = strata_as_is>
constexpr auto max_element(R&& r, Less less = {}, Of of = {}) {
    return std::max_element(std::begin(r), std::end(r),
                            [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R, class Less = strata_less, class Of = strata_as_is>
constexpr auto min_element(R&& r, Less less = {}, Of of = {}) {
    return std::min_element(std::begin(r), std::end(r),
                            [&](auto&& a, auto&& b) { return less(std::invoke(of, a), std::invoke(of, b)); });
}
template <class R>
constexpr auto max(R&& r) {
    return *ranges::max_element(r);
}
template <class R, class S, class Same = std::equal_to<>>
constexpr bool equal(R&& r, S&& s, Same same = {}) {
    return std::equal(std::begin(r), std::end(r), std::begin(s), std::end(s), same);
}

}  // namespace std::ranges
#endif
#endif
