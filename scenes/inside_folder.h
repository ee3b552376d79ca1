// scenes/inside_folder.h - checks that a file named by another file is inside a folder: neither its name nor a link may
// lead out of it.
//
// Rule     An untrusted file may only name files in its own folder or below: a relative path without ".." that, after
//          all links are followed, is inside the folder. Used for uris of glTF files, arrays of packs, and the command
//          stored in an image.
// Tests    tests/scenes/inside_folder_test.cpp
#pragma once
#include <filesystem>
#include <string>

namespace strata::scenes {

struct InsideFolder {
    enum class PathStatus : std::uint8_t { inside, nothing, name_leaves, link_leaves };
    PathStatus status = PathStatus::nothing;
    std::filesystem::path path{};  // canonical; empty if the file is not inside
};

// True if the text of the name alone is not allowed: absolute, empty, with "..", or with a zero byte, at which the
// system would end it.
[[nodiscard]] bool leaves_by_name(const std::filesystem::path& name);

// `name` is a path as stored in the file, relative to `folder`.
[[nodiscard]] InsideFolder inside_folder(const std::filesystem::path& folder, const std::filesystem::path& name);

// The name as the file system has it, if only letter case differs; empty if there is no such file inside the folder.
[[nodiscard]] std::string name_in_other_case(const std::filesystem::path& folder, const std::filesystem::path& name);

// The same, but throws InputError{file, place} with one message per fault.
[[nodiscard]] std::string path_inside(const std::string& folder, const std::string& name, const std::string& file,
                                      const std::string& location);

}  // namespace strata::scenes
