// strata/version.h - which version of the library a program is compiled with. CHANGELOG.md says what differs.
//
// Rule     Semantic versions. Before 1.0 a minor version may change what programs see: names of the library stand in
//          the inline namespace of their minor version, so that objects compiled with two of them do not link as if
//          they were one. A result bit changes with a minor version alone, and CHANGELOG.md says which.
#pragma once
#include <string_view>

namespace strata {

inline constexpr int version_major = 0, version_minor = 1, version_patch = 0;

inline namespace v0_1 {

// The version of the library that the program is linked with: "0.1.0".
[[nodiscard]] std::string_view version() noexcept;

}  // namespace v0_1
}  // namespace strata
