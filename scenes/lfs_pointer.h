// scenes/lfs_pointer.h - detects the text that Git LFS stores in place of a file that has not been fetched: 130 bytes
// that a reader could take for data.
// Source   Git LFS Specification, "The Pointer": the first line is "version https://git-lfs.github.com/spec/v1"
// Tests    tests/scenes/files/lfs_pointer_test.cpp
#pragma once
#include <string_view>

namespace strata::scenes {

[[nodiscard]] constexpr bool is_lfs_pointer(std::string_view bytes) noexcept {
    return bytes.starts_with("version https://git-lfs.github.com/spec/");
}
// The `found` part of an error message.
inline constexpr const char* lfs_pointer_found = "a Git LFS pointer, run git lfs pull";

}  // namespace strata::scenes
