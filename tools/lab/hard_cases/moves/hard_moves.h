// tools/lab/hard_cases/moves/hard_moves.h - copies of a hard case (a scene of almost degenerate triangles or almost
// equal depths) with coordinates moved slightly, triangles in another order, or the camera on a path. `strata
// hard-cases` renders them to see whether the picture stays stable.
//
// Rule     A move changes the coordinates of corners, all at once or a single one, by one unit in the last place or by
//          a relative 2^-20; a bit of splitmix64 of seed, mesh, corner and axis gives the sign. Corners of a mesh at
//          the same position move together, so that a closed surface stays closed. A camera path rotates the camera
//          about its axis by up to 2 atan(2^-6) and sideways by up to 2 atan(2^-7) and shifts it by up to 1/16; all
//          three grow evenly with the frame's number.
// Numbers  Both angles are given by the tangent t of their half: (1 - t^2) / (1 + t^2) and 2 t / (1 + t^2) in binary64.
// Source   splitmix64 (Steele, Lea, Flood 2014).
// Tests    tests/tools/lab/hard_cases/hard_moves_test.cpp
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "scenes/scene.h"

namespace strata::tools {

enum class MoveSize : std::uint8_t { unit, relative };
inline constexpr std::array move_sizes{MoveSize::unit, MoveSize::relative};
[[nodiscard]] std::string_view name_of(MoveSize size) noexcept;
// The largest relative change of a coordinate. A coordinate of 0 changes by 2^-149.
[[nodiscard]] double share_of(MoveSize size) noexcept;

struct Move {
    MoveSize size = MoveSize::unit;
    std::uint64_t seed = 0;
    std::optional<std::size_t> alone{};  // the only coordinate that moves: 3 * corner position + axis
};

// The number of coordinates of all distinct corner positions, three each.
[[nodiscard]] std::size_t coordinate_count(const scenes::Scene& scene);
[[nodiscard]] scenes::Scene moved(const scenes::Scene& scene, const Move& move);

// A permutation of the transparent triangles: triangle i of the new list is triangle from[i] of the old one.
struct Permuted {
    scenes::Scene scene;
    std::vector<std::uint32_t> from;
};
[[nodiscard]] Permuted permuted(const scenes::Scene& scene, std::uint64_t seed);

inline constexpr int path_frames = 64;
// The scene's own view from a position on the path; frame 0 is the view itself.
[[nodiscard]] pipeline::View view_on_path(const scenes::Scene& scene, int frame);

}  // namespace strata::tools
