// scenes/packs/new_folder.h - a folder of files that is kept only if all of them were written; a signal that ends the
// process removes it, too.
//
// Tests    tests/tools/probe/pack_test.cpp
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace strata::scenes {

// InputError if there is something at the path that is no empty folder: before the work whose result goes there.
void check_new_folder(const std::string& path);

class NewFolder {
  public:
    // InputError as check_new_folder.
    explicit NewFolder(const std::string& path);
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    // Removes the folder with everything in it unless it is to be kept.
    ~NewFolder();

    // `name` is a path within the folder, with slashes.
    void write(const std::string& name, std::string_view bytes) const;
    void keep() noexcept;

  private:
    std::filesystem::path path_;
    int slot_ = 0;  // in the table of unfinished files
    bool keep_ = false;
};

}  // namespace strata::scenes
