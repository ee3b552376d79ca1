// tools/request/values.h - parses the values of options, both of the command line and of a plan of `strata
// invariance`. Each function returns an empty optional for an invalid text.
#pragma once
#include <optional>
#include <string_view>

#include "pipeline/stages/depth_compare.h"
#include "pipeline/vertices/draw_list.h"
#include "rasterizer/rules/raster_state.h"

namespace strata::peeling {
struct VertexPaths;
}

namespace strata::tools {

// A size in pixels.
struct Size {
    int width = 0, height = 0;
};

struct Orbit {
    double azimuth = 30, elevation = 20;  // degrees
};

[[nodiscard]] std::optional<int> to_count(std::string_view text);    // at least 0
[[nodiscard]] std::optional<float> to_share(std::string_view text);  // from 0 to 1
// A number of bytes, with an optional suffix K, M or G.
[[nodiscard]] std::optional<std::uint64_t> to_bytes(std::string_view text);
// X,Y,W,H: a rectangle of pixels from the top left corner; width and height are at least 1.
[[nodiscard]] std::optional<rasterizer::Rect> to_region(std::string_view text);
// R,G,B or R,G,B,A, each from 0 to 1, or "none": 0,0,0,0.
[[nodiscard]] std::optional<pipeline::Rgba> to_background(std::string_view text);
inline constexpr const char* background_expected =
    "none, or three or four numbers from 0 to 1 such as 0.2,0.2,0.3 or 0,0,0,0.5";
[[nodiscard]] std::optional<Size> to_size(std::string_view text);    // WIDTHxHEIGHT, each 1 to 16384
[[nodiscard]] std::optional<Orbit> to_orbit(std::string_view text);  // AZ,EL

// "1e-7", a fraction of the depth range, or "2ulp", at most 2^24.
[[nodiscard]] std::optional<pipeline::CompareEpsilon> to_epsilon(std::string_view text);

// The vertex path of the first pass, and optionally `separator` and the path of further passes.
[[nodiscard]] std::optional<peeling::VertexPaths> to_vertex_paths(std::string_view text, char separator);

}  // namespace strata::tools
