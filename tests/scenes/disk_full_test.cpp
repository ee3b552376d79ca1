// Tests writing on a full disk. A limit on the size of files simulates it: write() fails in the same way, with EFBIG.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <functional>

#include "scenes/files/image_io.h"
#include "scenes/files/system_error.h"
#include "tests/scenes/image_support.h"
#include "tests/scenes/scenes_support.h"

using namespace strata::scenes;
using strata::pipeline::Format;
using strata::test::wild_image;

namespace {

using Write = std::function<void(const std::string& path)>;

// During its lifetime, this process cannot write beyond `bytes` in any file.
class FileSizeLimit {
  public:
    explicit FileSizeLimit(std::uintmax_t bytes) : handler_{std::signal(SIGXFSZ, SIG_IGN)} {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }
    FileSizeLimit(const FileSizeLimit&) = delete;
    FileSizeLimit& operator=(const FileSizeLimit&) = delete;

  private:
    void (*handler_)(int);
    rlimit before_{};
};

bool is_written(std::uintmax_t limit, const std::string& path, const Write& write) {
    const FileSizeLimit limited{limit};
    try {
        write(path);
    } catch (const strata::SystemError&) {
        return false;
    }
    return true;
}

void check_every_limit(const std::string& name, const Write& write) {
    const strata::test::TemporaryFolder folder;
    CHECK(is_written(1 << 24, folder / name, write));
    const auto size = std::filesystem::file_size(folder / name);
    std::filesystem::remove(folder / name);
    for (const std::uintmax_t limit : {std::uintmax_t{0}, std::uintmax_t{100}, size / 2, size - 1}) {
        INFO(name << " of " << size << " bytes, limit " << limit);
        CHECK_FALSE(is_written(limit, folder / name, write));
        CHECK(std::filesystem::is_empty(folder.path));
    }
    CHECK(is_written(size, folder / name, write));
}

}  // namespace

TEST_CASE("a disk that fills up at any point while an image is written is an error and leaves no file") {
    const OutputColor output{.color = wild_image(Format::rgba8, 100, 100, 1),
                             .depth = wild_image(Format::d24, 100, 100, 2)};
    const std::vector<OutputColor> layers(4, output);
    DeepFragments deep{.width = 50, .height = 50, .count = std::vector<std::uint32_t>(2500, 2)};
    for (std::uint32_t i = 0; i < 5000; ++i) {
        deep.depth_code.push_back(i * 2654435761u);
        deep.z.push_back(0.5f);
        deep.rgba.push_back({0.5f, 0.5f, 0.5f, 0.5f});
        deep.primitive.push_back(i);
    }
    check_every_limit("a.png", [&](const std::string& path) { write_image(path, output); });
    check_every_limit("a.exr", [&](const std::string& path) { write_image(path, output); });
    check_every_limit("layers.exr", [&](const std::string& path) { write_layers(path, layers); });
    check_every_limit("deep.exr", [&](const std::string& path) { write_deep(path, deep, {}); });
}
