// tools/oracle/pack/pack_pictures.h - what a golden pack expects and what a candidate holds of it, as pictures to
// compare.
//
// Rule     tools/oracle/PACK.md, "A candidate": names are the pack's; what a candidate has not is left out.
// Tests    tests/tools/oracle/pack_pictures_test.cpp
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "tools/oracle/passes.h"
#include "tools/oracle/picture.h"

namespace strata::oracle {

// A target's format by its name; `file` is where it stands.
[[nodiscard]] pipeline::Format format_named(const std::string& name, const std::string& file);

struct PassPicture {
    int number = 0, iteration = 0;
    std::string kind{};  // "geometry", "full_screen"
    Picture targets{};
    bool has_own = false;  // a file of its own: some target is not as earlier passes left it
};

// One algorithm's. A picture without targets is one that the candidate has not.
struct PackPictures {
    std::string algorithm{};
    Picture picture{};  // targets "color" and "depth"
    Picture layers{};   // parts from near to far, "color" and "depth" each
    std::vector<PassPicture> passes{};
};

// Of every algorithm of the pack at `path`.
[[nodiscard]] std::vector<PackPictures> expected_pictures(const std::string& path);
// Of those that the candidate, a folder or another pack, has anything of. InputError if that is none.
[[nodiscard]] std::vector<PackPictures> candidate_pictures(const std::string& pack, const std::string& candidate);

}  // namespace strata::oracle
