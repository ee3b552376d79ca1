// tools/oracle/verdict/equal_picture.h - finds the algorithm whose own picture a candidate is, to the last code.
//
// Rule     The stated algorithm is tried first, then every exact one that treats fragments of one depth alike (keeps or
//          loses them); each in the given formats, then in those of the candidate. A square with many fragments is
//          compared before the whole frame is rendered.
// Tests    tests/tools/strata/compare/compare_scene_test.cpp, compare_samples_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "tools/oracle/run_input.h"

namespace strata::oracle::verdict {

struct PictureQuestion;
class SceneFragments;

// Its name; empty if there is none. Profiles that reject an algorithm are no error.
[[nodiscard]] std::string equal_algorithm(const RunInput& input, const PictureQuestion& question,
                                          const SceneFragments& scene);
// The same for several samples per pixel, of the stated algorithm or else of the usual ones. The square with the most
// of the pixels that are `wrong` otherwise is compared first.
[[nodiscard]] std::string equal_sampled_algorithm(const RunInput& input, const PictureQuestion& question,
                                                  const std::vector<std::uint32_t>& wrong);

}  // namespace strata::oracle::verdict
