// tools/port/probe/operations.h - the kit's operations by OpenGL: a fragment reads four words of its texel and writes
// four.
//
// Rule     ../../probe/DESIGN.md says what a kit and a pack have of them.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tools/port/objects.h"

namespace strata::port {

// One operation, drawn; its results are words in rgba32ui. Throws std::runtime_error where OpenGL cannot draw it.
[[nodiscard]] Image draw_operation(const nlohmann::json& described);

}  // namespace strata::port
