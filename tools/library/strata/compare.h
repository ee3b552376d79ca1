// strata/compare.h - compares pictures of a program under test with reference pictures.
//
// Rule     `compare` returns the kinds of differences. `check` also formats them as one message for a failed test, and
//          writes pictures to a folder: NAME.side.png with reference, candidate, heat map and map of kinds side by
//          side, and NAME.candidate.npy with the codes of the candidate's first target. The folder is the environment
//          variable STRATA_PICTURES, or by default strata-pictures in the current folder. Nothing is written for equal
//          pictures.
//          `compare_folders` compares two folders of pictures, and writes nothing.
// Tests    tests/tools/library/matchers_test.cpp, folders_test.cpp
#pragma once
#include <string>
#include <vector>

#include "strata/picture.h"
#include "tools/oracle/compare/compare.h"
#include "tools/oracle/compare/report.h"
#include "tools/oracle/folders/compare_folders.h"

namespace strata {
inline namespace v0_1 {

// compare(reference, candidate, tolerances): exact unless tolerances are given. Throws InputError for pictures of
// unequal size or without a common target.
using oracle::compare;
using oracle::Comparison;
using oracle::Tolerances;

// The reference for a picture under test: a file, a golden pack, or a picture made by render().
class Reference {
  public:
    // A pack is named by its folder or its manifest.json. `algorithm` selects one of its results; throws InputError,
    // which lists them, if there is no such algorithm, or if it is "" and the pack has several.
    Reference(const std::string& path, const std::string& algorithm = "");  // NOLINT: a path is a reference
    Reference(const char* path) : Reference(std::string{path}) {}           // NOLINT
    Reference(Picture picture, std::string name);
    [[nodiscard]] const Picture& picture() const noexcept { return picture_; }
    [[nodiscard]] const std::string& name() const noexcept { return name_; }

  private:
    Picture picture_;
    std::string name_;
};

// "64x48 color of 4 x unorm8, depth of 1 x unorm24"
[[nodiscard]] std::string size_text(const Picture& picture);

struct Checked {
    bool is_accepted = false;
    // For example "differs from teapot.exr: color at 118 pixels, first at (17, 20); ...; pictures:
    // /.../teapot.side.png".
    std::string message{};
};

// Does not throw for pictures that cannot be compared: these are a failure with a message.
[[nodiscard]] Checked check(const Picture& candidate, const Reference& reference, const Tolerances& tolerances = {});

// The pictures of two folders, by name, as `strata compare FOLDER FOLDER` compares them.
struct ComparedFolders {
    oracle::FolderSummary summary{};
    std::vector<oracle::FolderCase> cases{};  // in the order of names
    [[nodiscard]] bool is_accepted() const noexcept { return summary.failed() == 0; }
};

// Which files are pictures: patterns with commas between, as the options --names and --baselines have them.
struct FolderNames {
    std::string names{}, baselines{};
};

// Throws InputError for a folder that cannot be read, for two without a picture, and for a text without {name}.
[[nodiscard]] ComparedFolders compare_folders(const std::string& reference, const std::string& candidate,
                                              const Tolerances& tolerances = {}, const FolderNames& names = {});
// What the command prints, with --json, and writes by --junit.
[[nodiscard]] std::string to_text(const ComparedFolders& compared);
[[nodiscard]] std::string to_json(const ComparedFolders& compared);
[[nodiscard]] std::string to_junit(const ComparedFolders& compared);

}  // namespace v0_1
}  // namespace strata
