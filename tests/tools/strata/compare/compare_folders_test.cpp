// Tests `strata compare FOLDER FOLDER` with PPM files whose bytes are written here.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.h"

using namespace strata::test;
using Catch::Contains;

namespace {

void write(const Folder& folder, const std::string& path, const std::string& bytes) {
    std::filesystem::create_directories(std::filesystem::path(folder / path).parent_path());
    std::ofstream{folder / path, std::ios::binary} << bytes;
}

// Two pixels.
std::string ppm(char first, char second) { return "P6\n2 1\n255\n" + std::string(3, first) + std::string(3, second); }

// One equal, one different, one missing and one extra picture.
void write_folders(const Folder& folder) {
    write(folder, "old/one.ppm", ppm('a', 'b'));
    write(folder, "new/one.ppm", ppm('a', 'b'));
    write(folder, "old/two.ppm", ppm('a', 'b'));
    write(folder, "new/two.ppm", ppm('a', 'c'));
    write(folder, "old/gone.ppm", ppm('a', 'b'));
    write(folder, "new/added.ppm", ppm('a', 'b'));
}

std::size_t number_of(const std::string& text, const std::string& part) {
    std::size_t number = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++number;
    return number;
}

}  // namespace

TEST_CASE("two folders of pictures have a line, a test case and an entry of the page for each name") {
    const Folder folder;
    write_folders(folder);
    const CommandResult ended =
        run_strata(folder, {"compare", "old", "new/", "--junit", "report.xml", "--report", "page.html"});
    INFO(ended.err);
    CHECK(ended.status == 1);
    const auto lines = lines_of(ended.out);
    REQUIRE(lines.size() == 5);
    CHECK(lines[0] == "different: 3 of 4 pictures fail: 1 different, 1 missing, 1 extra");
    CHECK(lines[1] == "added.ppm: extra: the reference's folder has no picture of this name");
    CHECK(lines[2] == "gone.ppm: missing: the candidate's folder has no picture of this name");
    CHECK(lines[3] == "one.ppm: equal");
    CHECK_THAT(lines[4], Catch::StartsWith("two.ppm: different: 1 of 2 pixels differ by at most 1 code; "));
    const std::string cases = content_of(folder / "report.xml");
    CHECK_THAT(cases,
               Contains("tests=\"4\" failures=\"3\"") && Contains("name=\"one.ppm\"/>") &&
                   Contains("<failure message=\"missing: the candidate's folder has no picture of this name\"/>"));
    const std::string page = content_of(folder / "page.html");
    CHECK(number_of(page, "<h1>Different</h1>") == 1);
    CHECK(number_of(page, "<p>strata compare old new</p>") == 1);
    CHECK(number_of(page, "<img src=\"data:image/png;base64,") == 3);  // of two.ppm
    for (const char* name : {"added.ppm", "gone.ppm", "one.ppm", "two.ppm"}) {
        INFO(name);
        CHECK(number_of(page, "<td>" + std::string(name) + "</td>") >= 1);
    }
    CHECK(page.find(folder / "") == std::string::npos);
}

TEST_CASE("two folders exit with 0 if every picture is accepted and their JSON says why") {
    const Folder folder;
    write(folder, "old/two.ppm", ppm('a', 'b'));
    write(folder, "new/two.ppm", ppm('a', 'c'));
    const CommandResult accepted = run_strata(folder, {"compare", "old", "new", "--tolerance", "color=1", "--json"});
    CHECK(accepted.status == 0);
    const auto document = nlohmann::json::parse(accepted.out);
    CHECK(document["accepted"] == true);
    CHECK(document["equal"] == false);
    CHECK(document["states"]["accepted"] == 1);
    CHECK(document["cases"].at(0)["name"] == "two.ppm");
    CHECK(document["cases"].at(0)["comparison"]["differing"] == 1);
    CHECK(run_strata(folder, {"compare", "new", "new"}).out == "equal: 1 picture\ntwo.ppm: equal\n");
}

TEST_CASE("patterns pair the pictures of one folder as test suites name them") {
    const Folder folder;
    write(folder, "out/menu-expected.ppm", ppm('a', 'b'));
    write(folder, "out/menu-actual.ppm", ppm('x', 'b'));
    write(folder, "out/menu-expected@mac.ppm", ppm('x', 'b'));
    const std::vector<std::string> words{"compare", "out", "out", "--names", "{name}-expected.ppm,{name}-actual.ppm"};
    CHECK(run_strata(folder, words).status == 1);
    std::vector<std::string> more = words;
    more.insert(more.end(), {"--baselines", "{name}-expected@*.ppm"});
    CHECK(run_strata(folder, more).out == "equal: 1 picture\nmenu: equal (baseline menu-expected@mac.ppm)\n");
}

TEST_CASE("the page of two folders names no path of this machine and shows 100 failed cases at most") {
    const Folder folder;
    for (int i = 0; i < 103; ++i) {
        write(folder, "old/" + std::to_string(i) + ".ppm", ppm('a', 'b'));
        write(folder, "new/" + std::to_string(i) + ".ppm", i == 0 ? "P6\n" : ppm('a', 'c'));
    }
    write(folder, "new/1.ppm", "P6\n1 1\n255\nabc");
    const CommandResult ended =
        run_strata(folder, {"compare", folder / "old", folder / "new", "--report", "page.html", "--junit", "c.xml"});
    CHECK(ended.status == 1);
    CHECK(lines_of(ended.out).at(0) ==
          "different: 103 of 103 pictures fail: 101 different, 1 other size, 1 unreadable");
    const std::string page = content_of(folder / "page.html");
    CHECK_THAT(page, Contains("<p>3 more failed cases are shown in the table alone, to keep this page small.</p>"));
    CHECK(number_of(page, "<h2>") == 101);
    for (const std::string& text : {page, content_of(folder / "c.xml"), ended.out})
        CHECK(text.find(folder.path().string()) == std::string::npos);
}

TEST_CASE("many pictures of two folders take no more memory than a few") {
    const Folder folder;
    const std::string pixels(std::size_t{3} * 256 * 256, 'a');
    for (int i = 0; i < 64; ++i)
        for (const char* name : {"old/", "new/"})
            write(folder, name + std::to_string(i) + ".ppm", "P6\n256 256\n255\n" + pixels);
    for (const char* name : {"few/0.ppm", "few/1.ppm"}) write(folder, name, "P6\n256 256\n255\n" + pixels);
    const std::uint64_t few = peak_of_strata(folder, {"compare", "few", "few"});
    const std::uint64_t many = peak_of_strata(folder, {"compare", "old", "new"});
    INFO(few << " and " << many);
    REQUIRE(few > 0);
    // The codes of all pictures take 100 MB.
    CHECK(many < few + (std::uint64_t{24} << 20));
}

TEST_CASE("folders that cannot be compared are refused with one sentence") {
    const Folder folder;
    write_folders(folder);
    std::filesystem::create_directories(folder / "none");
    const auto says = [&](std::vector<std::string> words) {
        words.insert(words.begin(), "compare");
        const CommandResult ended = run_strata(folder, words);
        CHECK(ended.status == 2);
        return ended.err;
    };
    CHECK(says({"none", "none"}) ==
          "strata: none: names: expected a picture in one of the two folders, found no file\n");
    CHECK_THAT(says({std::string(5000, 'n'), "new"}), Contains("no such file"));
    CHECK_THAT(says({"old", std::string(5000, 'n')}), Contains("no such folder"));
    CHECK(says({"old", "nowhere"}) == "strata: nowhere: no such folder\n");
    CHECK(says({"old", "new/one.ppm"}) ==
          "strata: new/one.ppm: type: expected a folder, as the reference is, found a file\n");
    CHECK(says({"old/one.ppm", "new"}) ==
          "strata: new: type: expected a picture, as the reference is, found a folder\n");
    CHECK(says({"old", "new", "--names", "*.ppm"}) ==
          "strata: --names: expected one or two patterns with {name} such as "
          "'{name}-expected.png,{name}-actual.png', found '*.ppm'\n");
    CHECK_THAT(says({"old", "new", "--heat", "heat.png"}), Contains("--heat"));
    CHECK_THAT(says({"old", "new", "--side", "side.png"}), Contains("--side"));
    CHECK_THAT(says({"old", "new", "--layout", "2x1:rgb8"}), Contains("--layout"));
    CHECK_THAT(says({"old/one.ppm", "new/one.ppm", "--names", "{name}.ppm"}), Contains("--names"));
    CHECK_THAT(says({"old", "new", "--tolerance", "depht=1"}), Contains("depht"));
}
