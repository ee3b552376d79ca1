// Tests that a protected file is not replaced. The process stays protected, but no other test writes a file that it has
// read.
#include "scenes/read_files.h"

#include <catch2/catch.hpp>
#include <filesystem>

#include "rasterizer/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/text_file.h"
#include "tests/support/own_folder.h"

using namespace strata;
using namespace strata::scenes;

TEST_CASE("a file that was read is replaced by a library and not by a process that protects what it reads") {
    const strata::test::OwnFolder folder;
    const std::string before = folder.path() + "/before", file = folder.path() + "/file",
                      other = folder.path() + "/other", link = folder.path() + "/link";
    for (const std::string& path : {before, file, other}) write_file(path, "old");
    CHECK(read_text_file(before) == "old");
    protect_read_files();
    CHECK_NOTHROW(write_file(before, "new"));
    CHECK(read_text_file(file) == "old");
    CHECK_THROWS_AS(write_file(file, "new"), InputError);
    CHECK_THROWS_AS(
        write_file(folder.path() + "/../" + std::filesystem::path(folder.path()).filename().string() + "/file", "new"),
        InputError);
    CHECK(read_text_file(file) == "old");
    CHECK_NOTHROW(write_file(other, "new"));
    CHECK(read_text_file(other) == "new");
    note_read_pack(folder.path() + "/pack");
    std::filesystem::create_directories(folder.path() + "/pack/inner");
    std::filesystem::create_directories(folder.path() + "/packs");
    for (const char* name : {"/pack/new", "/pack/inner/new", "/packs/../pack/new"})
        CHECK_THROWS_WITH(write_file(folder.path() + name, "new"), Catch::Contains("is in a pack that this command"));
    CHECK_NOTHROW(write_file(folder.path() + "/packs/new", "new"));
    std::filesystem::create_symlink(file, link);
    CHECK_NOTHROW(write_file(link, "new"));
    CHECK(read_text_file(file) == "old");
}
