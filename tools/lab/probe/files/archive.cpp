#include "tools/lab/probe/files/archive.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "rasterizer/base/input_error.h"
#include "scenes/files/text_file.h"
#include "scenes/inside_folder.h"

namespace strata::probe {

namespace {

// The answers to a kit take a few MiB in total.
constexpr std::size_t largest_file = std::size_t{1} << 28;
constexpr std::size_t block = 512;

std::map<std::string, std::string> files_of_folder(const std::string& path) {
    std::map<std::string, std::string> files;
    const std::filesystem::path folder{path};
    std::size_t left = largest_file;  // in total, as for an archive
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_directory() && !entry.is_symlink()) continue;
        const std::string name = entry.path().lexically_relative(folder).generic_string();
        if (entry.is_symlink() || !entry.is_regular_file() ||
            scenes::inside_folder(folder, name).status != scenes::InsideFolder::PathStatus::inside)
            throw InputError(path, name, "a file inside this folder", entry.is_symlink() ? "a link" : "no file");
        files[name] = scenes::read_text_file(entry.path().string(), left);
        left -= files[name].size();
    }
    return files;
}

// A field of a header, up to its first zero byte.
std::string text_at(std::string_view header, std::size_t at, std::size_t length) {
    const std::string_view field = header.substr(at, length);
    return std::string{field.substr(0, field.find('\0'))};
}

std::size_t octal_at(std::string_view header, std::size_t at, std::size_t length) {
    std::size_t value = 0;
    for (const char c : header.substr(at, length))
        if (c >= '0' && c <= '7') value = value * 8 + static_cast<std::size_t>(c - '0');
    return value;
}

std::map<std::string, std::string> files_of_tar(std::string_view bytes, const std::string& path) {
    std::map<std::string, std::string> files;
    for (std::size_t at = 0; at + block <= bytes.size() && bytes[at] != '\0';) {
        const std::string_view header = bytes.substr(at, block);
        if (header.substr(257, 5) != "ustar")
            throw InputError(path, "byte " + std::to_string(at), "a header of a tar archive (ustar)", "another text");
        const std::size_t size = octal_at(header, 124, 12);
        if (size > bytes.size() - at - block)
            throw InputError(path, "byte " + std::to_string(at + 124), "a file that ends within the archive",
                             std::to_string(size) + " bytes");
        const std::string prefix = text_at(header, 345, 155), name = text_at(header, 0, 100);
        if (header[156] == '0' || header[156] == '\0')
            files[prefix.empty() ? name : prefix + '/' + name] = bytes.substr(at + block, size);
        at += block + (size + block - 1) / block * block;
    }
    return files;
}

// The part before the first slash, if it is the same in all names.
std::string shared_folder(const std::map<std::string, std::string>& files) {
    if (files.empty()) return {};
    const std::string& first = files.begin()->first;
    const std::string folder = first.substr(0, first.find('/') + 1);
    const bool is_shared = std::ranges::all_of(files, [&](const auto& f) { return f.first.starts_with(folder); });
    return is_shared ? folder : std::string{};
}

}  // namespace

std::map<std::string, std::string> read_files(const std::string& path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return files_of_folder(path);
    const std::string bytes = scenes::read_text_file(path, largest_file);
    std::map<std::string, std::string> files = files_of_tar(bytes, path);
    if (files.empty()) throw InputError(path, "byte 0", "a folder or a tar archive of answers", "no file in it");
    const std::string folder = shared_folder(files);
    if (folder.empty()) return files;
    std::map<std::string, std::string> inner;
    for (auto& [name, content] : files) inner[name.substr(folder.size())] = std::move(content);
    return inner;
}

}  // namespace strata::probe
