// scenes/files/atomic_file.h - a file that appears under its name only when it is complete.
//
// Rule     Written beside its place under ".NAME.PROCESS-NUMBER.tmp", renamed by commit(). What was not committed is
//          removed: by the destructor, or by remove_unfinished_files() when the process is interrupted. A symbolic link
//          is replaced, not followed.
// Tests    tests/scenes/files/atomic_file_test.cpp
#pragma once
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace strata::scenes {

class AtomicFile {
  public:
    explicit AtomicFile(const std::string& path);  // SystemError if the folder takes no file
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    // Returns the number of bytes written: less than asked after a failure, which commit() reports. These functions
    // never throw, because image libraries call them.
    std::size_t write(const void* bytes, std::size_t size) noexcept;
    bool seek(std::int64_t position) noexcept;
    [[nodiscard]] std::int64_t position() const noexcept;
    [[nodiscard]] bool failed() const noexcept { return failure_ != 0; }

    // For a library that opens files by name only: it writes this one, commit() puts it in its place.
    [[nodiscard]] const std::string& temporary() const noexcept { return temporary_; }

    // Closes the file and gives it its name; call it once, last.
    void commit();  // SystemError if any write failed, or the rename does

  private:
    // note_failure() keeps the first errno; discard() closes and unlinks what was not committed.
    void note_failure() noexcept;
    void discard() noexcept;

    std::string path_, temporary_;
    std::FILE* file_ = nullptr;
    // Its entry in the table that a signal handler reads; -1 after commit().
    int slot_ = -1;
    int failure_ = 0;  // errno of the first failure
};

// The whole file at once.
void write_file(const std::string& path, std::string_view bytes);

// Unlinks every file that is being written. Async-signal-safe.
void remove_unfinished_files() noexcept;

// On SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE and SIGXCPU: remove_unfinished_files(), then _exit(128 + signal), which is
// 130 for SIGINT. A signal that the process was told to ignore (nohup) stays ignored. SIGXFSZ is ignored, so that a
// write beyond the limit of file sizes fails like one on a full disk.
void remove_unfinished_files_when_interrupted() noexcept;

}  // namespace strata::scenes
