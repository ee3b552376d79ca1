#include "tools/lab/sweep/lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "rasterizer/base/input_error.h"
#include "scenes/files/system_error.h"
#include "scenes/files/unfinished_files.h"
#include "tools/strata/messages.h"

namespace strata::tools {

namespace {

std::string this_run() {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    return fmt::format("process {} on {}", ::getpid(), host);
}

std::string holder_of(int descriptor) {
    char text[512];
    const ssize_t size = ::pread(descriptor, text, sizeof text, 0);
    return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "another run";
}

// The previous run may have removed the file between open() and flock(): then its name is free, or belongs to another
// file.
bool is_file_of(int descriptor, const std::string& path) {
    struct stat opened {
    }, named{};
    return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
           opened.st_dev == named.st_dev;
}

}  // namespace

Lock::Lock(const std::string& journal) {
    const std::filesystem::path file{journal};
    path_ = (file.parent_path() / ("." + file.filename().string() + ".lock")).string();
    while (true) {
        descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor_ < 0) throw SystemError(path_, "write", std::strerror(errno));
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
            const int error = errno;
            const std::string holder = holder_of(descriptor_);
            if (error != EWOULDBLOCK) {
                say_warning(path_ + ": cannot lock: " + std::strerror(error));
                return;
            }
            ::close(descriptor_);
            throw InputError(journal, "lock", "a journal that no other run writes to", holder);
        }
        if (is_file_of(descriptor_, path_)) break;
        ::close(descriptor_);
    }
    slot_ = scenes::enter_unfinished_file(path_);
    const std::string text = this_run();
    // The text is informational: the lock is valid without it.
    if (::ftruncate(descriptor_, 0) != 0 || ::pwrite(descriptor_, text.data(), text.size(), 0) < 0) return;
}

// The file is removed before the lock is released, so that no process locks a file that is about to lose its name
// without detecting it.
Lock::~Lock() {
    if (slot_ >= 0) {
        ::unlink(path_.c_str());
        scenes::forget_unfinished_file(slot_);
    }
    ::close(descriptor_);
}

}  // namespace strata::tools
