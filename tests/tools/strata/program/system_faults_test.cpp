// Tests commands whose system calls fail one after the other, through a library that is loaded before the C library.
// The expected files are those of the same command without a fault.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cerrno>
#include <fstream>
#include <iostream>
#include <map>
#include <thread>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

using Files = std::map<std::string, std::string>;

// All files in the folder by name, with their content.
Files files_under(const Folder& folder) {
    Files files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file())
            files[std::filesystem::relative(entry.path(), folder.path()).string()] = content_of(entry.path().string());
    return files;
}

CommandResult run_failing(const Folder& folder, const std::vector<std::string>& words, const std::string& fault) {
    return run_strata(folder, words, {.environment = {{"LD_PRELOAD", STRATA_FAILING_CALLS}, {"STRATA_FAIL", fault}}});
}

// The counted system calls of a command that does not fail, in order.
std::vector<std::string> calls_of(const Folder& folder, const std::vector<std::string>& words) {
    const Folder log;
    const CommandResult ended = run_strata(
        folder, words, {.environment = {{"LD_PRELOAD", STRATA_FAILING_CALLS}, {"STRATA_CALLS", log / "calls"}}});
    REQUIRE(ended.status == 0);
    return lines_of(content_of(log / "calls"));
}

std::string fault_of(const std::string& call, std::ptrdiff_t number, int error) {
    return call + ":" + std::to_string(number) + ":" + std::to_string(error);
}

// After a run with a fault each file must have its old content, or the content that the command writes.
bool is_old_or_new(const Files& found, const Files& whole) {
    return std::all_of(found.begin(), found.end(), [&](const auto& file) {
        return whole.contains(file.first) && (file.second == "old" || file.second == whole.at(file.first));
    });
}

// A command that writes files. To test another command, add an entry to `writing_commands`.
struct Writing {
    std::vector<std::string> words;
    std::vector<std::string> outputs{};  // files that exist before the run, with other content
    std::vector<std::string> before{};   // a run of strata that makes the command's inputs
    std::vector<std::string> timed{};    // files that contain times and cannot be compared
};

const std::vector<Writing> writing_commands{
    {{"render", "planes:count=2", "--size", "24x16", "--no-audit", "--threads", "1", "-o", "out.png"}, {"out.png"}},
    {{"render", "planes:count=2", "--size", "24x16", "--no-audit", "--threads", "1", "-o", "out.exr"}, {"out.exr"}},
    {{"layers", "planes:count=2", "--size", "24x16", "--no-audit", "--threads", "1", "-o", "l.exr", "--deep", "d.exr",
      "--stats", "s.json"},
     {"l.exr", "d.exr"},
     {},
     {"s.json"}},
    {{"bench", "planes:count=2", "--size", "24x16", "--algorithm", "depth", "--repeat", "1", "--threads", "1",
      "--warm-up", "0", "-o", "times.json"},
     {},
     {},
     {"times.json"}},
    {{"passes", "planes:count=1", "--size", "8x8", "--algorithm", "front_to_back", "--max-passes", "1", "-o", "."},
     {"contact.png", "passes.json"}},
    {{"explain", "planes:count=1", "--size", "8x8", "--pixel", "4,4", "--svg", "column.svg"}, {"column.svg"}},
    {{"compare", "a.exr", "a.exr", "--heat", "heat.png", "--side", "side.png", "--junit", "cases.xml"},
     {"heat.png", "side.png", "cases.xml"},
     {"render", "planes:count=1", "--size", "8x8", "--no-audit", "-o", "a.exr"}},
    {{"golden", "planes:count=1", "--size", "8x8", "--algorithm", "front_to_back", "--max-passes", "1", "-o", "pack"}},
    {{"report", "planes:count=1", "--size", "8x8", "--algorithm", "front_to_back", "--threads", "1", "-o", "page"}},
};

// Which calls of a kind fail: each of them in separate runs, or only the last one, when most of the work is done.
enum class Calls { each, last };

std::vector<std::ptrdiff_t> numbers_of(const std::vector<std::string>& calls, const std::string& call, Calls which) {
    const std::ptrdiff_t count = std::count(calls.begin(), calls.end(), call);
    std::vector<std::ptrdiff_t> numbers;
    for (std::ptrdiff_t n = which == Calls::each || count == 0 ? 1 : count; n <= count; ++n) numbers.push_back(n);
    return numbers;
}

// The files in the folder without those that contain times.
Files comparable(const Folder& folder, const Writing& writing) {
    Files files = files_under(folder);
    for (const std::string& name : writing.timed) files.erase(name);
    return files;
}

// Writes the files that the folder has before the command runs.
void prepare(const Folder& folder, const Writing& writing, const Files& read) {
    for (const auto& [name, bytes] : read) std::ofstream(folder / name, std::ios::binary) << bytes;
    for (const std::string& output : writing.outputs) std::ofstream(folder / output) << "old";
}

void fail_calls_of(const Writing& writing, Calls which) {
    const Folder clean;
    const auto& words = writing.words;
    Files read;
    if (!writing.before.empty()) {
        REQUIRE(run_strata(clean, writing.before).status == 0);
        read = files_under(clean);
    }
    const auto calls = calls_of(clean, words);
    const Files whole = comparable(clean, writing);
    std::string wrong;
    int told = 0, points = 0;
    // Either all calls from this one on fail, as on a full disk, or only one, whose data is then lost.
    struct Fault {
        std::string call, further;
        int error;
    };
    const auto faults = {Fault{"open", "", EIO},  Fault{"write", "+", ENOSPC}, Fault{"write", "", ENOSPC},
                         Fault{"fsync", "", EIO}, Fault{"rename", "", EIO},    Fault{"close", "", EIO}};
    for (const auto& [call, further, error] : faults)
        for (const std::ptrdiff_t n : numbers_of(calls, call, which)) {
            const Folder folder;
            prepare(folder, writing, read);
            const std::string fault = call + ":" + std::to_string(n) + further + ":" + std::to_string(error);
            const CommandResult ended = run_failing(folder, words, fault);
            const Files found = comparable(folder, writing);
            const bool says_it = ended.status == 3 && lines_of(ended.err).size() == 1;
            told += says_it ? 1 : 0;
            ++points;
            // Libraries write to sockets and pipes, and close files after the data is safe; these calls may fail
            // without an error if all files are complete.
            const bool may_pass = ended.status == 0 && (call == "close" || call == "write") && found == whole;
            if (!may_pass && !(says_it && is_old_or_new(found, whole)))
                wrong += call + " " + std::to_string(n) + ": " + std::to_string(ended.status) + " " + ended.err + "; ";
        }
    INFO(words.front());
    CHECK(wrong == "");
    CHECK(told >= 5);  // open, write twice, fsync, rename
    if (which == Calls::each) std::cout << words.front() << ": " << points << " calls failed" << std::endl;
}

// A sweep, and its files that contain times.
struct FailingSweep {
    std::vector<std::string> words, timed;
};

void fail_calls_of_a_sweep(const FailingSweep& sweep, Calls which) {
    const auto comparable_files = [&](const Folder& folder) {
        Files files = files_under(folder);
        for (const std::string& name : sweep.timed) files.erase(name);
        return files;
    };
    const Folder clean;
    const auto calls = calls_of(clean, sweep.words);
    const Files whole = comparable_files(clean);
    std::string wrong;
    int points = 0;
    for (const std::string call : {"open", "write", "fsync", "rename"})
        for (const std::ptrdiff_t n : numbers_of(calls, call, which)) {
            const Folder folder;
            const CommandResult ended = run_failing(folder, sweep.words, fault_of(call, n, ENOSPC));
            ++points;
            const bool is_wrong = ended.status != 3 || run_strata(folder, sweep.words).status != 0;
            if (is_wrong || comparable_files(folder) != whole)
                wrong += call + " " + std::to_string(n) + ": " + ended.err + "; ";
        }
    CHECK(wrong == "");
    CHECK(points >= 4);
    if (which == Calls::each) std::cout << sweep.words.front() << ": " << points << " calls failed" << std::endl;
}

const std::vector<FailingSweep> sweeps{
    {{"invariance", "planes:gap=64,count=3", "--size", "16x12", "--profile", "ideal", "--algorithm", "front_to_back",
      "--pair", "float32:exact", "--remedy", "none", "--depth-format", "d24", "--no-images", "--threads", "1", "-o",
      "out"},
     {"out/timings.jsonl"}},
    {{"hard-cases", "planes-1-unit", "--profile", "ideal", "--depth-format", "d24", "--algorithm", "unsorted", "-o",
      "out"},
     {"out/timings.jsonl"}},
    {{"cost", "planes:count=2", "--size", "16x12", "--knob", "average_count", "--repeat", "1", "--threads", "1", "-o",
      "out"},
     {"out/timings.jsonl"}},
};

}  // namespace

TEST_CASE("if any system call fails the command reports it and each file is old or new but never partial") {
    fail_calls_of(writing_commands[GENERATE(range(std::size_t{0}, writing_commands.size()))], Calls::last);
}

TEST_CASE("if any single system call fails each file of the command is old or new", "[exhaustive]") {
    for (const Writing& writing : writing_commands) fail_calls_of(writing, Calls::each);
}

TEST_CASE("a sweep one of whose system calls failed ends with the same bytes when it is started again") {
    fail_calls_of_a_sweep(sweeps[GENERATE(range(std::size_t{0}, sweeps.size()))], Calls::last);
}

TEST_CASE("a sweep ends with the same bytes after each single system call has failed", "[exhaustive]") {
    for (const FailingSweep& sweep : sweeps) fail_calls_of_a_sweep(sweep, Calls::each);
}

TEST_CASE("data is on the disk before its name and the name before the command ends") {
    const Folder folder;
    const auto calls = calls_of(
        folder, {"render", "planes:count=2", "--size", "24x16", "--no-audit", "--threads", "1", "--stats", "out.json"});
    std::vector<std::string> order;
    for (const std::string& call : calls)
        if (call == "write" || call == "fsync" || call == "rename") order.push_back(call);
    CHECK(order == std::vector<std::string>{"write", "fsync", "rename", "fsync"});
}

TEST_CASE("threads that the system denies reduce the number of threads with a warning and the same picture") {
    const std::vector<std::string> words{
        "render", "random:triangles=300", "--size", "200x150", "--no-audit", "--threads", "4", "--stats", "-"};
    const auto digest_in = [](const CommandResult& ended) {
        const auto begin = ended.out.find("\"digest\"");
        return begin == std::string::npos ? "none" : ended.out.substr(begin, ended.out.find('}', begin) - begin);
    };
    const Folder folder;
    const CommandResult plain = run_strata(folder, words);
    REQUIRE(plain.status == 0);
    REQUIRE(plain.err == "");
    REQUIRE(digest_in(plain).size() > 64);
    for (int most = 0; most <= 3; ++most) {
        const CommandResult ended = run_strata(
            folder, words,
            {.environment = {{"LD_PRELOAD", STRATA_FAILING_CALLS}, {"STRATA_MOST_THREADS", std::to_string(most)}}});
        INFO(most << " threads beside the first: " << ended.err);
        CHECK(ended.status == 0);
        const std::string warning = "strata: warning: --threads: the system did not start 4 threads; " +
                                    std::to_string(std::max(1, most)) + " threads ran\n";
        CHECK(ended.err == (most == 3 ? "" : warning));
        CHECK(digest_in(ended) == digest_in(plain));
    }
}

TEST_CASE("a stack that is too small is named") {
    const Folder folder;
    const CommandResult ended = shell(folder, "ulimit -s 64; strata render planes:count=1 --size 8x8 -o out.png");
    CHECK(ended.status == 3);
    CHECK(ended.err ==
          "strata: the stack: cannot grow beyond 64 KiB: strata needs 512 KiB (ulimit -s 8192 is the usual limit)\n");
    CHECK(folder.files().empty());
    CHECK(shell(folder, "ulimit -s 512; strata render planes:count=1 --size 8x8 -o out.png").status == 0);
}

TEST_CASE("a picture is written completely with however few threads") {
    const std::string output = GENERATE("out.png", "out.exr");
    const int threads = GENERATE(1, 4);
    const Folder clean;
    const std::vector<std::string> words{
        "render", "planes:count=2", "--size", "24x16", "--no-audit", "--threads", "1", "-o", output};
    REQUIRE(run_strata(clean, words).status == 0);
    const std::string whole = content_of(clean / output);
    auto asked = words;
    asked[6] = std::to_string(threads);
    const int most_of_all = 8 + static_cast<int>(std::thread::hardware_concurrency());
    for (int most = 0; most <= most_of_all; ++most) {
        const Folder folder;
        const CommandResult ended = run_strata(
            folder, asked,
            {.environment = {{"LD_PRELOAD", STRATA_FAILING_CALLS}, {"STRATA_MOST_THREADS", std::to_string(most)}}});
        INFO(most << " threads beside the first: " << ended.status << " " << ended.err);
        CHECK(ended.status == 0);  // PNG needs no extra thread, and EXR is compressed by the existing one
        CHECK(content_of(folder / output) == whole);
    }
}
