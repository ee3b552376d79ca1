// strata/compare.h - compares pictures of a program under test with reference pictures.
//
// Rule     `compare` returns the kinds of differences. `check` also formats them as one message for a failed test, and
//          writes pictures to a folder: NAME.side.png with reference, candidate, heat map and map of kinds side by
//          side, and NAME.candidate.npy with the codes of the candidate's first target. The folder is the environment
//          variable STRATA_PICTURES, or by default strata-pictures in the current folder. Nothing is written for equal
//          pictures.
// Tests    tests/tools/library/matchers_test.cpp
#pragma once
#include <string>

#include "strata/picture.h"
#include "tools/oracle/compare/compare.h"
#include "tools/oracle/compare/report.h"

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

}  // namespace v0_1
}  // namespace strata
