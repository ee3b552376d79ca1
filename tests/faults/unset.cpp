// tests/faults/unset.cpp - shows that the memory sanitizer detects a read of an uninitialised element. `unset read`
// branches on an element that was not written and must be reported; `unset write` writes it first and must not be
// reported.
#include <cstdio>
#include <cstring>

#include "rasterizer/base/uninitialized.h"

int main(int count, char** words) {
    strata::UninitializedVector<int> numbers(4);
    if (count == 2 && std::strcmp(words[1], "write") == 0) numbers[3] = count;
    for (int i = 0; i < numbers[3]; ++i) std::puts("one more");
}
