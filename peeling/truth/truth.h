// peeling/truth/truth.h - a picture as the numbers of a chain: with every link exact, the truth that errors are
// measured from.
//
// Rule     A pixel's opaque surface is the nearest of the opaque fragments (LESS); of the transparent ones those in
//          front of it count, nearest first, and of equal depths the first submitted. blend: D = alpha c + (1 - alpha)
//          D from the far end. The numbers are those that codes stand for, where a link stores codes.
// Source   audit.md 14.
// Tests    tests/peeling/truth/truth_test.cpp, chain_test.cpp
#pragma once
#include "peeling/truth/chain_list.h"
#include "peeling/truth/real_image.h"

namespace strata::peeling {

// Throws InputError for a list with a light: shadow maps are the machine's alone.
[[nodiscard]] RealImage render_chain(const ChainScene& scene, const Chain& chain);

}  // namespace strata::peeling
