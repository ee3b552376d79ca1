// tools/oracle/picture/other_size.h - how a picture of another size is related to the reference: scaled, transposed,
// turned, cut, with a border, or equal where both overlap.
//
// Rule     Two pixels agree if all colours that both have differ by at most 1/255. A picture is scaled by 2, 3 or 4, or
//          transposed or turned by 90 degrees, if all pixels agree. One of the two is cut from the other if it lies
//          somewhere in it and all its pixels agree: the first such place by rows counts, and only 64 places at which
//          32 pixels of rare colours agree are tried. Otherwise the pixels that agree are counted where the two
//          overlap, from the upper left corner.
// Tests    tests/tools/oracle/picture/other_size_test.cpp
#pragma once
#include <string>

#include "tools/oracle/picture/picture.h"

namespace strata::oracle {

// "48x32, the reference scaled by 2": the candidate's size, which is not the reference's.
[[nodiscard]] std::string size_in_words(const TargetImage& reference, const TargetImage& candidate);

}  // namespace strata::oracle
