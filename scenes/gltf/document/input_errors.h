// scenes/gltf/document/input_errors.h - several faults of one file; `main` prints one line per fault.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "rasterizer/base/input_error.h"

namespace strata::scenes {

// what() is the first fault and the number of the others.
struct InputErrors : InputError {
    InputErrors(const InputError& first, std::vector<std::string> all)
        : InputError(first), messages(std::move(all)), text_(first.what()) {
        if (messages.size() > 1) text_ += " (and " + std::to_string(messages.size() - 1) + " more)";
    }
    [[nodiscard]] const char* what() const noexcept override { return text_.c_str(); }

    std::vector<std::string> messages;  // including the first

  private:
    std::string text_;
};

}  // namespace strata::scenes
