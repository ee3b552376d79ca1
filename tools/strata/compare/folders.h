// tools/strata/compare/folders.h - compare on two folders of pictures: its options, text, page and other outputs.
//
// Rule     The page shows small pictures of the failed cases, in the order of names, until they take 4 million
//          characters or 100 cases are shown; it says how many are left out. The table has up to 5,000 cases.
// Tests    tests/tools/strata/compare/compare_folders_test.cpp
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "tools/oracle/folders/compare_folders.h"

namespace strata::tools {

// Adds --names and --baselines.
void add_folder_options(CLI::App& app, oracle::PictureNames& names);
// False for any path that cannot be looked up.
[[nodiscard]] bool is_folder(const std::string& path);
// True if both are folders. InputError if only one of two pictures is a folder.
[[nodiscard]] bool are_folders(const std::string& reference, const std::string& candidate);

struct FolderOutputs {
    std::string junit{}, report{};
    bool json = false;
};

// Prints the result and writes the files. Returns 0 if every case is accepted, otherwise 1.
[[nodiscard]] int compare_two_folders(oracle::FolderQuestion question, const FolderOutputs& outputs);

}  // namespace strata::tools
