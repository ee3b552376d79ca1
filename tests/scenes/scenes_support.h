// tests/scenes/scenes_support.h - temporary folders, the bytes of files, and a locale with decimal commas.
#pragma once
#include <unistd.h>

#include <clocale>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <stdexcept>
#include <string>

namespace strata::test {

struct TemporaryFolder {
    std::string path;
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "strata-test-XXXXXX").string();
        if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
        path = pattern;
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path); }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    std::string operator/(const std::string& name) const { return path + "/" + name; }
};

inline std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// During its lifetime, C++ streams and, if the system has such a locale, the C library write 1.5 as 1,5 and 1000 as
// 1.000.
class CommaLocale {
  public:
    CommaLocale() : cpp_{std::locale::global(std::locale{std::locale{}, new Comma})} {
        const std::string make = "localedef -i de_DE -f UTF-8 " + folder_ / "de_DE.UTF-8" + " 2>/dev/null";
        if (std::system(make.c_str()) == 0) ::setenv("LOCPATH", folder_.path.c_str(), 1);
        c_library_has_it = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    }
    ~CommaLocale() {
        std::locale::global(cpp_);
        std::setlocale(LC_ALL, "C");
        ::unsetenv("LOCPATH");
    }
    bool c_library_has_it = false;
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

  private:
    struct Comma : std::numpunct<char> {
        char do_decimal_point() const override { return ','; }
        char do_thousands_sep() const override { return '.'; }
        std::string do_grouping() const override { return "\3"; }
    };
    TemporaryFolder folder_;
    std::locale cpp_;
};

}  // namespace strata::test
