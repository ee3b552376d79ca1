// tests/tools/oracle/picture/own_file.h - a file with a unique name for one test.
#pragma once
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace strata::test {

// A file with a unique name, deleted when the test ends.
class OwnFile {
  public:
    OwnFile(const std::string& ending, const std::string& bytes) : path_{unique(ending)} {
        std::ofstream{path_, std::ios::binary} << bytes;
    }
    explicit OwnFile(const std::string& ending) : path_{unique(ending)} {}
    OwnFile(const OwnFile&) = delete;
    OwnFile& operator=(const OwnFile&) = delete;
    ~OwnFile() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    static std::string unique(const std::string& ending) {
        std::string name = (std::filesystem::temp_directory_path() / "strata-picture-XXXXXX").string();
        const int handle = mkstemp(name.data());
        if (handle < 0) throw std::runtime_error("no temporary file");
        close(handle);
        std::filesystem::remove(name);
        return name + ending;
    }
    std::string path_;
};

}  // namespace strata::test
