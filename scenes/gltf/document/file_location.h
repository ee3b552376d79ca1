// scenes/gltf/document/file_location.h - a position in a glTF file, and the function that throws an error there.
#pragma once
#include <string>
#include <string_view>

#include "rasterizer/base/input_error.h"

namespace strata::scenes {

// `code` is the Khronos glTF validator's issue code for the same fault (its ISSUES.md), if it has one.
struct FileLocation {
    std::string file;
    std::string pointer;  // JSON pointer (RFC 6901), or "byte N" in a .glb

    [[noreturn]] void fail(std::string_view code, const std::string& expected, const std::string& found) const {
        throw InputError(file, pointer.empty() ? "/" : pointer, expected, found + " [" + std::string(code) + "]");
    }
    // `key` is inserted unchanged: the caller escapes a key from the file (RFC 6901).
    [[nodiscard]] FileLocation under(std::string_view key) const { return {file, pointer + "/" + std::string(key)}; }
    [[nodiscard]] FileLocation under(std::size_t index) const { return under(std::to_string(index)); }
};

// Makes text from a file printable on one line of a terminal: control characters become '?', and it is truncated after
// 160 bytes.
[[nodiscard]] inline std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text.substr(0, 160)) line += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    return text.size() > 160 ? line + "..." : line;
}
[[nodiscard]] inline std::string in_quotes(std::string_view text) {
    std::string line{"'"};
    line += one_line(text);
    line += '\'';
    return line;
}

}  // namespace strata::scenes
