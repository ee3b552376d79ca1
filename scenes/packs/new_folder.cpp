// scenes/packs/new_folder.cpp - creates, fills and, unless kept, removes the folder of new_folder.h.
#include "scenes/packs/new_folder.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/system_error.h"
#include "scenes/files/unfinished_files.h"
#include "scenes/read_files.h"

namespace strata::scenes {

namespace {

constexpr const char* not_empty = "is not empty: expected a new or an empty folder";

}  // namespace

FolderClaim::FolderClaim(const std::filesystem::path& folder) {
    check_not_read(folder.string());
    is_new_ = std::filesystem::create_directories(folder);
    // The absolute path stays valid if the current folder changes.
    file_ = std::filesystem::absolute(folder) / file_name;
    const int descriptor = ::open(file_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0 && errno == EEXIST)
        throw InputError(folder.string(), "is being written by another run; if there is none, remove its file " +
                                              std::string(file_name));
    if (descriptor < 0)
        throw SystemError(folder.string(), "write into the folder", std::generic_category().message(errno));
    ::close(descriptor);
    try {
        slot_ = enter_unfinished_file(file_.string());
    } catch (...) {
        give_up();
        throw;
    }
}

void FolderClaim::give_up() noexcept {
    if (file_.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);
    if (is_new_) std::filesystem::remove(file_.parent_path(), ignored);  // only if it is still empty
    if (slot_ >= 0) forget_unfinished_file(slot_);
    file_.clear();
}

void check_new_folder(const std::string& path) {
    check_not_read(path);
    std::error_code error;
    if (std::filesystem::exists(path, error) &&
        !(std::filesystem::is_directory(path, error) && std::filesystem::is_empty(path, error)))
        throw InputError(path, not_empty);
}

namespace {

const std::string& checked(const std::string& path) {
    check_new_folder(path);
    return path;
}

}  // namespace

NewFolder::NewFolder(const std::string& path) : path_{path}, claim_{checked(path)} {
    // Another process may have finished between the check and the claim.
    for (const auto& entry : std::filesystem::directory_iterator(path_))
        if (entry.path().filename() != FolderClaim::file_name) throw InputError(path, not_empty);
    slot_ = enter_unfinished_folder(std::filesystem::absolute(path_).string());
}

NewFolder::~NewFolder() {
    if (keep_) return;
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
    forget_unfinished_file(slot_);
}

void NewFolder::keep() noexcept {
    keep_ = true;
    claim_.give_up();
    forget_unfinished_file(slot_);
}

void NewFolder::write(const std::string& name, std::string_view bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    write_file(file.string(), bytes);
}

}  // namespace strata::scenes
