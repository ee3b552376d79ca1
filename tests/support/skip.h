// tests/support/skip.h - a test case that cannot run says so.
#pragma once

#include <catch2/catch.hpp>
#include <string>

namespace strata::test {

// Reports why the rest of a test case is skipped. Counts as an assertion: a case without one fails.
inline void skip(const std::string& reason) {
    WARN("SKIPPED: " << reason);
    SUCCEED();
}

}  // namespace strata::test
