// tests/tools/oracle/folders/two_folders.h - two folders with unique names for one test, and files in them.
#pragma once
#include <string>

#include "tests/tools/oracle/picture/own_file.h"

namespace strata::test {

// Both are deleted when the test ends.
class TwoFolders {
  public:
    TwoFolders() {
        std::filesystem::create_directories(reference());
        std::filesystem::create_directories(candidate());
    }
    TwoFolders(const TwoFolders&) = delete;
    TwoFolders& operator=(const TwoFolders&) = delete;
    ~TwoFolders() {
        std::filesystem::remove_all(reference());
        std::filesystem::remove_all(candidate());
    }
    [[nodiscard]] std::string reference() const { return own_.path() + ".reference"; }
    [[nodiscard]] std::string candidate() const { return own_.path() + ".candidate"; }
    void write_reference(const std::string& path, const std::string& bytes) const { write(reference(), path, bytes); }
    void write_candidate(const std::string& path, const std::string& bytes) const { write(candidate(), path, bytes); }

  private:
    static void write(const std::string& folder, const std::string& path, const std::string& bytes) {
        const std::filesystem::path file = std::filesystem::path(folder) / path;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream{file, std::ios::binary} << bytes;
    }
    OwnFile own_{""};
};

}  // namespace strata::test
