// scenes/files/system_error.h - an error of the system: disk full, no permission, no such folder. Exit status 3.
#pragma once
#include <stdexcept>
#include <string>

namespace strata {

// InputError is for errors that the user can correct in the input; this is for failures of the system.
struct SystemError : std::runtime_error {
    // `action` as in "write"; `reason` is the system's message.
    SystemError(const std::string& file, const std::string& action, const std::string& reason)
        : std::runtime_error(file + ": cannot " + action + ": " + reason) {}
};

}  // namespace strata
