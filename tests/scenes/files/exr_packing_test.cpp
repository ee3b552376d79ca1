// Tests EXR files when zlib runs out of memory. This program replaces the two zlib functions that OpenEXR calls; they
// fail when a test requests it.
#include <dlfcn.h>
#include <zlib.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>

#include "scenes/files/image_io.h"
#include "scenes/files/system_error.h"
#include "tests/scenes/image_support.h"
#include "tests/scenes/scenes_support.h"

namespace {

std::atomic<int> calls = 0, failing = 0;  // failing: number of the call that fails, from 1; 0: none

template <class Function, class... Values>
int unless_failing(const char* name, Values... values) {
    if (++calls == failing) return Z_MEM_ERROR;
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name))(values...);
}

}  // namespace

int compress(Bytef* to, uLongf* size, const Bytef* from, uLong count) {
    return unless_failing<decltype(compress)>("compress", to, size, from, count);
}
int compress2(Bytef* to, uLongf* size, const Bytef* from, uLong count, int level) {
    return unless_failing<decltype(compress2)>("compress2", to, size, from, count, level);
}

namespace {

using namespace strata::scenes;
using strata::pipeline::Format;
using strata::test::TemporaryFolder;

// Checks that a write whose n-th block cannot be compressed fails and leaves no file, for every n.
template <class Write>
void fails_at_each_block(const Write& write) {
    const TemporaryFolder folder;
    calls = failing = 0;
    write(folder / "whole.exr");
    const int blocks = calls;
    REQUIRE(blocks > 4);
    for (int n = 1; n <= blocks; ++n) {
        INFO("block " << n << " of " << blocks);
        calls = 0;
        failing = n;
        CHECK_THROWS_AS(write(folder / "broken.exr"), strata::SystemError);
        failing = 0;
        CHECK_FALSE(std::filesystem::exists(folder / "broken.exr"));
    }
}

}  // namespace

TEST_CASE("an EXR whose block cannot be compressed is an error for every block") {
    const OutputColor image{.color = strata::test::wild_image(Format::rgba8, 40, 100, 5),
                            .depth = strata::test::wild_image(Format::d24, 40, 100, 6)};
    fails_at_each_block([&](const std::string& path) { write_image(path, image); });
}

TEST_CASE("a deep EXR whose block cannot be compressed is an error for every block") {
    DeepFragments fragments{.width = 2, .height = 3, .count = std::vector<std::uint32_t>(6, 40)};
    fragments.depth_code.resize(240);
    fragments.z.resize(240);
    fragments.rgba.resize(240);
    fragments.primitive.resize(240);
    fails_at_each_block([&](const std::string& path) { write_deep(path, fragments, {}); });
}
