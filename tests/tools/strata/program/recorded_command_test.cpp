// Tests that a command stored in a picture can do no harm. The test writes a picture whose command would succeed if it
// were executed, and checks that the folder's files are unchanged.
#include "tools/strata/recorded_command.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <map>

#include "scenes/files/image_io.h"
#include "tests/tools/program.h"
#include "tools/strata/options/shell_words.h"

using namespace strata::test;
using strata::tools::shell_word;
using strata::tools::shell_words;

namespace {

// Writes a picture of one black pixel with this command stored in it.
void write_picture(const std::string& path, const std::string& command) {
    strata::pipeline::Image pixel{strata::pipeline::Format::rgba8, 1, 1};
    pixel.codes[3] = 255;
    strata::scenes::write_image(path, {.color = pixel, .attributes = {{"command", command}}});
}

std::map<std::string, std::string> contents_of(const Folder& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file()) contents[entry.path().string()] = content_of(entry.path().string());
    return contents;
}

const std::string recorded_scene = "planes:count=2 --size 8x8";

}  // namespace

TEST_CASE("words are unchanged after quoting and splitting for a shell and a line with an open quote is rejected") {
    const std::vector<std::string> words{"a",    "",           "a b",        "it's", "$(touch pwned)",
                                         "`id`", "\"quoted\"", "--size=8x8", "\\n",  "a\nb\tc",
                                         "*?~",  "é",          "''",         ";"};
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
    CHECK(shell_words(line) == words);
    const Folder folder;
    std::string joined;
    for (const std::string& word : words) joined += word + "\n";
    CHECK(shell(folder, "printf '%s\\n' " + line).out == joined);  // the shell splits it the same way
    CHECK(shell_words("a  b ") == std::vector<std::string>{"a", "b"});
    CHECK_FALSE(shell_words("a 'b").has_value());
    CHECK(shell_word("planes:count=3,gap=1e-7") == "planes:count=3,gap=1e-7");
}

TEST_CASE("a picture's command writes nothing and only its options that choose what is drawn are used") {
    const Folder folder;
    for (const std::string name : {"victim.json", "victim.png", "victim.exr", "victim.html"})
        std::ofstream(folder / name) << "old";
    const std::string ending = GENERATE("png", "exr");
    for (const std::string verb : {"render", "layers"})
        for (const std::string words : {"--stats victim.json",
                                        "--stats=victim.json",
                                        "-o victim.png",
                                        "-ovictim.png",
                                        "--output victim.png",
                                        "--report victim.html",
                                        "--deep victim.exr",
                                        "--stats -",
                                        "--alpha --stats=victim.json",
                                        "--alpha 0.5 victim.png",
                                        "--no-light=false",
                                        "--algorithm dual --stats victim.json",
                                        "--size 8x8 -q",
                                        "--threads 1024",
                                        "--max-memory 1G",
                                        "--files-in /",
                                        "--from a.png",
                                        "--mistake culls_front -o victim.png",
                                        "--help",
                                        "--",
                                        "-- victim.png",
                                        "'--stats' victim.json",
                                        "--alpha"}) {
            INFO(verb << " " << words);
            write_picture(folder / ("a." + ending), "strata " + verb + " " + recorded_scene + " " + words);
            const auto before = contents_of(folder);
            const CommandResult ended = run_strata(folder, {verb, "--from", "a." + ending, "--no-audit"});
            CHECK(ended.status == 2);
            CHECK(lines_of(ended.err).size() == 1);
            CHECK(ended.out.empty());
            CHECK(contents_of(folder) == before);
        }
}

TEST_CASE("a picture's command names files in its own folder or in that of --files-in") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "mkdir own sub && strata list profiles --json geforce8 > chip.json && "
                  "cat > panes.json <<'END'\n"
                  "{\"positions\": [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]}\n"
                  "END\n"
                  "cat > camera.json <<'END'\n"
                  "{\"eye\": [0, 0, 5], \"center\": [0, 0, 0], \"up\": [0, 1, 0], \"fovy_degrees\": 33, \"near\": 2, "
                  "\"far\": 20}\n"
                  "END\n"
                  "cp panes.json chip.json camera.json sub; ln -s ../panes.json own/link.json; ln -s .. own/up")
                .status == 0);
    const auto run = [&](const std::string& words, const std::vector<std::string>& further = {}) {
        write_picture(folder / "own/a.png", "strata render " + words + " --size 8x8");
        std::vector<std::string> all{"render", "--from", "own/a.png", "--no-audit", "-o", "new.png"};
        all.insert(all.end(), further.begin(), further.end());
        const CommandResult ended = run_strata(folder, all);
        CHECK(std::filesystem::exists(folder / "new.png") == (ended.status == 0));
        std::filesystem::remove(folder / "new.png");
        return ended;
    };
    CHECK(run("-").err ==
          "strata: own/a.png: strata:command: expected the name of a scene, found '-': the scene came from standard "
          "input, and no file holds it\n");
    const std::string pwd = folder.path().string();
    for (const std::string& words :
         {std::string{"../panes.json"}, pwd + "/panes.json", std::string{"up/panes.json"}, std::string{"link.json"},
          std::string{"panes.json"}, std::string{"'../panes.json'"}, std::string{"teapot --profile ../chip.json"},
          std::string{"teapot --profile chip.json"}, "teapot --profile " + pwd + "/chip.json",
          std::string{"teapot --camera ../camera.json"}, std::string{"teapot --camera camera.json"},
          "teapot --camera " + pwd + "/camera.json", std::string{"teapot --camera up/camera.json"},
          std::string{"--size"}}) {
        INFO(words);
        const CommandResult ended = run(words);
        CHECK(ended.status == 2);
        CHECK(lines_of(ended.err).size() == 1);
    }
    const std::string words = "panes.json --profile chip.json --camera camera.json --alpha 0.5";
    CHECK(
        run(words).err ==
        "strata: own/a.png: strata:command: expected the file 'panes.json' in the folder own (--files-in FOLDER names "
        "another folder), found no such file\n");
    CHECK(run(words, {"--files-in", "sub"}).status == 0);
    CHECK(run(words, {"--files-in=."}).status == 0);
    for (const char* const name : {"panes.json", "chip.json", "camera.json"})
        std::filesystem::copy(folder / name, folder.path() / "own" / name);
    CHECK(run(words).status == 0);
    CHECK(run_strata(folder, {"render", "teapot", "--files-in", "sub"}).err ==
          "strata: --files-in is valid only with --from\n");
}

TEST_CASE("an option beside --from replaces the recorded one, and --orbit replaces --camera") {
    const Folder folder;
    const auto pixels = [&](const std::string& line) {
        const CommandResult ended = shell(folder, "strata render " + line + " --no-audit -q -o out.exr");
        INFO(line << ended.err);
        REQUIRE(ended.status == 0);
        std::ifstream file{folder / "out.exr", std::ios::binary};
        return std::string{std::istreambuf_iterator<char>{file}, {}};
    };
    REQUIRE(shell(folder, "strata render teapot --size 32x24 --orbit 10,20 --background 1,1,1 -q --no-audit -o a.png")
                .status == 0);
    const std::string from = "--from a.png ";
    CHECK(pixels(from) == pixels("teapot --size 32x24 --orbit 10,20 --background 1,1,1"));
    CHECK(pixels(from + "--size 24x16") == pixels("teapot --size 24x16 --orbit 10,20 --background 1,1,1"));
    CHECK(pixels(from + "--background=0,0,1 --orbit 40,5") ==
          pixels("teapot --size 32x24 --orbit 40,5 --background 0,0,1"));
    std::ofstream{folder / "c.json"}
        << R"({"eye": [0, 1, 9], "center": [0, 1, 0], "up": [0, 1, 0], "fovy_degrees": 30, "near": 1, "far": 20})";
    CHECK(pixels(from + "--camera c.json") == pixels("teapot --size 32x24 --camera c.json --background 1,1,1"));
}

TEST_CASE("a picture is redrawn whatever the name of its scene and from a pack with the pack's own state") {
    const Folder folder;
    REQUIRE(shell(folder,
                  "cat > \"it's \\$(touch pwned) --stats x.json\" <<'END'\n"
                  "{\"positions\": [[-1, -1, 0], [1, -1, 0], [0, 1, 0]]}\n"
                  "END\n"
                  "strata render \"it's \\$(touch pwned) --stats x.json\" --alpha 0.5 --size 16x16 -o a.png")
                .status == 0);
    const CommandResult again = run_strata(folder, {"render", "--from", "a.png", "-o", "b.png"});
    INFO(again.err);
    CHECK(again.status == 0);
    CHECK(content_of(folder / "a.png") == content_of(folder / "b.png"));
    // The line that info prints can be executed by a shell.
    CHECK(shell(folder, "sh -c \"$(strata info a.png | head -1) -o c.png\"").status == 0);
    CHECK(content_of(folder / "a.png") == content_of(folder / "c.png"));
    CHECK_FALSE(std::filesystem::exists(folder / "pwned"));

    REQUIRE(shell(folder,
                  "strata golden planes:count=2 --color-space linear --background 0.2,0.3,0.5 --profile geforce8_dx101 "
                  "--size 8x8 "
                  "-o pack && "
                  "strata render pack -o d.png && strata render --from d.png -o e.png")
                .status == 0);
    CHECK(content_of(folder / "d.png") == content_of(folder / "e.png"));
}
