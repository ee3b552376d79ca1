#include "scenes/read_files.h"

#include <sys/stat.h>

#include <atomic>
#include <mutex>
#include <set>
#include <utility>

#include "rasterizer/base/input_error.h"

namespace strata::scenes {
namespace {

std::atomic<bool> is_protecting{false};
std::mutex mutex;
std::set<std::pair<dev_t, ino_t>> read;  // used under `mutex`

}  // namespace

void protect_read_files() noexcept { is_protecting = true; }

void note_read_file(const std::string& path) {
    struct stat status {};
    if (!is_protecting || ::stat(path.c_str(), &status) != 0) return;
    const std::scoped_lock lock{mutex};
    read.emplace(status.st_dev, status.st_ino);
}

void check_not_read(const std::string& path) {
    struct stat status {};
    if (!is_protecting || ::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
    const std::scoped_lock lock{mutex};
    if (read.contains({status.st_dev, status.st_ino}))
        throw InputError(path, "is a file that this command reads: expected another name for its result");
}

}  // namespace strata::scenes
