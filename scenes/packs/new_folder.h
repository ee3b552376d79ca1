// scenes/packs/new_folder.h - a folder that is kept only if all of its files were written; a signal that ends the
// process removes it, too.
//
// Tests    tests/tools/lab/probe/pack_test.cpp
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace strata::scenes {

// A folder into which this process alone writes: the file .strata.lock in it says so to other processes, and is removed
// at the end or by a signal that ends the process.
class FolderClaim {
  public:
    // Creates the folder if it is missing. InputError if another process holds it.
    explicit FolderClaim(const std::filesystem::path& folder);
    FolderClaim(const FolderClaim&) = delete;
    FolderClaim& operator=(const FolderClaim&) = delete;
    ~FolderClaim() { give_up(); }
    void give_up() noexcept;
    static constexpr const char* file_name = ".strata.lock";

  private:
    std::filesystem::path file_;
    int slot_ = -1;        // in the table of unfinished files
    bool is_new_ = false;  // the folder was made here: it is removed with the claim if nothing was written into it
};

// InputError if the path exists and is not an empty folder. Call it before the work whose result is written there.
void check_new_folder(const std::string& path);

class NewFolder {
  public:
    // InputError under the same conditions.
    explicit NewFolder(const std::string& path);
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    // Removes the folder with its contents unless it was marked to be kept.
    ~NewFolder();

    // `name` is a path within the folder, with slashes.
    void write(const std::string& name, std::string_view bytes) const;
    void keep() noexcept;

  private:
    std::filesystem::path path_;
    FolderClaim claim_;  // of several processes that begin at once, one writes
    int slot_ = 0;       // in the table of unfinished files
    bool keep_ = false;
};

}  // namespace strata::scenes
