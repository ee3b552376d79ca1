// rasterizer/base/input_error.h - the only exception type of the project: an input is invalid. It is in the lowest
// folder because includes run downwards only.
#pragma once
#include <stdexcept>
#include <string>

namespace strata {

// Thrown only where input enters (files, options, JSON). `main` prints it as one line and exits with status 2.
struct InputError : std::runtime_error {
    // For a message without a place in the file: "no such file".
    InputError(const std::string& file, const std::string& message) : std::runtime_error(file + ": " + message) {}
    InputError(const std::string& file, const std::string& location, const std::string& expected,
               const std::string& found)
        : std::runtime_error(file + ": " + location + ": expected " + expected + ", found " + found) {}
};

}  // namespace strata
