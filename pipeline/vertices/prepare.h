// pipeline/vertices/prepare.h - the vertex stage and all other work that is done once per frame: transform, light,
// clip, set up, bin.
//
// Rule     Matrices are multiplied in binary64 (projection * view * model) and rounded once to binary32; positions are
//          transformed by the view's vertex path (vertex_transform.h); nv20 also has its own division by w. Lighting is
//          two-sided and diffuse: rgb x (0.25 + 0.75 |N.L|), L the unit vector from the view's centre to the eye, per
//          vertex in binary32, on the frame's colour values. A frame with lights takes vertex_light.h's colours
//          instead.
// Source   pipeline/reference/vertices.md 1.2, 5 and 6.
// Tests    tests/pipeline/vertices/prepare_test.cpp
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "pipeline/device/profile.h"
#include "pipeline/device/state.h"
#include "pipeline/vertices/draw_list.h"
#include "pipeline/vertices/fog.h"
#include "pipeline/vertices/primitive_range.h"
#include "pipeline/vertices/texgen.h"
#include "rasterizer/set_up/geometry.h"

namespace strata::pipeline {

// The texture and state that fragments of one material need in addition to their interpolants; an empty optional is an
// effect that is not used.
struct MaterialStage {
    const Texture* texture = nullptr;  // into the draw list, which must outlive this
    // alphaMode MASK: alpha GEQUAL cutoff, applied to the shaded alpha.
    AlphaTest mask;
    // For a MASK material: applied after the test, so that the test uses the material's own alpha.
    float alpha_scale = 1.0f;
};

// The values that a set of materials needs in every pass.
struct MaterialNeeds {
    // A material has a texture.
    bool texcoord = false;
    // A material tests its alpha, so that a depth-only pass must shade it.
    bool color = false;
    // The coordinates that the shadow lookup of every fragment's colour reads.
    rasterizer::UnitMask shadow = 0;
    // Every fragment's colour is mixed with fog.
    bool fog = false;
    // A secondary colour is added to every fragment's.
    bool secondary = false;
    MaterialNeeds& operator|=(const MaterialNeeds& other) noexcept {
        texcoord |= other.texcoord;
        color |= other.color;
        shadow |= other.shadow;
        fog |= other.fog;
        secondary |= other.secondary;
        return *this;
    }
    friend bool operator==(const MaterialNeeds&, const MaterialNeeds&) = default;
};

// Triangles that an algorithm draws together, and bounds of the depths of all their fragments, in units of shader_z.
struct DrawPart {
    PrimitiveRange primitives;
    double near = 0, far = 0;
    friend bool operator==(const DrawPart&, const DrawPart&) = default;
};

// A draw list prepared for passes, once per frame. It points into the draw list, which must outlive it. Every sample of
// a pixel has a set-up of its own: the same primitives with corners shifted by the sample's position, in the same
// tiles.
struct PreparedDraw {
    rasterizer::Geometry geometry;                      // of sample 0
    std::vector<rasterizer::Geometry> other_samples{};  // of samples 1, 2, ...
    // In submission order, without gaps; empty unless `order` returned some.
    std::vector<DrawPart> parts;
    std::vector<MaterialStage> materials;
    MaterialNeeds needs;  // union over all materials

    [[nodiscard]] std::size_t samples() const noexcept { return 1 + other_samples.size(); }
    [[nodiscard]] const rasterizer::Geometry& of_sample(std::size_t sample) const noexcept {
        return sample == 0 ? geometry : other_samples[sample - 1];
    }
    [[nodiscard]] rasterizer::Geometry& of_sample(std::size_t sample) noexcept {
        return sample == 0 ? geometry : other_samples[sample - 1];
    }
    // The number of triangles in a tile, of all samples.
    [[nodiscard]] std::size_t triangles_in(std::size_t tile) const noexcept;
};

// Sorts the triangles of every sample into tiles (rasterizer/set_up/geometry.h).
void bin_triangles(PreparedDraw& list, int tile_size, int threads);

// The needs of the materials of some triangles of a sample. Those of one tile may be fewer than those of the whole
// list.
[[nodiscard]] MaterialNeeds needs_of(const PreparedDraw& list, std::span<const std::uint32_t> triangles,
                                     std::size_t sample = 0);

// By alphaMode of the material: `opaque` selects OPAQUE and MASK, `transparent` selects BLEND.
enum class Selection : std::uint8_t { all, opaque, transparent };

// The order in which a soup's triangles are submitted; `parts` as in PreparedDraw.
struct SubmissionOrder {
    // Indices into the soup's triangles; empty: as listed.
    std::vector<std::uint32_t> triangles;
    std::vector<PrimitiveRange> parts;
};
using Ordering = std::function<SubmissionOrder(const rasterizer::TriangleSoup&)>;

// Deliberate mistakes in vertices, for a caller that wants to see their effect. Empty functions change nothing.
struct VertexAlteration {
    std::function<void(rasterizer::TriangleSoup&)> vertices{};  // in clip space, before clipping and projection
    std::function<void(rasterizer::Geometry&)> corners{};       // in window space, after set-up
};

// Options that, in addition to the list, determine a frame's vertices. The defaults draw the whole list as listed,
// binned into tiles of 32 pixels.
struct PrepareOptions {
    Selection selection = Selection::all;
    // --alpha: every alpha is multiplied by it at the vertex; for a MASK material after its test.
    float alpha_scale = 1.0f;
    // Adds r and q to every vertex, for perspective_rq and depth_replace (quotient_rows.h).
    bool depth_quotient = false;
    // Empty: as listed.
    Ordering order{};
    // 8, 16, 32, 64 or 128 pixels; 0: the triangles are not binned.
    int tile_size = 32;
    // 0: as many as the computer has; no result depends on it.
    int threads = 0;
    // Texture units that a pass reads.
    CoordinateUnits units{};
    // Multiply every colour by the comparison of shadow_stage.h.
    bool receives_shadow = false;
    // Mix every colour with fog.
    std::optional<Fog> fog{};
    // Light lit vertices by these lights instead of the one at the eye. Null: none.
    const Lighting* lighting = nullptr;
    // The list has been checked (check_list.h) and has not changed since.
    bool is_checked = false;
    // The meshes or materials that polygon offset moves, by name; empty: all.
    std::span<const std::string> offset_only{};
    // Null: none.
    const VertexAlteration* alteration = nullptr;
    // Samples of a pixel, at the profile's positions; 1: the state says at which point.
    int samples = 1;
};

// True if w depends on the distance from the eye, which a w buffer requires.
[[nodiscard]] bool has_perspective(const View& view) noexcept;

// RasterState::log_scale of the projection; 0 if it has no far plane.
[[nodiscard]] float log_scale_of(const View& view) noexcept;

// Transforms, lights, sets up and bins a list. Mirrored instances keep their winding and exchange their facing. Throws
// InputError for an invalid list, view, state or profile (check_list.h, rasterizer/set_up/check_input.h).
[[nodiscard]] PreparedDraw prepare(const DrawList& list, const View& view, const rasterizer::RasterState& state,
                                   const DeviceProfile& profile, const PrepareOptions& options);

// The clip-space soup that `prepare` sets up, for tests and for callers that need the vertices.
[[nodiscard]] rasterizer::TriangleSoup transform(const DrawList& list, const View& view, const PrepareOptions& options);

}  // namespace strata::pipeline
