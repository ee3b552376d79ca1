// peeling/truth/truth.h - the image that a chain computes; with every link exact, it is the truth from which errors are
// measured.
//
// Rule     A pixel's opaque surface is the nearest of the opaque fragments (LESS); the transparent fragments in front
//          of it are composited, sorted nearest first, and at equal depth the first submitted first. blend: D = alpha c
//          + (1 - alpha) D from the far end. If a link stores codes, the results are the values of those codes.
// Source   peeling/reference/audit.md 14.
// Tests    tests/peeling/truth/truth_test.cpp, chain_test.cpp
#pragma once
#include "peeling/truth/chain_list.h"
#include "peeling/truth/real_image.h"

namespace strata::peeling {

// Throws InputError for a list with a light: shadow maps exist only on the emulated device.
[[nodiscard]] RealImage render_chain(const ChainScene& scene, const Chain& chain);

}  // namespace strata::peeling
