// tools/oracle/pack/pack_pictures.h - reads the expected targets of a golden pack, and a candidate's, as images to
// compare.
//
// Rule     tools/oracle/pack/PACK.md, "A candidate": names are the pack's; parts missing from a candidate are omitted.
// Tests    tests/tools/oracle/pack/pack_pictures_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/passes/passes.h"
#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// A target's format by its name; `file` is for errors.
[[nodiscard]] pipeline::Format format_named(const std::string& name, const std::string& file);

struct PassPicture {
    int number = 0, iteration = 0;
    std::string kind{};  // "geometry", "full_screen"
    Picture targets{};
    bool has_own = false;  // has its own file: some target differs from its value after earlier passes
};

// The images of one algorithm. An image without targets is missing from the candidate.
struct PackPictures {
    std::string algorithm{};
    Picture picture{};  // targets "color" and "depth"
    Picture layers{};   // parts from near to far, with "color" and "depth" each
    std::vector<PassPicture> passes{};
};

// For every algorithm of the pack at `path`.
[[nodiscard]] std::vector<PackPictures> expected_pictures(const std::string& path);
// For the algorithms of which the candidate, a folder or another pack, has any file. InputError if there are none.
[[nodiscard]] std::vector<PackPictures> candidate_pictures(const std::string& pack, const std::string& candidate);

}  // namespace strata::oracle
