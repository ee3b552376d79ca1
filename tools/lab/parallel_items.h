// tools/lab/parallel_items.h - a list worked off by all cores, with a bar.
//
// Rule     body(i) writes to places of item i alone. Of several items that fail, the first one's exception is thrown,
//          whatever finished first.
// Tests    tests/tools/hardware_check_test.cpp
#pragma once
#include <atomic>
#include <exception>
#include <string>
#include <vector>

#include "rasterizer/base/parallel.h"
#include "tools/strata/progress.h"

namespace strata::tools {

// Runs body(0) to body(count - 1) on all cores under a bar with this label, and returns when all
// have ended. Every item runs, also after another one failed.
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
