// tools/port/probe/operations.h - draws the kit's operations with OpenGL: a fragment reads four words of its texel and
// writes four.
//
// Rule     ../../probe/DESIGN.md describes their format in a kit and in a pack.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tools/port/objects.h"

namespace strata::port {

// Draws one operation; its results are words in rgba32ui. Throws std::runtime_error if OpenGL cannot draw it.
[[nodiscard]] Image draw_operation(const nlohmann::json& described);

}  // namespace strata::port
