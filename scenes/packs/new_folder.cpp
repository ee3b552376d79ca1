// scenes/packs/new_folder.cpp - creates, fills and, unless kept, removes the folder of new_folder.h.
#include "scenes/packs/new_folder.h"

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/unfinished_files.h"

namespace strata::scenes {

void check_new_folder(const std::string& path) {
    std::error_code error;
    if (std::filesystem::exists(path, error) &&
        !(std::filesystem::is_directory(path, error) && std::filesystem::is_empty(path, error)))
        throw InputError(path, "is not empty; it has to be a new folder or an empty one");
}

NewFolder::NewFolder(const std::string& path) : path_{path} {
    check_new_folder(path);
    // The absolute path stays valid if the current folder changes.
    slot_ = enter_unfinished_folder(std::filesystem::absolute(path_).string());
    try {
        std::filesystem::create_directories(path_);
    } catch (...) {
        forget_unfinished_file(slot_);
        throw;
    }
}

NewFolder::~NewFolder() {
    if (keep_) return;
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    forget_unfinished_file(slot_);
}

void NewFolder::keep() noexcept {
    keep_ = true;
    forget_unfinished_file(slot_);
}

void NewFolder::write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    write_file(file.string(), bytes);
}

}  // namespace strata::scenes
