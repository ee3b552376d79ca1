// tools/oracle/pack/new_folder.h - a folder that is written as a whole: it goes again unless all of it was written.
#pragma once
#include <filesystem>
#include <string>

#include "rasterizer/base/input_error.h"

namespace strata::oracle {

class NewFolder {
  public:
    // InputError unless `path` is not there yet or is an empty folder.
    explicit NewFolder(const std::string& path) : path_{path} {
        std::error_code error;
        if (std::filesystem::exists(path_, error) && !std::filesystem::is_empty(path_, error))
            throw InputError(path, "folder", "one that does not exist or is empty", "something");
        std::filesystem::create_directories(path_);
    }
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;
    ~NewFolder() {
        std::error_code ignored;
        if (!keep_) std::filesystem::remove_all(path_, ignored);
    }
    void keep() noexcept { keep_ = true; }

  private:
    std::filesystem::path path_;
    bool keep_ = false;
};

}  // namespace strata::oracle
