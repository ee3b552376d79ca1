// scenes/files/text_file.cpp - reads a whole file. The checks come before the read, because a device or a pipe could
// deliver endless bytes.
#include "scenes/files/text_file.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>

#include "rasterizer/base/input_error.h"
#include "scenes/lfs_pointer.h"
#include "scenes/memory_limit.h"
#include "scenes/read_files.h"

namespace strata::scenes {

std::string read_standard_input() {
    constexpr std::size_t most = std::size_t{1} << 30, step = std::size_t{1} << 16;
    std::string text;
    while (text.size() <= most) {
        const std::size_t begin = text.size();
        check_file_memory("standard input", step);
        text.resize(begin + step);
        std::cin.read(text.data() + begin, static_cast<std::streamsize>(step));
        text.resize(begin + static_cast<std::size_t>(std::cin.gcount()));
        if (text.size() < begin + step) return text;
    }
    throw InputError("standard input", "size", "at most 1 GiB", "more bytes");
}

std::size_t size_of_file(const std::string& path, std::size_t max_bytes) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) throw InputError(path, "no such file");
    if (!std::filesystem::is_regular_file(status))
        throw InputError(path, std::filesystem::is_directory(status) ? "is a folder, not a file"
                                                                     : "is a device or a pipe, not a file");
    const auto size = std::filesystem::file_size(path, error);
    if (error) throw InputError(path, "cannot be read: " + error.message());
    // The limit is checked before memory is allocated.
    if (size > max_bytes)
        throw InputError(path, "size", "at most " + std::to_string(max_bytes) + " bytes",
                         std::to_string(size) + " bytes");
    return static_cast<std::size_t>(size);
}

std::string read_begin_of_file(const std::string& path, std::size_t bytes) {
    const std::size_t size = std::min(size_of_file(path, std::numeric_limits<std::size_t>::max()), bytes);
    check_file_memory(path, size);
    std::string text(size, '\0');
    std::ifstream file(path, std::ios::binary);
    // A file that shrank after its size was read is rejected, too: the read is short.
    if (!file || !file.read(text.data(), static_cast<std::streamsize>(text.size())))
        throw InputError(path, "cannot be read");
    note_read_file(path);
    if (is_lfs_pointer(text)) throw InputError(path, lfs_pointer_found);
    return text;
}

std::string read_text_file(const std::string& path, std::size_t max_bytes) {
    // The limit is checked before memory is allocated.
    return read_begin_of_file(path, size_of_file(path, max_bytes));
}

}  // namespace strata::scenes
