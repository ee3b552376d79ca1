// Copies the program and its image module into the layouts of a build tree and of an installation, and tests that the
// program finds the module or reports that it is missing.
#include <catch2/catch.hpp>
#include <fstream>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

constexpr const char* render = " render teapot --size 16x16 --no-audit -o out.png";
constexpr const char* digest = " info --digests out.png";

// Copies the program to bin/ and, if a folder is given, the module into that folder.
void install(const Folder& folder, const std::string& module_folder) {
    std::filesystem::create_directories(folder / "bin");
    std::filesystem::copy_file(STRATA_PROGRAM, folder / "bin/strata");
    if (module_folder.empty()) return;
    std::filesystem::create_directories(folder / module_folder);
    std::filesystem::copy_file(STRATA_IMAGES, folder / (module_folder + "/strata_images.so"));
}

}  // namespace

TEST_CASE("the image module is found in the program's folder and in STRATA_IMAGE_FOLDER relative to it") {
    const auto module_folder = GENERATE(as<std::string>{}, "bin", "bin/" STRATA_IMAGE_FOLDER);
    const Folder folder;
    install(folder, module_folder);
    const CommandResult ended =
        shell(folder, std::string{"bin/strata"} + render + " && bin/strata info --digests out.png");
    INFO(ended.err);
    CHECK(ended.status == 0);
    CHECK(ended.out.find("rgba8") != std::string::npos);
}

TEST_CASE("without the image module reading a PNG fails with a one-line error and other commands work") {
    const Folder folder;
    install(folder, "");
    REQUIRE(shell(folder, std::string{"bin/strata"} + render).status == 0);
    const CommandResult ended = shell(folder, std::string{"bin/strata"} + digest);
    CHECK(ended.status == 3);
    CHECK(ended.out.empty());
    CHECK(ended.err.starts_with("strata: strata_images.so: cannot load the image module: expected in "));
    CHECK(lines_of(ended.err).size() == 1);
}

TEST_CASE("a module file that cannot be loaded gives a one-line error") {
    const Folder folder;
    install(folder, "");
    std::ofstream(folder / "bin/strata_images.so") << "not a library";
    REQUIRE(shell(folder, std::string{"bin/strata"} + render).status == 0);
    const CommandResult ended = shell(folder, std::string{"bin/strata"} + digest);
    CHECK(ended.status == 3);
    CHECK(ended.err.find("bin/strata_images.so: cannot load the image module: ") != std::string::npos);
    CHECK(lines_of(ended.err).size() == 1);
}
