// scenes/files/atomic_file.cpp - writes a temporary file and renames it, or copies it to a stream (atomic_file.h).
#include "scenes/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "scenes/files/system_error.h"
#include "scenes/files/unfinished_files.h"
#include "scenes/read_files.h"

namespace strata::scenes {
namespace {

constexpr std::size_t buffer_bytes = 65536;
std::atomic<void (*)(const std::string& path)> on_file_written{nullptr};
constexpr std::string_view temporary_ending = ".tmp";

// The process id and a counter make the name unique; the same folder makes the rename atomic, within one file system.
// The leading dot hides it from globs. Linux's file systems allow names of at most 255 bytes.
std::string temporary_name(const std::string& path, bool is_stream) {
    static std::atomic<unsigned> number{0};
    const std::filesystem::path target{path};
    const std::string own = fmt::format(".{}-{}{}", ::getpid(), number++, temporary_ending);
    const std::string name = "." + target.filename().string().substr(0, 255 - 1 - own.size()) + own;
    // The folder of a pipe or a device may not allow files.
    return ((is_stream ? std::filesystem::temp_directory_path() : target.parent_path()) / name).string();
}

std::string reason(int error) { return std::generic_category().message(error); }

// Writes all of it, however little the system takes per call. False with errno after a failure.
bool write_all(int descriptor, const std::byte* bytes, std::size_t size) noexcept {
    while (size > 0) {
        const ssize_t written = ::write(descriptor, bytes, size);
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

// True if the path leads to a pipe or a device, which a rename must not replace. A folder, or a name that no folder
// allows, is an error here: the rename would report it only after all the rendering.
bool leads_to_stream(const std::string& path) {
    if (is_standard_output(path)) return true;
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) {
        if (S_ISDIR(status.st_mode)) throw SystemError(path, "write", reason(EISDIR));
        return !S_ISREG(status.st_mode);
    }
    if (errno == ENAMETOOLONG) throw SystemError(path, "write", reason(errno));
    return false;
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path)
    : path_{path}, is_stream_{leads_to_stream(path)}, buffer_{std::make_unique<std::byte[]>(buffer_bytes)} {
    check_not_read(path);
    open_temporary();
    if (descriptor_ >= 0) return;
    const int error = errno;
    discard();
    throw SystemError(path, "write", reason(error));
}

// O_EXCL: an existing file of that name belongs to another process. A killed process of the same id may have left one
// (the first process of a container always has id 1): then the next name is tried. Mode 0666 leaves the permissions to
// the umask.
void AtomicFile::open_temporary() {
    constexpr int most_tries = 10000;
    for (int i = 0; i < most_tries; ++i) {
        temporary_ = temporary_name(path_, is_stream_);
        // Entered before the file exists: an interrupt between the two finds nothing to unlink; in the other order a
        // file could remain.
        slot_ = enter_unfinished_file(temporary_);
        descriptor_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) return;
        // Not discard(): the file belongs to another process.
        const int error = errno;
        forget_unfinished_file(slot_);
        slot_ = -1;
        errno = error;
        if (error != EEXIST) return;
    }
}

AtomicFile::~AtomicFile() { discard(); }

bool AtomicFile::flush() noexcept {
    if (failure_ != 0) return false;
    errno = 0;
    if (!write_all(descriptor_, buffer_.get(), used_)) return note_failure(), false;
    begin_ += static_cast<std::int64_t>(used_);
    used_ = 0;
    return true;
}

std::size_t AtomicFile::write(const void* bytes, std::size_t size) noexcept {
    const auto* from = static_cast<const std::byte*>(bytes);
    for (std::size_t left = size; left > 0;) {
        if (used_ == buffer_bytes && !flush()) return size - left;
        const std::size_t part = std::min(left, buffer_bytes - used_);
        std::memcpy(buffer_.get() + used_, from, part);
        from += part;
        used_ += part;
        left -= part;
    }
    return size;
}

bool AtomicFile::seek(std::int64_t position) noexcept {
    if (!flush()) return false;
    errno = 0;
    if (::lseek(descriptor_, position, SEEK_SET) != position) return note_failure(), false;
    begin_ = position;
    return true;
}

void AtomicFile::note_failure() noexcept {
    if (failure_ == 0) failure_ = errno != 0 ? errno : EIO;
}

// The order ensures safety: the name must not reach the disk before the file's bytes.
void AtomicFile::rename_to_target() {
    errno = 0;
    if (::fsync(descriptor_) != 0 && errno != EINVAL) return note_failure();
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) return note_failure();
    if (::rename(temporary_.c_str(), path_.c_str()) != 0) return note_failure();
    forget_unfinished_file(slot_);
    slot_ = -1;
    errno = sync_folder(std::filesystem::path(path_).parent_path().string());
    if (errno != 0) note_failure();
}

void AtomicFile::send() noexcept {
    // Standard output may be a file that is open at some offset, which only its own descriptor has.
    const int stream = is_standard_output(path_) ? ::dup(STDOUT_FILENO) : ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (stream < 0) return note_failure();
    bool done = ::lseek(descriptor_, 0, SEEK_SET) == 0;
    while (done) {
        const ssize_t count = ::read(descriptor_, buffer_.get(), buffer_bytes);
        done = count >= 0 && write_all(stream, buffer_.get(), static_cast<std::size_t>(count));
        if (count <= 0) break;
    }
    if (!done) note_failure();
    if (::close(stream) != 0) note_failure();
    discard();
}

void AtomicFile::commit() {
    if (flush()) is_stream_ ? send() : rename_to_target();
    if (failure_ != 0) throw SystemError(path_, "write", reason(failure_));  // the destructor removes the file
    if (const auto on_written = on_file_written.load()) on_written(path_);
}

void AtomicFile::discard() noexcept {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
    if (slot_ < 0) return;
    ::unlink(temporary_.c_str());
    forget_unfinished_file(slot_);
    slot_ = -1;
}

void report_written_files(void (*on_written)(const std::string& path)) noexcept { on_file_written = on_written; }

bool is_standard_output(std::string_view path) noexcept {
    return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

void write_file(const std::string& path, std::string_view bytes) {
    AtomicFile file{path};
    file.write(bytes.data(), bytes.size());
    file.commit();
}

int sync_folder(const std::string& folder) noexcept {
    const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // A folder may be writable but not readable; then its entries reach the disk when the system writes them.
    if (descriptor < 0) return errno == EACCES ? 0 : errno;
    const int error = ::fsync(descriptor) == 0 ? 0 : errno;
    ::close(descriptor);
    return error == EINVAL || error == ENOTSUP ? 0 : error;
}

std::string target_of_temporary(std::string_view name) {
    if (!name.starts_with('.') || !name.ends_with(temporary_ending)) return "";
    name.remove_prefix(1);
    name.remove_suffix(temporary_ending.size());
    const std::size_t dot = name.rfind('.'), dash = name.rfind('-');
    if (dot == name.npos || dot == 0 || dash == name.npos || dash < dot) return "";
    const auto is_number = [](std::string_view digits) {
        return !digits.empty() && digits.find_first_not_of("0123456789") == digits.npos;
    };
    if (!is_number(name.substr(dot + 1, dash - dot - 1)) || !is_number(name.substr(dash + 1))) return "";
    return std::string(name.substr(0, dot));
}

}  // namespace strata::scenes
