// pipeline/vertices/prepare.h - the vertex stage and everything else that is done once a frame: transform, light, clip,
// set up, bin.
//
// Rule     Matrices are multiplied in binary64 (projection * view * model) and rounded once to binary32; positions go
//          through it by the view's vertex path (vertex_transform.h); nv20 divides by w in its own way, too. Lighting
//          is two-sided and diffuse: rgb x (0.25 + 0.75 |N.L|), L the unit vector from the view's centre to the eye,
//          per vertex in binary32, on the frame's colour values.
// Source   vertices.md 1.2, 5 and 6.
// Tests    tests/pipeline/vertices/prepare_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/primitive_range.h"
#include "pipeline/vertices/texgen.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// The texture and state that fragments of one material need besides their interpolants; an empty optional is an effect
// that is not used.
struct MaterialStage {
    const Texture* texture = nullptr;  // into the draw list, which must outlive this
    // alphaMode MASK: alpha GEQUAL cutoff, applied to the shaded alpha.
    AlphaTest mask;
    // Of a MASK material: applied after the test, so that the cut is at the material's own alpha.
    float alpha_scale = 1.0f;
};

// The values that some set of materials needs in every pass.
struct MaterialNeeds {
    // One of them has a texture.
    bool texcoord = false;
    // One of them tests its alpha, so that a pass of depth alone must shade it.
    bool color = false;
    // The coordinates that a shadow lookup of every fragment's colour reads.
    rasterizer::UnitMask shadow = 0;
    friend bool operator==(const MaterialNeeds&, const MaterialNeeds&) = default;
};

// Triangles that an algorithm draws together, and depths between which all their fragments lie, in units of shader_z.
struct DrawPart {
    PrimitiveRange primitives;
    double near = 0, far = 0;
    friend bool operator==(const DrawPart&, const DrawPart&) = default;
};

// A draw list as passes draw it, prepared once a frame. It points into the draw list, which must live as long.
struct PreparedDraw {
    rasterizer::Geometry geometry;
    // In submission order, without gaps; empty unless the order made some.
    std::vector<DrawPart> parts;
    std::vector<MaterialStage> materials;
    MaterialNeeds needs;  // of all of them
};

// The needs of the materials of some of a draw list's triangles. Those of one tile may be fewer than those of the whole
// list.
[[nodiscard]] MaterialNeeds needs_of(const PreparedDraw& list, std::span<const std::uint32_t> triangles);

// By the material: `opaque` are alphaMode OPAQUE and MASK, `transparent` is BLEND.
enum class Selection : std::uint8_t { all, opaque, transparent };

// The order in which a soup's triangles are submitted; `parts` as in PreparedDraw.
struct SubmissionOrder {
    // Numbers in the soup; empty: as listed.
    std::vector<std::uint32_t> triangles;
    std::vector<PrimitiveRange> parts;
};
using Ordering = std::function<SubmissionOrder(const rasterizer::TriangleSoup&)>;

// What vertices suffer beside the rules: a deliberate mistake, for a caller that wants to know what it looks like.
// Empty functions change nothing.
struct VertexAlteration {
    std::function<void(rasterizer::TriangleSoup&)> vertices{};  // in clip space, before they are cut and projected
    std::function<void(rasterizer::Geometry&)> corners{};       // in the window, set up
};

// Options that decide a frame's vertices beside the list. The defaults
// draw all of it as listed, binned into tiles of 32 pixels.
struct PrepareOptions {
    Selection selection = Selection::all;
    // --alpha: every alpha is multiplied by it, at the vertex; a MASK material's after its test.
    float alpha_scale = 1.0f;
    // Also r and q of every vertex, for perspective_rq and depth_replace (quotient_rows.h).
    bool depth_quotient = false;
    // None: as listed.
    Ordering order{};
    // 8, 16, 32, 64 or 128 pixels; 0 leaves the triangles unbinned.
    int tile_size = 32;
    // 0 takes all that the machine has; no result depends on it.
    int threads = 0;
    // Texture units that a pass reads.
    CoordinateUnits units{};
    // Every colour is multiplied by the comparison of shadow_stage.h.
    bool receives_shadow = false;
    // The list has been checked (check_list.h), and has not changed since.
    bool is_checked = false;
    // Null: none.
    const VertexAlteration* alteration = nullptr;
};

// Whether w differs with the distance from the eye: what a w buffer needs.
[[nodiscard]] bool has_perspective(const View& view) noexcept;

// Inverts nothing it need not: mirrored instances keep their winding and flip their facing. Throws InputError for a
// list, a view, a state or a profile that no rule covers (check_list.h, rasterizer/set_up/check_input.h).
[[nodiscard]] PreparedDraw prepare(const DrawList& list, const View& view, const rasterizer::RasterState& state,
                                   const DeviceProfile& profile, const PrepareOptions& options);

// The clip-space soup that `prepare` sets up; for tests and for callers that want the vertices.
[[nodiscard]] rasterizer::TriangleSoup transform(const DrawList& list, const View& view, const PrepareOptions& options);

}  // namespace strata::pipeline
