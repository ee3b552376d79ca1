// tools/oracle/emulations/of_device.cpp - mistakes in formats, rasterizer state and the options of a peel.
#include "rasterizer/base/fused.h"
#include "tools/oracle/emulations/catalogue.h"

namespace strata::oracle {

namespace {

using pipeline::DepthFormat;
using pipeline::Format;

DepthFormat depth_of(const AlteredRun& e) { return e.profile.depth_buffer(e.options.depth); }

bool takes_depth(AlteredRun& e, DepthFormat format) {
    if (depth_of(e) == format) return false;
    e.profile.has_d16 = e.profile.has_d24 = e.profile.has_d32f = true;
    e.options.depth = format;
    return true;
}

bool takes_color(AlteredRun& e, Format format) {
    const bool is_exact = e.profile.raster.depth_path == rasterizer::DepthPath::exact;
    if (e.options.color_format.value_or(is_exact ? Format::rgba32f : Format::rgba8) == format) return false;
    e.profile.has_float_targets = true;
    e.options.color_format = format;
    return true;
}

// Translates clip x and y by the given number of pixels, to the right and up: after the vertex stage, so that no
// product of it is rounded differently. A device that fuses the viewport's sums also fuses those of its shaders.
bool moves(AlteredRun& e, double right_px, double up_px) {
    const auto x = static_cast<float>(2 * right_px / e.options.width);
    const auto y = static_cast<float>(2 * up_px / e.options.height);
    using enum rasterizer::ViewportArithmetic;
    const bool fuses = e.profile.raster.viewport == fused || e.profile.raster.viewport == fused_given;
    const auto moved = [fuses](float c, float by, float w) {
        if (fuses) return rasterizer::fused_multiply_add(by, w, c);
        const float distance = by * w;
        return c + distance;
    };
    e.alter_vertices({.vertices = [x, y, moved](rasterizer::TriangleSoup& soup) {
        for (rasterizer::ClipVertex& v : soup.vertices) {
            v.x = moved(v.x, x, v.w);
            v.y = moved(v.y, y, v.w);
        }
    }});
    return true;
}

// Reverses the tie rule: 1 exchanges left and right, 2 top and bottom.
bool gives_ties(AlteredRun& e, unsigned sides) {
    using rasterizer::TieRule;
    constexpr TieRule rules[] = {TieRule::top_left, TieRule::top_right, TieRule::bottom_left, TieRule::bottom_right};
    unsigned now = 0;
    while (rules[now] != e.profile.raster.tie_rule) ++now;
    e.profile.raster.tie_rule = rules[now ^ sides];
    return true;
}

bool snaps_to(AlteredRun& e, int bits) {
    if (e.profile.raster.subpixel_bits == bits) return false;
    e.profile.raster.subpixel_bits = bits;
    return true;
}

// No transparent surface is left to peel.
bool loses_transparent_surfaces(AlteredRun& e) {
    pipeline::DrawList& scene = e.scene();
    const auto is_transparent = [&](const pipeline::Instance& instance) {
        return e.options.alpha || scene.materials[instance.material].alpha_mode == pipeline::AlphaMode::blend;
    };
    return std::erase_if(scene.instances, is_transparent) > 0;
}

bool is_peel(const AlteredRun& e) { return e.right.passes > 1; }

// The option with which a caller limits the number of layers.
int* limit_of(AlteredRun& e) {
    if (e.options.termination.rule == pipeline::TerminationRule::fixed) return &e.options.termination.passes;
    return e.options.max_passes > 0 ? &e.options.max_passes : nullptr;
}

const Mistake device_mistakes[] = {
    {"one_pass_too_few", "one pass too few: the last layers are missing", ChangedPart::device,
     [](AlteredRun& e) {
         if (!is_peel(e) || e.right.enough_passes < 1) return false;
         if (e.right.enough_passes == 1) return loses_transparent_surfaces(e);  // the only layer is the last one
         e.options.max_passes = e.right.enough_passes - 1;
         return true;
     }},
    {"one_pass_too_many", "one pass too many for the number that was asked for", ChangedPart::device,
     [](AlteredRun& e) {
         int* const limit = limit_of(e);
         if (limit != nullptr) ++*limit;
         return limit != nullptr;
     }},
    {"depth_16", "depths stored in 16 bits", ChangedPart::device,
     [](AlteredRun& e) { return takes_depth(e, DepthFormat::d16); }},
    {"depth_24", "depths stored in 24 bits", ChangedPart::device,
     [](AlteredRun& e) { return takes_depth(e, DepthFormat::d24); }},
    {"depth_32f", "depths stored as binary32", ChangedPart::device,
     [](AlteredRun& e) { return takes_depth(e, DepthFormat::d32f); }},
    {"depth_rounded_otherwise", "depths cut to their code instead of rounded to it, or the other way round",
     ChangedPart::device,
     [](AlteredRun& e) {
         using rasterizer::DepthRounding;
         DepthRounding& rounding = e.profile.raster.depth_rounding;
         rounding = rounding == DepthRounding::floor ? DepthRounding::nearest : DepthRounding::floor;
         return true;
     }},
    {"depth_stepwise", "depths from a plane that is stepped in binary32", ChangedPart::device,
     [](AlteredRun& e) {
         using rasterizer::DepthPath;
         if (e.options.depth_path.value_or(e.profile.raster.depth_path) != DepthPath::float32) return false;
         e.options.depth_path = DepthPath::float32_plane;
         return true;
     }},
    {"depth_bias", "a depth bias left on: glPolygonOffset(1, 1)", ChangedPart::device,
     [](AlteredRun& e) {
         if (e.options.raster.polygon_offset.enabled) return false;
         e.options.raster.polygon_offset = {true, 1, 1};
         return true;
     }},
    {"depth_bias_lost", "the depth bias forgotten", ChangedPart::device,
     [](AlteredRun& e) {
         if (!e.options.raster.polygon_offset.enabled) return false;
         e.options.raster.polygon_offset = {};
         return true;
     }},
    {"compared_with_bias", "a bias of 2^-16 added to the peeled depth before the comparison", ChangedPart::device,
     [](AlteredRun& e) {
         if (e.algorithm->compares_own_codes || !is_peel(e)) return false;
         e.options.compare_epsilon.absolute += 0x1p-16;
         return true;
     }},
    {"depth_clamp", "nothing clipped at the near and the far plane: depth clamp left on", ChangedPart::device,
     [](AlteredRun& e) {
         if (e.options.raster.depth_clamp) return false;
         e.profile.has_depth_clamp = true;
         return e.options.raster.depth_clamp = true;
     }},
    {"clip_zero_to_one",
     "clip space taken for 0 <= z <= w where the projection is made for -w <= z <= w, or the "
     "other way round",
     ChangedPart::device,
     [](AlteredRun& e) {
         using rasterizer::ClipDepth;
         ClipDepth& clip = e.options.raster.clip_depth;
         clip = clip == ClipDepth::zero_to_one ? ClipDepth::minus_one_to_one : ClipDepth::zero_to_one;
         return true;
     }},
    {"reversed_depth", "depth running from 1 at the near plane to 0, the tests left as they were", ChangedPart::device,
     [](AlteredRun& e) {
         for (int c = 0; c < 4; ++c) e.view.projection[c][2] = -e.view.projection[c][2];
         return true;
     }},
    {"half_pixel_up", "everything moved right and up by half a pixel", ChangedPart::device,
     [](AlteredRun& e) { return moves(e, 0.5, 0.5); }},
    {"half_pixel_down", "everything moved left and down by half a pixel", ChangedPart::device,
     [](AlteredRun& e) { return moves(e, -0.5, -0.5); }},
    // If y points down, a half pixel in both directions is one of these.
    {"half_pixel_right", "everything moved right and down by half a pixel", ChangedPart::device,
     [](AlteredRun& e) { return moves(e, 0.5, -0.5); }},
    {"half_pixel_left", "everything moved left and up by half a pixel", ChangedPart::device,
     [](AlteredRun& e) { return moves(e, -0.5, 0.5); }},
    {"ties_of_rows", "a centre on a horizontal edge given to the other triangle (fill rule upside down)",
     ChangedPart::device, [](AlteredRun& e) { return gives_ties(e, 2); }},
    {"ties_of_columns", "a centre on an edge given to the triangle on the other side, left for right",
     ChangedPart::device, [](AlteredRun& e) { return gives_ties(e, 1); }},
    {"snapped_to_16ths", "positions snapped to 1/16 pixel", ChangedPart::device,
     [](AlteredRun& e) { return snaps_to(e, 4); }},
    {"snapped_to_256ths", "positions snapped to 1/256 pixel", ChangedPart::device,
     [](AlteredRun& e) { return snaps_to(e, 8); }},
    {"snapped_otherwise", "positions cut to the subpixel grid instead of rounded, or the other way round",
     ChangedPart::device,
     [](AlteredRun& e) {
         using rasterizer::Snap;
         Snap& snap = e.profile.raster.snap;
         snap = snap == Snap::toward_zero ? Snap::nearest_even : Snap::toward_zero;
         return true;
     }},
    {"culls_front", "front faces culled instead of back faces", ChangedPart::device,
     [](AlteredRun& e) {
         e.options.raster.cull = rasterizer::CullFace::front;
         return true;
     }},
    {"front_is_clockwise", "clockwise triangles taken for front faces", ChangedPart::device,
     [](AlteredRun& e) {
         using rasterizer::FrontFace;
         FrontFace& front = e.options.raster.front_face;
         front = front == FrontFace::clockwise ? FrontFace::counter_clockwise : FrontFace::clockwise;
         return true;
     }},
    {"upside_down", "drawn upside down: y of the viewport runs the other way", ChangedPart::device,
     [](AlteredRun& e) {
         using rasterizer::YDirection;
         YDirection& y = e.options.raster.y_direction;
         y = y == YDirection::up ? YDirection::down : YDirection::up;
         return true;
     }},
    {"color_8", "colours blended in 8 bits", ChangedPart::device,
     [](AlteredRun& e) { return takes_color(e, Format::rgba8); }},
    {"color_16f", "colours blended as fp16", ChangedPart::device,
     [](AlteredRun& e) { return takes_color(e, Format::rgba16f); }},
    {"color_32f", "colours blended as binary32", ChangedPart::device,
     [](AlteredRun& e) { return takes_color(e, Format::rgba32f); }},
    {"background_lost", "the background lost: black behind the layers", ChangedPart::device,
     [](AlteredRun& e) {
         e.options.background = {0, 0, 0, 1};
         return true;
     }},
};

}  // namespace

std::span<const Mistake> mistakes_of_device() { return device_mistakes; }

}  // namespace strata::oracle
