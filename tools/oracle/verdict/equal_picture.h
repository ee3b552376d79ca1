// tools/oracle/verdict/equal_picture.h - finds the algorithm whose own picture a candidate is, to the last code.
//
// Rule     The stated algorithm is tried first, then every exact one that treats fragments of one depth alike (keeps or
//          loses them), of several samples per pixel the usual ones alone; each in the given formats, then in those of
//          the candidate. A part of the picture is compared before the whole frame is rendered: the square with the
//          most fragments, or with the most pixels that are wrong otherwise.
// Tests    tests/tools/strata/compare/compare_scene_test.cpp, compare_samples_test.cpp
#pragma once
#include <string>

#include "peeling/frame_request.h"

namespace strata::oracle::verdict {

struct PictureQuestion;
class SceneFragments;

// The square of a grid with the most fragments.
[[nodiscard]] rasterizer::Rect fullest(const SceneFragments& scene);

// The algorithm's name; empty if there is none. `part` is compared first. Profiles that reject an algorithm are no
// error.
[[nodiscard]] std::string equal_algorithm(const peeling::FrameRequest& input, const PictureQuestion& question,
                                          const rasterizer::Rect& part);

}  // namespace strata::oracle::verdict
