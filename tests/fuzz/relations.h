// tests/fuzz/relations.h - changes of a frame that must not change its picture.
//
// Rule     Splitting meshes in two, giving triangles separate corners, adding unreferenced materials, meshes and
//          textures, moving the viewport by whole tiles, and adding state without effect (a white texel, an offset of
//          0, a scissor as large as the viewport, all effects) change no result. Triangles without an area change only
//          counters and diagnostics. Where no two fragments of a pixel have equal depths, the order of triangles does
//          not change the pictures of algorithms that sort by depth. Where programs load their own sample, every sample
//          of a frame has the picture of a frame of that sample alone.
#pragma once
#include <cstdint>
#include <iosfwd>
#include <map>
#include <span>
#include <string_view>

#include "tests/fuzz/frame_case.h"

namespace strata::fuzz {

// By a relation's name: the number of frames for which it was tested and held.
using RelationCounts = std::map<std::string_view, std::uint64_t>;

// Counts the relations that hold for the frame that these bytes make. If one does not hold, prints it and the frame and
// returns false.
[[nodiscard]] bool check_relations(std::span<const std::uint8_t> bytes, RelationCounts& held, std::ostream& out);

}  // namespace strata::fuzz
