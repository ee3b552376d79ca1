// scenes/files/system_error.h - the system did not do its part: disk full, no permission, no such folder. Exit status
// 3.
#pragma once
#include <stdexcept>
#include <string>

namespace strata {

// InputError is for what the user can mend in the input; this is for what the machine refused.
struct SystemError : std::runtime_error {
    // `action` as in "write", `reason` as the system words it.
    SystemError(const std::string& file, const std::string& action, const std::string& reason)
        : std::runtime_error(file + ": cannot " + action + ": " + reason) {}
};

}  // namespace strata
