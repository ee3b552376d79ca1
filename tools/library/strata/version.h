// strata/version.h - the version of the library with which a program is compiled. CHANGELOG.md lists the changes.
//
// Rule     Semantic versions. Before 1.0 a minor version may change the interface: the names of the library are in an
//          inline namespace of their minor version, so that objects compiled with two versions cannot be linked
//          together by mistake. Result bits change only with a minor version, and CHANGELOG.md lists these changes.
#pragma once
#include <string_view>

namespace strata {

inline constexpr int version_major = 0, version_minor = 1, version_patch = 0;

inline namespace v0_1 {

// The version of the library with which the program is linked, such as "0.1.0".
[[nodiscard]] std::string_view version() noexcept;

}  // namespace v0_1
}  // namespace strata
