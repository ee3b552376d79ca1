#include "scenes/read_files.h"

#include <sys/stat.h>

#include <atomic>
#include <filesystem>
#include <mutex>
#include <set>
#include <utility>

#include "rasterizer/base/input_error.h"

namespace strata::scenes {
namespace {

std::atomic<bool> is_protecting{false};
std::mutex mutex;
// Used under `mutex`. Folders have no unique inode: a folder may be removed, and another get its inode.
std::set<std::pair<dev_t, ino_t>> read;
std::set<std::filesystem::path> packs;

}  // namespace

void protect_read_files() noexcept { is_protecting = true; }

void note_read_file(const std::string& path) {
    struct stat status {};
    if (!is_protecting || ::stat(path.c_str(), &status) != 0) return;
    const std::scoped_lock lock{mutex};
    read.emplace(status.st_dev, status.st_ino);
}

void note_read_pack(const std::string& folder) {
    if (!is_protecting) return;
    std::error_code ignored;
    const std::scoped_lock lock{mutex};
    packs.insert(std::filesystem::weakly_canonical(folder, ignored));
}

void check_not_read(const std::string& path) {
    if (!is_protecting) return;
    const std::scoped_lock lock{mutex};
    struct stat status {};
    if (::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && read.contains({status.st_dev, status.st_ino}))
        throw InputError(path, "is a file that this command reads: expected another name for its result");
    if (packs.empty()) return;
    std::error_code ignored;
    for (auto folder = std::filesystem::weakly_canonical(path, ignored); folder.has_relative_path();
         folder = folder.parent_path())
        if (packs.contains(folder))
            throw InputError(path, "is in a pack that this command reads: expected a place outside of it");
}

}  // namespace strata::scenes
