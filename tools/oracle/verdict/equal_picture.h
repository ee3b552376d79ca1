// tools/oracle/verdict/equal_picture.h - finds the algorithm whose own picture a candidate is, to the last code.
//
// Rule     The stated algorithm is tried first, then every exact one that treats fragments of one depth alike (keeps or
//          loses them); each in the given formats, then in those of the candidate. A square with many fragments is
//          compared before the whole frame is rendered.
// Tests    tests/tools/strata/compare/compare_scene_test.cpp
#pragma once
#include <string>

#include "tools/oracle/run_input.h"

namespace strata::oracle::verdict {

struct PictureQuestion;
class SceneFragments;

// Its name; empty if there is none. Profiles that reject an algorithm are no error.
[[nodiscard]] std::string equal_algorithm(const RunInput& input, const PictureQuestion& question,
                                          const SceneFragments& scene);

}  // namespace strata::oracle::verdict
