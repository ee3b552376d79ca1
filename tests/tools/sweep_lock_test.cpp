// Tests the lock of a sweep with a lock that this process holds, and by listing the folder.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/tools/program.h"
#include "tools/lab/sweep/leftovers.h"
#include "tools/lab/sweep/lock.h"

using namespace strata::test;
using strata::tools::Lock;

namespace {

std::vector<std::string> two_cells(const std::string& folder) {
    return {"invariance", "planes:gap=64,count=3", "--size",         "16x12", "--profile",   "ideal",
            "--pair",     "float32:exact",         "--depth-format", "d24",   "--algorithm", "front_to_back",
            "--remedy",   "none,bias:2",           "--threads",      "1",     "--no-images", "-o",
            folder};
}

}  // namespace

TEST_CASE("a second run on a folder reports who writes to it and changes nothing") {
    const Folder folder;
    std::filesystem::create_directory(folder / "out");
    {
        const Lock held(folder / "out/results.jsonl");
        const CommandResult second = run_strata(folder, two_cells("out"));
        CHECK(second.status == 2);
        CHECK(second.err.starts_with(
            "strata: out/results.jsonl: lock: expected a journal that no other run writes to, found "
            "process " +
            std::to_string(::getpid()) + " on "));
        CHECK(lines_of(second.err).size() == 1);
        auto merge = two_cells("out");
        merge.insert(merge.end(), {"--merge", "2"});
        CHECK(run_strata(folder, merge).err.find("no other run writes to") != std::string::npos);
        // Another shard has its own files.
        auto shard = two_cells("out");
        shard.insert(shard.end(), {"--shard", "1/2"});
        CHECK(run_strata(folder, shard).status == 0);
        CHECK_FALSE(std::filesystem::exists(folder / "out/results.jsonl"));
    }
    CHECK(run_strata(folder, two_cells("out")).status == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "out/.results.jsonl.lock"));
}

TEST_CASE("a lock is released when its process ends and its file is then available") {
    const Folder folder;
    const std::string journal = folder / "results.jsonl";
    const pid_t child = ::fork();
    if (child == 0) {
        const Lock held(journal);
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(folder.files() == std::vector<std::string>{".results.jsonl.lock"});
    {
        const Lock mine(journal);
        CHECK_THROWS_AS(Lock(journal), strata::InputError);
    }
    CHECK(folder.files().empty());
    CHECK_NOTHROW(Lock(journal));
}

TEST_CASE("temporary files of a killed run are deleted by the next run of the same shard and no other files") {
    const Folder folder;
    std::filesystem::create_directory(folder / "images");
    const std::vector<std::string> ours{".results.2of3.jsonl.7-0.tmp", ".timings.2of3.jsonl.7-1.tmp",
                                        "images/.0001.png.7-2.tmp", "images/.0004.difference.exr.99-123.tmp"};
    const std::vector<std::string> others{
        "results.2of3.jsonl",   ".results.jsonl.7-0.tmp",   ".results.1of3.jsonl.7-0.tmp",
        ".results.csv.7-0.tmp", "images/.0000.png.7-2.tmp", "images/.0002.png.7-2.tmp",
        "images/0001.png",      "images/.note.png.7-2.tmp", "images/.0001.png.tmp"};
    for (const auto& names : {ours, others})
        for (const std::string& name : names) std::ofstream(folder / name) << "x";
    strata::tools::remove_leftovers(folder.path().string(), {2, 3});
    for (const std::string& name : ours) CHECK_FALSE(std::filesystem::exists(folder / name));
    for (const std::string& name : others) CHECK(std::filesystem::exists(folder / name));
    strata::tools::remove_leftovers(folder / "nowhere", {});
}
