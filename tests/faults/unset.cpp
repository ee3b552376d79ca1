// tests/faults/unset.cpp - two ways with a vector whose elements have no value yet, under the memory sanitizer: `unset
// read` decides by an uninitialised one, `unset write` writes it first. The sanitizer must tell the first and be silent
// about the second.
#include <cstdio>
#include <cstring>

#include "rasterizer/base/uninitialized.h"

int main(int count, char** words) {
    strata::UninitializedVector<int> numbers(4);
    if (count == 2 && std::strcmp(words[1], "write") == 0) numbers[3] = count;
    for (int i = 0; i < numbers[3]; ++i) std::puts("one more");
}
