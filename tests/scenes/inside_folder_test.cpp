// Tests file access inside a folder. The test creates the folder, and links that lead outside to existing files, so
// that following one would succeed.
#include "scenes/inside_folder.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/scenes/scenes_support.h"

using strata::scenes::inside_folder;
using strata::scenes::path_inside;
using PathStatus = strata::scenes::InsideFolder::PathStatus;

TEST_CASE("a name inside a folder is found and every path out of the folder is rejected") {
    namespace fs = std::filesystem;
    const strata::test::TemporaryFolder root;
    fs::create_directories(root / "home/below");
    fs::create_directories(root / "home-too");
    for (const char* const name : {"home/a", "home/below/b", "home-too/c", "secret"})
        std::ofstream(root / name) << name;
    fs::create_symlink("../secret", root / "home/out");
    fs::create_symlink("..", root / "home/up");
    fs::create_symlink("../home-too", root / "home/beside");
    fs::create_symlink("below/b", root / "home/in");
    fs::create_symlink("loop", root / "home/loop");
    const std::string home = root / "home";
    const auto found = [&](const std::string& name) { return inside_folder(home, name).status; };
    for (const char* const name : {"a", "below/b", "./a", "below/./b", "in", "below//b"}) {
        INFO(name);
        CHECK(found(name) == PathStatus::inside);
    }
    CHECK(inside_folder(home, "in").path == fs::canonical(root / "home/below/b"));
    for (const std::string& name : {std::string{}, std::string{"../secret"}, std::string{"below/../../secret"},
                                    root / "secret", std::string{".."}, std::string{"a/.."}, std::string{"a\0b", 3}}) {
        INFO(name);
        CHECK(found(name) == PathStatus::name_leaves);
    }
    for (const char* const name : {"out", "up/secret", "beside/c"}) {
        INFO(name);
        CHECK(found(name) == PathStatus::link_leaves);
    }
    for (const char* const name : {"none", "loop", "below/a", "a/b"}) {
        INFO(name);
        CHECK(found(name) == PathStatus::nothing);
    }
    CHECK(path_inside(home, "below/b", "file", "place") == root / "home/below/b");
    CHECK_THROWS_WITH(path_inside(home, "out", "file", "place"),
                      "file: place: expected a file in the folder " + home + ", found 'out', a link that leaves it");
}
