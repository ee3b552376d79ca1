// tools/oracle/program/drawing/fit_drawings.h - is a picture that of the scene drawn in another way: with another
// opaque pass, or on another grid of positions?
//
// Rule     The right program runs on the lists of each other drawing, and is proved as any program is (prove.h), on all
//          pixels, those at edges too. Where none explains the picture, one plain edit (pairs.h) is tried on each
//          of them; and where one costs less than 0.8 of the right drawing, one more edit is searched on its lists.
// Tests    tests/tools/oracle/program/drawing_test.cpp
#pragma once
#include "tools/oracle/program/drawing/opaque_pass.h"
#include "tools/oracle/program/fit/fitting.h"

namespace strata::oracle::program {

// `given`: the lists of the right drawing, of all pixels, `right`: the fitness of the
// right program on them, if it is known.
[[nodiscard]] Fitting fit_drawings(const Lists& given, const std::vector<OtherLists>& others,
                                   const Fitness* right = nullptr);

// The lists of a scene in all ways of drawing that are known.
[[nodiscard]] std::vector<OtherLists> other_drawings(const peeling::FrameRequest& input, const Lists& given,
                                                     const verdict::Colors& candidate);

}  // namespace strata::oracle::program
