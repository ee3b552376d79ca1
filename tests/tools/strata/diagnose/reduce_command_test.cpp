// Tests `strata reduce` by the files that the test's own shell commands leave. A named pipe reports when a command
// runs, and when every process that has it open has ended, so no test waits for a time.
#include <catch2/catch.hpp>

#include "tests/tools/program.h"

using namespace strata::test;

namespace {

void make_pack(const Folder& folder) {
    REQUIRE(
        run_strata(folder, {"golden", "planes:count=2", "--size", "4x4", "--algorithm", "front_to_back", "-o", "pack"})
            .status == 0);
}

const std::string faulty = "strata render {pack} --algorithm front_to_back --mistake one_pass_too_few -o {picture}";

}  // namespace

TEST_CASE("reduce passes a pack of any name to the command in any quotes") {
    const Folder folder;
    make_pack(folder);
    int number = 0;
    for (const std::string name : {"$(touch pwned)", "`touch pwned`", "a b", "it's", "\"", ";touch pwned;",
                                   "a&touch pwned", "-o", "{picture}"}) {
        std::filesystem::copy(folder / "pack", folder / name, std::filesystem::copy_options::recursive);
        for (const std::string quote : {"", "'", "\""}) {
            INFO(name << " in " << quote);
            const std::string small = "small" + std::to_string(number++);
            const std::string command = "strata render " + quote + "{pack}" + quote +
                                        " --algorithm front_to_back --mistake one_pass_too_few -o {picture}";
            const std::string path = std::filesystem::exists(folder / "pwned") ? "" : "./" + name;
            const CommandResult ended = shell(folder, "strata reduce \"$PACK\" \"$COMMAND\" -o " + small,
                                              {.environment = {{"PACK", path}, {"COMMAND", command}}});
            INFO(ended.err);
            CHECK(ended.status == 0);
            CHECK_FALSE(std::filesystem::exists(folder / "pwned"));
        }
    }
    // The ending is part of the picture's name, and TMPDIR part of both names.
    CHECK(run_strata(folder, {"reduce", "pack", faulty, "--picture", ".exr;touch pwned", "-o", "none"}).status == 2);
    CHECK(run_strata(folder, {"reduce", "pack", faulty, "--picture", "/../x.exr", "-o", "none"}).status == 2);
    std::filesystem::create_directory(folder / "$(touch pwned)/tmp");
    CHECK(run_strata(folder, {"reduce", "pack", faulty, "-o", "none"},
                     {.environment = {{"TMPDIR", folder / "$(touch pwned)/tmp"}}})
              .err ==
          "strata: TMPDIR: folder: expected a name without blanks and other characters that a shell reads, found '" +
              (folder / "$(touch pwned)/tmp/strata-reduce-XXXXXX") + "'\n");
    CHECK_FALSE(std::filesystem::exists(folder / "none"));
    CHECK_FALSE(std::filesystem::exists(folder / "pwned"));
}

TEST_CASE("every command of a list that reduce runs is silent and has empty input") {
    const Folder folder;
    make_pack(folder);
    const CommandResult ended = shell(folder, "echo loud | strata reduce pack 'echo loud; echo loud >&2; cat; " +
                                                  faulty + "; echo loud >&2' -o small");
    CHECK(ended.status == 0);
    CHECK((ended.out + ended.err).find("loud") == std::string::npos);
}

TEST_CASE("a signal ends reduce and the command with its child processes and deletes the temporary folder") {
    const Folder folder;
    make_pack(folder);
    // A grandchild also holds the pipe open, and would write "late" if it survived.
    const CommandResult ended =
        shell(folder,
              "mkdir tmp; mkfifo pipe; for signal in INT TERM HUP; do\n"
              "TMPDIR=$PWD/tmp env --default-signal=INT strata reduce pack 'exec 3>pipe; trap \"\" INT TERM HUP; echo "
              "started >&3; touch {picture}.tmp; mkdir -p {picture}.d/e; sh -c \"sleep 20; echo late >&3\"; : {pack}' "
              "-o small &\n"
              "exec 4<pipe; read line <&4; kill -$signal $!; wait $!; echo $line $?; cat <&4; ls tmp\n"
              "done");
    CHECK(ended.out == "started 130\nstarted 143\nstarted 129\n");
    CHECK(ended.err == "strata: interrupted\nstrata: interrupted\nstrata: interrupted\n");
    CHECK_FALSE(std::filesystem::exists(folder / "small"));
}

TEST_CASE("a command that hangs is killed after --timeout together with processes that it leaves behind") {
    const Folder folder;
    make_pack(folder);
    const CommandResult late = shell(
        folder,
        "mkdir tmp; mkfifo pipe; cat pipe > seen & TMPDIR=$PWD/tmp strata reduce pack 'exec 3>pipe; sh -c \"sleep 20; "
        "echo late >&3\"; : {pack} {picture}' --timeout 0.2 -o small; echo $?; wait; cat seen; ls tmp");
    CHECK(late.out == "2\n");
    CHECK(late.err.ends_with(": end: expected exit status 0 and a picture, found no end within 0.2 s (--timeout)\n"));
    const CommandResult behind = shell(
        folder, "cat pipe > seen & TMPDIR=$PWD/tmp strata reduce pack '(exec 3>pipe; sleep 20; echo late >&3) & " +
                    faulty + "' -o small > /dev/null; echo $?; wait; cat seen; ls tmp");
    CHECK(behind.out == "0\n");
    CHECK(run_strata(folder, {"reduce", "pack", faulty, "--timeout", "0", "-o", "none"}).err ==
          "strata: --timeout: expected a number of seconds above 0, at most 86400, found '0'\n");
}
