// scenes/files/atomic_file.h - a file that appears under its name only when it is complete.
//
// Rule     The file is written in its target folder under ".NAME.PROCESS-NUMBER.tmp", where a long NAME is shortened so
//          that the whole has 255 bytes. commit() writes the bytes to disk (fsync), renames the file, and writes the
//          new name to disk (fsync of the folder). A file that was not committed is removed: by the destructor, or by
//          unfinished_files.h when the process is interrupted. A symbolic link is replaced, not followed, unless it
//          leads to a pipe or a device: commit() writes the finished bytes to these. The path "-" is the process's
//          standard output of any kind.
// Tests    tests/scenes/files/atomic_file_test.cpp
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace strata::scenes {

class AtomicFile {
  public:
    // SystemError if no file can be created in the folder; InputError if the file is protected (read_files.h).
    explicit AtomicFile(const std::string& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    // Returns the number of bytes written: less than `size` after a failure, which commit() reports. These functions
    // never throw, because image libraries call them.
    std::size_t write(const void* bytes, std::size_t size) noexcept;
    bool seek(std::int64_t position) noexcept;
    [[nodiscard]] std::int64_t position() const noexcept { return begin_ + static_cast<std::int64_t>(used_); }
    [[nodiscard]] bool failed() const noexcept { return failure_ != 0; }

    // For a library that opens files by name: it writes this file, and commit() renames it.
    [[nodiscard]] const std::string& temporary() const noexcept { return temporary_; }

    // Closes the file and renames it; call it once, last.
    void commit();  // SystemError if a write or the rename failed

  private:
    void open_temporary();
    bool flush() noexcept;    // writes the buffer to the file
    void rename_to_target();  // renames the temporary file
    void send() noexcept;     // copies the temporary file to a pipe or a device
    // note_failure() keeps the first errno; discard() closes and unlinks a file that was not committed.
    void note_failure() noexcept;
    void discard() noexcept;

    std::string path_, temporary_;
    bool is_stream_ = false;  // the path names a pipe or a device
    int descriptor_ = -1;
    // The buffered bytes at file offset `begin_`, not written yet.
    std::unique_ptr<std::byte[]> buffer_;
    std::size_t used_ = 0;
    std::int64_t begin_ = 0;
    // This file's slot in the table of unfinished files; -1 after commit().
    int slot_ = -1;
    int failure_ = 0;  // errno of the first failure
};

// From now on `on_written` is called for every committed file with its path, on the thread that wrote the file.
void report_written_files(void (*on_written)(const std::string& path)) noexcept;

// True for "-" and for the names by which Linux calls standard output.
[[nodiscard]] bool is_standard_output(std::string_view path) noexcept;

// Writes a whole file at once.
void write_file(const std::string& path, std::string_view bytes);

// Writes a folder's entries to disk, so that files created or renamed in it survive a power loss. File systems that do
// not support this are ignored. Returns errno, or 0 for success.
[[nodiscard]] int sync_folder(const std::string& folder) noexcept;

// If `name`, without folder, is that of a temporary file of AtomicFile, returns its target name (the beginning of a
// long one), else "".
[[nodiscard]] std::string target_of_temporary(std::string_view name);

}  // namespace strata::scenes
