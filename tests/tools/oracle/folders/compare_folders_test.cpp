// Tests the cases of two folders. The pictures are PPM files of a few pixels whose bytes are written here.
#include "tools/oracle/folders/compare_folders.h"

#include <catch2/catch.hpp>

#include "tests/tools/oracle/folders/two_folders.h"
#include "tools/oracle/folders/folders_report.h"

using namespace strata::oracle;
using namespace strata::test;

namespace {

// Grey pixels of one row.
std::string ppm(const std::string& greys) {
    std::string bytes = "P6\n" + std::to_string(greys.size()) + " 1\n255\n";
    for (const char grey : greys) bytes += std::string(3, grey);
    return bytes;
}

std::vector<std::string> lines_of(const TwoFolders& folders, FolderQuestion question = {}) {
    const auto read = [](const std::string& path) { return read_picture(path); };
    question.reference = folders.reference();
    question.candidate = folders.candidate();
    question.read_reference = question.read_candidate = read;
    std::vector<std::string> lines;
    const FolderSummary summary = compare_folders(question, [&](FolderCase&& one) { lines.push_back(line_of(one)); });
    lines.insert(lines.begin(), first_line(summary));
    return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("each name is equal, different, missing, extra, of another size or unreadable") {
    const TwoFolders folders;
    folders.write_reference("a.ppm", ppm("abc"));
    folders.write_candidate("a.ppm", ppm("abc"));
    folders.write_reference("b.ppm", ppm("abc"));
    folders.write_candidate("b.ppm", ppm("aec"));
    folders.write_reference("c.ppm", ppm("abc"));
    folders.write_candidate("d.ppm", ppm("abc"));
    folders.write_reference("e.ppm", ppm("abc"));
    folders.write_candidate("e.ppm", ppm("abcd"));
    folders.write_reference("f.ppm", ppm("abc"));
    folders.write_candidate("f.ppm", "P6\n");
    const Lines lines = lines_of(folders);
    REQUIRE(lines.size() == 7);
    CHECK(lines[0] == "different: 5 of 6 pictures fail: 1 different, 1 other size, 1 missing, 1 extra, 1 unreadable");
    CHECK(lines[1] == "a.ppm: equal");
    CHECK_THAT(lines[2], Catch::StartsWith("b.ppm: different: 1 of 3 pixels differ by at most 3 codes; "));
    CHECK(lines[3] == "c.ppm: missing: the candidate's folder has no picture of this name");
    CHECK(lines[4] == "d.ppm: extra: the reference's folder has no picture of this name");
    CHECK_THAT(lines[5],
               Catch::Equals("e.ppm: other size: expected 3x1, the reference's size, found 4x1, equal where both "
                             "overlap, from the upper left corner"));
    CHECK_THAT(lines[6], Catch::StartsWith("f.ppm: unreadable: the candidate: "));
}

TEST_CASE("tolerances and budgets apply to each picture") {
    const TwoFolders folders;
    folders.write_reference("a.ppm", ppm("abcd"));
    folders.write_candidate("a.ppm", ppm("abce"));
    folders.write_reference("b.ppm", ppm("abcd"));
    folders.write_candidate("b.ppm", ppm("abyz"));
    const auto first = [&](const Tolerances& tolerances) {
        return lines_of(folders, {.tolerances = tolerances}).at(0);
    };
    CHECK(first({.color_codes = 1}) == "different: 1 of 2 pictures fails: 1 different");
    CHECK(first({.pixels = {.pixels = 1}}) == "different: 1 of 2 pictures fails: 1 different");
    CHECK(first({.pixels = {.pixels = 2}}) == "accepted: 2 of 2 pictures differ within the tolerance");
    CHECK(first({.pixels = {.share = 0.25}}) == "different: 1 of 2 pictures fails: 1 different");
}

TEST_CASE("a picture has to fit one of its baselines, and the report names that one or the nearest") {
    const TwoFolders folders;
    folders.write_reference("a.ppm", ppm("abcd"));
    folders.write_reference("a@mac.ppm", ppm("xbcd"));
    folders.write_reference("a@win.ppm", ppm("xyzw"));
    const PictureNames names{.baselines = {*name_pattern("{name}@*.ppm")}};
    const auto line = [&](const std::string& greys) {
        folders.write_candidate("a.ppm", ppm(greys));
        return lines_of(folders, {.names = names}).at(1);
    };
    CHECK(line("abcd") == "a.ppm: equal (baseline a.ppm)");
    CHECK(line("xyzw") == "a.ppm: equal (baseline a@win.ppm)");
    CHECK_THAT(line("xbce"), Catch::StartsWith("a.ppm: different (nearest of 3 baselines: a@mac.ppm): 1 of 4 pixels"));
    folders.write_candidate("a.ppm", ppm("xbce"));
    CHECK_THAT(lines_of(folders, {.names = names, .tolerances = {.color_codes = 1}}).at(1),
               Catch::StartsWith("a.ppm: accepted (baseline a@mac.ppm): "));
}

TEST_CASE("many pictures are taken in the order of their names") {
    const TwoFolders folders;
    Lines names;
    for (int i = 100; i < 170; ++i) {
        names.push_back(std::to_string(i) + ".ppm: equal");
        folders.write_reference(std::to_string(i) + ".ppm", ppm("abc"));
        folders.write_candidate(std::to_string(i) + ".ppm", ppm("abc"));
    }
    names.insert(names.begin(), "equal: 70 pictures");
    CHECK(lines_of(folders) == names);
}

TEST_CASE("NaN is named, and no budget of pixels accepts it") {
    const TwoFolders folders;
    const auto npy = [](std::uint32_t second) {
        const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 2, 3), }";
        std::string bytes = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header;
        bytes.resize(127, ' ');
        bytes += '\n';
        for (const std::uint32_t word : {0x3f000000u, 0x3f000000u, 0x3f000000u, second, 0x3f000000u, 0x3f000000u})
            for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(word >> shift & 0xff);
        return bytes;
    };
    folders.write_reference("a.npy", npy(0x3f000000));
    folders.write_candidate("a.npy", npy(0x7fc00000));
    CHECK_THAT(lines_of(folders, {.tolerances = {.pixels = {.pixels = 2}}}).at(1),
               Catch::StartsWith("a.npy: different: 1 of 2 pixels differ; NaN at 0 pixels of the reference and 1 of "
                                 "the candidate, first at 1,0"));
    CHECK_THAT(lines_of(folders, {.tolerances = {.not_finite = {.pixels = 1}}}).at(1),
               Catch::StartsWith("a.npy: accepted: "));
}

TEST_CASE("test cases of a CI fail with the sentence of the case") {
    const FolderCase failed{.name = "a.png", .state = CaseState::missing, .sentence = "none"};
    CHECK(junit_case(failed).failure == "missing: none");
    CHECK(junit_case(failed).name == "a.png");
    CHECK(line_of({.name = "a\nb.png"}) == "a\\x0ab.png: equal");
    CHECK(junit_case({.name = "b.png", .state = CaseState::accepted, .sentence = "some"}).failure.empty());
}
