// Tests which pictures of two folders belong together. The files are empty: their names alone count.
#include "tools/oracle/folders/picture_folders.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "rasterizer/base/input_error.h"
#include "tests/tools/oracle/folders/two_folders.h"

using namespace strata;
using namespace strata::oracle;
using namespace strata::test;

namespace {

// "name: reference,reference|candidate" of every name.
std::vector<std::string> lines_of(const PairedFolders& found) {
    std::vector<std::string> lines;
    for (const NamedPictures& named : found.pictures) {
        std::string line = named.name + ": ";
        for (const std::string& path : named.references) line += (line.ends_with(' ') ? "" : ",") + path;
        lines.push_back(line + "|" + named.candidate);
    }
    return lines;
}

using Lines = std::vector<std::string>;

}  // namespace

TEST_CASE("without patterns pictures of the same path belong together and other files are left out") {
    const TwoFolders folders;
    for (const char* path : {"b.png", "ui/a.exr", "gone.tif", ".hidden.png", ".git/x.png", "notes.txt"})
        folders.write_reference(path, "");
    for (const char* path : {"b.png", "ui/a.exr", "added.NPY", "b.png.json"}) folders.write_candidate(path, "");
    const PairedFolders found = pair_folders(folders.reference(), folders.candidate(), {});
    CHECK(lines_of(found) ==
          Lines{"added.NPY: |added.NPY", "b.png: b.png|b.png", "gone.tif: gone.tif|", "ui/a.exr: ui/a.exr|ui/a.exr"});
    CHECK(found.left_out == 2);
}

TEST_CASE("patterns choose the files and their names, also in one folder") {
    const TwoFolders folders;
    for (const char* path : {"a-expected.png", "a-actual.png", "a-diff.png", "b-expected.png"})
        folders.write_reference(path, "");
    const PairedFolders found = pair_folders(
        folders.reference(), folders.reference(),
        {.reference = name_pattern("{name}-expected.png"), .candidate = name_pattern("{name}-actual.png")});
    CHECK(lines_of(found) == Lines{"a: a-expected.png|a-actual.png", "b: b-expected.png|"});
}

TEST_CASE("in one folder no candidate is a baseline and no further baseline is a candidate") {
    const TwoFolders folders;
    for (const char* path : {"a-expected.png", "a-actual.png", "b-actual.png", "a-win.png", "note.txt"})
        folders.write_reference(path, "");
    const std::vector<NamePattern> any{*name_pattern("{name}-*.png")};
    const PairedFolders found = pair_folders(folders.reference(), folders.reference(),
                                             {.reference = name_pattern("{name}-expected.png"),
                                              .candidate = name_pattern("{name}-actual.png"),
                                              .baselines = any});
    CHECK(lines_of(found) == Lines{"a: a-expected.png,a-win.png|a-actual.png", "b: |b-actual.png"});
    CHECK(found.left_out == 1);
    const std::vector<NamePattern> win{*name_pattern("{name}-win.png")};
    CHECK(lines_of(pair_folders(folders.reference(), folders.reference(), {.baselines = win})) ==
          Lines{"a-actual.png: a-actual.png|a-actual.png", "a-expected.png: a-expected.png|a-expected.png",
                "a.png: a-win.png|", "b-actual.png: b-actual.png|b-actual.png"});
    CHECK(lines_of(pair_folders(folders.reference(), folders.reference(),
                                {.reference = name_pattern("{name}.png"),
                                 .candidate = name_pattern("{name}-actual.png"),
                                 .baselines = {}})) ==
          Lines{"a: |a-actual.png", "a-expected: a-expected.png|", "a-win: a-win.png|", "b: |b-actual.png"});
}

TEST_CASE("further baselines come after the picture of the name itself") {
    const TwoFolders folders;
    for (const char* path : {"a@win.png", "a.png", "a@mac.png", "b@mac.png", "c.png"})
        folders.write_reference(path, "");
    for (const char* path : {"a.png", "b.png", "c.png"}) folders.write_candidate(path, "");
    const std::vector<NamePattern> baselines{*name_pattern("{name}@*.png")};
    CHECK(lines_of(pair_folders(folders.reference(), folders.candidate(), {.baselines = baselines})) ==
          Lines{"a.png: a.png,a@mac.png,a@win.png|a.png", "b.png: b@mac.png|b.png", "c.png: c.png|c.png"});
    CHECK(lines_of(pair_folders(folders.reference(), folders.candidate(),
                                {.reference = name_pattern("{name}.png"),
                                 .candidate = name_pattern("{name}.png"),
                                 .baselines = baselines})) ==
          Lines{"a: a.png,a@mac.png,a@win.png|a.png", "b: b@mac.png|b.png", "c: c.png|c.png"});
    // Without the pattern they are pictures of their own.
    CHECK(pair_folders(folders.reference(), folders.candidate(), {}).pictures.size() == 6);
}

TEST_CASE("a folder in the other one is no part of it") {
    const TwoFolders folders;
    folders.write_reference("a.png", "");
    folders.write_reference("out/a.png", "");
    CHECK(lines_of(pair_folders(folders.reference(), folders.reference() + "/out", {})) == Lines{"a.png: a.png|a.png"});
    CHECK(lines_of(pair_folders(folders.reference() + "/out/", folders.reference() + "/", {})) ==
          Lines{"a.png: a.png|a.png"});
}

TEST_CASE("folders without pictures and two pictures of one name are refused") {
    const TwoFolders folders;
    folders.write_reference("a.txt", "");
    CHECK_THROWS_WITH(pair_folders(folders.reference(), folders.candidate(), {}),
                      Catch::Contains("names: expected a picture in one of the two folders, found 1 other file"));
    CHECK_THROWS_AS(pair_folders(folders.reference() + "/none", folders.candidate(), {}), InputError);
    folders.write_candidate("a.png", "");
    folders.write_candidate("a.exr", "");
    CHECK_THROWS_WITH(pair_folders(folders.reference(), folders.candidate(),
                                   {.reference = name_pattern("{name}.*"), .candidate = name_pattern("{name}.*")}),
                      Catch::Contains("names: expected one picture named a, found a.exr and a.png"));
}
