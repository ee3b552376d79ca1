// tools/oracle/explain/history.h - the history of a pixel: its fragments, and every change that a pass made to its
// targets.
//
// Rule     The run is literal and simulates every effect, so that each fragment has all its values; neither changes a
//          bit. Lines are in chronological order. They contain enough to repeat every step: what was cleared or copied,
//          the outputs of a program, the state of tests and blending, and the targets' values before and after.
// Tests    tests/tools/oracle/explain/explain_lines_test.cpp repeats the steps
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/frame/observer.h"
#include "rasterizer/rules/primitive.h"
#include "tools/oracle/passes/passes.h"

namespace strata::oracle {

// A fragment of the transparent or of the opaque list; colours and depth are the inputs of fragment programs.
struct FragmentFact {
    std::uint32_t primitive = 0;  // submission index of its triangle in its list
    std::string mesh{};  // may be shortened; "" and triangle -1 if the algorithm has its own order of triangles
    int triangle = -1;   // index in the mesh
    rasterizer::Primitive kind = rasterizer::Primitive::triangles;
    // Of the snapped triangle, in submission order; if clipped, of its piece. Lines and points have none.
    std::array<double, 3> barycentric{};
    std::array<float, 4> color{};
    float shader_z = 0;
    std::uint32_t code = 0;                       // in the algorithm's key format
    bool front_facing = true, is_masked = false;  // masked: discarded by its material's alpha test
    // Per depth path, in the frame's depth format; empty if the format or device does not support the path.
    std::array<std::optional<std::uint32_t>, 9> path_codes{};
};

// Names as in options.
inline constexpr std::array<std::string_view, 9> depth_path_names{"window_z", "perspective_rq", "depth_replace",
                                                                  "float32",  "float32_plane",  "exact",
                                                                  "w_buffer", "logarithmic",    "packed_rgba8"};

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

// All samples of a pixel, with interleaved channels.
struct TargetValues {
    std::string target{};
    pipeline::Format format{};
    std::vector<std::uint32_t> before{}, after{};  // of a target that is read: `before` only
};

// The output of a program for one colour target.
struct ProgramOutput {
    std::string target{};
    std::array<float, 4> color{};
    pipeline::Blend blend{};
};

// opaque: a fragment of the opaque list, which is drawn before the first pass.
enum class LineKind : std::uint8_t { opaque, clear, copy, fragment, quad, query, taken, published };
[[nodiscard]] std::string_view name(LineKind kind) noexcept;

struct Line {
    LineKind kind{};
    int pass = 0;  // as in passes(); for clears and copies the pass that follows; for opaque fragments -1
    int iteration = 0;
    std::string from{};  // source of a copy
    std::vector<TargetValues>
        held{};  // the targets that may change (clear, copy, fragment, quad), or the image (published)
    // The following members are for fragments and quads.
    int fragment = -1;  // index among the pixel's fragments, or among its opaque ones; -1: a quad
    Fate fate = Fate::passed;
    pipeline::PassState state{};  // without its primitives
    std::string depth_target{}, stencil_target{};
    std::uint32_t depth_code = 0;                   // the depth that is tested and stored
    std::optional<std::uint32_t> reference_code{};  // the depth that the program compares, if it is another one
    std::vector<TargetValues> reads{};
    std::vector<ProgramOutput> outputs{};
    // For queries.
    std::uint64_t count = 0;
    bool goes_on = false;
    // For `taken`: the fragments composited at this end, all of one depth, by index.
    pipeline::Side side = pipeline::Side::none;
    std::vector<int> fragments{};
};

struct History {
    int x = 0, y = 0;
    std::string algorithm{}, profile{};
    std::optional<int> sample{};  // its number, of several
    pipeline::DepthFormat depth_format{};
    bool is_reversed = false;  // all depths are keys (rasterizer/rules/depth_key.h), where less is nearer
    std::vector<FragmentFact> fragments{};
    std::vector<FragmentFact> opaque{};  // of opaque and masked materials, in the order of their list
    std::vector<Line> lines{};
};

// The histories of a rectangle's pixels, row by row, in a frame of one sample. InputError if it leaves the frame;
// throws Refused.
[[nodiscard]] std::vector<History> explain(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                           const rasterizer::Rect& pixels);

// The histories of a pixel's samples, one or several: counts of queries are of all samples. What a line reads is what
// its own sample stores, whichever sample the program loads (Multisampling::loads).
struct SampledHistory {
    std::vector<History> samples{};
    std::vector<rasterizer::SamplePoint> points{};
    peeling::Multisampling sampling{};
    pipeline::Format format{};
    std::vector<std::uint32_t> resolved{};  // the pixel of the picture
};
// The histories of one sample by all algorithms.
[[nodiscard]] inline std::vector<History> of_sample(std::span<const SampledHistory> histories, std::size_t sample) {
    std::vector<History> chosen;
    for (const SampledHistory& history : histories) chosen.push_back(history.samples.at(sample));
    return chosen;
}
[[nodiscard]] SampledHistory explain_samples(const peeling::FrameRequest& input, const peeling::Algorithm& algorithm,
                                             int x, int y);

// The fragments of each composited layer, near to far: those taken at the near end in order, then those taken at the
// far end, last first.
[[nodiscard]] std::vector<std::vector<int>> composited(const History& history);

}  // namespace strata::oracle
