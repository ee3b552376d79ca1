// tools/lab/parallel_items.h - processes a list on all cores, with a progress bar.
//
// Rule     body(i) must only write to data of item i. If several items fail, the exception of the first in the list is
//          thrown, whatever the order of completion.
// Tests    tests/tools/lab/hardware_check/hardware_check_test.cpp
#pragma once
#include <atomic>
#include <exception>
#include <string>
#include <vector>

#include "rasterizer/base/parallel.h"
#include "tools/strata/progress.h"

namespace strata::tools {

// Runs body(0) to body(count - 1) on all cores under a progress bar with this label, and returns when all have ended.
// Every item runs, even after another one has failed.
void for_every(const std::string& label, std::size_t count, const auto& body) {
    Progress progress(label);
    std::atomic<std::size_t> done = 0;
    std::vector<std::exception_ptr> failures(count);
    parallel_for(count, 0, [&](std::size_t i) {
        try {
            body(i);
        } catch (...) {
            failures[i] = std::current_exception();
        }
        progress.show(static_cast<double>(++done) / static_cast<double>(count));
    });
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

}  // namespace strata::tools
