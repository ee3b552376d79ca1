// scenes/models/model_counts.h - do the counts of a PLY or OFF file fit its bytes, and an OFF file's corners its
// vertices?
//
// Rule     Assimp reserves memory for every count of a header and reads lists of any length, for minutes if a file of
//          40 bytes claims 2,000,000,000 vertices. Here no count may exceed the bytes of the file, and each element
//          and list of a PLY file is walked over once: InputError at the header's line, or at the element, whose
//          values the file lacks. The corners of an OFF file's faces are its vertices, which Assimp does not check.
// Source   G. Turk, The PLY Polygon File Format, 1994.
// Tests    tests/scenes/models/models_test.cpp
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace strata::scenes::models {

// Returns the number of edges.
std::uint64_t check_ply_counts(std::string_view file, const std::string& path);
void check_off_counts(std::string_view file, const std::string& path);

}  // namespace strata::scenes::models
