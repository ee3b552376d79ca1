// tests/fuzz/relations.h - frames that are said in another way and must stay the same picture.
//
// Rule     A mesh in two parts, triangles with corners of their own, and materials, meshes and textures that nobody names change
//          nothing that a user sees. Triangles without an area change counters and diagnostics alone.
#pragma once
#include <iosfwd>
#include <span>

#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

// How many relations hold for the frame that these bytes make; if one does not, 0, and which it is and the frame are printed.
[[nodiscard]] int check_relations(std::span<const std::uint8_t> bytes, std::ostream& out);

}  // namespace strata::fuzz
