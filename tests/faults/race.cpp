// tests/faults/race.cpp - shows that the thread sanitizer detects a race in a parallel loop. `race shared` increments
// one number from every index, which is a race and must be reported. `race own` increments a separate number per index,
// as parallel.h requires, and must not be reported. All four indices first wait at a latch, so that each runs on its
// own thread.
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
