// tools/oracle/history.h - what happened at a pixel: its fragments, and each thing that a pass did to its targets.
//
// Rule     The run is literal and simulates every effect, so that each fragment has all its values; neither changes a
//          bit. Lines stand in the order in which things happened. They are enough to do them again: what was cleared
//          or copied, what a program gave out, with which state it was tested and blended, and what the targets held
//          before and after.
// Tests    tests/tools/oracle/explain_lines_test.cpp does them again
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/observer.h"
#include "tools/oracle/passes.h"

namespace strata::oracle {

// A fragment of the transparent list, or of the opaque one; colours and depth are those that fragment programs get.
struct FragmentFact {
    std::uint32_t primitive = 0;  // submission number of its triangle in its list
    std::string mesh{};  // the begin of a long name; "" and triangle -1 where the algorithm sorts triangles by an order
                         // of its own
    int triangle = -1;   // within the mesh
    std::array<double, 3>
        barycentric{};  // of the snapped triangle's corners, in submission order; of a clipped one, its piece's
    std::array<float, 4> color{};
    float shader_z = 0;
    std::uint32_t code = 0;                       // in the algorithm's key format
    bool front_facing = true, is_masked = false;  // masked: cut by its material's alpha
    // By depth path, in the frame's depth format; empty where the format or device has no such path.
    std::array<std::optional<std::uint32_t>, 7> path_codes{};
};

// As options name them.
inline constexpr std::array<std::string_view, 7> depth_path_names{
    "window_z", "perspective_rq", "depth_replace", "float32", "float32_plane", "exact", "w_buffer"};

enum class Fate : std::uint8_t {
    passed,
    masked,
    discarded,
    alpha_killed,
    depth_unit_killed,
    stencil_killed,
    depth_killed
};
[[nodiscard]] std::string_view name(Fate fate) noexcept;

// All samples of a pixel, channel by channel.
struct Held {
    std::string target{};
    pipeline::Format format{};
    std::vector<std::uint32_t> before{}, after{};  // of what is read: before alone
};

// What a program gives to one colour target.
struct Output {
    std::string target{};
    std::array<float, 4> color{};
    pipeline::Blend blend{};
};

// opaque: a fragment of the opaque list, which is drawn before the first pass.
enum class LineKind : std::uint8_t { opaque, clear, copy, fragment, quad, query, taken, published };
[[nodiscard]] std::string_view name(LineKind kind) noexcept;

struct Line {
    LineKind kind{};
    int pass = 0;  // as in passes(); of clears and copies, the pass that follows; of opaque fragments -1
    int iteration = 0;
    std::string from{};        // copy
    std::vector<Held> held{};  // targets that may change: clear, copy, fragment, quad; the picture, published
    // Fragments and quads.
    int fragment = -1;  // its number among the pixel's, or among its opaque ones; -1: a quad
    Fate fate = Fate::passed;
    pipeline::PassState state{};  // without its primitives
    std::string depth_target{}, stencil_target{};
    std::uint32_t depth_code = 0;                   // tested and stored
    std::optional<std::uint32_t> reference_code{};  // compared by the program, where that is a depth of its own
    std::vector<Held> reads{};
    std::vector<Output> outputs{};
    // Queries.
    std::uint64_t count = 0;
    bool goes_on = false;
    // Taken: composited at this end, all fragments of one depth; their numbers.
    pipeline::Side side = pipeline::Side::none;
    std::vector<int> fragments{};
};

struct History {
    int x = 0, y = 0;
    std::string algorithm{}, profile{};
    pipeline::DepthFormat depth_format{};
    bool is_reversed = false;  // all depths are keys (rasterizer/rules/depth_key.h): less is nearer
    std::vector<FragmentFact> fragments{};
    std::vector<FragmentFact> opaque{};  // of materials that are opaque or masked, in the order of their list
    std::vector<Line> lines{};
};

// The histories of a rectangle's pixels, row by row. InputError if it leaves the frame; throws Refused.
[[nodiscard]] std::vector<History> explain(const RunInput& input, const peeling::Algorithm& algorithm,
                                           const rasterizer::Rect& pixels);

// The fragments of each layer that was composited, near to far: those taken in front, then those taken behind, the last
// first.
[[nodiscard]] std::vector<std::vector<int>> composited(const History& history);

}  // namespace strata::oracle
