// Tests that files appear completely or not at all, by listing and reading the folder.
#include "scenes/files/atomic_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "scenes/files/system_error.h"
#include "tests/scenes/scenes_support.h"

using strata::SystemError;
using strata::scenes::AtomicFile;
using strata::test::TemporaryFolder;

namespace {

int files_in(const std::string& folder) {
    int count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++count;
    return count;
}

// The exit status of `body` run in a child process while `beside` runs in this one; 1000 + the signal's number if a
// signal ends it.
template <class Body, class Beside>
int status_of_child(Body body, Beside beside) {
    const pid_t child = ::fork();
    if (child == 0) {
        body();
        ::_exit(99);
    }
    beside();
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

template <class Body>
int status_of_child(Body body) {
    return status_of_child(body, [] {});
}

}  // namespace

TEST_CASE("a file appears when it is committed and not before") {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    {
        AtomicFile file{path};
        CHECK(file.write("hello", 5) == 5);
        CHECK_FALSE(std::filesystem::exists(path));
        file.commit();
    }
    CHECK(strata::test::bytes_of(path) == "hello");
    CHECK(files_in(folder.path) == 1);
}

TEST_CASE("a file that is not committed is removed and the old one is unchanged") {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    strata::scenes::write_file(path, "old");
    { AtomicFile{path}.write("new", 3); }
    CHECK(strata::test::bytes_of(path) == "old");
    CHECK(files_in(folder.path) == 1);
    strata::scenes::write_file(path, "new");
    CHECK(strata::test::bytes_of(path) == "new");
}

TEST_CASE("data written after a seek replaces what was there") {
    const TemporaryFolder folder;
    AtomicFile file{folder / "a.txt"};
    file.write("0123456789", 10);
    CHECK(file.seek(2));
    file.write("ab", 2);
    CHECK(file.position() == 4);
    file.commit();
    CHECK(strata::test::bytes_of(folder / "a.txt") == "01ab456789");
}

TEST_CASE("a missing folder and a name of a folder and a name that is too long are system errors") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(strata::scenes::write_file(folder / "no/such/a.txt", "x"), SystemError);
    CHECK_THROWS_AS(strata::scenes::write_file(folder.path, "x"), SystemError);
    CHECK_THROWS_AS(strata::scenes::write_file(folder / std::string(300, 'a'), "x"), SystemError);
    CHECK_THROWS_AS(strata::scenes::write_file(folder / std::string(5000, 'a'), "x"), SystemError);
    CHECK(files_in(folder.path) == 0);
}

TEST_CASE("a full disk is an error and leaves neither the file nor its temporary file") {
    const TemporaryFolder folder;
    const int status = status_of_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};  // writes beyond this size fail as on a full disk
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            strata::scenes::write_file(folder / "a.txt", std::string(5000, 'x'));
        } catch (const SystemError&) {
            ::_exit(3);
        }
    });
    CHECK(status == 3);
    CHECK(files_in(folder.path) == 0);
}

TEST_CASE("slots for unfinished files are reused and there are sixteen of them") {
    const TemporaryFolder folder;
    for (int i = 0; i < 1000; ++i) AtomicFile{folder / "a.txt"}.write("x", 1);
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (int i = 0; i < 16; ++i) files.push_back(std::make_unique<AtomicFile>(folder / std::to_string(i)));
    CHECK_THROWS_AS(AtomicFile{folder / "one too many"}, SystemError);
}

TEST_CASE("a name of any length that the file system accepts is written and one byte more is an error at once") {
    const TemporaryFolder folder;
    for (const std::size_t length : {1, 200, 238, 239, 240, 250, 254, 255}) {
        const std::string path = folder / std::string(length, 'n');
        strata::scenes::write_file(path, "x");
        CHECK(strata::test::bytes_of(path) == "x");
    }
    CHECK(files_in(folder.path) == 8);
    CHECK_THROWS_AS(AtomicFile{folder / std::string(256, 'n')}, SystemError);
    CHECK(files_in(folder.path) == 8);
}

TEST_CASE("temporary files of a killed process with the same process number are left alone and other names are used") {
    const TemporaryFolder folder;
    // The counter increases by one with each file, so the next names are known.
    std::string first;
    { first = AtomicFile{folder / "a.txt"}.temporary(); }
    const auto dash = first.rfind('-');
    const int next = std::stoi(first.substr(dash + 1)) + 1;
    for (int i = 0; i < 5; ++i)
        std::ofstream(first.substr(0, dash + 1) + std::to_string(next + i) + ".tmp") << "another's";
    strata::scenes::write_file(folder / "a.txt", "x");
    CHECK(strata::test::bytes_of(folder / "a.txt") == "x");
    CHECK(files_in(folder.path) == 6);
    for (int i = 0; i < 5; ++i)
        CHECK(strata::test::bytes_of(first.substr(0, dash + 1) + std::to_string(next + i) + ".tmp") == "another's");
}

TEST_CASE("a pipe gets the bytes of the finished file and remains a pipe and also behind a symbolic link") {
    const TemporaryFolder folder;
    ::mkfifo((folder / "pipe").c_str(), 0600);
    std::filesystem::create_symlink("pipe", folder / "link");
    for (const char* name : {"pipe", "link"}) {
        const int status = status_of_child(
            [&] {
                AtomicFile file{folder / name};
                file.write(std::string(100000, 'x').data(), 100000);
                file.seek(0);
                file.write("ab", 2);
                file.commit();
                ::_exit(0);
            },
            [&] {
                const std::string bytes = strata::test::bytes_of(folder / "pipe");
                CHECK(bytes == "ab" + std::string(99998, 'x'));
            });
        CHECK(status == 0);
        CHECK(std::filesystem::is_fifo(folder / "pipe"));
    }
    CHECK(files_in(folder.path) == 2);
}

TEST_CASE("a device that rejects writes is an error and remains a device") {
    CHECK_THROWS_WITH(strata::scenes::write_file("/dev/full", "x"), Catch::Contains("No space left"));
    CHECK(std::filesystem::is_character_file("/dev/full"));
    CHECK_NOTHROW(strata::scenes::write_file("/dev/null", "x"));
}

TEST_CASE("a temporary file's name contains the final name and no other name is taken for a temporary file's") {
    using strata::scenes::target_of_temporary;
    const TemporaryFolder folder;
    for (const std::string target : {"a.txt", "0003.difference.png", ".hidden", "a-b.7-7"}) {
        const AtomicFile file{folder / target};
        const std::string name = std::filesystem::path(file.temporary()).filename().string();
        CHECK(target_of_temporary(name) == target);
    }
    for (const char* name : {"", ".", ".tmp", "a.txt", ".a.txt.tmp", ".a.txt.12-.tmp", ".a.txt.-1.tmp", "a.txt.1-1.tmp",
                             ".a.txt.1-1.tm", ".a.txt.1x-1.tmp", "..1-1.tmp", ".1-1.tmp", ".a.1.1-x.tmp"})
        CHECK(target_of_temporary(name) == "");
}
