// strata/compare.h - pictures of a program under test against reference pictures, for its own tests.
//
// Rule     `compare` tells kinds of mistakes; `check` also puts them into one message for a failed test, and leaves
//          pictures behind in a folder: NAME.side.png with reference, candidate, heat map and map of kinds side by
//          side, and NAME.candidate.npy with the codes of the candidate's first target. The folder is STRATA_PICTURES
//          of the environment, else strata-pictures in the current folder. Equal pictures leave nothing.
// Tests    tests/tools/library/matchers_test.cpp
#pragma once
#include <string>

#include "strata/picture.h"
#include "tools/oracle/compare.h"
#include "tools/oracle/report.h"

namespace strata {
inline namespace v0_1 {

// compare(reference, candidate, tolerances): exact unless tolerances say otherwise. InputError for pictures of unequal
// size and for those that share no target.
using oracle::compare;
using oracle::Comparison;
using oracle::Tolerances;

// What a picture under test is measured by: a file, a golden pack, or a picture made by render().
class Reference {
  public:
    // A pack is named by its folder or its manifest.json. `algorithm` chooses among the pack's; InputError lists them
    // if it is none of them, or is "" where there are several.
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
    // "differs from teapot.exr: color at 118 pixels, first at (17, 20); ...; pictures: /.../teapot.side.png"
    std::string message{};
};

// Never throws for pictures that cannot be compared: that is a failure with a message.
[[nodiscard]] Checked check(const Picture& candidate, const Reference& reference, const Tolerances& tolerances = {});

}  // namespace v0_1
}  // namespace strata
