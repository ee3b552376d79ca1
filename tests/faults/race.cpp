// tests/faults/race.cpp - two ways of adding up in a parallel loop, under the thread sanitizer: `race shared` has every
// index add to one number, which is a race; `race own` gives each index a place of its own, as parallel.h asks. The
// sanitizer must tell the first and be silent about the second, or its silence about the product means nothing. All
// four indices meet at a latch first, so that each has a thread of its own.
#include <cstdio>
#include <cstring>
#include <latch>
#include <numeric>
#include <vector>

#include "rasterizer/base/parallel.h"

int main(int count, char** words) {
    const bool is_shared = count == 2 && std::strcmp(words[1], "shared") == 0;
    std::vector<int> place(4);
    std::latch all_there{4};
    strata::parallel_for(place.size(), 4, [&](std::size_t i) {
        all_there.arrive_and_wait();
        ++place[is_shared ? 0 : i];
    });
    const int sum = std::accumulate(place.begin(), place.end(), 0);
    std::printf("%d\n", sum);
    return is_shared || sum == 4 ? 0 : 1;
}
