// tools/port/probe/operations.h - the operations of a kit (../../probe/operation.h), run by OpenGL.
//
// Rule     Each input once, from a texture of words into one of words: in a fragment's program over all texels, or in a vertex's,
//          a point for each. An operation that the driver's compiler refuses is missing, with the compiler's words.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "tools/port/probe/kit.h"

namespace strata::port {

// Writes FOLDER/NAME.npy for each, and says in `missing` why one is not there.
void answer_operations(const Kit& kit, const std::string& folder, nlohmann::ordered_json& missing);

}  // namespace strata::port
