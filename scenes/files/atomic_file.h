// scenes/files/atomic_file.h - a file that appears under its name only when it is complete.
//
// Rule     Written beside its place under ".NAME.PROCESS-NUMBER.tmp", with a long NAME cut so that the whole has 255
//          bytes. commit() puts the bytes on the disk (fsync), renames, and puts the new name on the disk (fsync of the
//          folder). What was not committed is removed: by the destructor, or by unfinished_files.h when the process is
//          interrupted. A symbolic link is replaced, not followed, unless it leads to a pipe or a device: commit()
//          writes the finished bytes to these. The path "-" is the process's own standard output, whatever that is.
// Tests    tests/scenes/files/atomic_file_test.cpp
#pragma once
#include <cstdint>
#include <memory>
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
    [[nodiscard]] std::int64_t position() const noexcept { return begin_ + static_cast<std::int64_t>(used_); }
    [[nodiscard]] bool failed() const noexcept { return failure_ != 0; }

    // For a library that opens files by name only: it writes this one, commit() puts it in its place.
    [[nodiscard]] const std::string& temporary() const noexcept { return temporary_; }

    // Closes the file and gives it its name; call it once, last.
    void commit();  // SystemError if any write failed, or the rename does

  private:
    void open_temporary();
    bool flush() noexcept;  // the buffer to the file
    void put_in_place();    // the temporary's bytes under the final name
    void send() noexcept;   // the temporary's bytes to a pipe or a device
    // note_failure() keeps the first errno; discard() closes and unlinks what was not committed.
    void note_failure() noexcept;
    void discard() noexcept;

    std::string path_, temporary_;
    bool is_stream_ = false;  // the path names a pipe or a device
    int descriptor_ = -1;
    // The bytes that follow `begin_` in the file and are not written yet.
    std::unique_ptr<std::byte[]> buffer_;
    std::size_t used_ = 0;
    std::int64_t begin_ = 0;
    // Its place in the table of unfinished files; -1 after commit().
    int slot_ = -1;
    int failure_ = 0;  // errno of the first failure
};

// `told` is called with the path of every file that is in its place from now on, by the thread that wrote it.
void tell_written_files(void (*told)(const std::string& path)) noexcept;

// "-", or a name by which Linux calls standard output.
[[nodiscard]] bool is_standard_output(std::string_view path) noexcept;

// The whole file at once.
void write_file(const std::string& path, std::string_view bytes);

// Puts a folder's names on the disk: what was created in it or renamed is there after a power loss. A file system that
// cannot is passed over. Answers errno, 0 if it is done.
[[nodiscard]] int sync_folder(const std::string& folder) noexcept;

// Whether `name`, without folder, is a temporary of AtomicFile; then the name that it was to get (the beginning of a
// long one), else "".
[[nodiscard]] std::string target_of_temporary(std::string_view name);

}  // namespace strata::scenes
