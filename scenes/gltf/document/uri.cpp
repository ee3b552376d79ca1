// scenes/gltf/document/uri.cpp - decodes data: uris and resolves relative ones to files (uri.h).
#include "scenes/gltf/document/uri.h"

#include <algorithm>
#include <cctype>
#include <fstream>

#include "scenes/inside_folder.h"
#include "scenes/lfs_pointer.h"
#include "scenes/memory_limit.h"
#include "scenes/read_files.h"

namespace strata::scenes {
namespace {

namespace fs = std::filesystem;

int base64_value(char c) {  // -1: not in the alphabet
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

// RFC 4648, 4: six bits per letter, with or without the padding. A single letter beyond whole groups of four cannot
// encode a byte.
std::vector<std::byte> decode_base64(std::string_view text, const FileLocation& location) {
    for (int i = 0; i < 2 && !text.empty() && text.back() == '='; ++i) text.remove_suffix(1);
    if (text.size() % 4 == 1)
        location.fail("INVALID_URI", "base64 text in groups of 4 characters",
                      std::to_string(text.size()) + " characters");
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        const int value = base64_value(c);
        if (value < 0) location.fail("INVALID_URI", "base64 characters", in_quotes(std::string_view(&c, 1)));
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> held & 0xff));
    }
    return bytes;
}

// RFC 2397. Parameters of the type, such as a charset, are ignored; "data:" is 5 bytes long.
Resource read_data_uri(std::string_view uri, const FileLocation& location) {
    const std::size_t comma = uri.find(',');
    if (comma == uri.npos) location.fail("INVALID_URI", "a comma before the data", in_quotes(uri));
    std::string_view head = uri.substr(5, comma - 5);
    constexpr std::string_view base64 = ";base64";
    if (!head.ends_with(base64)) location.fail("INVALID_URI", "base64 data", in_quotes(head));
    head.remove_suffix(base64.size());
    return {std::string(head.substr(0, head.find(';'))), decode_base64(uri.substr(comma + 1), location)};
}

// RFC 3986, 4.2: a colon before the first slash ends a scheme, even one of a single letter, which some systems treat as
// a drive.
bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find_first_of(":/");
    return colon != uri.npos && uri[colon] == ':';
}

int hex_value(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    const char lower = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string percent_decoded(std::string_view uri, const FileLocation& location) {
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            path += uri[i];
            continue;
        }
        const bool is_whole = i + 2 < uri.size() && hex_value(uri[i + 1]) >= 0 && hex_value(uri[i + 2]) >= 0;
        if (!is_whole) location.fail("INVALID_URI", "two hexadecimal digits after %", in_quotes(uri));
        path += static_cast<char>(hex_value(uri[i + 1]) * 16 + hex_value(uri[i + 2]));
        i += 2;
    }
    return path;
}

// Converts to a path whose text alone guarantees that it does not leave its folder.
fs::path relative_path(std::string_view uri, const FileLocation& location) {
    const std::string inside = "a relative uri inside the scene's folder";
    if (has_scheme(uri) || uri.starts_with('/')) location.fail("NON_RELATIVE_URI", inside, in_quotes(uri));
    if (uri.empty() || uri.find_first_of("?#") != uri.npos) location.fail("INVALID_URI", inside, in_quotes(uri));
    // The checks below use the decoded text: "%2e%2e" must not pass as a name.
    const std::string decoded = percent_decoded(uri, location);
    if (decoded.find('\\') != decoded.npos)
        location.fail("INVALID_URI", "a uri with / between folders and file, as in every glTF file",
                      in_quotes(uri) + ", which has a backslash");
    const auto is_forbidden = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; };
    if (std::any_of(decoded.begin(), decoded.end(), is_forbidden)) location.fail("INVALID_URI", inside, in_quotes(uri));
    const fs::path path{decoded};
    if (leaves_by_name(path)) location.fail("NON_RELATIVE_URI", inside, in_quotes(uri));
    return path;
}

// A uri without a file, and the file whose name differs from it in letter case alone: other systems find that one.
std::string missing(std::string_view uri, const fs::path& folder, const fs::path& relative) {
    const std::string other = name_in_other_case(folder, relative);
    return in_quotes(uri) + (other.empty() ? "" : ", which is " + in_quotes(other) + " there: letter case differs");
}

}  // namespace

std::vector<std::byte> read_file(const fs::path& path, const FileLocation& location) {
    std::error_code error;
    if (!fs::is_regular_file(path, error))
        location.fail(
            "FILE_NOT_FOUND", "a file",
            fs::is_directory(path, error) ? "a folder" : in_quotes(path.filename().string()) + ", which is no file");
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || size > max_file_bytes)
        location.fail("IO_ERROR", "a file of less than 4 GiB",
                      error ? error.message() : std::to_string(size) + " bytes");
    check_file_memory(path.string(), size);
    std::vector<std::byte> bytes(size);
    std::ifstream stream(path, std::ios::binary);
    if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        location.fail("IO_ERROR", "a readable file", "a file that cannot be read");
    note_read_file(path);
    if (is_lfs_pointer({reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
        location.fail("IO_ERROR", "the file itself",
                      in_quotes(path.filename().string()) + ", which is " + lfs_pointer_found);
    return bytes;
}

Resource read_uri(std::string_view uri, const std::optional<fs::path>& folder, const FileLocation& location) {
    if (uri.starts_with("data:")) return read_data_uri(uri, location);
    const fs::path relative = relative_path(uri, location);
    if (!folder)
        location.fail("FILE_NOT_FOUND", "a data: uri, because a scene in memory has no folder", in_quotes(uri));
    const InsideFolder found = inside_folder(*folder, relative);
    if (found.status == InsideFolder::PathStatus::nothing)
        location.fail("FILE_NOT_FOUND", "a file in the scene's folder", missing(uri, *folder, relative));
    if (found.status != InsideFolder::PathStatus::inside)
        location.fail("NON_RELATIVE_URI", "a file in the scene's folder", "a link to a file outside of it");
    return {"", read_file(found.path, location)};
}

}  // namespace strata::scenes
