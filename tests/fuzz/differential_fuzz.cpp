// tests/fuzz/differential_fuzz.cpp - libFuzzer's entry: makes a frame from the bytes, which every execution and
// instruction set must draw alike. Run: differential_fuzz CORPUS
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/differential.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (!strata::fuzz::check({data, size}, std::cerr)) std::abort();
    return 0;
}
