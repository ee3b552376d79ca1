// scenes/files/atomic_file.cpp - the temporary file, and the table of those being written that a signal handler
// may read.
#include "scenes/files/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "scenes/files/system_error.h"

namespace strata::scenes {
namespace {

// A temporary file's path where a signal handler may read it: fixed storage and lock-free flags.
// A path is written while its slot is `claimed`, when the handler passes it over, and read only while `active`.
// 16 slots: a run writes a few files at a time.
struct Slot {
    std::atomic<int> state{empty};
    char path[4096];
    enum State : int { empty, claimed, active };
};
Slot slots[16];
static_assert(std::atomic<int>::is_always_lock_free);

// The path is entered before the file exists: an interrupt between the two finds nothing to unlink, which does
// no harm; the other order would leave a file behind.
int claim_slot(const std::string& path) {
    if (path.size() >= sizeof(Slot::path)) throw SystemError(path, "write", "the name is too long");
    for (int i = 0; i < static_cast<int>(std::size(slots)); ++i) {
        int expected = Slot::empty;
        if (!slots[i].state.compare_exchange_strong(expected, Slot::claimed)) continue;
        std::memcpy(slots[i].path, path.c_str(), path.size() + 1);
        slots[i].state = Slot::active;
        return i;
    }
    throw SystemError(path, "write", "too many files are being written at once");
}

// The process and a counter make the name its own; the same folder makes the later rename one step of one file
// system. The dot in front hides it from a glob.
std::string temporary_name(const std::string& path) {
    static std::atomic<unsigned> number{0};
    const std::filesystem::path target{path};
    const std::string name = fmt::format(".{}.{}-{}.tmp", target.filename().string(), ::getpid(), number++);
    return (target.parent_path() / name).string();
}

std::string reason(int error) { return std::generic_category().message(error); }

// Async-signal-safe calls alone: unlink and _exit. 128 + the signal is what a shell reports for a process that
// a signal ended.
extern "C" void on_interrupt(int signal) {
    remove_unfinished_files();
    ::_exit(128 + signal);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& path) : path_{path}, temporary_{temporary_name(path)} {
    // A rename onto a folder would fail only after all the work of rendering: the constructor says so at once.
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) throw SystemError(path, "write", reason(EISDIR));
    slot_ = claim_slot(temporary_);
    // O_EXCL: a file of that name is somebody else's. Mode 0666 leaves the permissions to the umask, as for any
    // new file.
    const int descriptor = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) file_ = ::fdopen(descriptor, "wb");
    if (file_ == nullptr) {
        const int error = errno;
        if (descriptor >= 0) ::close(descriptor);
        discard();
        throw SystemError(path, "write", reason(error));
    }
}

AtomicFile::~AtomicFile() { discard(); }

std::size_t AtomicFile::write(const void* bytes, std::size_t size) noexcept {
    errno = 0;
    const std::size_t written = std::fwrite(bytes, 1, size, file_);
    if (written != size) note_failure();
    return written;
}

bool AtomicFile::seek(std::int64_t position) noexcept {
    errno = 0;
    const bool done = ::fseeko(file_, position, SEEK_SET) == 0;
    if (!done) note_failure();
    return done;
}

std::int64_t AtomicFile::position() const noexcept { return ::ftello(file_); }

void AtomicFile::note_failure() noexcept {
    if (failure_ == 0) failure_ = errno != 0 ? errno : EIO;
}

void AtomicFile::commit() {
    errno = 0;
    if (std::fclose(file_) != 0) note_failure();  // the last buffer may be the one that does not fit
    file_ = nullptr;
    if (failure_ == 0 && ::rename(temporary_.c_str(), path_.c_str()) != 0) note_failure();
    if (failure_ != 0) throw SystemError(path_, "write", reason(failure_));  // the destructor removes what is there
    slots[slot_].state = Slot::empty;
    slot_ = -1;
}

void AtomicFile::discard() noexcept {
    if (file_ != nullptr) std::fclose(file_);
    file_ = nullptr;
    if (slot_ < 0) return;
    ::unlink(temporary_.c_str());
    slots[slot_].state = Slot::empty;
    slot_ = -1;
}

void write_file(const std::string& path, std::string_view bytes) {
    AtomicFile file{path};
    file.write(bytes.data(), bytes.size());
    file.commit();
}

void remove_unfinished_files() noexcept {
    for (const Slot& slot : slots) {
        if (slot.state == Slot::active) ::unlink(slot.path);
    }
}

void remove_unfinished_files_when_interrupted() noexcept {
    struct sigaction action {};
    action.sa_handler = on_interrupt;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
    }
    std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace strata::scenes
