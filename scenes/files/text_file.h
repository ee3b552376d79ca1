// scenes/files/text_file.h - reads a whole small file into a string.
#pragma once
#include <cstddef>
#include <string>

namespace strata::scenes {

// read_text_file throws InputError if `path` is not a readable regular file, is larger than `max_bytes`, or is a Git
// LFS pointer. The default of 1 MiB is for texts written by hand: cameras, profiles. Bytes, including line ends, are
// unchanged.
[[nodiscard]] std::string read_standard_input();  // reads to the end, at most 1 GiB
[[nodiscard]] std::string read_text_file(const std::string& path, std::size_t max_bytes = std::size_t{1} << 20);
// The file's size, and its first `bytes` bytes (all of a shorter file). Errors as read_text_file.
[[nodiscard]] std::size_t size_of_file(const std::string& path, std::size_t max_bytes);
[[nodiscard]] std::string read_begin_of_file(const std::string& path, std::size_t bytes);

}  // namespace strata::scenes
