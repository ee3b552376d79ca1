// scenes/inside_folder.h - a file that another file names: it must lie in a folder, and no name or link may lead out of
// it.
//
// Rule     A file from someone else may name only what lies beside it or below: a relative path without "..", whose
//          links, all of them followed, end in the folder. Used for uris of glTF files, arrays of packs, and the
//          command that a picture keeps.
// Tests    tests/scenes/inside_folder_test.cpp
#pragma once
#include <filesystem>
#include <string>

namespace strata::scenes {

struct InsideFolder {
    enum class Found : std::uint8_t { inside, nothing, name_leaves, link_leaves };
    Found found = Found::nothing;
    std::filesystem::path path{};  // canonical; empty unless it is inside
};

// By its text alone: absolute, empty, with a step up, or with a zero byte, at which the system would end it.
[[nodiscard]] bool leaves_by_name(const std::filesystem::path& name);

// `name` is a path as the file has it, relative to `folder`.
[[nodiscard]] InsideFolder inside_folder(const std::filesystem::path& folder, const std::filesystem::path& name);

// The same for a reader that has one sentence for each fault. InputError{file, place}.
[[nodiscard]] std::string path_inside(const std::string& folder, const std::string& name, const std::string& file,
                                      const std::string& place);

}  // namespace strata::scenes
