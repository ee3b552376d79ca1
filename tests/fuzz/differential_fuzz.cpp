// tests/fuzz/differential_fuzz.cpp - any bytes make a frame that every execution and instruction set draws alike.
// Run: differential_fuzz CORPUS
#include <cstdlib>
#include <iostream>

#include "tests/fuzz/differential.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (!strata::fuzz::check({data, size}, std::cerr)) std::abort();
    return 0;
}
