// Model: folders as a build and an installation lay them out, made here from copies of the program and its module.
#include <catch2/catch.hpp>
#include <fstream>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

constexpr const char* render = " render teapot --size 16x16 --no-audit -o out.png";
constexpr const char* digest = " digest out.png";

// Copies the program to bin/ and, if it is named, the module into that folder.
void install(const Folder& folder, const std::string& module_folder) {
    std::filesystem::create_directories(folder / "bin");
    std::filesystem::copy_file(STRATA_PROGRAM, folder / "bin/strata");
    if (module_folder.empty()) return;
    std::filesystem::create_directories(folder / module_folder);
    std::filesystem::copy_file(STRATA_IMAGES, folder / (module_folder + "/strata_images.so"));
}

}  // namespace

TEST_CASE("the image module is found beside the program, and in the library folder beside the program's own") {
    const auto module_folder = GENERATE(as<std::string>{}, "bin", "bin/" STRATA_IMAGE_FOLDER);
    const Folder folder;
    install(folder, module_folder);
    const Ended ended = shell(folder, std::string{"bin/strata"} + render + " && bin/strata digest out.png");
    INFO(ended.err);
    CHECK(ended.status == 0);
    CHECK(ended.out.find("rgba8") != std::string::npos);
}

TEST_CASE("without the image module a run that reads a PNG ends with one sentence, and every other runs") {
    const Folder folder;
    install(folder, "");
    REQUIRE(shell(folder, std::string{"bin/strata"} + render).status == 0);
    const Ended ended = shell(folder, std::string{"bin/strata"} + digest);
    CHECK(ended.status == 3);
    CHECK(ended.out.empty());
    CHECK(ended.err.starts_with("strata: strata_images.so: cannot load the image module: expected in "));
    CHECK(lines_of(ended.err).size() == 1);
}

TEST_CASE("a file that is no image module ends in one sentence") {
    const Folder folder;
    install(folder, "");
    std::ofstream(folder / "bin/strata_images.so") << "not a library";
    REQUIRE(shell(folder, std::string{"bin/strata"} + render).status == 0);
    const Ended ended = shell(folder, std::string{"bin/strata"} + digest);
    CHECK(ended.status == 3);
    CHECK(ended.err.find("bin/strata_images.so: cannot load the image module: ") != std::string::npos);
    CHECK(lines_of(ended.err).size() == 1);
}
