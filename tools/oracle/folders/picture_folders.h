// tools/oracle/folders/picture_folders.h - pairs the pictures of two folders by their names.
//
// Rule     Without patterns a picture's name is its path in the folder, with its ending, and files of other endings
//          than those of pictures are left out. With patterns the name is the part that {name} stands for, and every
//          file that the pattern fits is a picture. A path that a pattern of further baselines fits is a further
//          baseline of that name, and nothing else. Where both folders are one, no candidate is a baseline. Hidden
//          files, hidden folders and linked folders are left out, and so is one of the two folders where it lies in
//          the other. Pictures are sorted by the bytes of their names.
// Tests    tests/tools/oracle/folders/picture_folders_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/folders/name_pattern.h"

namespace strata::oracle {

struct PictureNames {
    std::optional<NamePattern> reference{}, candidate{};
    std::vector<NamePattern> baselines{};
};

// The pictures of one name. Paths are those in the folders.
struct NamedPictures {
    std::string name{};
    std::vector<std::string> references{};  // the one that has the name itself first; empty: there is none
    std::string candidate{};                // empty: there is none
};

struct PairedFolders {
    std::vector<NamedPictures> pictures{};
    std::size_t left_out = 0;  // files in both folders that are no pictures
};

// InputError for a folder that cannot be read, for two pictures of one name in a folder, and if both have no picture.
[[nodiscard]] PairedFolders pair_folders(const std::string& reference, const std::string& candidate,
                                         const PictureNames& names);

}  // namespace strata::oracle
