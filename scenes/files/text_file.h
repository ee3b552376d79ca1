// scenes/files/text_file.h - a whole small file as a string.
#pragma once
#include <cstddef>
#include <string>

namespace strata::scenes {

// InputError if `path` is not a readable regular file, holds more than `max_bytes`, or is a Git LFS pointer. The
// default of 1 MiB is for texts that people write: cameras, profiles. Bytes come back as they are, line ends included.
[[nodiscard]] std::string read_standard_input();  // at most 1 GiB, to its end
[[nodiscard]] std::string read_text_file(const std::string& path, std::size_t max_bytes = std::size_t{1} << 20);
// Its size, with the same errors, and its first bytes: all of a shorter file.
[[nodiscard]] std::size_t size_of_file(const std::string& path, std::size_t max_bytes);
[[nodiscard]] std::string read_begin_of_file(const std::string& path, std::size_t bytes);

}  // namespace strata::scenes
