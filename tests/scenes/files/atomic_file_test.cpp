#include "scenes/files/atomic_file.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
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

// The exit status of `body` run in a child process.
template <class Body>
int status_of_child(Body body) {
    const pid_t child = ::fork();
    if (child == 0) {
        body();
        ::_exit(99);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
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

TEST_CASE("a file that is not committed leaves nothing, and the old one as it was") {
    const TemporaryFolder folder;
    const std::string path = folder / "a.txt";
    strata::scenes::write_file(path, "old");
    { AtomicFile{path}.write("new", 3); }
    CHECK(strata::test::bytes_of(path) == "old");
    CHECK(files_in(folder.path) == 1);
    strata::scenes::write_file(path, "new");
    CHECK(strata::test::bytes_of(path) == "new");
}

TEST_CASE("what is written after a seek replaces what stood there") {
    const TemporaryFolder folder;
    AtomicFile file{folder / "a.txt"};
    file.write("0123456789", 10);
    CHECK(file.seek(2));
    file.write("ab", 2);
    CHECK(file.position() == 4);
    file.commit();
    CHECK(strata::test::bytes_of(folder / "a.txt") == "01ab456789");
}

TEST_CASE("a folder that is missing, a name that is a folder and a name too long are the system's errors") {
    const TemporaryFolder folder;
    CHECK_THROWS_AS(strata::scenes::write_file(folder / "no/such/a.txt", "x"), SystemError);
    CHECK_THROWS_AS(strata::scenes::write_file(folder.path, "x"), SystemError);
    CHECK_THROWS_AS(strata::scenes::write_file(folder / std::string(300, 'a'), "x"), SystemError);
    CHECK_THROWS_AS(strata::scenes::write_file(folder / std::string(5000, 'a'), "x"), SystemError);
    CHECK(files_in(folder.path) == 0);
}

TEST_CASE("a disk that is full is an error, and leaves neither the file nor its temporary") {
    const TemporaryFolder folder;
    const int status = status_of_child([&] {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};  // writes beyond it fail as they would on a full disk
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

TEST_CASE("a signal that ends the process removes every unfinished file, and the status is 128 and its number") {
    const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU);
    const TemporaryFolder folder;
    const int status = status_of_child([&] {
        strata::scenes::remove_unfinished_files_when_interrupted();
        AtomicFile a{folder / "a.txt"}, b{folder / "b.txt"};
        a.write("x", 1);
        if (files_in(folder.path) != 2) ::_exit(1);
        ::raise(signal);
    });
    INFO("signal " << signal);
    CHECK(status == 128 + signal);
    CHECK(files_in(folder.path) == 0);
}

TEST_CASE("a write beyond the limit of file sizes is an error, not a signal") {
    const TemporaryFolder folder;
    const int status = status_of_child([&] {
        strata::scenes::remove_unfinished_files_when_interrupted();
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            strata::scenes::write_file(folder / "a.txt", std::string(5000, 'x'));
        } catch (const SystemError& error) {
            ::_exit(std::string{error.what()}.find("File too large") != std::string::npos ? 3 : 4);
        }
    });
    CHECK(status == 3);
    CHECK(files_in(folder.path) == 0);
}

TEST_CASE("slots for unfinished files are given back: a thousand files one after the other, sixteen at once") {
    const TemporaryFolder folder;
    for (int i = 0; i < 1000; ++i) AtomicFile{folder / "a.txt"}.write("x", 1);
    std::vector<std::unique_ptr<AtomicFile>> files;
    for (int i = 0; i < 16; ++i) files.push_back(std::make_unique<AtomicFile>(folder / std::to_string(i)));
    CHECK_THROWS_AS(AtomicFile{folder / "one too many"}, SystemError);
}
