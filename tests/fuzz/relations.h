// tests/fuzz/relations.h - frames that are said in another way and must stay the same picture.
//
// Rule     A mesh in two parts, triangles with corners of their own, materials, meshes and textures that are not
//          referenced, a viewport further by whole tiles, and state that changes nothing (a white texel, an offset of
//          0, a scissor as large as the viewport, all effects) leave whatever a user sees. Triangles without an area
//          change counters and diagnostics alone. Where no two fragments of a pixel have one depth, the order of
//          triangles leaves the pictures of algorithms that sort by depth.
#pragma once
#include <cstdint>
#include <iosfwd>
#include <map>
#include <span>
#include <string_view>

#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

// By a relation's name: of how many frames it was asked, and held.
using RelationCounts = std::map<std::string_view, std::uint64_t>;

// Counts the relations that hold for the frame that these bytes make. If one does not: false, and which it is and the
// frame are printed.
[[nodiscard]] bool check_relations(std::span<const std::uint8_t> bytes, RelationCounts& held, std::ostream& out);

}  // namespace strata::fuzz
