// tools/oracle/program/fit/pairs.h - plain edits, alone and in pairs: what a port did everywhere, and layers that it
// lost or doubled.
//
// Rule     Every entry with every candidate of its parameter and no condition, and layers left out or blended twice by
//          a flag or a rank. Each of them, or each two, run on some wrong and some right pixels, exactly, and are given
//          up when they cost too much.
// Tests    tests/tools/oracle/program/pairs_test.cpp
#pragma once
#include "tools/oracle/program/fit/solve.h"

namespace strata::oracle::program {

// The cheapest programs of so many plain edits, if they cost less than a quarter of the right program.
[[nodiscard]] std::vector<Program> plain_programs(const Lists& lists, std::size_t edits);

}  // namespace strata::oracle::program
