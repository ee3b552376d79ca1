// rasterizer/base/input_error.h - the one exception of the project: some input is not what it has to be.
// It lives in the lowest folder because includes run downwards only.
#pragma once
#include <stdexcept>
#include <string>

namespace strata {

// Thrown only where the outside comes in (files, options, JSON); `main` turns it into one line and exit status 2.
struct InputError : std::runtime_error {
    // Where a plain sentence says it: "no such file".
    InputError(const std::string& file, const std::string& sentence) : std::runtime_error(file + ": " + sentence) {}
    InputError(const std::string& file, const std::string& place, const std::string& expected, const std::string& found)
        : std::runtime_error(file + ": " + place + ": expected " + expected + ", found " + found) {}
};

}  // namespace strata
